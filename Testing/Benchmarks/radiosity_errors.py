#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether errors of the radiosity are as large as they are told, over random scenes.

    radiosity_errors.py [--scenes 200] [--first 0] [--patches 400] [--settings S,S,...]

A scene is a room, closed or open at the top or at one or two sides, with up to three boxes in it,
turned, on the floor or above it; reflectances .2 to .95; light from one patch, some, all, or the
sky. Settings are dense:T (ViewFactorTolerance), hierarchical:T (LinkTolerance), auto:A and
sampled:A (Accuracy). What is right is a matrix at 1e-4 whose rows have been closed.

Prints a row for each setting: scenes; the part of them whose error is within a factor of two of
"AccuracyReached"; the quantiles of error over told of which a twentieth is below and above, and
the median; the parts of patches, mean over the scenes, that are within one and two of their
"RadiosityError"; CPU seconds. Scenes whose error is below --floor are
as exact as the reference, and left out.
"""

import argparse
import collections
import math
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

SETTINGS = ("dense:1e-1,dense:1e-2,dense:1e-3,hierarchical:3e-2,hierarchical:1e-2,"
            "hierarchical:3e-3,sampled:1e-2,auto:3e-2,auto:1e-2,auto:3e-3")
TOLERANCES = {"dense": "ViewFactorTolerance", "hierarchical": "LinkTolerance", "auto": "Accuracy",
              "sampled": "Accuracy"}
LEFT_OUT = {"closed": (), "top": ((2, 1),), "side": ((0, 1),), "both": ((2, 1), (1, 0))}
SOLVER_TOLERANCE = 1e-7

Scene = collections.namedtuple("Scene", "data areas sky")


class Surface:
    def __init__(self):
        self.quads = []

    def add_grid(self, origin, u, v, edge):
        n, m = (max(1, round(np.linalg.norm(side) / edge)) for side in (u, v))
        for i, j in np.ndindex(n, m):
            self.quads.append([origin + u * (i + a) / n + v * (j + b) / m
                               for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])

    def add_box(self, low, high, edge, *, inside=False, left_out=(), angle=0.0):
        """left_out: (axis, side) of the faces that are not there."""
        middle, size = (low + high) / 2, high - low
        turn = np.array([[math.cos(angle), -math.sin(angle), 0],
                         [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
        for axis, side in np.ndindex(3, 2):
            if (axis, side) in left_out:
                continue
            u, v = (turn @ (size * (np.arange(3) == (axis + k) % 3)) for k in (1, 2))
            origin = np.where(np.arange(3) == axis, (low, high)[side], low)
            origin = middle + turn @ (origin - middle)
            self.add_grid(origin, *((u, v) if (side == 1) != inside else (v, u)), edge)

    def get(self):
        points, polygons = vtkPoints(), vtkCellArray()
        points.SetDataTypeToDouble()
        for quad in self.quads:
            polygons.InsertNextCell(4)
            for corner in quad:
                polygons.InsertCellPoint(points.InsertNextPoint(corner))
        data = vtkPolyData()
        data.SetPoints(points)
        data.SetPolys(polygons)
        areas = [np.linalg.norm(np.cross(q[1] - q[0], q[3] - q[0])) for q in self.quads]
        return data, np.array(areas)


def make_scene(seed, most):
    random = np.random.default_rng(seed)
    size = random.uniform(2, (6, 6, 4))
    walls = 2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0])
    edge = math.sqrt(1.4 * walls / math.exp(random.uniform(math.log(50), math.log(most))))
    kind = random.choice(list(LEFT_OUT), p=(0.5, 0.2, 0.15, 0.15))
    surface = Surface()
    surface.add_box(np.zeros(3), size, edge, inside=True, left_out=LEFT_OUT[kind])
    add_boxes(surface, size, edge, random)
    data, areas = surface.get()
    light = random.choice(["lamp", "some", "all", "sky" if kind != "closed" else "lamp"],
                          p=(0.35, 0.2, 0.2, 0.25))
    count = len(areas)
    reflectance = random.uniform(0.2, 0.95) + random.uniform(-0.2, 0.2, count) * random.integers(2)
    emission = np.zeros(count)
    lit = {"lamp": 1, "some": max(1, count // 12), "all": count, "sky": 0}[light]
    emission[random.choice(count, lit, replace=False)] = random.uniform(0.3, 1, lit)
    set_array(data, "Reflectance", np.clip(reflectance, 0.1, 0.95))
    set_array(data, "Emission", emission)
    return Scene(data, areas, float(light == "sky"))


def add_boxes(surface, size, edge, random):
    placed = []
    for _ in range(random.integers(0, 4)):
        extent = size * random.uniform(0.12, 0.4, 3)
        radius = math.hypot(*extent[:2]) / 2
        room = size[:2] - 2.06 * radius
        centre = 1.03 * radius + room * random.random(2)
        if room.min() <= 0 or any(np.linalg.norm(centre - c) < 1.02 * (radius + r)
                                  for c, r in placed):
            continue
        placed.append((centre, radius))
        height = random.choice([0.01 * size[2], random.uniform(0.02, size[2] - 1.02 * extent[2])])
        low = np.append(centre - extent[:2] / 2, height)
        surface.add_box(low, low + extent, edge * random.uniform(0.6, 1),
                        angle=random.uniform(0, 1.5))


def set_array(data, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=1)
    array.SetName(name)
    data.GetCellData().AddArray(array)


def solve(scene, setting, *, errors=True):
    method, tolerance = setting.split(":")
    radiosity = lt.vtkRadiosity()
    getattr(radiosity, f"SetLinkMethodTo{method.capitalize()}")()
    getattr(radiosity, f"Set{TOLERANCES[method]}")(float(tolerance))
    radiosity.SetTolerance(SOLVER_TOLERANCE)
    radiosity.SetDeviceToCPU()
    radiosity.SetComputeErrors(errors)
    radiosity.SetEnforceClosure(setting == "dense:1e-4")
    if scene.sky:
        radiosity.SetBackgroundRadiance(scene.sky)
    radiosity.SetInputData(scene.data)
    radiosity.Update()
    return radiosity.GetOutput()


def get_array(output, name):
    return vtk_to_numpy(output.GetCellData().GetArray(name))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--patches", type=float, default=400, help="about as many at most")
    parser.add_argument("--settings", default=SETTINGS)
    parser.add_argument("--floor", type=float, default=2e-5)
    parser.add_argument("--verbose", action="store_true", help="a row for each scene, too")
    options = parser.parse_args()

    settings = options.settings.split(",")
    ratios, within, seconds = ({setting: [] for setting in settings} for _ in range(3))
    for seed in range(options.first, options.first + options.scenes):
        scene = make_scene(seed, options.patches)
        right = get_array(solve(scene, "dense:1e-4", errors=False), "Radiosity")
        emission = get_array(scene.data, "Emission")
        scattered = (scene.areas * (right - emission) ** 2).sum()
        for setting in settings:
            begin = time.process_time()
            output = solve(scene, setting)
            seconds[setting].append(time.process_time() - begin)
            off = get_array(output, "Radiosity") - right
            error = math.sqrt((scene.areas * off ** 2).sum() / scattered)
            told = output.GetFieldData().GetArray("AccuracyReached").GetValue(0)
            one = np.abs(off) / np.maximum(get_array(output, "RadiosityError"), 1e-30)
            shares = [(one < 1).mean(), (one < 2).mean()]
            if options.verbose:
                print(seed, len(off), setting, f"error {error:.2e} told {told:.2e}",
                      "within {:.2f} {:.2f}".format(*shares), flush=True)
            if error >= options.floor:
                ratios[setting].append(error / max(told, 1e-30))
                within[setting].append(shares)
    print("| setting | scenes | within a factor of 2 | error over told: 5 %, median, 95 % "
          "| within one, two errors | CPU s |")
    print("|---|--:|--:|--:|--:|--:|")
    for setting in settings:
        ratio = np.array(ratios[setting])
        good = ((ratio > 0.5) & (ratio < 2)).mean()
        one, two = np.mean(within[setting], axis=0)
        low, middle, high = np.quantile(ratio, (0.05, 0.5, 0.95))
        print(f"| {setting} | {len(ratio)} | {100 * good:.0f} % | {low:.2f}, {middle:.2f}, "
              f"{high:.2f} | {100 * one:.0f} %, {100 * two:.0f} % | {sum(seconds[setting]):.1f} |")


if __name__ == "__main__":
    main()
