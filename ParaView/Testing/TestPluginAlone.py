# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Only the plugin is loaded, and there is no display.

Device = OpenGL computes on OpenGL, and what the CPU computes.
"""

import PluginTools as tools

import sys

from paraview import simple

problems = []
if "vtklighttransport" in sys.modules:
    problems.append("the Python package is loaded: this is no test of the plugin alone")
reader = simple.XMLPolyDataReader(FileName=[tools.get_data("cornell_box.vtp")])
triangles = simple.Triangulate(Input=reader)
cpu = simple.servermanager.Fetch(
    simple.Radiosity(Input=triangles, Device="CPU", Solver="Jacobi", Tolerance=1e-6))
opengl = simple.servermanager.Fetch(
    simple.Radiosity(Input=triangles, Device="OpenGL", Solver="Jacobi", Tolerance=1e-6))
if not str(tools.get_summary(opengl, "DeviceUsed")).startswith("OpenGL"):
    problems.append(f"it ran on {tools.get_summary(opengl, 'DeviceUsed')}")
if tools.get_summary(cpu, "DeviceUsed") != "CPU":
    problems.append(f"the reference ran on {tools.get_summary(cpu, 'DeviceUsed')}")
for name in ("Radiosity", "Irradiance", "NetFlux"):
    problems.append(tools.compare_arrays(
        name, cpu.GetCellData().GetArray(name), opengl.GetCellData().GetArray(name), 1e-5))
tools.finish([problem for problem in problems if problem])
