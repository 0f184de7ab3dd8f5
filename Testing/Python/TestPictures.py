# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""TestPictures.py CASE BASELINE OUTPUT: draws one picture and compares it with its baseline.

Renderers differ by a grey level here and there, and along edges; so two numbers are compared: the
mean difference of all values, which a wrong brightness raises, and the share of pixels that are
clearly different, which a wrong shape raises.
"""

import os
import sys

import numpy

import vtklighttransport as lt
from vtklighttransport.lights import make_light

import demo_pictures
from demo_bunny import FROM_BEHIND, FROM_FRONT, Translucent, read_bunny
from demo_cornell_box import RadiosityScene
from TestingTools import read_picture

SIZE = 256

# Of 255.
LARGEST_MEAN_DIFFERENCE = 1.0
CLEAR_DIFFERENCE = 24
LARGEST_CLEAR_SHARE = 0.005


def solve_cornell_box():
    scene = RadiosityScene(500)
    surface, _ = scene.solve(lt.vtkRadiosity.SOLVER_AUTO, lt.vtkRadiosity.DEVICE_CPU, 1e-6)
    return surface


def draw_cornell_box(file):
    demo_pictures.render_cornell_box(file, solve_cornell_box(), SIZE)


def draw_cornell_box_solving(file):
    """By shots on the GPU, whole in the first frame."""
    scene = RadiosityScene(500)
    radiosity = lt.vtkRadiosity()
    radiosity.SetSolverToSouthwell()
    radiosity.SetDeviceToOpenGL()
    radiosity.SetTolerance(1e-2)
    demo_pictures.render_cornell_box_while_solving(file, scene.surface, radiosity, SIZE // 2)


def draw_colored_by_array(file):
    demo_pictures.render_colored_by_array(
        file,
        solve_cornell_box(),
        "Irradiance",
        (0.0, 1.0),
        demo_pictures.look_into_cornell_box,
        SIZE,
    )


def draw_bunny(file):
    marble = Translucent(lt.vtkSubsurfaceScattering.MATERIAL_MARBLE)
    lit, _ = marble.light(read_bunny(), FROM_FRONT)
    surface, _ = marble.scatter(lit, marble.filter.DEVICE_CPU)
    light = make_light(FROM_FRONT)
    demo_pictures.render_bunny(file, surface, marble.refractive_index, light, SIZE)


def draw_bunny_scattering(file):
    """On the GPU, while it is drawn; light from behind."""
    mesher = lt.vtkPatchMesher()
    mesher.SetInputData(read_bunny())
    mesher.SetTargetNumberOfPatches(1500)
    atlas = lt.vtkSurfaceAtlas()
    atlas.SetInputConnection(mesher.GetOutputPort())
    atlas.SetResolution(64)
    atlas.Update()
    material = lt.vtkSubsurfaceScattering()
    material.SetMaterialToMarble()
    material.SetMillimetersPerUnit(3.0)
    material.SetLinkMethodToAdaptive()
    light = make_light(FROM_BEHIND)
    demo_pictures.render_bunny_while_scattering(
        file, atlas.GetOutput(), material, light, SIZE // 2)


CASES = {
    "CornellBox": draw_cornell_box,
    "CornellBoxWhileSolving": draw_cornell_box_solving,
    "ColoredByArray": draw_colored_by_array,
    "BunnyDirectAndScattered": draw_bunny,
    "BunnyScatteredWhileDrawn": draw_bunny_scattering,
}


def compare(picture, baseline):
    if picture.shape != baseline.shape:
        print(f"The picture has the shape {picture.shape}, the baseline {baseline.shape}.")
        return False
    difference = numpy.abs(picture - baseline)
    mean = difference.mean()
    share = (difference.max(axis=2) > CLEAR_DIFFERENCE).mean()
    print(f"mean difference {mean:.3f} of 255 (at most {LARGEST_MEAN_DIFFERENCE})")
    print(f"pixels off by more than {CLEAR_DIFFERENCE}: {share:.4%}"
          f" (at most {LARGEST_CLEAR_SHARE:.2%})")
    return mean <= LARGEST_MEAN_DIFFERENCE and share <= LARGEST_CLEAR_SHARE


def main(case, baseline, output):
    CASES[case](output)
    if not os.path.isfile(baseline):
        print(f"There is no baseline {baseline}.")
        print(f"The picture is in {output}: look at it, then copy it there.")
        return 1
    if not compare(read_picture(output), read_picture(baseline)):
        print(f"{output} differs from {baseline}.")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
