# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What TestParallel.py runs in pvbatch: radiosity of the room of ParallelScene.py, gathered and written by the first rank."""

import os
import sys

import PluginTools  # noqa: F401 (loads the plugin)

from paraview import simple
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

# Not `output`: the programmable source deletes that name.
case, target = sys.argv[1:]
folder = os.path.dirname(os.path.abspath(__file__))
source = simple.ProgrammableSource(
    OutputDataSetType="vtkPolyData",
    Script=f"""
import sys
sys.path.insert(0, {folder!r})
sys.dont_write_bytecode = True
import ParallelScene
ParallelScene.make_piece({case!r}, self.GetPolyDataOutput())
""",
    ScriptRequestInformation="""
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
self.GetOutputInformation(0).Set(vtkAlgorithm.CAN_HANDLE_PIECE_REQUEST(), 1)
""")
radiosity = simple.Radiosity(Input=source, Device="CPU", Tolerance=1e-10)
radiosity.UpdatePipeline()
writer = vtkXMLPolyDataWriter()
writer.SetInputData(simple.servermanager.Fetch(radiosity))
writer.SetFileName(target)
writer.Write()
print("the script came to its end", flush=True)
