#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Daylight in a room: what an even sky of 10,000 lx gives on its floor through a window."""

import vtklighttransport as lt
from shapes import draw, expect, make_plates
from vtklighttransport.arrays import get_areas, get_cell_array

OUTSIDE = 10000.0  # lx on anything that sees nothing but sky
WIDTH, DEPTH, HEIGHT = 4.0, 6.0, 3.0
LEFT, RIGHT, SILL, LINTEL = 1.0, 3.0, 0.9, 2.4


def make_front(*ranges):
    """Parts of the wall with the window, seen from inside."""
    return [("walls", (a, 0, low), (0, 0, high - low), (b - a, 0, 0),
             (max(2, round(4 * (high - low))), max(2, round(4 * (b - a)))))
            for a, b, low, high in ranges]


room = make_plates(
    ("floor", (0, 0, 0), (WIDTH, 0, 0), (0, DEPTH, 0), (16, 24)),
    ("ceiling", (0, 0, HEIGHT), (0, DEPTH, 0), (WIDTH, 0, 0), (12, 8)),
    ("walls", (0, 0, 0), (0, DEPTH, 0), (0, 0, HEIGHT), (12, 8)),
    ("walls", (WIDTH, 0, 0), (0, 0, HEIGHT), (0, DEPTH, 0), (8, 12)),
    ("walls", (0, DEPTH, 0), (WIDTH, 0, 0), (0, 0, HEIGHT), (8, 8)),
    *make_front((0, WIDTH, 0, SILL), (0, LEFT, SILL, LINTEL), (RIGHT, WIDTH, SILL, LINTEL),
                (0, WIDTH, LINTEL, HEIGHT)))

# The job itself; radiance is illuminance over pi.
reflectance = {"floor": 0.2, "ceiling": 0.7, "walls": 0.5}
result = lt.radiosity(room, emission=0.0, reflectance=reflectance,
                      background_radiance=OUTSIDE / 3.141592653589793)

areas, light = get_areas(result), get_cell_array(result, "Irradiance")
floor = get_cell_array(result, "Region") == 0
factor = 100.0 * light[floor] / OUTSIDE
print(f"daylight factor of the floor: {factor.mean():.1f} %, from {factor.min():.1f} to "
      f"{factor.max():.1f} %")

# What enters is absorbed, or goes out again.
sky = lt.view_factors(room).sky
gone = (sky * areas * get_cell_array(result, "Radiosity")).sum()
absorbed = -(get_cell_array(result, "NetFlux") * areas).sum()
entering = (RIGHT - LEFT) * (LINTEL - SILL) * OUTSIDE
expect("light absorbed or gone, of what enters", absorbed + gone, entering, 2e-3)
draw("daylight", result, "Irradiance", (10.0, 3000.0), "lx", (0.6, -1.0, 1.3), logarithmic=True)
