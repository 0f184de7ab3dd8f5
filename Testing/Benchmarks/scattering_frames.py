#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering while drawing: error and time over the sizes of both maps, and frame times by step.

    scattering_frames.py sizes [--entering 128,256,512,1024] [--leaving 64,128,256] [--filter]
    scattering_frames.py frames [--sizes 512,1024] [--links 16,64] [--patches 6000]
                                [--plain PROGRAM]
    scattering_frames.py single [--patches 6000] [--steps 4,8,16,32]

`sizes` compares both maps, on the triangles, with vtkDirectIrradiance and vtkSubsurfaceScattering
on these triangles, each divided into 16: no atlas, no texels, no GPU; with and without shadows.
Links are so fine (LinkTolerance 3e-3, at most 256) that they are not what is off. Of the largest
size of what leaves with --filter also with vtkSubsurfaceScattering on the texel image of the same
map (all links the same). `frames` draws sizes x sizes pixels with maps of that size, step by step
after the light has moved: what enters (with its shadow map), what leaves, the picture. The bunny
of marble, 1 unit is 3 mm, a directional light; CPU seconds of the process, medians. PROGRAM is
ScatteringProductBenchmark: what a plain shader takes that reads as many bytes as these links have.
`single` marches single scattering alone (SingleScattering Only), 512 x 512 pixels, of marble and
of the same with a hundredth of its coefficients: a frame where the camera moves, and the error of a
picture against that of the most steps, relative L2 of its bytes.
"""

import argparse
import pathlib
import subprocess
import sys
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkRenderingCore import vtkLight, vtkRenderer

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "Python" / "Examples"))
from translucent_bunny import (  # noqa: E402 (found by the line before)
    BUNNY, MIDDLE, look_at_bunny, make_actor, make_surface)

FRAMES = 5


class Scene:
    def __init__(self, surface, pixels, entering, leaving, method, links, compress=False):
        self.surface = surface
        self.actor = make_actor(surface)
        self.material = lt.vtkSubsurfaceScattering()
        self.material.SetMaterialToMarble()
        self.material.SetMillimetersPerUnit(3.0)
        getattr(self.material, f"SetLinkMethodTo{method}")()
        self.material.SetNumberOfLinks(links)
        self.material.SetCompressLinks(compress)
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetFocalPoint(*MIDDLE)
        self.scattering = lt.vtkSubsurfaceScatteringPass()
        self.scattering.SetMaterial(self.actor, self.material)
        self.scattering.SetIrradianceMapSize(entering)
        self.scattering.SetScatteredMapSize(leaving)
        self.renderer = vtkRenderer()
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(self.light)
        self.renderer.AddActor(self.actor)
        self.renderer.SetPass(self.scattering)
        self.window = lt.vtkOffScreenOpenGLRenderWindow()
        self.window.SetMultiSamples(0)
        self.window.SetSize(pixels, pixels)
        self.window.AddRenderer(self.renderer)
        look_at_bunny(self.renderer)
        self.turn = 0.7
        self.put_light()

    def put_light(self):
        self.light.SetPosition(MIDDLE[0] + 20.0 * np.sin(self.turn), MIDDLE[1] + 14.0,
                               MIDDLE[2] + 20.0 * np.cos(self.turn))

    def draw(self):
        return self.time(self.window.Render)

    def get_frame(self, change):
        """The median of frames, each after a change."""
        seconds = []
        for _ in range(FRAMES):
            change()
            seconds.append(self.draw())
        return float(np.median(seconds))

    def get_steps(self):
        """Medians of what enters, what leaves and the picture, each time after the light has
        moved."""
        entering = self.scattering.GetTransmittedMap(self.actor)
        leaving = self.scattering.GetScatteredMap(self.actor)
        steps = (lambda: entering.Update(self.actor, self.renderer),
                 lambda: leaving.Update(entering), self.window.Render)
        seconds = []
        for _ in range(FRAMES):
            self.move_light()
            seconds.append([self.time(step) for step in steps])
        return np.median(seconds, axis=0)

    def time(self, step):
        begin = time.process_time()
        step()
        self.window.WaitForCompletion()
        return time.process_time() - begin

    def move_light(self):
        self.turn += 0.01
        self.put_light()

    def turn_camera(self):
        self.renderer.GetActiveCamera().Azimuth(1.0)

    def read(self, atlas_map):
        """A map, on the triangles."""
        image = vtkImageData()
        atlas_map.GetTexture().ReadImage(image, "Map")
        back = lt.vtkAtlasToSurface()
        back.SetInputData(0, self.surface)
        back.SetInputData(1, image)
        back.Update()
        return vtk_to_numpy(back.GetOutput().GetCellData().GetArray("Map")).astype(float)

    def read_both(self):
        return [self.read(self.scattering.GetTransmittedMap(self.actor)),
                self.read(self.scattering.GetScatteredMap(self.actor))]

    def get_filters_result(self):
        """What enters and what leaves the triangles, as the filters have it."""
        divided = vtkLinearSubdivisionFilter()
        divided.SetInputData(take_shape(self.surface))
        divided.SetNumberOfSubdivisions(2)
        direct = lt.vtkDirectIrradiance()
        direct.SetInputConnection(divided.GetOutputPort())
        direct.SetShadows(self.scattering.GetShadows())
        direct.SetRefractiveIndex(
            self.scattering.GetTransmittedMap(self.actor).GetRefractiveIndex())
        direct.AddLight(self.light)
        scattering = lt.vtkSubsurfaceScattering()
        scattering.SetInputConnection(direct.GetOutputPort())
        scattering.SetMaterial(self.material.GetMaterial())
        scattering.SetMillimetersPerUnit(3.0)
        scattering.SetLinkMethodToAdaptive()
        scattering.SetNumberOfLinks(self.material.GetNumberOfLinks())
        scattering.SetLinkTolerance(self.material.GetLinkTolerance())
        scattering.SetIncidenceToTransmitted()
        scattering.Update()
        cells = scattering.GetOutputDataObject(0).GetCellData()
        areas = get_areas(divided.GetOutput())
        return [average(vtk_to_numpy(cells.GetArray(name)).astype(float), areas)
                for name in ("TransmittedIrradiance", "ScatteredIrradiance")]

    def compare_with_filter(self):
        """Relative L2 of what leaves against the filter on the CPU: same texels, same light."""
        leaving = self.scattering.GetScatteredMap(self.actor)
        entering = vtkImageData()
        self.scattering.GetTransmittedMap(self.actor).GetTexture().ReadImage(
            entering, "TransmittedIrradiance")
        texels = vtkImageData()
        texels.DeepCopy(leaving.GetTexels())
        image = vtkImageData()
        leaving.GetTexture().ReadImage(image, "Leaving")
        found = vtk_to_numpy(image.GetPointData().GetArray("Leaving")).astype(float)
        texels.GetPointData().AddArray(
            entering.GetPointData().GetArray("TransmittedIrradiance"))
        scattering = lt.vtkSubsurfaceScattering()
        scattering.SetMaterial(self.material.GetMaterial())
        scattering.SetMillimetersPerUnit(3.0)
        scattering.SetLinkMethod(self.material.GetLinkMethod())
        scattering.SetNumberOfLinks(self.material.GetNumberOfLinks())
        scattering.SetIncidenceToTransmitted()
        scattering.SetDeviceToCPU()
        scattering.SetInputData(texels)
        scattering.Update()
        points = scattering.GetOutputDataObject(0).GetPointData()
        expected = vtk_to_numpy(points.GetArray("ScatteredIrradiance")).astype(float)
        areas = vtk_to_numpy(points.GetArray("Area"))[:, None]
        return np.sqrt((areas * (found - expected) ** 2).sum() / (areas * expected ** 2).sum())


def get_areas(surface):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (points[corners[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1)[:, None]


def take_shape(surface):
    shape = vtkPolyData()
    shape.SetPoints(surface.GetPoints())
    shape.SetPolys(surface.GetPolys())
    return shape


def average(values, areas):
    """Of sixteen triangles each."""
    weighted = (areas * values).reshape(-1, 16, values.shape[1]).sum(axis=1)
    return weighted / areas.reshape(-1, 16, 1).sum(axis=1)


def show_sizes(arguments):
    surface = make_surface(BUNNY, arguments.patches, max(arguments.leaving))
    areas = get_areas(surface)
    expected = {}
    for leaving in arguments.leaving:
        scene = Scene(surface, 256, max(arguments.entering), leaving, "Adaptive", 256)
        scene.material.SetLinkTolerance(3e-3)
        links = scene.draw()
        for shadows in (False, True):
            scene.scattering.SetShadows(shadows)
            for entering in arguments.entering:
                scene.scattering.SetIrradianceMapSize(entering)
                scene.turn = 0.7
                scene.put_light()
                scene.draw()
                if shadows not in expected:
                    expected[shadows] = scene.get_filters_result()
                errors = [
                    100.0 * np.sqrt((areas * (found - best) ** 2).sum() / (areas * best ** 2).sum())
                    for found, best in zip(scene.read_both(), expected[shadows])]
                frame = scene.get_frame(scene.move_light)
                print(f"entering {entering}, leaving {leaving}, shadows {shadows}: off by "
                      f"{errors[0]:.2f} and {errors[1]:.2f} %, first frame {links:.2f} CPU s, "
                      f"light moves {frame:.3f} CPU s", flush=True)
        if arguments.filter and leaving == max(arguments.leaving):
            scene.scattering.SetIrradianceMapSize(leaving)
            scene.draw()
            print(f"{leaving}: {scene.compare_with_filter():.1e} from the filter", flush=True)


def time_plain_shader(program, size, link_bytes):
    output = subprocess.run([program, "--plain", str(size), str(link_bytes)], check=True,
                            capture_output=True, text=True)
    return float(output.stdout)


def show_frames(arguments):
    for size in arguments.sizes:
        surface = make_surface(BUNNY, arguments.patches, size)
        for method, compress in (("Uniform", False), ("Adaptive", False), ("Adaptive", True)):
            for links in arguments.links:
                scene = Scene(surface, size, size, size, method, links, compress)
                first = scene.draw()
                camera = scene.get_frame(scene.turn_camera)
                entering, leaving, picture = scene.get_steps()
                link_bytes = scene.scattering.GetScatteredMap(scene.actor).GetNumberOfLinkBytes()
                plain = (time_plain_shader(arguments.plain, size, link_bytes)
                         if arguments.plain else np.nan)
                name = method + (", coded" if compress else "")
                print(f"{size}, {surface.GetNumberOfCells()} triangles, {name} {links}: "
                      f"{link_bytes * 1e-6:.0f} MB, first {first:.1f}, camera moves {camera:.3f}, "
                      f"light moves {entering + leaving + picture:.3f}: enters {entering:.3f}, "
                      f"leaves {leaving:.3f} (plain shader {plain:.4f}, {leaving / plain:.1f} "
                      f"times), picture {picture:.3f} CPU s", flush=True)


def show_single(arguments):
    surface = make_surface(BUNNY, arguments.patches, 512)
    for share in (1.0, 0.01):
        scene = Scene(surface, 512, 512, 128, "Uniform", 16)
        scene.material.SetMillimetersPerUnit(3.0 * share)
        scene.scattering.SetSingleScatteringToOnly()
        scene.scattering.SetExposure(20.0)
        scene.scattering.SetOutputEncodingToLinear()
        scene.actor.GetProperty().SetSpecular(0.0)
        pictures, seconds = [], []
        for steps in arguments.steps:
            scene.scattering.SetSingleScatteringSteps(steps)
            scene.draw()
            pixels = vtkUnsignedCharArray()
            scene.window.GetPixelData(0, 0, 511, 511, 0, pixels)
            pictures.append(vtk_to_numpy(pixels).astype(float))
            scene.turn_camera()
            seconds.append(scene.draw())
            scene.renderer.GetActiveCamera().Azimuth(-1.0)
        for steps, picture, second in zip(arguments.steps, pictures, seconds):
            error = np.linalg.norm(picture - pictures[-1]) / np.linalg.norm(pictures[-1])
            print(f"{surface.GetNumberOfCells()} triangles, coefficients x {share}, {steps} steps: "
                  f"{second:.2f} CPU s a frame, error {100 * error:.2f} %", flush=True)


def main():
    def numbers(text):
        return [int(number) for number in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("sizes", "frames", "single"))
    parser.add_argument("--entering", type=numbers, default=[128, 256, 512, 1024])
    parser.add_argument("--leaving", type=numbers, default=[64, 128, 256])
    parser.add_argument("--sizes", type=numbers, default=[512, 1024])
    parser.add_argument("--links", type=numbers, default=[16, 64])
    parser.add_argument("--patches", type=int, default=6000)
    parser.add_argument("--steps", type=numbers, default=[4, 8, 16, 32])
    parser.add_argument("--filter", action="store_true")
    parser.add_argument("--plain", metavar="PROGRAM")
    arguments = parser.parse_args()
    shows = {"sizes": show_sizes, "frames": show_frames, "single": show_single}
    shows[arguments.what](arguments)


if __name__ == "__main__":
    main()
