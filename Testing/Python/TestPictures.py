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
from vtkmodules.numpy_interface import dataset_adapter as dsa
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkTexture

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


def make_bunny_with_atlas():
    mesher = lt.vtkPatchMesher()
    mesher.SetInputData(read_bunny())
    mesher.SetTargetNumberOfPatches(1500)
    atlas = lt.vtkSurfaceAtlas()
    atlas.SetInputConnection(mesher.GetOutputPort())
    atlas.SetResolution(64)
    atlas.Update()
    return atlas.GetOutput()


def make_marble(millimeters_per_unit=3.0):
    material = lt.vtkSubsurfaceScattering()
    material.SetMaterialToMarble()
    material.SetMillimetersPerUnit(millimeters_per_unit)
    material.SetLinkMethodToAdaptive()
    return material


def draw_bunny_scattering(file):
    """On the GPU, while it is drawn; light from behind."""
    demo_pictures.render_bunny_while_scattering(
        file, make_bunny_with_atlas(), make_marble(), make_light(FROM_BEHIND), SIZE // 2)


def make_sky(size=32):
    """A blue sky with a warm sun over the left ear, and a dim floor; +z is up."""
    latitude, longitude = numpy.mgrid[0:size, 0:2 * size] + 0.5
    latitude = (latitude / size - 0.5) * numpy.pi
    longitude = longitude / size * numpy.pi
    places = numpy.stack((numpy.cos(latitude) * numpy.cos(longitude),
                          numpy.cos(latitude) * numpy.sin(longitude),
                          numpy.sin(latitude)), axis=-1)
    sun = 12.0 * numpy.exp(30.0 * (places @ (-0.6, 0.0, 0.8) - 1.0))
    up = 0.5 + 0.5 * places[..., 2]
    radiance = numpy.stack((0.05 + 0.2 * up + sun, 0.05 + 0.3 * up + 0.7 * sun,
                            0.04 + 0.6 * up + 0.3 * sun), axis=-1)
    sky = vtkImageData()
    sky.SetDimensions(2 * size, size, 1)
    sky.GetPointData().SetScalars(numpy_to_vtk(0.4 * radiance.reshape(-1, 3), deep=True))
    return sky


# Of a bunny in a sky, or lit from the front.
EXPOSURE = 2.5


def draw_bunny_in_sky(file, set_up, surface=None, bumps=None, millimeters_per_unit=3.0):
    """Without lights; the bunny's up is +y."""
    lighting = lt.vtkSurfaceLighting()
    lighting.RendererLightsOff()
    lighting.SetEnvironmentUp(0.0, 1.0, 0.0)
    lighting.SetEnvironment(make_sky())
    set_up(lighting)
    demo_pictures.render_bunny_while_scattering(
        file, surface or make_bunny_with_atlas(), make_marble(millimeters_per_unit),
        make_light(FROM_FRONT), SIZE // 2, EXPOSURE, lighting, bumps)


def draw_harmonics(file):
    draw_bunny_in_sky(file, lambda lighting: lighting.SetEnvironmentMethodToHarmonics())


def draw_directions(file):
    def set_up(lighting):
        lighting.SetEnvironmentMethodToDirections()
        lighting.SetNumberOfEnvironmentDirections(48)
    draw_bunny_in_sky(file, set_up)


def draw_transfer(file):
    transfer = lt.vtkRadianceTransfer()
    transfer.SetInputData(make_bunny_with_atlas())
    transfer.SetRefractiveIndex(1.5)
    transfer.Update()
    draw_bunny_in_sky(file, lambda lighting: lighting.SetEnvironmentMethodToTransfer(),
                      transfer.GetOutput())


def draw_array(file):
    """The height as irradiance."""
    surface = make_bunny_with_atlas()
    points = dsa.WrapDataObject(surface)
    points.PointData.append(0.1 * points.Points[:, 1], "Height")

    def set_up(lighting):
        lighting.SetEnvironment(None)
        lighting.SetIrradianceArray("Height")
    draw_bunny_in_sky(file, set_up, surface)


def draw_at_corners(file):
    def set_up(lighting):
        lighting.SetEnvironment(None)
        lighting.RendererLightsOn()
        lighting.AtCornersOn()
    draw_bunny_in_sky(file, set_up)


def draw_bumps(file):
    """Waves over the bunny's height; it is so large that light does not level them out."""
    surface = make_bunny_with_atlas()
    wrapped = dsa.WrapDataObject(surface)
    x, y, z = wrapped.Points.T
    zero = numpy.zeros_like(x)
    wrapped.PointData.append(numpy.stack((zero, 0.4 * y), axis=-1), "Height")
    wrapped.PointData.append(numpy.stack((z, zero, -x), axis=-1) + 1e-3, "Around")
    surface.GetPointData().SetActiveTCoords("Height")
    surface.GetPointData().SetActiveTangents("Around")
    angle = numpy.arange(64) / 64 * 2.0 * numpy.pi
    normals = numpy.stack((zero[:64], 0.7 * numpy.sin(angle), zero[:64] + 0.7), axis=-1)
    image = vtkImageData()
    image.SetDimensions(2, 64, 1)
    image.GetPointData().SetScalars(
        numpy_to_vtk(
            numpy.repeat(127.5 * (1.0 + normals), 2, axis=0).astype(numpy.uint8), deep=True))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.RepeatOn()
    texture.InterpolateOn()

    def set_up(lighting):
        lighting.SetEnvironment(None)
        lighting.RendererLightsOn()
    draw_bunny_in_sky(file, set_up, surface, texture, 30.0)


CASES = {
    "CornellBox": draw_cornell_box,
    "CornellBoxWhileSolving": draw_cornell_box_solving,
    "ColoredByArray": draw_colored_by_array,
    "BunnyDirectAndScattered": draw_bunny,
    "BunnyScatteredWhileDrawn": draw_bunny_scattering,
    "BunnyInHarmonics": draw_harmonics,
    "BunnyInDirections": draw_directions,
    "BunnyInTransfer": draw_transfer,
    "BunnyInArray": draw_array,
    "BunnyAtCorners": draw_at_corners,
    "BunnyWithBumps": draw_bumps,
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
