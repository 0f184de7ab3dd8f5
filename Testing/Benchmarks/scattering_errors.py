#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Error of adaptive links of scattering, beside the error that they tell.

    scattering_errors.py [--sizes 10,100,1000] [--tolerances 0.01] [--bodies bunny,plate,spot]
                         [--dragon FILE.ply]

The bunny, a thin plate and, where it is given, the dragon, of marble and skim milk (photon beam
diffusion), as many mean free paths of the red across as `--sizes`, lit from one side with a sharp
border of light and shade, or in a spot. Links for any light and for this one (RefineByIrradiance),
at most 64 a patch, and as many as LinkTolerance asks for; against all pairs at 1e-4. Errors are
relative, L2, of the worst band. A line ends in the error over the told one.
"""

import argparse
import gzip
import pathlib
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOPLY import vtkPLYReader

BUNNY = pathlib.Path(__file__).parents[2] / "Data" / "bunny.ply"
# Of the red, per mm: reduced scattering and absorption.
EXTINCTION = {"Marble": 2.19 + 0.0021, "Skimmilk": 0.70 + 0.0014}
MANY = 1000000


def read(path):
    path = pathlib.Path(path)
    reader = vtkPLYReader()
    if path.suffix == ".gz":
        reader.ReadFromInputStringOn()
        reader.SetInputString(gzip.decompress(path.read_bytes()).decode("latin-1"))
    else:
        reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def make_plate(side=36, thickness=0.05):
    """1 x 1 x .05, with one square across the thickness."""
    faces = vtkAppendPolyData()
    low = np.array([0.0, 0.0, 0.0])
    high = np.array([1.0, 1.0, thickness])
    for axis in range(3):
        for end in (0, 1):
            u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            if end == 0:
                u, v = v, u
            size = high - low
            origin = low + end * size * np.eye(3)[axis]
            plane = vtkPlaneSource()
            plane.SetOrigin(origin)
            plane.SetPoint1(origin + u * size)
            plane.SetPoint2(origin + v * size)
            plane.SetXResolution(max(1, round(side * float(u @ size))))
            plane.SetYResolution(max(1, round(side * float(v @ size))))
            plane.Update()
            faces.AddInputData(plane.GetOutput())
    clean = vtkCleanPolyData()
    clean.SetInputConnection(faces.GetOutputPort())
    triangles = vtkTriangleFilter()
    triangles.SetInputConnection(clean.GetOutputPort())
    triangles.Update()
    return triangles.GetOutput()


def light(surface, is_spot):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (points[corners[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    values = np.maximum(0.0, normals @ [0.3, 0.5, 0.8124])
    if is_spot:
        brightest = (a + b + c)[np.argmax(values)]
        values *= np.linalg.norm(a + b + c - brightest, axis=1) < 0.15 * get_diagonal(surface)
    irradiance = numpy_to_vtk(values, deep=True)
    irradiance.SetName("Irradiance")
    surface.GetCellData().AddArray(irradiance)
    return surface


def get_diagonal(surface):
    return float(np.linalg.norm(np.diff(np.reshape(surface.GetBounds(), (3, 2)), axis=1)))


def scatter(surface, material, size, **properties):
    scattering = lt.vtkSubsurfaceScattering()
    scattering.SetInputData(surface)
    getattr(scattering, f"SetMaterialTo{material}")()
    scattering.SetModelToPhotonBeamDiffusion()
    scattering.SetMillimetersPerUnit(size / EXTINCTION[material] / get_diagonal(surface))
    scattering.SetDeviceToCPU()
    scattering.SetReuseLinks(False)
    for name, value in properties.items():
        getattr(scattering, f"Set{name}")(value)
    begin = time.process_time()
    scattering.Update()
    seconds = time.process_time() - begin
    output = scattering.GetOutput()
    return output, vtk_to_numpy(output.GetCellData().GetArray("ScatteredIrradiance")), seconds


def get_areas(surface):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (points[corners[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1)


def run(name, surface, material, size, tolerances):
    adaptive = lt.vtkSubsurfaceScattering.LINK_METHOD_ADAPTIVE
    dense = lt.vtkSubsurfaceScattering.LINK_METHOD_DENSE
    _, exact, seconds = scatter(surface, material, size, LinkMethod=dense, LinkTolerance=1e-4)
    areas = get_areas(surface)[:, None]
    print(f"{name}, {material}, {size} mean free paths: all pairs {seconds:.1f} CPU s")
    for tolerance in tolerances:
        for is_lit in (False, True):
            for most in (64, MANY):
                output, found, seconds = scatter(
                    surface, material, size, LinkMethod=adaptive, LinkTolerance=tolerance,
                    NumberOfLinks=most, RefineByIrradiance=is_lit)
                squares = (areas * (found - exact) ** 2).sum(0) / (areas * exact ** 2).sum(0)
                error = float(np.sqrt(squares.max()))
                fields = output.GetFieldData()
                told = fields.GetArray("LinkError").GetValue(0)
                links = fields.GetArray("LinksPerReceiver").GetValue(0)
                limit = fields.GetAbstractArray("LinksLimitedBy").GetValue(0)
                print(f"  {'this' if is_lit else 'any '} light: {links:6.1f} links, "
                      f"{100 * error:.2f} % (told {100 * told:.2f} %), by {limit}, "
                      f"{seconds:.2f} CPU s; {error / told:.2f}", flush=True)


def main():
    def numbers(text):
        return [float(number) for number in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=numbers, default=[10.0, 100.0, 1000.0])
    parser.add_argument("--tolerances", type=numbers, default=[0.01])
    parser.add_argument("--bodies", default="bunny,plate,spot")
    parser.add_argument("--dragon")
    arguments = parser.parse_args()
    bodies = {"bunny": lambda: read(BUNNY), "plate": make_plate, "spot": lambda: read(BUNNY)}
    names = arguments.bodies.split(",")
    if arguments.dragon:
        bodies["dragon"] = lambda: read(arguments.dragon)
        names.append("dragon")
    for name in names:
        surface, is_spot = bodies[name](), name == "spot"
        for material in EXTINCTION:
            for size in arguments.sizes:
                run(name, light(surface, is_spot), material, size, arguments.tolerances)


if __name__ == "__main__":
    main()
