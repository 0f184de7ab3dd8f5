# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The representation "Subsurface": a bunny that is made translucent, turned, changed, put back.

Without a display: the project's own off-screen window is ParaView's before the first view.
"""

import vtklighttransport as lt
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

PROBLEMS = []


def check(good, problem):
    if not good:
        PROBLEMS.append(problem)


def draw():
    simple.Render(view)
    image = view.SMProxy.CaptureWindow(1)
    return vtk_to_numpy(image.GetPointData().GetScalars())[:, :3].astype(float)


def get_mean():
    return draw().mean(axis=0)


def get_pass():
    """That of the view, below the one that sets the camera."""
    steps = view.GetClientSideObject().GetRenderer().GetPass()
    while steps and not steps.IsA("vtkSubsurfaceScatteringPass"):
        steps = steps.GetDelegatePass() if hasattr(steps, "GetDelegatePass") else None
    return steps


def get_runs():
    steps = get_pass()
    return steps.GetNumberOfLinkRuns(), steps.GetNumberOfIrradianceRuns()


assert lt.vtkOffScreenOpenGLRenderWindow.RegisterAsDefault()
import PluginTools as tools  # noqa: E402
from paraview import simple  # noqa: E402

reader = simple.PLYReader(FileNames=[tools.get_data("bunny.ply")])
atlas = simple.SurfaceAtlas(Input=reader)
view = simple.CreateRenderView(ViewSize=[100, 100], OrientationAxesVisibility=0)
view.UseFXAA = 0
view.UseColorPaletteForBackground = 0
view.Background = [0.0, 0.0, 0.0]
display = simple.Show(atlas, view)
display.ColorArrayName = [None, ""]
# A light of the scene, and none that follow the camera.
view.UseLight = 0
light = simple.AddLight(view=view)
light.Coords = "Scene"
light.Position = [30.0, 30.0, 30.0]
view.ResetCamera()
surface = draw()

display.SetRepresentationType("Subsurface")
display.SubsurfaceMillimetersPerUnit = 10.0
display.SubsurfaceScatteredMapSize = "64"
display.SubsurfaceExposure = 4.0
display.Specular = 0.0
bright = get_mean()
check(bright.min() > 5.0, f"the bunny is dark: {bright}")
check(get_runs() == (1, 1), f"one body, and runs of {get_runs()}")

view.GetActiveCamera().Azimuth(120.0)
turned = get_mean()
check(get_runs() == (1, 1), "the view turned, and something is computed again")
check(turned.min() > 1.0, f"no light comes through: {turned}")
display.Specular = 1.0
display.SpecularPower = 1.0
reflected = get_mean() - turned
display.SubsurfaceDirectShadows = 1
shadowed = get_mean() - turned
check(0.5 * reflected[0] < shadowed[0] < 0.98 * reflected[0],
      f"a reflection of {reflected}, with shadows {shadowed}")
display.SubsurfaceDirectShadows = 0
display.Specular = 0.0
light.Position = [40.0, 10.0, -25.0]
check(get_mean().min() > turned.min(), "the light came to this side, and it is darker")
check(get_runs() == (1, 2), f"a light moved: runs of {get_runs()}")

display.SubsurfaceMeanFreePath = 2.0
draw()
check(get_runs() == (2, 2), f"another mean free path: runs of {get_runs()}")
before = get_mean()
display.SubsurfaceAlbedoColor = [1.0, 0.99, 0.95]
after = get_mean()
check(after[0] > after[1] > after[2], f"an albedo of red to blue gives {after}")
check(abs(after[0] - before[0]) < 0.02 * before[0], "the red changed with the others' albedo")

# Several images at once: the view puts a pass of its own around.
view.UseFXAA = 1
check(abs(get_mean()[0] - after[0]) < 0.05 * after[0], "another picture with FXAA")
view.UseFXAA = 0
simple.Hide(atlas, view)
check(draw().max() == 0.0, "hidden, and something is seen")
check(get_pass() is None, "hidden, and its pass stays")
simple.Show(atlas, view)
check(abs(get_mean()[0] - after[0]) < 0.01 * after[0], "another picture after it was hidden")

# A pass that is not known: the surface is drawn with the colours that it had.
renderer = view.GetClientSideObject().GetRenderer()
before = renderer.GetPass()
renderer.SetPass(vtkRenderStepsPass())
check(get_mean().min() > 1.0, "with another pass the surface is dark")
renderer.SetPass(before)
check(abs(get_mean()[0] - after[0]) < 0.01 * after[0], "another picture after another pass")

display.SetRepresentationType("Surface")
display.Specular = 0.0
light.Position = [30.0, 30.0, 30.0]
view.GetActiveCamera().Azimuth(-120.0)
difference = abs(draw() - surface)
check(difference.mean() < 0.5, f"the surface differs by {difference.mean()}, {difference.max()}")
simple.Delete(view)
tools.finish(PROBLEMS)
