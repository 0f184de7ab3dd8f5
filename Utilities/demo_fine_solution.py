# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A fine solution to tell the errors of coarser ones by: a part of demo.py."""

import numpy

from vtklighttransport.arrays import (
    divide_triangles,
    get_cell_array,
    get_point_array,
    get_points,
    get_triangle_corners,
    make_surface,
)
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkStaticCellLocator


def get_triangles(surface):
    """Corners of the cells of a triangle mesh: cells x 3 x 3."""
    return get_points(surface)[get_triangle_corners(surface)]


def find_barycentric(corners, points):
    """Barycentric coordinates of points in the planes of triangles: n x 3."""
    a, b, c = numpy.moveaxis(corners, 1, 0)
    normal = numpy.cross(b - a, c - a)
    square = (normal**2).sum(axis=1)
    second = (numpy.cross(points - a, c - a) * normal).sum(axis=1) / square
    third = (numpy.cross(b - a, points - a) * normal).sum(axis=1) / square
    return numpy.stack([1.0 - second - third, second, third], axis=1)


def get_reflected(surface):
    """Radiosity without emission: the lamp's own light is known, and would hide other errors."""
    return get_cell_array(surface, "Radiosity") - get_cell_array(surface, "Emission")


class FineSolution:
    """A solution on many patches, to be averaged over the patches of a coarser mesh of the scene.

    Within a patch it is taken as linear: the slope of the point values about the value of the cell.
    """

    def __init__(self, surface):
        self.surface = surface
        self.corners = get_triangles(surface)
        self.regions = get_cell_array(surface, "Region")
        self.values = get_reflected(surface)
        at_corners = get_point_array(surface, "Radiosity")[get_triangle_corners(surface)]
        self.slopes = at_corners - at_corners.mean(axis=1, keepdims=True)

    def average_over(self, surface):
        """The means over the cells of another mesh, from 16 equal pieces of each cell."""
        pieces = divide_triangles(divide_triangles(surface))
        points = get_triangles(pieces).mean(axis=1)
        cells = self.find_cells(points, get_cell_array(pieces, "Region"))
        weights = find_barycentric(self.corners[cells], points)
        values = self.values[cells] + (weights[:, :, None] * self.slopes[cells]).sum(axis=1)
        return values.reshape(surface.GetNumberOfCells(), 16, -1).mean(axis=1)

    def find_cells(self, points, regions):
        """The cell of the same region that each point lies on."""
        found = numpy.empty(len(points), dtype=int)
        for region in numpy.unique(regions):
            own = numpy.flatnonzero(self.regions == region)
            part = make_surface(get_points(self.surface), get_triangle_corners(self.surface)[own])
            wanted = numpy.flatnonzero(regions == region)
            found[wanted] = own[find_closest_cells(part, points[wanted])]
        return found


def find_closest_cells(surface, points):
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    closest, generic = [0.0, 0.0, 0.0], vtkGenericCell()
    cell, sub, distance = reference(0), reference(0), reference(0.0)
    found = numpy.empty(len(points), dtype=int)
    for i, point in enumerate(points):
        locator.FindClosestPoint(point, closest, generic, cell, sub, distance)
        found[i] = cell.get()
    return found
