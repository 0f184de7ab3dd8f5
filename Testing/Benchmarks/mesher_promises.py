#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What vtkPatchMesher keeps of a surface, a row for each mesh, before and after: pairs of triangles
of one component that cross, pieces, borders (connected edges with one triangle), area and volume;
seconds of the processor; and what is not kept, though no message tells so:

    X  patches cross, and the surface does not
    P  other pieces             B  other borders
    A  more than 5 % of the area or, of a closed surface, of the volume is gone
    E  an error

    mesher_promises.py --kinds MESH...      .off, .ply, .stl, .vtp, or a folder of them

Self-intersections of the meshes are kept. Exit 1 where a letter stands.
"""

import argparse
import os
import sys
import time

from mesher_kinds import make_kinds, make_surface
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersCore import (
    vtkCleanPolyData,
    vtkFeatureEdges,
    vtkPolyDataConnectivityFilter,
    vtkTriangleFilter,
)
from vtkmodules.vtkIOGeometry import vtkSTLReader
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
import numpy
import vtklighttransport as lt

READERS = {".ply": vtkPLYReader, ".stl": vtkSTLReader, ".vtp": vtkXMLPolyDataReader}


def read_off(path):
    with open(path, encoding="utf-8") as file:
        lines = [line.split("#")[0].split() for line in file]
    lines = [line for line in lines if line]
    if not lines or not lines[0][0].endswith("OFF"):
        return None
    header = lines[0][1:] or lines[1]
    size, number = int(header[0]), int(header[1])
    faces = lines[1:] if lines[0][1:] else lines[2:]
    points, faces = faces[:size], faces[size:]
    # What follows the corners of a face in its line is its colour.
    corners = [[int(word) for word in line[1:][: int(line[0])]] for line in faces[:number]]
    places = numpy.array([line[:3] for line in points], float)
    return make_surface(places, corners) if corners else None


def read(path):
    kind = os.path.splitext(path)[1]
    if kind == ".off":
        return read_off(path)
    reader = READERS[kind]()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def find_files(paths):
    for path in paths:
        if os.path.isdir(path):
            names = sorted(os.listdir(path), key=str.lower)
            yield from (os.path.join(path, n) for n in names if n.endswith((".off", *READERS)))
        else:
            yield path


def run(made, source):
    """The output of a filter of VTK."""
    made.SetInputData(source)
    made.Update()
    return made.GetOutput()


def count_pieces(surface):
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetExtractionModeToAllRegions()
    run(pieces, surface)
    return pieces.GetNumberOfExtractedRegions()


class Measures:
    """Of a surface whose points with equal coordinates, but for rounding, are one."""

    def __init__(self, surface):
        cleaner = vtkCleanPolyData()
        cleaner.ToleranceIsAbsoluteOn()
        cleaner.SetAbsoluteTolerance(1e-13 * surface.GetLength())
        cleaner.ConvertPolysToLinesOff()
        whole = run(cleaner, surface)
        triangles = run(vtkTriangleFilter(), surface)
        self.pieces = count_pieces(whole)
        edges = vtkFeatureEdges()
        edges.FeatureEdgesOff()
        edges.NonManifoldEdgesOff()
        border = run(edges, whole)
        self.borders = count_pieces(border) if border.GetNumberOfCells() else 0
        points = vtk_to_numpy(triangles.GetPoints().GetData()).astype(float)
        corners = vtk_to_numpy(triangles.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        a, b, c = (points[corners[:, i]] - points.mean(0) for i in range(3))
        normals = numpy.cross(b - a, c - a)
        self.area = numpy.linalg.norm(normals, axis=1).sum() / 2
        self.volume = numpy.einsum("ij,ij->", a, normals) / 6


def get(surface, name):
    array = surface.GetFieldData().GetArray(name)
    return int(vtk_to_numpy(array)[0]) if array else -1


def find_broken(before, after, crossings, message):
    """The letters above."""
    letters = ""
    repaired = "repaired" in message or "cut along" in message or "are loose" in message
    if crossings[0] == 0 and crossings[1] > 0 and "cross" not in message:
        letters += "X"
    if before.pieces != after.pieces and not repaired:
        letters += "P"
    if before.borders != after.borders and not repaired:
        letters += "B"
    left = after.area / before.area
    if before.borders == 0 and abs(before.volume) > 1e-6 * before.area**1.5 and not repaired:
        left = min(left, after.volume / before.volume)
    if left < 0.95 and "lost more than" not in message and not repaired:
        letters += "A"
    return letters


def look_at(name, surface, settings):
    """Print a row, and return the letters of what is broken."""
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    mesher = lt.vtkPatchMesher()
    mesher.SetInputData(surface)
    mesher.SetSelfIntersectionsToKeep()
    for setting in settings:
        key, _, value = setting.partition("=")
        getattr(mesher, "Set" + key)(float(value) if set(value) & set(".e") else int(value))
    start = time.process_time()
    mesher.Update()
    seconds = time.process_time() - start
    message = window.GetOutput()
    patches = mesher.GetOutput()
    title = f"{name[:26]:<26} {surface.GetNumberOfCells():>8} {patches.GetNumberOfCells():>8}"
    texts = [line.split("): ", 1)[1] for line in message.splitlines() if "): " in line]
    if patches.GetNumberOfCells() == 0:
        print(title, "E", " ".join(texts), flush=True)
        return "E"
    crossings = get(patches, "NumberOfInputSelfIntersections"), get(
        patches, "NumberOfSelfIntersections"
    )
    before, after = Measures(surface), Measures(patches)
    letters = find_broken(before, after, crossings, message)
    numbers = (*crossings, before.pieces, after.pieces, before.borders, after.borders)
    parts = [after.area / before.area, after.volume / before.volume if before.volume else 1.0]
    print(
        title,
        *(f"{number:>6}" for number in numbers),
        *(f"{part:>7.3f}" for part in parts),
        f"{seconds:>6.2f} {letters:<4}",
        " ".join(texts),
        flush=True,
    )
    return letters


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("meshes", nargs="*")
    parser.add_argument("--kinds", action="store_true", help="surfaces that are hard, made here")
    parser.add_argument("--largest", type=int, default=200000, help="cells of a mesh that is taken")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE")
    options = parser.parse_args()
    titles = ("cross", "after", "pieces", "after", "border", "after")
    print(
        f"{'mesh':<26} {'cells':>8} {'patches':>8}",
        *(f"{title:>6}" for title in titles),
        f"{'area':>7} {'volume':>7} {'CPU s':>6}",
    )
    broken = 0
    for name, surface in make_kinds() if options.kinds else ():
        broken += look_at(name, surface, options.set) != ""
    for path in find_files(options.meshes):
        surface = read(path)
        name = os.path.basename(path)
        if surface is None or surface.GetNumberOfPolys() == 0:
            print(f"{name[:26]:<26} no surface mesh")
        elif surface.GetNumberOfCells() > options.largest:
            print(f"{name[:26]:<26} {surface.GetNumberOfCells():>8} left out")
        else:
            broken += look_at(name, surface, options.set) != ""
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
