# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Numbers into data sets and out of them, with numpy; the rest of the package does without it."""

import math

import numpy

from vtklighttransport.summaries import get_summary
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

__all__ = [
    "divide_triangles", "get_area_vectors", "get_areas", "get_cell_array", "get_point_array",
    "get_points", "get_summary", "get_triangle_corners", "make_surface", "relative_error",
    "set_cell_array"]


def make_surface(points, polygons):
    """A vtkPolyData from points (n x 3) and polygons (rows of point ids, all equally long)."""
    coordinates = numpy.ascontiguousarray(points, dtype=numpy.float64)
    corners = numpy.ascontiguousarray(polygons, dtype=numpy.int64)
    if coordinates.ndim != 2 or coordinates.shape[1] != 3 or corners.ndim != 2:
        raise ValueError("points must be n x 3 and polygons m x corners")
    vtk_points = vtkPoints()
    vtk_points.SetData(numpy_support.numpy_to_vtk(coordinates, deep=True))
    cells = vtkCellArray()
    offsets = numpy.arange(0, corners.size + 1, corners.shape[1], dtype=numpy.int64)
    cells.SetData(
        numpy_support.numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_support.numpy_to_vtkIdTypeArray(corners.ravel(), deep=True),
    )
    surface = vtkPolyData()
    surface.SetPoints(vtk_points)
    surface.SetPolys(cells)
    return surface


def set_cell_array(surface, name, values):
    """Add a cell array: one value or row per cell, or one for all cells."""
    count = surface.GetNumberOfCells()
    rows = numpy.asarray(values, dtype=numpy.float64)
    if rows.ndim == 0 or rows.shape[0] != count:
        rows = numpy.broadcast_to(rows, (count,) + rows.shape)
    array = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(rows), deep=True)
    array.SetName(name)
    surface.GetCellData().AddArray(array)


def get_cell_array(surface, name):
    """A cell array as numpy array; KeyError where there is none of that name."""
    return _get(surface.GetCellData(), name)


def get_point_array(surface, name):
    """A point array as numpy array; KeyError where there is none of that name."""
    return _get(surface.GetPointData(), name)


def get_points(surface):
    """Coordinates in double precision: n x 3."""
    return numpy_support.vtk_to_numpy(surface.GetPoints().GetData()).astype(float)


def get_triangle_corners(surface):
    """Point ids of the cells of a triangle mesh: cells x 3."""
    return numpy_support.vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def get_area_vectors(surface):
    """Of each polygon its area along its normal (n x 3), by Newell's formula."""
    polygons = surface.GetPolys()
    corners = get_points(surface)[numpy_support.vtk_to_numpy(polygons.GetConnectivityArray())]
    offsets = numpy_support.vtk_to_numpy(polygons.GetOffsetsArray())
    following = numpy.arange(1, len(corners) + 1)
    following[offsets[1:] - 1] = offsets[:-1]
    # About a corner of the polygon, so that nothing cancels far from the origin.
    corners = corners - numpy.repeat(corners[offsets[:-1]], numpy.diff(offsets), axis=0)
    parts = numpy.cross(corners, corners[following])
    return 0.5 * numpy.add.reduceat(parts, offsets[:-1], axis=0)


def get_areas(surface):
    """The area of each polygon."""
    return numpy.linalg.norm(get_area_vectors(surface), axis=1)


def relative_error(values, exact, areas):
    """Root mean square over the area and the components, relative to that of the exact values."""
    weights = areas[:, None]
    square = (weights * exact ** 2).sum()
    return math.sqrt((weights * (values - exact) ** 2).sum() / (square or 1.0))


def divide_triangles(surface):
    """Each triangle in four, by the middles of its edges, in the order of the input.

    Cell arrays are carried along. Neighbours share the new points. Any surface will do, also where
    more than two triangles meet.
    """
    points = get_points(surface)
    corners = get_triangle_corners(surface)
    edges = numpy.sort(numpy.stack([corners, numpy.roll(corners, -1, axis=1)], axis=2), axis=2)
    ends, middles = numpy.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    a, b, c = corners.T
    ab, bc, ca = middles.reshape(-1, 3).T + len(points)
    parts = [a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca]
    finer = make_surface(numpy.concatenate([points, points[ends].mean(axis=1)]),
                         numpy.stack(parts, axis=1).reshape(-1, 3))
    data = surface.GetCellData()
    for index in range(data.GetNumberOfArrays()):
        array = data.GetArray(index)
        if array is not None:
            values = numpy.repeat(numpy_support.vtk_to_numpy(array), 4, axis=0)
            copy = numpy_support.numpy_to_vtk(values, deep=True)
            copy.SetName(array.GetName())
            finer.GetCellData().AddArray(copy)
    return finer


def _get(attributes, name):
    array = attributes.GetArray(name)
    if array is None:
        raise KeyError(name)
    return numpy_support.vtk_to_numpy(array)
