# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of rectangles, numbers that must come out, and pictures: what the gallery shares."""

import os
import sys

import numpy

from vtklighttransport.arrays import make_surface
from vtklighttransport.meshes import set_regions
from vtklighttransport.pictures import look_at, render_cell_array

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../Data")


def make_plates(*plates):
    """A surface of rectangles, each (region, corner, one side, the other side, patches along both).

    The front is where both sides turn counter-clockwise.
    """
    names = list(dict.fromkeys(plate[0] for plate in plates))
    points, polygons, regions = [], [], []
    for name, corner, along, across, (m, n) in plates:
        first = sum(map(len, points))
        u, v = numpy.meshgrid(numpy.arange(m + 1) / m, numpy.arange(n + 1) / n, indexing="ij")
        points.append(numpy.add(corner, numpy.multiply.outer(u.ravel(), along)
                                + numpy.multiply.outer(v.ravel(), across)))
        i, j = (index.ravel() for index in numpy.meshgrid(range(m), range(n), indexing="ij"))
        start = first + i * (n + 1) + j
        polygons.append(numpy.stack([start, start + n + 1, start + n + 2, start + 1], axis=1))
        regions += [names.index(name)] * (m * n)
    surface = make_surface(numpy.concatenate(points), numpy.concatenate(polygons))
    set_regions(surface, regions, names)
    return surface


def make_block(name, low, high, counts):
    """The sides and the top of a block that stands on the floor, seen from outside."""
    (x, y, z), (a, b, c) = low, numpy.subtract(high, low)
    i, j, k = counts
    return [(name, (x, y, z), (a, 0, 0), (0, 0, c), (i, k)),
            (name, (x + a, y, z), (0, b, 0), (0, 0, c), (j, k)),
            (name, (x + a, y + b, z), (-a, 0, 0), (0, 0, c), (i, k)),
            (name, (x, y + b, z), (0, -b, 0), (0, 0, c), (j, k)),
            (name, (x, y, z + c), (a, 0, 0), (0, b, 0), (i, j))]


def draw(name, surface, array, color_range, title, direction, logarithmic=False):
    """FOLDER/name.png, where the script was given a folder; z is up."""
    if len(sys.argv) > 1:
        os.makedirs(sys.argv[1], exist_ok=True)
        render_cell_array(os.path.join(sys.argv[1], name + ".png"), surface, array, color_range,
                          title, look_at(surface, direction, up=(0, 0, 1)), logarithmic,
                          size=(640, 480))


def expect(what, found, wanted, tolerance):
    """Prints a number beside the one that theory or a catalogue has; the script ends where they
    differ."""
    print(f"{what}: {found:.5g} (expected {wanted:.5g})")
    if not abs(found - wanted) <= tolerance * abs(wanted):
        sys.exit(f"{what} is {found}, not {wanted}")
