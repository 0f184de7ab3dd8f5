# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The representation "Subsurface" where several ranks render: the surface is drawn as usual."""

import PluginTools as tools
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def draw():
    simple.Render(view)
    image = view.SMProxy.CaptureWindow(1)
    return vtk_to_numpy(image.GetPointData().GetScalars())[:, :3].astype(float)


reader = simple.PLYReader(FileNames=[tools.get_data("bunny.ply")])
atlas = simple.SurfaceAtlas(Input=reader)
view = simple.CreateRenderView(ViewSize=[100, 100], OrientationAxesVisibility=0)
view.UseColorPaletteForBackground = 0
view.Background = [0.0, 0.0, 0.0]
display = simple.Show(atlas, view)
display.ColorArrayName = [None, ""]
view.ResetCamera()
usual = draw()
display.SetRepresentationType("Subsurface")
problems = []
if usual.mean() < 5.0:
    problems.append(f"the bunny is dark: {usual.mean()}")
if abs(draw() - usual).max() > 1.0:
    problems.append("a surface that several ranks render is not drawn as usual")
# The other ranks are waited for, unless something is wrong.
if problems:
    tools.finish(problems)
