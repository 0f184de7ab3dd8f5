#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Cornell box, solved while it is drawn: the camera moves on while the light comes in.

    radiosity_room.py FOLDER [--patches 1000] [--size 256] [--budget 0.05]
                      [--shots [--tolerance 0.05]]

writes FOLDER/frame_000.png and so on until the solution is there; then the lamp turns blue, and a
ball comes into the room. Needs no display. With links (the default) they are made for the room,
serve the blue lamp, and are made again for the ball; with --shots there are none.
"""

import argparse
import os
import sys
import time

import vtklighttransport as lt
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (mappers of OpenGL register here)
from vtklighttransport.pictures import make_window, write_picture
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

ROOM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Data/cornell_box.vtp")


def make_room(patches):
    """With the cell arrays "Emission" and "Reflectance"."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(ROOM)
    mesher = lt.vtkPatchMesher()
    mesher.SetInputConnection(reader.GetOutputPort())
    mesher.SetTargetNumberOfPatches(patches)
    mesher.Update()
    return mesher.GetOutput()


def make_ball():
    """Its color is a property."""
    ball = vtkSphereSource()
    ball.SetRadius(75.0)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(16)
    ball.Update()
    actor = make_actor(ball.GetOutput())
    actor.GetProperty().SetDiffuseColor(0.9, 0.6, 0.2)
    actor.SetPosition(185.0, 240.5, 169.0)
    return actor


def make_actor(surface):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


class RadiosityRoom:
    """A window whose pass solves the room."""

    def __init__(self, arguments):
        self.folder = arguments.folder
        self.surface = make_room(arguments.patches)
        self.radiosity = lt.vtkRadiosity()
        if arguments.shots:
            self.radiosity.SetSolverToSouthwell()
            self.radiosity.SetDeviceToOpenGL()
            self.radiosity.SetTolerance(arguments.tolerance)
        self.light = lt.vtkRadiosityPass()
        self.light.SetRadiosity(self.radiosity)
        self.light.SetFrameBudget(arguments.budget)
        self.light.SetExposure(8.0)
        self.light.AmbientTermOn()
        self.renderer = vtkRenderer()
        self.renderer.AddActor(make_actor(self.surface))
        self.renderer.SetPass(self.light)
        self.window = make_window(self.renderer, (arguments.size, arguments.size))
        self.frames = 0
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(178.0, 273.0, -800.0)
        camera.SetFocalPoint(278.0, 273.0, 0.0)
        camera.SetViewAngle(39.3)

    def draw_until_solved(self, what):
        """Frame after frame, from a camera that moves on."""
        begin = time.process_time()
        first = self.frames
        worst = 0.0
        while self.frames == first or not self.light.IsConverged():
            self.renderer.GetActiveCamera().Azimuth(-0.1)
            self.renderer.ResetCameraClippingRange()
            write_picture(self.window,
                          os.path.join(self.folder, f"frame_{self.frames:03}.png"))
            worst = max(worst, self.light.GetSolvingSeconds())
            self.frames += 1
        print(f"{what}: {self.frames - first} frames, {time.process_time() - begin:.2f} CPU "
              f"seconds, the longest solved for {worst:.3f} seconds", flush=True)

    def turn_lamp_blue(self):
        emission = self.surface.GetCellData().GetArray("Emission")
        vtk_to_numpy(emission)[:] *= (0.4, 0.6, 2.0)
        emission.Modified()

    def get_runs(self):
        return (self.light.GetNumberOfLinkRuns(), self.light.GetNumberOfLightRuns(),
                self.light.GetNumberOfSolverRuns())


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder")
    parser.add_argument("--patches", type=int, default=1000)
    parser.add_argument("--size", type=int, default=256, help="pixels a side")
    parser.add_argument("--budget", type=float, default=0.05, help="seconds of a frame")
    parser.add_argument("--shots", action="store_true", help="on the GPU, without links")
    parser.add_argument("--tolerance", type=float, default=0.05, help="of shots")
    arguments = parser.parse_args()
    os.makedirs(arguments.folder, exist_ok=True)
    room = RadiosityRoom(arguments)
    room.draw_until_solved("room")
    room.turn_lamp_blue()
    room.draw_until_solved("blue lamp")
    room.renderer.AddActor(make_ball())
    room.draw_until_solved("ball")
    runs = room.get_runs()
    print(f"links were made {runs[0]} times, direct light was computed {runs[1]} times, and the "
          f"room was solved {runs[2]} times")
    return 0 if runs == (0 if arguments.shots else 2, 2, 3) else 1


if __name__ == "__main__":
    sys.exit(main())
