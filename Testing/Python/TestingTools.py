# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces for tests, and what is in them; needs neither the package nor the plugin."""

import os
import tempfile
import unittest

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

# Of a cube seen from inside, whose corner number c is at (c & 1, c >> 1 & 1, c >> 2).
CUBE_FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
CUBE_CORNERS = [(corner & 1, corner >> 1 & 1, corner >> 2) for corner in range(8)]


class FolderTestCase(unittest.TestCase):
    """Tests with an empty folder of their own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)


def make_box(low, high, outside=False, count=1):
    """The polygons of a box: two faces for each axis, of count x count patches."""
    polygons = []
    for axis in range(3):
        for end in (0, 1):
            for i in range(count):
                for j in range(count):
                    square = []
                    for steps in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        corner = [0.0, 0.0, 0.0]
                        corner[axis] = (low, high)[end][axis]
                        for place, step in zip(((axis + 1) % 3, (axis + 2) % 3), steps):
                            corner[place] = low[place] + (high[place] - low[place]) * step / count
                        square.append(corner)
                    polygons.append(square if (end == 1) == outside else square[::-1])
    return polygons


def make_surface(polygons):
    """From lists of corners; each polygon has its own points."""
    corners = [corner for polygon in polygons for corner in polygon]
    ids = iter(range(len(corners)))
    return join_points(corners, [[next(ids) for _ in polygon] for polygon in polygons])


def join_points(corners, polygons):
    """From points, and lists of their numbers."""
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for corner in corners:
        points.InsertNextPoint(corner)
    cells = vtkCellArray()
    for polygon in polygons:
        cells.InsertNextCell(len(polygon), polygon)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def add_array(surface, name, values, components=1):
    """A cell array, the same value in all components; returns the surface."""
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    for value in values:
        array.InsertNextTuple((value,) * components)
    surface.GetCellData().AddArray(array)
    return surface


def get_tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def write_surface(file, surface):
    """Whether it could be written."""
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    # Encoded: with the libexpat1 of Debian 12's security updates VTK 9.2 cannot read raw files.
    writer.SetDataModeToBinary()
    writer.SetFileName(file)
    return writer.Write() == 1


def read_surface(file):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def read_picture(file):
    """Values from 0 to 255: rows x columns x colours. Needs numpy."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    reader = vtkPNGReader()
    reader.SetFileName(file)
    reader.Update()
    columns, rows, _ = reader.GetOutput().GetDimensions()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return values.reshape(rows, columns, -1)[:, :, :3].astype(int)
