#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scattering in a bunny that is twisted: links that are kept from frame to frame, against new ones.

    moving_bodies.py [--frames 30] [--angle 90] [--cut 0] [--unit 10] [--links 64] [--tolerance 0]
                     [--method Adaptive] [--compress] [--no-errors]

Prints, over all frames but the first: CPU seconds and seconds of a frame, the share of links that
was kept, how often links were chosen afresh, and the errors of both against all pairs at 1e-4
(relative L2, the worst band), with their largest ratio. Each triangle is cut in 4^cut.
"""

import argparse
import pathlib
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkIOPLY import vtkPLYReader

BUNNY = pathlib.Path(__file__).parents[2] / "Data" / "bunny.ply"
LIGHT = np.array([0.6, 0.64, 0.48])


class Bunny:
    """Twisted around its vertical axis, in light from one side that stays where it is."""

    def __init__(self, cut):
        reader = vtkPLYReader()
        reader.SetFileName(str(BUNNY))
        finer = vtkLinearSubdivisionFilter()
        finer.SetNumberOfSubdivisions(cut)
        finer.SetInputConnection(reader.GetOutputPort())
        last = finer if cut > 0 else reader
        last.Update()
        self.surface = last.GetOutput()
        self.points = vtk_to_numpy(self.surface.GetPoints().GetData()).astype(float)
        polygons = self.surface.GetPolys().GetConnectivityArray()
        self.triangles = vtk_to_numpy(polygons).reshape(-1, 3)

    def twist(self, angle):
        """The surface where its top is turned against its bottom, and the areas of its cells."""
        low, high = self.points.min(axis=0), self.points.max(axis=0)
        middle = (low + high) / 2
        x, y, z = (self.points - middle).T
        turn = np.radians(angle) * (self.points[:, 1] - low[1]) / (high[1] - low[1])
        moved = middle + np.stack([np.cos(turn) * x + np.sin(turn) * z, y,
                                   np.cos(turn) * z - np.sin(turn) * x], axis=1)
        points = vtkPoints()
        points.SetData(numpy_to_vtk(moved, deep=1))
        surface = vtkPolyData()
        surface.ShallowCopy(self.surface)
        surface.SetPoints(points)
        corners = moved[self.triangles]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        lengths = np.linalg.norm(normals, axis=1)
        light = numpy_to_vtk(np.maximum(0.0, normals @ LIGHT / lengths), deep=1)
        light.SetName("TransmittedIrradiance")
        surface.GetCellData().AddArray(light)
        return surface, 0.5 * lengths


def make_filter(arguments, method):
    scattering = lt.vtkSubsurfaceScattering()
    scattering.SetMaterialToMarble()
    scattering.SetIncidenceToTransmitted()
    scattering.SetMillimetersPerUnit(arguments.unit)
    scattering.SetDeviceToCPU()
    getattr(scattering, f"SetLinkMethodTo{method}")()
    if method != "Dense":
        scattering.SetNumberOfLinks(arguments.links)
        scattering.SetLinkTolerance(arguments.tolerance)
        scattering.SetCompressLinks(arguments.compress)
    return scattering


def run(scattering, surface):
    """Scattered irradiance, CPU seconds, seconds and the field data."""
    scattering.SetInputData(surface)
    begin = time.process_time(), time.perf_counter()
    scattering.Update()
    seconds = time.process_time() - begin[0], time.perf_counter() - begin[1]
    output = scattering.GetOutput()
    fields = {name: output.GetFieldData().GetArray(name).GetTuple1(0)
              for name in ("LinksReused", "LinkError", "LinksPerReceiver")
              if output.GetFieldData().GetArray(name)}
    values = vtk_to_numpy(output.GetCellData().GetArray("ScatteredIrradiance"))
    return values.copy(), seconds, fields


def compare(found, expected, areas):
    squares = areas @ (found - expected) ** 2 / (areas @ expected ** 2)
    return float(np.sqrt(squares.max()))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=30)
    parser.add_argument("--angle", type=float, default=90.0)
    parser.add_argument("--cut", type=int, default=0)
    parser.add_argument("--unit", type=float, default=10.0, help="mm per unit")
    parser.add_argument("--links", type=int, default=64)
    parser.add_argument("--tolerance", type=float, default=0.0)
    parser.add_argument("--method", default="Adaptive", choices=("Adaptive", "Uniform"))
    parser.add_argument("--compress", action="store_true")
    parser.add_argument("--no-errors", action="store_true", help="without all pairs")
    arguments = parser.parse_args()
    bunny = Bunny(arguments.cut)
    kept = make_filter(arguments, arguments.method)
    pairs = make_filter(arguments, "Dense")
    rows = []
    for frame in range(arguments.frames):
        surface, areas = bunny.twist(arguments.angle * frame / (arguments.frames - 1))
        old = run(kept, surface)
        new = run(make_filter(arguments, arguments.method), surface)
        errors = (0.0, 0.0)
        if not arguments.no_errors:
            exact = run(pairs, surface)[0]
            errors = compare(old[0], exact, areas), compare(new[0], exact, areas)
        if frame > 0:
            rows.append((*old[1], *new[1], old[2]["LinksReused"], old[2]["LinksPerReceiver"],
                         new[2]["LinksPerReceiver"], old[2]["LinkError"], new[2]["LinkError"],
                         *errors))
    rows = np.array(rows)
    mean = rows.mean(axis=0)
    reused = rows[:, 4]
    print(f"{len(areas)} patches, {arguments.method}, {arguments.frames} frames")
    print(f"CPU s a frame: kept {mean[0]:.3f}, new {mean[2]:.3f}; "
          f"frames/s: kept {1 / mean[1]:.2f}, new {1 / mean[3]:.2f}")
    print(f"share kept: {reused.mean():.3f}; chosen afresh: {(reused == 0).sum()} times; "
          f"links: kept {mean[5]:.1f}, new {mean[6]:.1f}")
    print(f"told: kept {mean[7]:.4f}, new {mean[8]:.4f}, "
          f"largest ratio {(rows[:, 7] / rows[:, 8]).max():.3f}")
    if not arguments.no_errors:
        print(f"error: kept {mean[9]:.4f}, new {mean[10]:.4f}, "
              f"largest ratio {(rows[:, 9] / rows[:, 10]).max():.3f}")


if __name__ == "__main__":
    main()
