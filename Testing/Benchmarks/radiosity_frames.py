#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames of the Cornell box that vtkRadiosityPass solves while it draws them.

    radiosity_frames.py [--patches 2000] [--budget 0.05] [--size 256] [--most 20]

For links and for shots: frames and CPU seconds until the solution is there, how far frames exceed
their budget (of the clock, and of the CPU: all threads together), and after each CPU second the
error of what is reflected and of the irradiance against the filter with exact view factors
(relative L2). Then what a frame takes when only the camera moves, and frames and CPU seconds for a
lamp of another color.
"""

import argparse
import os
import time

import numpy

import vtklighttransport as lt
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (mappers of OpenGL register here)
from vtklighttransport.arrays import get_areas, get_cell_array
from vtklighttransport.pictures import make_window
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer

ROOM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../Data/cornell_box.vtp")


def make_room(patches):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(ROOM)
    mesher = lt.vtkPatchMesher()
    mesher.SetInputConnection(reader.GetOutputPort())
    mesher.SetTargetNumberOfPatches(patches)
    mesher.Update()
    return mesher.GetOutput()


class Frames:
    """A window, and what its frames have taken."""

    def __init__(self, room, by_shots, arguments):
        self.actor = vtkActor()
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(room)
        mapper.ScalarVisibilityOff()
        self.actor.SetMapper(mapper)
        self.budget = arguments.budget
        self.solver = lt.vtkRadiosity()
        if by_shots:
            self.solver.SetSolverToSouthwell()
            self.solver.SetDeviceToOpenGL()
            self.solver.SetTolerance(1e-3)
        self.light = lt.vtkRadiosityPass()
        self.light.SetRadiosity(self.solver)
        self.light.SetFrameBudget(arguments.budget)
        self.light.SetExposure(8.0)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(self.actor)
        self.renderer.SetPass(self.light)
        self.window = make_window(self.renderer, (arguments.size, arguments.size))
        camera = self.renderer.GetActiveCamera()
        camera.SetPosition(278.0, 273.0, -800.0)
        camera.SetFocalPoint(278.0, 273.0, 0.0)
        camera.SetViewAngle(39.3)
        self.renderer.ResetCameraClippingRange()
        self.restart()

    def restart(self):
        self.frames = 0
        self.cpu = 0.0
        self.solving = []
        self.solving_cpu = []

    def draw(self):
        begin = time.process_time()
        self.window.Render()
        taken = time.process_time() - begin
        self.cpu += taken
        self.frames += 1
        self.solving.append(self.light.GetSolvingSeconds())
        self.solving_cpu.append(taken)

    def describe(self):
        clock = numpy.sort(self.solving)[::-1]
        cpu = numpy.sort(self.solving_cpu)[::-1]
        late = numpy.mean(numpy.array(self.solving) > 1.2 * self.budget)
        return (f"{self.frames} frames, {self.cpu:.2f} CPU s; longest of the clock "
                f"{clock[:3].round(3)}, {late:.1%} over 1.2 budgets; of the CPU {cpu[:3].round(3)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--patches", type=int, default=2000)
    parser.add_argument("--budget", type=float, default=0.05)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--most", type=float, default=20.0, help="CPU seconds of frames")
    arguments = parser.parse_args()
    room = make_room(arguments.patches)
    exact = lt.vtkRadiosity()
    exact.SetInputData(room)
    exact.SetViewFactorTolerance(1e-3)
    exact.Update()
    emission = get_cell_array(room, "Emission")
    areas = get_areas(room)[:, None]
    print(f"{room.GetNumberOfCells()} patches, a budget of {arguments.budget} s a frame")

    def tell_error(frames):
        output = frames.light.GetOutput(frames.actor)
        errors = []
        for name, base in (("Radiosity", emission), ("Irradiance", 0.0)):
            right = get_cell_array(exact.GetOutput(), name) - base
            found = get_cell_array(output, name) - base if output else 0.0 * right
            errors.append(numpy.sqrt((areas * (found - right) ** 2).sum() /
                                     (areas * right**2).sum()))
        print(f"  {frames.cpu:6.2f} CPU s, {frames.frames} frames: reflected {errors[0]:.3%}, "
              f"irradiance {errors[1]:.3%}", flush=True)

    for by_shots in (False, True):
        frames = Frames(room, by_shots, arguments)
        print("shots" if by_shots else "links")
        second = 1.0
        while frames.frames == 0 or (not frames.light.IsConverged() and
                                     frames.cpu < arguments.most):
            frames.draw()
            if frames.cpu >= second:
                tell_error(frames)
                second = numpy.floor(frames.cpu) + 1.0
        tell_error(frames)
        print(f"  {frames.describe()}; converged: {frames.light.IsConverged()}; "
              f"{frames.light.GetNumberOfShots()} shots, "
              f"{frames.light.GetNumberOfBytesRead()} bytes read")
        if not frames.light.IsConverged():
            continue
        frames.restart()
        for _ in range(20):
            frames.renderer.GetActiveCamera().Azimuth(0.5)
            frames.draw()
        print(f"  camera: {frames.cpu / 20:.4f} CPU s a frame")
        frames.restart()
        lamp = room.GetCellData().GetArray("Emission")
        vtk_to_numpy(lamp)[:] *= (0.4, 0.6, 2.0)
        lamp.Modified()
        while frames.frames == 0 or not frames.light.IsConverged():
            frames.draw()
        print(f"  another lamp: {frames.describe()}")
        vtk_to_numpy(lamp)[:] /= (0.4, 0.6, 2.0)
        lamp.Modified()


if __name__ == "__main__":
    main()
