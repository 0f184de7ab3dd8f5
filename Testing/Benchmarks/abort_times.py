#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""How long a filter leaves its user alone: the longest gap between two of its progress events, and
the worst time from a wish to abort to the return of Update().

    abort_times.py vtkViewFactors 20000
    abort_times.py vtkRadiosity 100000 --set LinkMethod=2 --shape room
    abort_times.py vtkPatchMesher 200000 --file scan.vtp --set TargetEdgeLength=0.01

A wish is made at a random time of the run, and the filter can hear it at its next progress event.
Two numbers each: seconds of the clock, and seconds of all processors, which a busy machine does not
spoil. Exit 1 where an aborted run gives cells or an error message.
"""

import argparse
import math
import random
import sys
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkPoints, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkLight


def make_surface(points, triangles):
    """vtkPolyData of numpy arrays."""
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, np.float64), deep=True))
    cells = np.hstack([np.full((len(triangles), 1), 3), triangles]).astype(np.int64).ravel()
    polygons = vtkCellArray()
    polygons.SetCells(len(triangles), numpy_to_vtkIdTypeArray(cells, deep=True))
    surface = vtkPolyData()
    surface.SetPoints(places)
    surface.SetPolys(polygons)
    return surface


def make_grid(columns, rows):
    """Triangles of a grid of points: each square in two."""
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    right, up = first + 1, first + columns + 1
    return np.vstack([np.stack([first, right, up], 1), np.stack([right, up + 1, up], 1)])


def make_sphere(triangles, bumps):
    """A sphere with bumps, cut open at its poles."""
    columns = max(3, round(math.sqrt(triangles)))
    rows = max(2, triangles // (2 * columns))
    j, i = np.meshgrid(np.arange(columns + 1) % columns, np.arange(rows + 1))
    theta = 0.02 + (math.pi - 0.04) * i / rows
    phi = 2.0 * math.pi * j / columns
    radius = 1.0 + bumps * np.sin(7.0 * theta) * np.cos(5.0 * phi)
    points = np.stack(
        [
            radius * np.sin(theta) * np.cos(phi),
            radius * np.sin(theta) * np.sin(phi),
            radius * np.cos(theta),
        ],
        -1,
    ).reshape(-1, 3)
    cells = make_grid(columns, rows)
    seam = cells % (columns + 1) == columns
    cells[seam] -= columns
    return points, cells[:, ::-1]


def make_room(triangles):
    """A box seen from inside, with a pillar of bumps in it."""
    half = triangles // 2
    points, cells = make_sphere(half, 0.3)
    side = max(1, round(math.sqrt(half / 12)))
    grid = make_grid(side, side)
    across, along = np.meshgrid(np.linspace(-2, 2, side + 1), np.linspace(-2, 2, side + 1))
    parts, faces = [points], [cells]
    for axis in range(3):
        for end in (-2.0, 2.0):
            wall = np.zeros((across.size, 3))
            wall[:, axis] = end
            wall[:, (axis + 1) % 3] = across.ravel()
            wall[:, (axis + 2) % 3] = along.ravel()
            faces.append((grid[:, ::-1] if end > 0 else grid) + sum(map(len, parts)))
            parts.append(wall)
    return np.vstack(parts), np.vstack(faces)


def make_input(options):
    """The surface that the options ask for, with the arrays that filters need."""
    if options.file:
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

        reader = vtkXMLPolyDataReader()
        reader.SetFileName(options.file)
        reader.Update()
        surface = reader.GetOutput()
    elif options.shape == "room":
        surface = make_surface(*make_room(options.triangles))
    else:
        surface = make_surface(*make_sphere(options.triangles, 0.2))
    cells = surface.GetNumberOfCells()
    values = {"Reflectance": np.full(cells, 0.7), "Irradiance": np.ones(cells)}
    values["Emission"] = np.zeros(cells)
    values["Emission"][: max(1, cells // 50)] = 1.0
    for name, numbers in values.items():
        array = numpy_to_vtk(numbers, deep=True)
        array.SetName(name)
        surface.GetCellData().AddArray(array)
    return surface


def make_filter(options, surface):
    """A new filter with its properties."""
    made = getattr(lt, options.filter)()
    made.SetInputData(surface)
    if options.filter == "vtkDirectIrradiance":
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(5, 4, 3)
        made.AddLight(light)
    for setting in options.set:
        name, _, text = setting.partition("=")
        numbers = [float(t) if set(t) & set(".e") else int(t) for t in text.split(",")]
        getattr(made, "Set" + name)(*numbers)
    return made


class Run:
    """One Update() of a filter; the wish is made `wish` seconds after its begin."""

    def __init__(self, options, surface, wish):
        self.filter = make_filter(options, surface)
        self.filter.AddObserver("ProgressEvent", self.hear)
        self.wish = wish
        self.clock, self.processor = time.perf_counter(), time.process_time()
        self.begin = self.clock
        self.gap, self.gap_processor, self.gap_at = 0.0, 0.0, 0.0
        self.events, self.wished = 0, None
        self.filter.Update()
        self.look("end")
        self.end = self.clock
        self.latency = max(0.0, self.end - (self.begin + wish)) if self.wished else 0.0
        self.latency_processor = self.processor - self.heard if self.wished else 0.0

    def look(self, place):
        clock, processor = time.perf_counter(), time.process_time()
        if clock - self.clock > self.gap:
            self.gap, self.gap_at = clock - self.clock, place
        self.gap_processor = max(self.gap_processor, processor - self.processor)
        self.clock, self.processor = clock, processor

    def hear(self, caller, _):
        self.events += 1
        self.look(f"{caller.GetProgress():.3f}")
        if self.wish is not None and self.clock - self.begin >= self.wish and not self.wished:
            self.wished, self.heard = True, self.processor
            caller.SetAbortExecute(1)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("filter", help="class, such as vtkViewFactors")
    parser.add_argument("triangles", type=int)
    parser.add_argument("--shape", choices=("sphere", "room"), default="sphere")
    parser.add_argument("--file", help="a .vtp file in place of the shape")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    parser.add_argument("--aborts", type=int, default=10)
    parser.add_argument(
        "--most", type=float, default=120.0, help="seconds after which the first run is aborted"
    )
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    messages = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(messages)
    surface = make_input(options)
    whole = Run(options, surface, options.most)
    length = whole.end - whole.begin
    print(
        f"{options.filter} {surface.GetNumberOfCells()} cells: {length:.1f} s"
        f"{' (aborted)' if whole.wished else ''}, {whole.events} events, longest gap"
        f" {whole.gap:.2f} s (before {whole.gap_at}), processors {whole.gap_processor:.2f} s",
        flush=True,
    )
    print(messages.GetOutput()[:400], file=sys.stderr)
    numbers = random.Random(options.seed)
    worst, worst_processor, bad = 0.0, 0.0, 0
    for _ in range(options.aborts):
        before = messages.GetOutput().count("ERROR")
        run = Run(options, surface, numbers.uniform(0.0, length))
        worst = max(worst, run.latency)
        worst_processor = max(worst_processor, run.latency_processor)
        if run.wished:
            output = run.filter.GetOutputDataObject(0)
            cells = output.GetNumberOfCells() if hasattr(output, "GetNumberOfCells") else 0
            bad += int(cells > 0 or messages.GetOutput().count("ERROR") > before)
    print(
        f"worst of {options.aborts} aborts {worst:.2f} s, processors {worst_processor:.2f} s;"
        f" with cells or an error: {bad}"
    )
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
