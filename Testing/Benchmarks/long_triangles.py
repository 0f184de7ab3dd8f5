#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What long triangles, as CAD exports them, cost vtkPatchMesher and vtkSurfaceAtlas: triangles
before and after, seconds of the processor, and the atlas's stretch. A row for each size.

    long_triangles.py mesher|atlas fan TRIANGLES...     a disc of triangles around one point
    long_triangles.py mesher|atlas rod LENGTH SIDES...  of radius 1: two triangles a side, two fans
"""

import math
import sys
import time

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
import vtklighttransport as lt


def make_surface(corners, triangles):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    for corner in corners:
        points.InsertNextPoint(corner)
    cells = vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, triangle)
    surface = vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    return surface


def get_corner(i, number, height):
    angle = 2.0 * math.pi * i / number
    return (math.cos(angle), math.sin(angle), height)


def make_fan(number):
    corners = [get_corner(i, number, 0.0) for i in range(number)]
    triangles = [(number, i, (i + 1) % number) for i in range(number)]
    return make_surface(corners + [(0.0, 0.0, 0.0)], triangles)


def make_rod(sides, length):
    corners = [get_corner(i, sides, height) for i in range(sides) for height in (0.0, length)]
    low, high = 2 * sides, 2 * sides + 1
    triangles = []
    for i in range(sides):
        a, b = 2 * i, 2 * ((i + 1) % sides)
        triangles += [(a, b, b + 1), (a, b + 1, a + 1), (low, b, a), (high, a + 1, b + 1)]
    return make_surface(corners + [(0.0, 0.0, 0.0), (0.0, 0.0, length)], triangles)


def main():
    kind, shape = sys.argv[1:3]
    sizes = sys.argv[3:] if shape == "fan" else sys.argv[4:]
    print("triangles     after     CPU s   stretch")
    for size in sizes:
        surface = make_fan(int(size)) if shape == "fan" else make_rod(int(size), float(sys.argv[3]))
        algorithm = lt.vtkPatchMesher() if kind == "mesher" else lt.vtkSurfaceAtlas()
        if kind == "atlas":
            algorithm.SetResolution(64)
            algorithm.SetTexelMaps(False)
        algorithm.SetInputData(surface)
        start = time.process_time()
        algorithm.Update()
        seconds = time.process_time() - start
        output = algorithm.GetOutput()
        stretch = output.GetFieldData().GetArray("L2Stretch")
        text = f"{stretch.GetTuple1(0):10.3f}" if stretch else ""
        counts = (surface.GetNumberOfCells(), output.GetNumberOfCells())
        print(f"{counts[0]:9}{counts[1]:10}{seconds:10.2f}{text}", flush=True)


if __name__ == "__main__":
    main()
