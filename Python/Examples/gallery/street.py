#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""How much of the sky is seen from a street."""

import math

import numpy

import vtklighttransport as lt
from shapes import draw, expect, make_block, make_plates
from vtklighttransport.arrays import get_cell_array

WIDTH = 20.0


def make_street(heights, gap, length):
    """Houses of 20 m on both sides of a street along y."""
    plates = [("road", (-WIDTH / 2, 0, 0), (WIDTH, 0, 0), (0, length, 0), (10, int(length / 4)))]
    step = length / len(heights)
    for k, height in enumerate(heights):
        for low, high in ((-WIDTH / 2 - 15, -WIDTH / 2), (WIDTH / 2, WIDTH / 2 + 15)):
            plates += make_block("houses", (low, k * step + gap / 2, 0),
                                 (high, (k + 1) * step - gap / 2, height),
                                 (4, int(step / 5), 5))
            if gap:
                plates += [("gardens", (low, y, 0), (15, 0, 0), (0, gap / 2, 0), (4, 1))
                           for y in (k * step, (k + 1) * step - gap / 2)]
    return make_plates(*plates)


def view_sky(street):
    """The job itself; the road's patches come first, ten abreast."""
    matrix = lt.view_factors(street, tolerance=1e-2)
    return matrix, matrix.sky[get_cell_array(street, "Region") == 0].reshape(10, -1)


# An endless canyon as deep as wide: 1 / sqrt(1 + (2 H / W)^2) in its middle (Oke 1987).
_, sky = view_sky(make_street([WIDTH], 0.0, 320.0))
expect("sky view in the middle of a canyon", float(sky[4:6, 38:42].mean()),
       1.0 / math.sqrt(1.0 + 4.0), 0.02)

matrix, sky = view_sky(make_street([12, 18, 9, 21, 15, 12, 24, 9], 6.0, 200.0))
print(f"sky view of the street: {sky.min():.2f} to {sky.max():.2f}")
assert numpy.all(sky < 0.9)
draw("street", matrix.mesh, "SkyFraction", (0.0, 1.0), "sky view", (-0.8, -0.5, 0.9))
