#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Solar panels in rows: how much of the sky a panel sees past the row before it."""

import math

import numpy

import vtklighttransport as lt
from shapes import draw, expect, make_plates
from vtklighttransport.arrays import get_cell_array

TILT, WIDTH, PITCH = math.radians(30.0), 2.0, 3.5  # m
UP = numpy.array([0.0, math.cos(TILT), math.sin(TILT)])  # along a panel, from its lower edge


def make_field(rows, length, patches, front):
    """Rows along x, one behind the other along y, on the ground; panels have two sides."""
    plates = []
    for k in range(rows):
        corner = numpy.array([0.0, PITCH * k, 0.05])
        plates += [("panels", corner, (length, 0, 0), WIDTH * UP, (patches, 10)),
                   ("backs", corner, WIDTH * UP, (length, 0, 0), (2, patches))]
    depth = PITCH * rows + front
    plates.append(("ground", (-2, -front, 0), (length + 4, 0, 0), (0, depth, 0),
                   (patches, int(2 * depth))))
    return make_plates(*plates)


def view_sky(field, rows, patches):
    """The job itself: for each row the patches along it, and those from its lower edge upwards."""
    matrix = lt.view_factors(field, tolerance=3e-3)
    panels = get_cell_array(field, "Region") == 0
    return matrix, matrix.sky[panels].reshape(rows, patches, 10)


# Two rows without end: from the horizon down to a panel's own plane it sees all but what is below
# the upper edge of the row before, half the difference of the sines from its normal.
_, sky = view_sky(make_field(2, 150.0, 25, 8.0), 2, 25)
place = PITCH * numpy.array([0.0, 1.0, 0.0]) + numpy.multiply.outer(
    (numpy.arange(10) + 0.5) / 10.0 * WIDTH, UP)
edge = WIDTH * UP - place
angle = numpy.arctan2(edge[:, 2], edge[:, 1]) - TILT - math.pi / 2.0
wanted = (1.0 + numpy.sin(angle)) / 2.0
found = sky[1, 12]
expect("sky seen from the lower edge of a panel", found[0], wanted[0], 0.01)
expect("sky seen from its upper edge", found[9], wanted[9], 0.01)
expect("sky seen from the whole panel", found.mean(), wanted.mean(), 0.01)
print(f"lost to the row before: {1.0 - 2.0 * found.mean() / (1.0 + math.cos(TILT)):.1%}")

matrix, _ = view_sky(make_field(4, 16.0, 16, 2.0), 4, 16)
draw("solar_rows", matrix.mesh, "SkyFraction", (0.5, 1.0), "sky view", (-0.5, -1.0, 0.5))
