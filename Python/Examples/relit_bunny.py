#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A window with a translucent bunny that is relit while it is looked at.

    relit_bunny.py [--map 128] [--patches 3000] [--size 600] [--frames FOLDER]

The mouse turns the view. Left, Right, Up and Down move the light; + and - make it brighter and
darker; sliders change the mean free path of light inside, and the albedo, for which links are made
again when they are let go. With --frames nothing is shown: the program presses the same keys and
moves the sliders, and pictures go to the folder.
"""

import argparse
import ctypes
import math
import os
import sys

import vtklighttransport as lt
import vtkmodules.vtkInteractionStyle  # noqa: F401 (what the mouse does registers here)
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (the sliders' titles)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (mappers of OpenGL register here)
from translucent_bunny import BUNNY, MIDDLE, look_at_bunny, make_actor, make_surface
from vtklighttransport.pictures import write_picture
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkInteractionWidgets import vtkSliderRepresentation2D, vtkSliderWidget
from vtkmodules.vtkRenderingCore import (
    vtkLight, vtkRenderer, vtkRenderWindow, vtkRenderWindowInteractor)

STEP = math.radians(10.0)
BRIGHTER = 1.25
HIGHEST = math.radians(80.0)


class RelitBunny:
    def __init__(self, surface, size, resolution):
        self.angles = [math.radians(-50.0), math.radians(35.0)]
        self.path = 0.5
        self.albedo = 0.999
        self.material = lt.vtkSubsurfaceScattering()
        self.material.SetMillimetersPerUnit(3.0)
        self.material.SetLinkMethodToAdaptive()
        self.light = vtkLight()
        self.light.SetLightTypeToSceneLight()
        self.light.SetFocalPoint(*MIDDLE)
        actor = make_actor(surface)
        self.scattering = lt.vtkSubsurfaceScatteringPass()
        self.scattering.SetMaterial(actor, self.material)
        self.scattering.SetIrradianceMapSize(max(4 * resolution, 128))
        self.scattering.SetScatteredMapSize(resolution)
        self.scattering.SetExposure(3.0)
        self.renderer = vtkRenderer()
        self.renderer.AutomaticLightCreationOff()
        self.renderer.AddLight(self.light)
        self.renderer.AddActor(actor)
        self.renderer.SetPass(self.scattering)
        self.window = vtkRenderWindow()
        self.window.SetWindowName("Relit bunny")
        self.window.SetSize(size, size)
        self.window.AddRenderer(self.renderer)
        self.interactor = vtkRenderWindowInteractor()
        self.interactor.SetRenderWindow(self.window)
        self.interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
        self.interactor.AddObserver("KeyPressEvent", lambda *_: self.press())
        # Logarithms, so that each step is a factor: of the path, and of what is absorbed.
        self.sliders = [
            self.add_slider("log10 of mean free path, mm", 0.06, -1.5, 1.0, math.log10(self.path)),
            self.add_slider("-log10(1 - albedo)", 0.56, 0.5, 4.5, -math.log10(1.0 - self.albedo))]
        self.set_material()
        self.put_light()
        look_at_bunny(self.renderer)

    def add_slider(self, title, left, low, high, value):
        look = vtkSliderRepresentation2D()
        look.SetTitleText(title)
        look.SetMinimumValue(low)
        look.SetMaximumValue(high)
        look.SetValue(value)
        look.SetTitleHeight(0.02)
        look.SetLabelHeight(0.02)
        for point, x in ((look.GetPoint1Coordinate(), left),
                         (look.GetPoint2Coordinate(), left + 0.38)):
            point.SetCoordinateSystemToNormalizedDisplay()
            point.SetValue(x, 0.08)
        slider = vtkSliderWidget()
        slider.SetInteractor(self.interactor)
        slider.SetRepresentation(look)
        slider.SetAnimationModeToJump()
        slider.AddObserver("EndInteractionEvent", lambda *_: self.slide())
        slider.EnabledOn()
        return slider

    def slide(self):
        self.path, absorbed = (
            10.0 ** slider.GetRepresentation().GetValue() for slider in self.sliders)
        self.albedo = 1.0 - 1.0 / absorbed
        self.set_material()
        self.window.Render()

    def press(self):
        """What a key does; others are VTK's own."""
        key = self.interactor.GetKeySym()
        turns = {"Left": (0, -STEP), "Right": (0, STEP), "Up": (1, STEP), "Down": (1, -STEP)}
        if key in turns:
            axis, step = turns[key]
            self.angles[axis] += step
            self.angles[1] = min(max(self.angles[1], -HIGHEST), HIGHEST)
            self.put_light()
        elif key in ("plus", "minus"):
            factor = BRIGHTER if key == "plus" else 1.0 / BRIGHTER
            self.light.SetIntensity(factor * self.light.GetIntensity())
        else:
            return
        self.window.Render()

    def put_light(self):
        around, above = self.angles
        self.light.SetPosition(MIDDLE[0] + 25.0 * math.cos(above) * math.sin(around),
                               MIDDLE[1] + 25.0 * math.sin(above),
                               MIDDLE[2] + 25.0 * math.cos(above) * math.cos(around))

    def set_material(self):
        """Blue is absorbed a little more than red, as in most of what grows."""
        albedos = [1.0 - factor * (1.0 - self.albedo) for factor in (1.0, 1.5, 2.5)]
        albedos = [max(albedo, 0.0) for albedo in albedos]
        self.material.SetScatteringCoefficient([albedo / self.path for albedo in albedos])
        self.material.SetAbsorptionCoefficient([(1.0 - albedo) / self.path for albedo in albedos])

    def get_runs(self):
        return (self.scattering.GetNumberOfLinkRuns(), self.scattering.GetNumberOfIrradianceRuns())


def play(bunny, folder):
    """Each picture after a key or a slider; whether only what had to be was computed."""
    def press(key):
        bunny.interactor.SetKeySym(key)
        bunny.interactor.InvokeEvent("KeyPressEvent")

    def slide(number, value):
        bunny.sliders[number].GetRepresentation().SetValue(value)
        bunny.sliders[number].InvokeEvent("EndInteractionEvent")

    steps = [
        (lambda: None, (1, 1)), (lambda: press("Left"), (1, 2)), (lambda: press("Up"), (1, 3)),
        (lambda: press("plus"), (1, 4)), (lambda: slide(0, 0.5), (2, 4)),
        (lambda: slide(1, 1.5), (3, 4)),
        (lambda: bunny.renderer.GetActiveCamera().Azimuth(90.0), (3, 4))]
    good = True
    os.makedirs(folder, exist_ok=True)
    for number, (change, expected) in enumerate(steps):
        change()
        write_picture(bunny.window, os.path.join(folder, f"relit_{number}.png"))
        print(f"picture {number}: links were made {bunny.get_runs()[0]} times, "
              f"what enters was drawn {bunny.get_runs()[1]} times", flush=True)
        good = good and bunny.get_runs() == expected
    return good


def has_display():
    """Whether the X server of VTK's window answers: where none does, VTK ends the process."""
    if not sys.platform.startswith("linux"):
        return True
    try:
        library = ctypes.CDLL("libX11.so.6")
    except OSError:
        return False
    library.XOpenDisplay.restype = ctypes.c_void_p
    return library.XOpenDisplay(None) is not None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--map", type=int, default=128, help="texels a side of what leaves")
    parser.add_argument("--patches", type=int, default=3000)
    parser.add_argument("--size", type=int, default=600, help="pixels a side")
    parser.add_argument("--frames", metavar="FOLDER", help="pictures in place of a window")
    arguments = parser.parse_args()
    if arguments.frames:
        lt.vtkOffScreenOpenGLRenderWindow.RegisterAsDefault()
    elif not has_display():
        sys.exit("There is no display for a window (DISPLAY is not set, or nothing answers there): "
                 "with --frames FOLDER pictures are written instead, which needs none; or start "
                 "this on a desktop, over ssh -X or under xvfb-run.")
    surface = make_surface(BUNNY, arguments.patches, arguments.map)
    bunny = RelitBunny(surface, arguments.size, arguments.map)
    if arguments.frames:
        return 0 if play(bunny, arguments.frames) else 1
    bunny.interactor.Initialize()
    bunny.window.Render()
    bunny.interactor.Start()
    return 0


if __name__ == "__main__":
    sys.exit(main())
