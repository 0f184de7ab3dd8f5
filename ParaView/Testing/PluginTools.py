# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the plugin's tests share. Imported first, it loads the plugin."""

import os
import sys

from paraview import simple

from TestingTools import get_tuples

simple.LoadPlugin(os.environ["LIGHT_TRANSPORT_PLUGIN"], remote=False, ns=vars(simple))


def get_data(name):
    return os.path.join(os.environ["LIGHT_TRANSPORT_DATA"], name)


def make_source(make, case):
    """Of polygons, a piece on each rank, by a function of ParallelScene.py."""
    folder = os.path.dirname(os.path.abspath(__file__))
    return simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData",
        Script=f"""
import sys
sys.path.insert(0, {folder!r})
sys.dont_write_bytecode = True
import ParallelScene
ParallelScene.{make}({case!r}, self.GetPolyDataOutput())
""",
        ScriptRequestInformation="""
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
self.GetOutputInformation(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
""")


def finish(problems):
    """pvpython's exit code says nothing after an exception, so it is set here."""
    for problem in problems:
        print("FAILED: " + problem, file=sys.stderr)
    sys.stderr.flush()
    os._exit(1 if problems else 0)


def get_arrays(attributes):
    return {attributes.GetAbstractArray(i).GetName(): attributes.GetAbstractArray(i)
            for i in range(attributes.GetNumberOfArrays())}


def get_summary(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return array.GetValue(0) if array else None


def compare_arrays(name, expected, found, tolerance):
    """The problem, or None: largest difference relative to the largest value."""
    if found is None:
        return f"{name} is missing"
    if (expected.GetNumberOfTuples(), expected.GetNumberOfComponents()) != (
            found.GetNumberOfTuples(), found.GetNumberOfComponents()):
        return f"{name} has another size"
    largest = 0.0
    difference = 0.0
    for one, other in zip(get_tuples(expected), get_tuples(found)):
        for a, b in zip(one, other):
            largest = max(largest, abs(a))
            # Not max(): it would pass over a NaN.
            if not abs(a - b) <= difference:
                difference = abs(a - b)
    if not difference <= tolerance * largest:
        return f"{name} differs by {difference} where its largest value is {largest}"
    return None
