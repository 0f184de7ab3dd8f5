# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces that are hard for a mesher: walls that are thin, solids that touch, sheets with two
sides, corners on edges, surfaces with one side, corners that differ by rounding."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def make_surface(points, faces):
    """vtkPolyData of an array of points and lists of corners."""
    places = vtkPoints()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    cells = vtkCellArray()
    for face in faces:
        cells.InsertNextCell(len(face), [int(corner) for corner in face])
    surface = vtkPolyData()
    surface.SetPoints(places)
    surface.SetPolys(cells)
    return surface


def join(*parts):
    """One list of points and one of triangles."""
    points, triangles, first = [], [], 0
    for part in parts:
        points.append(part[0])
        triangles.append(np.asarray(part[1]) + first)
        first += len(part[0])
    return np.vstack(points), np.vstack(triangles)


def turn(part):
    """The other side."""
    return part[0], np.asarray(part[1])[:, ::-1]


def make_grid(rows, columns, place):
    """Triangles of rows x columns squares over the unit square."""
    points = [place(i / rows, j / columns) for i in range(rows + 1) for j in range(columns + 1)]
    triangles = []
    for i in range(rows):
        for j in range(columns):
            a = i * (columns + 1) + j
            triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
    return np.array(points, float), np.array(triangles)


def make_box(sizes, corner=(0, 0, 0), extent=(1, 1, 1)):
    """A box with a grid of its own on each of its six sides; they share no points."""
    parts = []
    for side in range(6):
        axis, end = side // 2, side % 2

        def place(u, v, axis=axis, end=end):
            point = [0.0, 0.0, 0.0]
            point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3] = end, u, v
            return point

        part = make_grid(sizes[side], sizes[side], place)
        parts.append(turn(part) if end else part)
    points, triangles = join(*parts)
    return np.asarray(corner) + points * np.asarray(extent), triangles[:, ::-1]


def make_ring(rows, columns, turns):
    """Triangles between rows of points, closed around, turned over where turns are odd."""
    triangles = []
    for i in range(rows):
        for j in range(columns):
            a = i * (columns + 1) + j
            c, d = a + columns + 2, a + columns + 1
            if i == rows - 1:
                c, d = (columns - j - 1, columns - j) if turns % 2 else (j + 1, j)
            triangles += [(a, a + 1, c), (a, c, d)]
    return np.array(triangles)


def make_moebius(turns, rows=80, columns=4):
    """A band that is turned over so many times."""
    points = []
    for t in 2 * np.pi * np.arange(rows) / rows:
        for s in np.linspace(-0.3, 0.3, columns + 1):
            radius = 1 + s * np.cos(turns * t / 2)
            height = s * np.sin(turns * t / 2)
            points.append((radius * np.cos(t), radius * np.sin(t), height))
    return np.array(points), make_ring(rows, columns, turns)


def make_klein(rows=40, columns=20):
    """Klein's bottle, as an eight that turns over on its way round: it crosses itself."""
    points = []
    for u in 2 * np.pi * np.arange(rows) / rows:
        for v in 2 * np.pi * np.arange(columns + 1) / columns:
            x = 2 + np.cos(u / 2) * np.sin(v) - np.sin(u / 2) * np.sin(2 * v)
            z = np.sin(u / 2) * np.sin(v) + np.cos(u / 2) * np.sin(2 * v)
            points.append((x * np.cos(u), x * np.sin(u), z))
    triangles = make_ring(rows, columns, 1)
    seam = triangles % (columns + 1) == columns
    return np.array(points), np.where(seam, triangles - columns, triangles)


def make_wall(columns, profile):
    """What a closed profile (radius, height) makes around the axis."""
    points = [
        (r * np.cos(t), r * np.sin(t), z)
        for r, z in profile
        for t in 2 * np.pi * np.arange(columns) / columns
    ]
    triangles = []
    for i in range(len(profile)):
        for j in range(columns):
            below, above = i * columns, (i + 1) % len(profile) * columns
            k = (j + 1) % columns
            triangles += [(below + j, below + k, above + k), (below + j, above + k, above + j)]
    return np.array(points), np.array(triangles)


def make_bowl(wall):
    """A bowl with a hole in its ground."""
    angles = np.linspace(0.2, np.pi / 2, 12)
    outside = [(np.sin(t), -np.cos(t)) for t in angles]
    inside = [((1 - wall) * r, (1 - wall) * z) for r, z in outside[::-1]]
    return make_wall(48, outside + inside)


def make_soup(part, noise):
    """Each triangle with corners of its own, off by rounding."""
    points = part[0][part[1]].reshape(-1, 3)
    points += np.random.default_rng(0).normal(0.0, noise, points.shape)
    return points, np.arange(len(points)).reshape(-1, 3)


def make_kinds():
    """Names and surfaces."""
    for wall in (0.05, 0.01, 0.002):
        yield f"bowl, wall {wall}", make_surface(*make_bowl(wall))
        tube = make_wall(32, [(1, 0), (1, 2), (1 - wall, 2), (1 - wall, 0)])
        yield f"tube, wall {wall}", make_surface(*tube)
        yield f"plate {wall}", make_surface(*make_box([3] * 6, extent=(1, 1, wall)))
    for size in (1, 2, 3):
        first = make_box([2] * 6)
        for name, corner in (("face", (1, 0, 0)), ("edge", (1, 1, 0)), ("point", (1, 1, 1))):
            second = make_box([size] * 6, corner)
            yield f"boxes, a {name}, 2:{size}", make_surface(*join(first, second))
        third = make_box([1] * 6, (2, 0, 0))
        row = join(first, make_box([size] * 6, (1, 0, 0)), third)
        yield f"three boxes, 2:{size}:1", make_surface(*row)
        corner = join(first, make_box([size] * 6, (1, 0, 0)), make_box([1] * 6, (0, 1, 0)))
        yield f"boxes in a corner, 2:{size}:1", make_surface(*corner)
        sheet = make_grid(size, size, lambda u, v: (u, v, 0.1 * np.sin(3 * u)))
        yield f"sheet, two sides, {size}", make_surface(*join(sheet, turn(sheet)))
    for levels in (1, 3, 5):
        strips = [
            make_grid(1, 2**k, lambda u, v, k=k: (k + u, 2 * v, 0)) for k in range(levels + 1)
        ]
        yield f"corners on edges, {levels}", make_surface(*join(*strips))
        sizes = [1 + side * levels % 7 for side in range(6)]
        yield f"box of grids {sizes}", make_surface(*make_box(sizes))
    for turns in (1, 2, 3, 5):
        yield f"band, {turns} turns", make_surface(*make_moebius(turns))
    yield "Klein's bottle", make_surface(*make_klein())
    for noise in (1e-15, 1e-14, 1e-12):
        yield f"box, noise {noise}", make_surface(*make_soup(make_box([4] * 6), noise))
