#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Models of subsurface scattering against Monte Carlo in the same body: error and CPU seconds.

    scattering_models.py speed                  photons per millisecond of one thread
    scattering_models.py models [--error 0.01]  all models on three bodies

Bodies are so many mean free paths across (of red); light falls in from one side, as diffuse light
of that flux. Errors are area-weighted, relative, root mean square over the surface; that of Monte
Carlo itself is taken off, and stands beside.
"""

import argparse
import os
import pathlib
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlatonicSolidSource
from vtkmodules.vtkIOPLY import vtkPLYReader

MATERIALS = {"marble": 6, "skim milk": 8}
# Of the cubes with which Monte Carlo codes for tissue are measured: index of a custom material.
CUBES = {"index 1": 1.0, "index 1.37": 1.37}
MODELS = {"Dipole": 0, "BetterDipole": 1, "PhotonBeamDiffusion": 2, "ChristensenBurley": 3}
BUNNY = pathlib.Path(__file__).parents[2] / "Data" / "bunny.ply"


def follow(*filters):
    """The output of filters one after another, without arrays."""
    for before, after in zip(filters, filters[1:]):
        after.SetInputConnection(before.GetOutputPort())
    filters[-1].Update()
    surface = filters[-1].GetOutput()
    surface.GetPointData().Initialize()
    surface.GetCellData().Initialize()
    return surface


def make_orientation():
    orientation = vtkPolyDataNormals()
    orientation.AutoOrientNormalsOn()
    orientation.SplittingOff()
    return orientation


def make_sphere(levels):
    solid = vtkPlatonicSolidSource()
    solid.SetSolidTypeToIcosahedron()
    cuts = vtkLinearSubdivisionFilter()
    cuts.SetNumberOfSubdivisions(levels)
    surface = follow(solid, make_orientation(), cuts)
    points = vtk_to_numpy(surface.GetPoints().GetData())
    points *= (0.5 / np.linalg.norm(points, axis=1))[:, None].astype(points.dtype)
    return surface


def make_box(x, y, z, levels):
    box = vtkCubeSource()
    box.SetXLength(x)
    box.SetYLength(y)
    box.SetZLength(z)
    cuts = vtkLinearSubdivisionFilter()
    cuts.SetNumberOfSubdivisions(levels)
    return follow(box, vtkCleanPolyData(), vtkTriangleFilter(), cuts)


def make_bunny():
    reader = vtkPLYReader()
    reader.SetFileName(str(BUNNY))
    reader.Update()
    bounds = reader.GetOutput().GetBounds()
    width = max(bounds[2 * axis + 1] - bounds[2 * axis] for axis in range(3))
    scale = vtkTransform()
    scale.Scale(1.0 / width, 1.0 / width, 1.0 / width)
    transform = vtkTransformPolyDataFilter()
    transform.SetTransform(scale)
    return follow(reader, transform)


def measure(surface):
    """Normals and areas of triangles."""
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[corners]
    cross = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    twice = np.linalg.norm(cross, axis=1)
    return cross / twice[:, None], 0.5 * twice


def add_light(surface, bands):
    """From one side, in some of the bands."""
    normals, areas = measure(surface)
    light = np.maximum(normals @ np.array([0.6, 0.64, 0.48]), 0.0)
    array = numpy_to_vtk(light[:, None] * np.array(bands, dtype=float), deep=True)
    array.SetName("Irradiance")
    surface.GetCellData().AddArray(array)
    return areas


def set_medium(scattering, material, across):
    """The body is so many mean free paths of red long where it is one unit long."""
    if material in CUBES:
        scattering.SetScatteringCoefficient(1.0, 1.0, 1.0)
        scattering.SetAbsorptionCoefficient(0.005, 0.005, 0.005)
        scattering.SetRefractiveIndex(CUBES[material])
        extinction = 1.005
    else:
        coefficients = [0.0] * 3, [0.0] * 3
        scattering.SetMaterial(MATERIALS[material])
        scattering.GetMaterialProperties(MATERIALS[material], *coefficients, reference(0.0))
        extinction = coefficients[0][0] + coefficients[1][0]
    scattering.SetMillimetersPerUnit(across / extinction)


class Run:
    """A result of a model, its CPU seconds, and the filter's field data."""

    def __init__(self, surface, material, across, model, **properties):
        self.filter = lt.vtkSubsurfaceScattering()
        self.filter.SetInputData(surface)
        set_medium(self.filter, material, across)
        self.filter.SetModel(model)
        for name, value in properties.items():
            getattr(self.filter, "Set" + name)(value)
        begin = time.process_time()
        self.filter.Update()
        self.seconds = time.process_time() - begin
        self.output = self.filter.GetOutput()

    def get(self, name="ScatteredIrradiance"):
        return vtk_to_numpy(self.output.GetCellData().GetArray(name))

    def field(self, name):
        return vtk_to_numpy(self.output.GetFieldData().GetArray(name)).ravel()


def print_speed(photons):
    os.environ.setdefault("VTK_SMP_MAX_THREADS", "1")
    bodies = (
        ("sphere", make_sphere(3), "marble", 16.5),
        ("sphere", make_sphere(3), "skim milk", 55.0),
        ("sphere, 20,480 triangles", make_sphere(5), "marble", 16.5),
        ("cube", make_box(1, 1, 1, 0), "index 1", 60.3),
        ("cube", make_box(1, 1, 1, 0), "index 1.37", 60.3),
        ("slab 10 by 10 by 1", make_box(10, 10, 1, 0), "marble", 43.8),
        ("bunny", make_bunny(), "marble", 100.0),
    )
    print(f"{'body':26} {'material':10} {'across':>6} {'scatterings':>11} {'photons/ms':>10}")
    for name, surface, material, across in bodies:
        add_light(surface, (1, 0, 0))
        # The first run brings in what is loaded once, and the short one what a run costs anyway.
        Run(surface, material, across, 4, NumberOfPhotons=1000)
        little = Run(surface, material, across, 4, NumberOfPhotons=1000)
        run = Run(surface, material, across, 4, NumberOfPhotons=photons)
        speed = (photons - 1000) / (run.seconds - little.seconds) / 1000.0
        print(f"{name:26} {material:10} {across:6g} {run.field('ScatteringsPerPhoton')[0]:11.1f} "
              f"{speed:10.0f}", flush=True)


def print_models(error):
    print(f"{'body':7} {'material':10} {'across':>6} {'model':20} {'CPU s':>7} "
          f"{'leaving share':>21} {'off by, %':>18} {'MC error, %':>12}")
    bodies = {"sphere": lambda: make_sphere(3), "plate": lambda: make_box(1, 1, 0.1, 4),
              "bunny": make_bunny}
    for name, make in bodies.items():
        for material in MATERIALS:
            for across in (20, 100):
                surface = make()
                areas = add_light(surface, (1, 1, 1))
                exact = Run(surface, material, across, 4, TargetError=error)
                own = np.array(exact.field("RelativeError"))
                print_row((name, material, across, "MonteCarlo"), exact, np.zeros(3), own)
                norm = np.sqrt(areas @ exact.get()**2)
                for model, value in MODELS.items():
                    run = Run(surface, material, across, value)
                    off = np.sqrt(areas @ (run.get() - exact.get())**2) / norm
                    print_row((name, material, across, model), run,
                              np.sqrt(np.maximum(off**2 - own**2, 0.0)), own)


def print_row(what, run, off, own):
    shares = np.array(run.field("LeavingFlux")) / np.array(run.field("EnteringFlux"))
    print(f"{what[0]:7} {what[1]:10} {what[2]:6g} {what[3]:20} {run.seconds:7.2f} "
          + " ".join(f"{share:6.3f}" for share in shares) + "  "
          + " ".join(f"{100 * value:5.1f}" for value in off) + "  "
          + " ".join(f"{100 * value:4.2f}" for value in own), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("speed", "models"))
    parser.add_argument("--error", type=float, default=0.01, help="TargetError of Monte Carlo")
    parser.add_argument("--photons", type=int, default=400000)
    options = parser.parse_args()
    if options.what == "speed":
        print_speed(options.photons)
    else:
        print_models(options.error)


if __name__ == "__main__":
    main()
