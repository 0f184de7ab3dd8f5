#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Monte Carlo in the mesh, and models of subsurface scattering: speed, error against CPU seconds.

    scattering_models.py speed [--threads 1] [--photons 400000]
    scattering_models.py models FOLDER [--error 0.03]
    scattering_models.py bunny FOLDER [--error 0.02]

`speed` prints photons per millisecond: by body, by albedo and size, and where CPU seconds go up
with the threads. `models` runs the report of `python3 -m vtklighttransport report --scatter` on
three bodies, in marble and skim milk; `bunny` draws what it says of a bunny of three sizes.
Bodies are so many mean free paths across (of red); light falls in from one side, as diffuse light
of that flux. --error is TargetError of the Monte Carlo reference.
"""

import argparse
import os
import pathlib
import time

import numpy as np
import vtklighttransport as lt
from vtklighttransport.plots import Line, plot_lines
from vtklighttransport.report.record import Record
from vtklighttransport.report.scattering import Scattering
from vtklighttransport.report.study import Study
from vtklighttransport.shell.stages import Messages
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
# Of the bunny in Documentation/guide/models.md, in mm.
HEIGHTS = (15, 50, 150)
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


class Medium:
    """Of a filter: coefficients of a material, of the cubes, or of an albedo at an index of 1.3."""

    def __init__(self, material):
        self.material = MATERIALS.get(material, 0)
        self.index = CUBES.get(material, 1.3)
        self.coefficients = [1.0] * 3, [0.005] * 3
        if self.material:
            self.coefficients, index = ([0.0] * 3, [0.0] * 3), reference(0.0)
            lt.vtkSubsurfaceScattering.GetMaterialProperties(
                self.material, *self.coefficients, index)
            self.index = index.get()
        elif isinstance(material, float):
            self.coefficients = [material] * 3, [1.0 - material] * 3

    def set_on(self, scattering, across):
        """The body is so many mean free paths of red long where it is one unit long."""
        scattering.SetMaterial(self.material)
        scattering.SetScatteringCoefficient(self.coefficients[0])
        scattering.SetAbsorptionCoefficient(self.coefficients[1])
        scattering.SetRefractiveIndex(self.index)
        scattering.SetMillimetersPerUnit(across / self.get_extinction())

    def get_extinction(self):
        return self.coefficients[0][0] + self.coefficients[1][0]


class Walks:
    """Photons that walk, the seconds that they take, and the filter's field data."""

    def __init__(self, surface, material, across, photons, seed=1):
        self.filter = lt.vtkSubsurfaceScattering()
        self.filter.SetInputData(surface)
        Medium(material).set_on(self.filter, across)
        self.filter.SetModelToMonteCarlo()
        self.filter.SetNumberOfPhotons(photons)
        self.filter.SetSeed(seed)
        begin, cpu_begin = time.perf_counter(), time.process_time()
        self.filter.Update()
        self.seconds = time.perf_counter() - begin
        self.cpu_seconds = time.process_time() - cpu_begin

    def field(self, name):
        return vtk_to_numpy(self.filter.GetOutput().GetFieldData().GetArray(name)).ravel()


def print_speed(photons):
    bodies = [
        ("sphere", make_sphere(3), "marble", 16.5),
        ("sphere", make_sphere(3), "skim milk", 55.0),
        ("sphere, 20,480 triangles", make_sphere(5), "marble", 16.5),
        ("cube", make_box(1, 1, 1, 0), "index 1", 60.3),
        ("cube", make_box(1, 1, 1, 0), "index 1.37", 60.3),
        ("slab 10 by 10 by 1", make_box(10, 10, 1, 0), "marble", 43.8),
        ("bunny", make_bunny(), "marble", 100.0),
    ]
    bodies += [("sphere", make_sphere(3), albedo, across)
               for across in (10.0, 100.0) for albedo in (0.5, 0.9, 0.99, 0.999)]
    print(f"{'body':26} {'medium':10} {'across':>6} {'scatterings':>11} {'photons/CPU ms':>14} "
          f"{'photons/ms':>10}")
    for name, surface, material, across in bodies:
        add_light(surface, (1, 0, 0))
        # The first run brings in what is loaded once, and the short one what a run costs anyway.
        Walks(surface, material, across, 1000)
        little = Walks(surface, material, across, 1000)
        walks = Walks(surface, material, across, photons)
        cpu_speed, speed = (
            (photons - 1000) / (seconds - before) / 1000.0 for seconds, before in
            ((walks.cpu_seconds, little.cpu_seconds), (walks.seconds, little.seconds)))
        scatterings = walks.field("ScatteringsPerPhoton")[0]
        print(f"{name:26} {material!s:10} {across:6g} {scatterings:11.1f} {cpu_speed:14.0f} "
              f"{speed:10.0f}", flush=True)


def make_report(folder, name, surface, prepare, **values):
    """Rows of the report's table, NAME.csv. `prepare` sets the medium of a filter."""
    options = argparse.Namespace(
        **{"levels": 0, "repeat": 1, "quiet": True, "models": None,
           "link_tolerances": [1e-1, 1e-2, 1e-3], "target_errors": [0.1, 0.05]} | values)

    def make_filter():
        scattering = lt.vtkSubsurfaceScattering()
        prepare(scattering)
        return scattering

    subject = Scattering(options, make_filter)
    os.makedirs(folder, exist_ok=True)
    record = Record(folder, subject.COLUMNS, quiet=True)
    record.file = os.path.join(folder, name + ".csv")
    Study(options, Messages(), record, subject).run(surface)
    return record.rows


def measure_models(folder, error):
    bodies = {"sphere": lambda: make_sphere(3), "plate": lambda: make_box(1, 1, 0.1, 4),
              "bunny": make_bunny}
    print(f"{'body':7} {'material':10} {'across':>6} {'model':20} {'tolerance':>9} {'CPU s':>7} "
          f"{'error, %':>20} {'worst band':>10} {'total':>7}")
    for name, make in bodies.items():
        for material in MATERIALS:
            for across in (20, 100):
                surface = make()
                add_light(surface, (1, 1, 1))
                rows = make_report(
                    folder, f"{name}_{material.replace(' ', '')}_{across}", surface,
                    lambda scattering, m=material, a=across: Medium(m).set_on(scattering, a),
                    reference_error=error)
                for row in rows:
                    print_row((name, material, across), row)


def print_row(what, row):
    ends = [100.0 * (row[name] or 0.0) for name in ("error_l2", "error_l2_low", "error_l2_high")]
    print(f"{what[0]:7} {what[1]:10} {what[2]:6g} {row['method']:20} {row['tolerance']:9g} "
          f"{row['seconds_cpu']:7.2f} " + "{:6.2f} ({:5.2f}, {:5.2f})".format(*ends) +
          f" {100.0 * (row['error_worst_band'] or 0.0):10.2f} {row['ratio_total'] or 1.0:7.4f}",
          flush=True)


def draw_bunny(folder, error):
    """A line for each model and material through the sizes."""
    surface = make_bunny()
    add_light(surface, (1, 1, 1))
    bounds = surface.GetBounds()
    height = bounds[3] - bounds[2]
    tables = {}
    for material, number in MATERIALS.items():
        for millimeters in HEIGHTS:
            def prepare(scattering, number=number, scale=millimeters / height):
                scattering.SetMaterial(number)
                scattering.SetMillimetersPerUnit(scale)
            rows = make_report(
                folder, f"bunny_{material.replace(' ', '')}_{millimeters}mm", surface, prepare,
                reference_error=error, target_errors=[0.05], link_tolerances=[1e-3])[1:]
            for row in rows:
                print_row(("bunny", material, millimeters), row)
                tables.setdefault((row["method"], material), []).append(row)
    methods = list(dict.fromkeys(method for method, _material in tables))
    lines = [make_line(method, material, rows, methods.index(method))
             for (method, material), rows in sorted(
                 tables.items(), key=lambda item: methods.index(item[0][0]))]
    plot_lines(os.path.join(folder, "bunny_models.png"), lines, "height of the bunny in mm",
               "error in % (root mean square over the area)")


def make_line(method, material, rows, family):
    seconds = [row["seconds_cpu"] for row in rows]
    percent = [[100.0 * row[name] for row in rows]
               for name in ("error_l2", "error_l2_low", "error_l2_high")]
    return Line(f"{method}, {material} ({np.median(seconds):.2g} s)", HEIGHTS, percent[0], family,
                1.0 if material == "marble" else 0.3, *percent[1:])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="what", required=True)
    speed = commands.add_parser("speed")
    speed.add_argument("--photons", type=int, default=400000)
    speed.add_argument("--threads", default="1")
    for name, error in (("models", 0.03), ("bunny", 0.02)):
        command = commands.add_parser(name)
        command.add_argument("folder")
        command.add_argument("--error", type=float, default=error)
    options = parser.parse_args()
    if options.what == "speed":
        os.environ.update(VTK_SMP_BACKEND_IN_USE="STDThread", VTK_SMP_MAX_THREADS=options.threads)
        print_speed(options.photons)
    else:
        {"models": measure_models, "bunny": draw_bunny}[options.what](options.folder, options.error)


if __name__ == "__main__":
    main()
