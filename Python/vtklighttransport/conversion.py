# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Meshes of meshio as VTK's; needs numpy and meshio."""

import numpy

from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules import vtkCommonDataModel
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

# Cell arrays of integers that file formats keep regions in.
TAGS = ("gmsh:physical", "medit:ref", "cell_tags", "Region")

# Types of VTK by meshio's names for them; besides, it has VTK_LAGRANGE_TRIANGLE and the like.
CELL_TYPES = {name: getattr(vtkCommonDataModel, "VTK_" + kind) for name, kind in (
    ("vertex", "VERTEX"), ("line", "LINE"), ("line3", "QUADRATIC_EDGE"), ("line4", "CUBIC_LINE"),
    ("triangle", "TRIANGLE"), ("triangle6", "QUADRATIC_TRIANGLE"),
    ("triangle7", "BIQUADRATIC_TRIANGLE"), ("pixel", "PIXEL"), ("polygon", "POLYGON"),
    ("quad", "QUAD"), ("quad6", "QUADRATIC_LINEAR_QUAD"), ("quad8", "QUADRATIC_QUAD"),
    ("quad9", "BIQUADRATIC_QUAD"), ("tetra", "TETRA"), ("tetra10", "QUADRATIC_TETRA"),
    ("hexahedron", "HEXAHEDRON"), ("hexahedron20", "QUADRATIC_HEXAHEDRON"),
    ("hexahedron24", "BIQUADRATIC_QUADRATIC_HEXAHEDRON"),
    ("hexahedron27", "TRIQUADRATIC_HEXAHEDRON"), ("wedge", "WEDGE"),
    ("wedge12", "QUADRATIC_LINEAR_WEDGE"), ("wedge15", "QUADRATIC_WEDGE"),
    ("wedge18", "BIQUADRATIC_QUADRATIC_WEDGE"), ("pyramid", "PYRAMID"),
    ("pyramid13", "QUADRATIC_PYRAMID"), ("penta_prism", "PENTAGONAL_PRISM"),
    ("hexa_prism", "HEXAGONAL_PRISM"))}


def find_cell_type(name):
    """None where VTK has no such cells."""
    return CELL_TYPES.get(name, getattr(vtkCommonDataModel, name, None)
                          if name.startswith("VTK_") else None)


def convert_meshio(mesh):
    points = numpy.zeros((len(mesh.points), 3))
    points[:, :mesh.points.shape[1]] = mesh.points
    kept = [k for k, block in enumerate(mesh.cells)
            if find_cell_type(block.type) is not None]
    blocks = [mesh.cells[k] for k in kept]
    grid = vtkUnstructuredGrid()
    coordinates = vtkPoints()
    coordinates.SetData(numpy_support.numpy_to_vtk(points, deep=True))
    grid.SetPoints(coordinates)
    if blocks:
        set_cells(grid, blocks)
    for name, values in mesh.cell_data.items():
        add_array(grid.GetCellData(), name, numpy.concatenate([values[k] for k in kept]))
    for name, values in mesh.point_data.items():
        add_array(grid.GetPointData(), name, numpy.asarray(values))
    set_regions(grid, mesh, kept)
    return grid


def set_cells(grid, blocks):
    lengths = numpy.concatenate([numpy.full(len(block), block.data.shape[1]) for block in blocks])
    corners = numpy.concatenate([block.data.ravel() for block in blocks]).astype(numpy.int64)
    offsets = numpy.concatenate([[0], numpy.cumsum(lengths)]).astype(numpy.int64)
    kinds = numpy.concatenate(
        [numpy.full(len(block), find_cell_type(block.type)) for block in blocks])
    cells = vtkCellArray()
    cells.SetData(numpy_support.numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_support.numpy_to_vtkIdTypeArray(corners, deep=True))
    grid.SetCells(numpy_support.numpy_to_vtk(kinds.astype(numpy.uint8), deep=True), cells)


def add_array(attributes, name, values):
    if values.dtype.kind not in "iuf":
        return
    array = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def set_regions(grid, mesh, kept):
    """From the first array that is known to hold them, and the names that the mesh has for it."""
    tag = next((name for name in TAGS if name in mesh.cell_data), None)
    if tag is None:
        return
    numbers = numpy.concatenate([mesh.cell_data[tag][k] for k in kept]).astype(numpy.int32)
    add_array(grid.GetCellData(), "Region", numbers)
    named = {int(numpy.ravel(value)[0]): name for name, value in mesh.field_data.items()
             if numpy.issubdtype(numpy.asarray(value).dtype, numpy.integer)}
    if named and min(named) >= 0:
        names = vtkStringArray()
        names.SetName("RegionNames")
        for number in range(max(named) + 1):
            names.InsertNextValue(named.get(number, str(number)))
        grid.GetFieldData().AddArray(names)
