#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Links of scattering of many patches: how long they take to make and to apply, and their bytes.

    scattering_links.py texels [--sizes 64,128,256,512] [--surface FILE.ply]
    scattering_links.py bodies [--cuts 0,1,2,3,4] [--surface FILE.ply]
    scattering_links.py balls [--sides 30,60,190] [--method Dense]

`texels` takes those of the surface's atlas, 10 mm per unit; `bodies` cut each of its triangles in
4^CUTS, and `balls` have about two triangles for the square of SIDES: these are 100 mean free paths
across. Light falls in from one side on marble (photon beam diffusion). --compress and --links are
CompressLinks and NumberOfLinks; seconds are those of the process on all processors, but those of
the product, the least of some by the clock.
"""

import argparse
import pathlib
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYReader

BUNNY = pathlib.Path(__file__).parents[2] / "Data" / "bunny.ply"
# Of marble's red, per mm.
EXTINCTION = 2.19 + 0.0021
REPEATS = 5


def light(surface):
    """The same surface, lit from one side."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (points[corners[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]
    irradiance = numpy_to_vtk(np.maximum(0.0, normals @ [0.3, 0.5, 0.8124]) + 0.02, deep=True)
    irradiance.SetName("Irradiance")
    surface.GetCellData().AddArray(irradiance)
    return surface


def read(path):
    reader = vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def make_texels(surface, size):
    atlas = lt.vtkSurfaceAtlas()
    atlas.SetInputData(surface)
    atlas.SetResolution(size)
    atlas.Update()
    texels = lt.vtkSurfaceToAtlas()
    texels.SetInputData(0, light(atlas.GetOutput(0)))
    texels.Update()
    return texels.GetOutput()


def cut(surface, cuts):
    if cuts == 0:
        return surface
    subdivision = vtkLinearSubdivisionFilter()
    subdivision.SetInputData(surface)
    subdivision.SetNumberOfSubdivisions(cuts)
    subdivision.Update()
    return subdivision.GetOutput()


def make_ball(sides):
    ball = vtkSphereSource()
    ball.SetThetaResolution(sides)
    ball.SetPhiResolution(sides)
    ball.Update()
    return ball.GetOutput()


def measure(name, patches, scale, arguments):
    scattering = lt.vtkSubsurfaceScattering()
    scattering.SetInputData(patches)
    scattering.SetMaterialToMarble()
    scattering.SetModelToPhotonBeamDiffusion()
    scattering.SetMillimetersPerUnit(scale)
    getattr(scattering, f"SetLinkMethodTo{arguments.method}")()
    scattering.SetNumberOfLinks(arguments.links)
    scattering.SetCompressLinks(arguments.compress)
    scattering.SetDeviceToCPU()

    def get(field):
        return scattering.GetOutput().GetFieldData().GetArray(field).GetValue(0)

    begin = time.process_time()
    scattering.Update()
    seconds = time.process_time() - begin
    links = get("LinksPerReceiver")
    megabytes = get("LinkBytes") / 1e6
    applied = get("ApplySeconds")
    for _ in range(REPEATS):
        patches.Modified()
        scattering.Update()
        applied = min(applied, get("ApplySeconds"))
    print(f"{name}: {links:.1f} links each, {megabytes:.1f} MB, {seconds:.2f} CPU s; applied in "
          f"{1e3 * applied:.0f} ms", flush=True)


def get_diagonal(surface):
    return np.linalg.norm(np.diff(np.reshape(surface.GetBounds(), (3, 2)), axis=1))


def measure_body(surface, arguments):
    scale = 100.0 / (EXTINCTION * get_diagonal(surface))
    name = f"{surface.GetNumberOfCells()} triangles"
    measure(name, light(surface), scale, arguments)


def main():
    def numbers(text):
        return [int(number) for number in text.split(",")]

    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("texels", "bodies", "balls"))
    parser.add_argument("--sizes", type=numbers, default=[64, 128, 256, 512])
    parser.add_argument("--cuts", type=numbers, default=[0, 1, 2, 3, 4])
    parser.add_argument("--sides", type=numbers, default=[30, 60, 190])
    parser.add_argument("--surface", default=BUNNY)
    parser.add_argument("--method", default="Adaptive")
    parser.add_argument("--links", type=int, default=64)
    parser.add_argument("--compress", action="store_true")
    arguments = parser.parse_args()
    if arguments.what == "texels":
        for size in arguments.sizes:
            measure(f"{size} x {size} texels", make_texels(read(arguments.surface), size), 10.0,
                    arguments)
    elif arguments.what == "bodies":
        for cuts in arguments.cuts:
            measure_body(cut(read(arguments.surface), cuts), arguments)
    else:
        for sides in arguments.sides:
            measure_body(make_ball(sides), arguments)


if __name__ == "__main__":
    main()
