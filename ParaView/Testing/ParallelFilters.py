# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What TestParallel.py runs in pvbatch: the filters on the room of ParallelScene.py.

The first rank gathers the results and writes them.
"""

import os
import sys

from PluginTools import make_source  # loads the plugin

from paraview import simple
from TestingTools import write_surface

case, folder = sys.argv[1:]
source = make_source("make_piece", case)
irradiance = simple.DirectIrradiance(Input=source, RefractiveIndex=1.3)
irradiance.Light1 = "Point Light"
irradiance.Light1.Position = [0.5, 0.5, 0.8]
scattering = simple.SubsurfaceScattering(
    Input=irradiance, Device="CPU", Incidence="Transmitted", MillimetersPerUnit=10.0)
results = {
    "radiosity": simple.Radiosity(Input=source, Device="CPU", Tolerance=1e-10),
    "scattering": simple.ViewFactors(Input=scattering)}
if case in ("split", "empty", "ghosts"):
    results["sampled"] = simple.Radiosity(
        Input=source, Device="CPU", Tolerance=1e-10, LinkMethod="Sampled", ComputeErrors=1)
for name, result in results.items():
    result.UpdatePipeline()
    write_surface(os.path.join(folder, name + ".vtp"), simple.servermanager.Fetch(result))
print("the script came to its end", flush=True)
