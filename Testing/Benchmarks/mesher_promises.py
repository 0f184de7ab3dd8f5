#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What vtkPatchMesher keeps of a surface, a row for each mesh: pairs of triangles of one component
that cross, pieces and edges at borders, before and after, patches, and seconds of the processor.

    mesher_promises.py MESH...      .off, .ply, .vtp; self-intersections of the meshes are kept
"""

import sys
import time

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataConnectivityFilter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
import numpy
import vtklighttransport as lt


def read_off(path):
    with open(path, encoding="utf-8") as file:
        words = [word for line in file for word in line.split("#")[0].split()]
    size, number = int(words[1]), int(words[2])
    points = vtkPoints()
    place = 4 + 3 * size
    coordinates = numpy.array(words[4:place], float).reshape(-1, 3)
    points.SetData(numpy_to_vtk(coordinates, deep=True))
    cells = vtkCellArray()
    for _ in range(number):
        corners = int(words[place])
        first, place = place + 1, place + 1 + corners
        cells.InsertNextCell(corners, [int(word) for word in words[first:place]])
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def read(path):
    if path.endswith(".off"):
        return read_off(path)
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def count_borders(surface):
    edges = vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.FeatureEdgesOff()
    edges.NonManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def count_pieces(surface):
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetInputData(surface)
    pieces.SetExtractionModeToAllRegions()
    pieces.Update()
    return pieces.GetNumberOfExtractedRegions()


def get(surface, name):
    array = surface.GetFieldData().GetArray(name)
    return int(vtk_to_numpy(array)[0]) if array else -1


def main():
    titles = ("patches", "crossings", "after", "pieces", "after", "borders", "after", "CPU s")
    print("mesh".ljust(22), "triangles", *(f"{title:>9}" for title in titles))
    for path in sys.argv[1:]:
        surface = read(path)
        mesher = lt.vtkPatchMesher()
        mesher.SetInputData(surface)
        mesher.SetSelfIntersectionsToKeep()
        start = time.process_time()
        mesher.Update()
        seconds = time.process_time() - start
        patches = mesher.GetOutput()
        numbers = (
            surface.GetNumberOfCells(),
            patches.GetNumberOfCells(),
            get(patches, "NumberOfInputSelfIntersections"),
            get(patches, "NumberOfSelfIntersections"),
            count_pieces(surface),
            count_pieces(patches),
            count_borders(surface),
            count_borders(patches),
        )
        name = path.split("/")[-1].ljust(22)
        print(name, *(f"{number:>9}" for number in numbers), f"{seconds:9.2f}", flush=True)


if __name__ == "__main__":
    main()
