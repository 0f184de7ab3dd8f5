# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Data sets with and without blocks, as the filters count their patches; needs numpy."""

import numpy

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes

SKIPPED = vtkDataSetAttributes.DUPLICATECELL | vtkDataSetAttributes.HIDDENCELL


def list_leaves(data):
    """The data sets with cells: the one that it is, or those in its blocks, in order."""
    if not data.IsA("vtkCompositeDataSet"):
        return [data]
    leaves = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        leaves.append(iterator.GetCurrentDataObject())
        iterator.GoToNextItem()
    return leaves


def gather_cell_array(data, name):
    """Values of the patches: of all blocks, of polygons alone, without ghosts. KeyError where
    there is no such array."""
    parts = []
    for leaf in list_leaves(data):
        array = leaf.GetCellData().GetArray(name)
        if array is not None:
            parts.append(vtk_to_numpy(array)[find_patches(leaf)])
        elif leaf.GetNumberOfCells():
            raise KeyError(name)
    return numpy.concatenate(parts) if parts else numpy.zeros(0)


def find_patches(surface):
    """The numbers of the cells that are patches."""
    first = surface.GetNumberOfVerts() + surface.GetNumberOfLines()
    cells = numpy.arange(first, first + surface.GetNumberOfPolys())
    ghosts = surface.GetCellGhostArray()
    return cells if ghosts is None else cells[vtk_to_numpy(ghosts)[cells] & SKIPPED == 0]
