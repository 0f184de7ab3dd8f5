# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What TestParallel.py runs in pvbatch: photons in a block of which each rank has a piece, and an
image of its medium, which a source gives each rank as it asks for it; in the case `pieces` no more
than a piece. Then the profile of a table whose photons the ranks share.

The first rank gathers the results and writes them.
"""

import os
import sys

from PluginTools import make_source  # loads the plugin

from paraview import simple
from TestingTools import write_surface

case, folder = sys.argv[1:]
body = make_source("make_block", case)
if case == "pieces":
    image = simple.ProgrammableSource(
        OutputDataSetType="vtkImageData",
        Script="""
from vtkmodules.vtkParallelCore import vtkMultiProcessController
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
self.GetImageDataOutput().SetExtent(-2, 2, -2, 2, rank, rank + 1)
""",
        ScriptRequestInformation="""
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
self.GetOutputInformation(0).Set(pipeline.WHOLE_EXTENT(), (-2, 2, -2, 2, -2, 2), 6)
""")
else:
    image = simple.Wavelet(WholeExtent=[-2, 2, -2, 2, -2, 2])
medium = simple.Calculator(
    Input=image, ResultArrayName="Scattering",
    Function="2 + coordsX" if case == "pieces" else "0.01 * RTData")
results = {
    "photons": simple.SubsurfaceScattering(
        Input=body, Medium=medium, Model="Monte Carlo", NumberOfPhotons=5000),
    "table": simple.SubsurfaceScattering(
        Input=body, Model="Tabulated", NumberOfPhotons=5000, Device="CPU")}
for name, result in results.items():
    result.UpdatePipeline()
    write_surface(os.path.join(folder, name + ".vtp"), simple.servermanager.Fetch(result))
print("the script came to its end", flush=True)
