# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A room, or a block, of which each rank has a piece.

The room is a cube seen from inside with a bright ceiling and a block standing in it, so that what a
rank does not have throws shadows on what it has.
"""

import resource

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdTypeArray, vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from TestingTools import make_box

GHOSTS_ON_EACH_SIDE = 7
MEGABYTE = 1 << 20


def make_patches():
    return (make_box((0, 0, 0), (1, 1, 1), count=5) +
            make_box((0.3, 0.3, 0.05), (0.6, 0.7, 0.5), outside=True, count=3))


def choose_patches(case, rank, ranks, count):
    """(patch, whether it is a ghost) for each patch of a rank."""
    if case == "empty":
        return [(patch, False) for patch in range(count)] if rank == 0 else []
    begin, end = count * rank // ranks, count * (rank + 1) // ranks
    chosen = [(patch, False) for patch in range(begin, end)]
    if case == "ghosts":
        before = range(max(begin - GHOSTS_ON_EACH_SIDE, 0), begin)
        after = range(end, min(end + GHOSTS_ON_EACH_SIDE, count))
        chosen = ([(patch, True) for patch in before] + chosen + [(patch, True) for patch in after])
    return chosen


def leave_memory(count):
    """From here on this process gets no more than so many bytes."""
    with open("/proc/self/status", encoding="ascii") as status:
        used = next(int(line.split()[1]) for line in status if line.startswith("VmSize"))
    resource.setrlimit(resource.RLIMIT_AS, (used * 1024 + count, resource.RLIM_INFINITY))


def make_block(case, output):
    """Fill a vtkPolyData with this rank's piece of a lit block."""
    make_piece(case, output, make_box((-1, -1, -1), (1, 1, 1), outside=True, count=3))


def make_piece(case, output, patches=None):
    """Fill a vtkPolyData with this rank's piece of some patches, those of the room by default."""
    patches = patches or make_patches()
    controller = vtkMultiProcessController.GetGlobalController()
    rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
    points, cells = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    arrays = {"Emission": vtkDoubleArray(), "Reflectance": vtkDoubleArray(),
              "Irradiance": vtkDoubleArray(), "PatchId": vtkIdTypeArray(),
              "Rank": vtkIdTypeArray()}
    if case == "ghosts":
        arrays[vtkDataSetAttributes.GhostArrayName()] = vtkUnsignedCharArray()
    for patch, ghost in choose_patches(case, rank, ranks, len(patches)):
        cells.InsertNextCell(4)
        for corner in patches[patch]:
            cells.InsertCellPoint(points.InsertNextPoint(corner))
        ceiling = min(corner[2] for corner in patches[patch]) == 1.0
        values = (1.0 if ceiling else 0.0, 0.2 + 0.6 * (7 * patch % 11) / 11, 1.0, patch, rank,
                  vtkDataSetAttributes.DUPLICATECELL if ghost else 0)
        for array, value in zip(arrays.values(), values):
            array.InsertNextValue(value)
    if case == "error" and rank == ranks - 1:
        points.SetPoint(0, float("nan"), 0.0, 0.0)
    if case == "array" and rank == ranks - 1:
        arrays["Wrong"] = vtkDoubleArray()
        arrays["Wrong"].SetNumberOfTuples(cells.GetNumberOfCells() + 1)
    output.SetPoints(points)
    output.SetPolys(cells)
    for name, array in arrays.items():
        array.SetName(name)
        output.GetCellData().AddArray(array)
    if case == "memory" and rank == ranks - 1:
        leave_memory(MEGABYTE)
