#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A bunny that light shines through, scattered while it is drawn; the light goes round.

    translucent_bunny.py FOLDER [--frames 24] [--size 384] [--map 128] [--patches 6000]

writes FOLDER/frame_000.png and so on, and FOLDER/steps.png: what enters, what leaves, and the
picture. Needs no display. Links are made for the first frame; each other frame draws what enters
and applies them.
"""

import argparse
import math
import os
import sys
import time

import vtklighttransport as lt
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (mappers of OpenGL register here)
from vtklighttransport.pictures import make_window, write_picture
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer

BUNNY = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Data/bunny.ply")
MIDDLE = (-0.17, 4.8, 0.0)
EXPOSURE = 3.0


def make_surface(file, patches, resolution):
    """Triangles with an atlas, and normals for the reflection."""
    reader = vtkPLYReader()
    reader.SetFileName(file)
    mesher = lt.vtkPatchMesher()
    mesher.SetInputConnection(reader.GetOutputPort())
    mesher.SetTargetNumberOfPatches(patches)
    atlas = lt.vtkSurfaceAtlas()
    atlas.SetInputConnection(mesher.GetOutputPort())
    atlas.SetResolution(resolution)
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(atlas.GetOutputPort())
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def make_actor(surface):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.0)
    look.SetDiffuse(0.0)
    look.SetSpecular(0.1)
    look.SetSpecularPower(30.0)
    return actor


def make_material():
    """A little bunny of marble: light comes through its ears."""
    material = lt.vtkSubsurfaceScattering()
    material.SetMaterialToMarble()
    material.SetMillimetersPerUnit(3.0)
    material.SetLinkMethodToAdaptive()
    material.SetLinkTolerance(3e-3)
    material.SetNumberOfLinks(256)
    return material


def look_at_bunny(renderer):
    camera = renderer.GetActiveCamera()
    camera.SetPosition(MIDDLE[0], 7.0, 30.0)
    camera.SetFocalPoint(*MIDDLE)
    camera.SetViewAngle(24.0)
    renderer.ResetCameraClippingRange()


class TranslucentBunny:
    """A window with the bunny, and a light that can be moved around it."""

    def __init__(self, surface, size, resolution):
        self.actor = make_actor(surface)
        self.surface = surface
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetFocalPoint(*MIDDLE)
        self.scattering = lt.vtkSubsurfaceScatteringPass()
        self.scattering.SetMaterial(self.actor, make_material())
        self.scattering.SetIrradianceMapSize(max(4 * resolution, 128))
        self.scattering.SetScatteredMapSize(resolution)
        self.scattering.SetExposure(EXPOSURE)
        self.renderer = vtkRenderer()
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(self.light)
        self.renderer.AddActor(self.actor)
        self.renderer.SetPass(self.scattering)
        self.window = make_window(self.renderer, (size, size))
        look_at_bunny(self.renderer)

    def put_light(self, angle):
        """0: behind the bunny, above."""
        self.light.SetPosition(MIDDLE[0] - 20.0 * math.sin(angle), MIDDLE[1] + 14.0,
                               MIDDLE[2] - 20.0 * math.cos(angle))

    def read_map(self, atlas_map, name):
        """One of the maps, brought to the surface (one read-back)."""
        image = vtkImageData()
        atlas_map.GetTexture().ReadImage(image, name)
        back = lt.vtkAtlasToSurface()
        back.SetInputData(0, self.surface)
        back.SetInputData(1, image)
        back.Update()
        return back.GetOutput()

    def draw_steps(self, file, size):
        """What enters, what leaves, and the picture, side by side."""
        entering = self.read_map(
            self.scattering.GetTransmittedMap(self.actor), "TransmittedIrradiance")
        leaving = self.read_map(
            self.scattering.GetScatteredMap(self.actor), "ScatteredIrradiance")
        window = make_window(self.renderer, (3 * size, size))
        passes = []
        for place, surface in enumerate((entering, leaving)):
            step = lt.vtkRadiosityPass()
            step.SetArrayName(("TransmittedIrradiance", "ScatteredIrradiance")[place])
            step.SetExposure(EXPOSURE)
            renderer = vtkRenderer()
            renderer.AddActor(make_actor(surface))
            renderer.SetPass(step)
            renderer.SetViewport(place / 3.0, 0.0, (place + 1) / 3.0, 1.0)
            look_at_bunny(renderer)
            window.AddRenderer(renderer)
            passes.append(step)
        self.window.RemoveRenderer(self.renderer)
        self.renderer.SetViewport(2.0 / 3.0, 0.0, 1.0, 1.0)
        write_picture(window, file)
        window.Finalize()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--frames", type=int, default=24)
    parser.add_argument("--size", type=int, default=384, help="pixels a side")
    parser.add_argument("--map", type=int, default=128, help="texels a side of what leaves")
    parser.add_argument("--patches", type=int, default=6000)
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    surface = make_surface(BUNNY, arguments.patches, arguments.map)
    bunny = TranslucentBunny(surface, arguments.size, arguments.map)
    for frame in range(arguments.frames):
        begin = time.process_time()
        bunny.put_light(2.0 * math.pi * frame / arguments.frames)
        write_picture(bunny.window, os.path.join(arguments.folder, f"frame_{frame:03}.png"))
        print(f"frame {frame}: {time.process_time() - begin:.2f} CPU seconds", flush=True)
    runs = (bunny.scattering.GetNumberOfIrradianceRuns(), bunny.scattering.GetNumberOfLinkRuns(),
            bunny.scattering.GetNumberOfScatteringRuns())
    print(f"what enters was drawn {runs[0]} times, links were made {runs[1]} times "
          f"and applied {runs[2]} times")
    bunny.put_light(0.0)
    bunny.window.Render()
    bunny.draw_steps(os.path.join(arguments.folder, "steps.png"), arguments.size)
    good = runs == (arguments.frames, 1, arguments.frames)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
