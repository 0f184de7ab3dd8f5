#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What one feels in a room: the globe thermometer under a heated ceiling, beside a cold window."""

import itertools
import math

import numpy

import vtklighttransport as lt
from shapes import draw, expect, make_plates
from vtklighttransport.arrays import get_areas, get_cell_array
from vtklighttransport.meshes import list_regions, set_regions
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

ROOM = (5.0, 4.0, 2.7)  # m
TEMPERATURES = {"ceiling": 308.0, "window": 283.0, "walls": 293.0}  # K
GLOBE, DIAMETER = (1.2, 1.5, 1.1), 0.15


def make_room():
    """Seen from inside, and the globe in it, as regions."""
    x, y, z = ROOM
    room = make_plates(
        ("ceiling", (0, 0, z), (0, y, 0), (x, 0, 0), (12, 15)),
        ("window", (0, 0, 0), (0, y, 0), (0, 0, z), (12, 8)),
        ("walls", (0, 0, 0), (x, 0, 0), (0, y, 0), (15, 12)),
        ("walls", (x, 0, 0), (0, 0, z), (0, y, 0), (8, 12)),
        ("walls", (0, 0, 0), (0, 0, z), (x, 0, 0), (8, 15)),
        ("walls", (0, y, 0), (x, 0, 0), (0, 0, z), (15, 8)))
    globe = vtkSphereSource()
    globe.SetCenter(GLOBE)
    globe.SetRadius(DIAMETER / 2.0)
    globe.SetThetaResolution(20)
    globe.SetPhiResolution(12)
    numbers = get_cell_array(room, "Region").tolist()
    names = [*list_regions(room).values(), "globe"]
    both = vtkAppendPolyData()
    both.AddInputData(room)
    both.AddInputConnection(globe.GetOutputPort())
    both.Update()
    scene = both.GetOutput()
    set_regions(scene, numbers + [3] * (scene.GetNumberOfCells() - len(numbers)), names)
    return scene


def see(distance, along, across):
    """The part of all directions in which a rectangle is, from a point at a distance; its sides go
    from the foot of the point to these pairs of places."""
    def corner(a, b):
        return math.atan2(a * b, distance * math.hypot(a, b, distance))
    return sum((-1) ** (i + j) * corner(along[i], across[j])
               for i, j in itertools.product((0, 1), repeat=2)) / (4.0 * math.pi)


# The job itself: the globe is black, and no heat flows into it.
room = make_room()
result = lt.radiosity(room, temperature={**TEMPERATURES, "globe": 293.0}, emissivity=1.0,
                      boundary_condition={"globe": 1, "": 0})
globe = get_cell_array(result, "Region") == 3
areas = get_areas(result)[globe]
reading = ((get_cell_array(result, "SurfaceTemperature")[globe] ** 4 * areas).sum()
           / areas.sum()) ** 0.25

# A small globe sees each surface by its part of all directions.
sides = [(-GLOBE[k], ROOM[k] - GLOBE[k]) for k in range(3)]
ceiling, window = see(sides[2][1], sides[0], sides[1]), see(GLOBE[0], sides[1], sides[2])
powers = {name: value ** 4 for name, value in TEMPERATURES.items()}
wanted = (ceiling * powers["ceiling"] + window * powers["window"]
          + (1.0 - ceiling - window) * powers["walls"]) ** 0.25
expect("reading, over that of the walls, K", reading - 293.0, wanted - 293.0, 0.02)
sides_of_globe = get_cell_array(result, "SurfaceTemperature")[globe]
print(f"its sides would be at {sides_of_globe.min():.1f} to {sides_of_globe.max():.1f} K")
draw("globe_thermometer", result, "Irradiance", (400.0, 470.0), "W/m2", (1.0, -1.3, 0.5))
assert numpy.all(sides_of_globe > 283.0)
