#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""An integrating sphere: how much brighter its wall is than the lamp alone would make it."""

import math

import numpy

import vtklighttransport as lt
from shapes import draw, expect
from vtklighttransport.arrays import get_areas, get_cell_array, get_points, get_triangle_corners
from vtkmodules.vtkFiltersCore import vtkReverseSense
from vtkmodules.vtkFiltersSources import vtkSphereSource

REFLECTANCE, PORT = 0.95, math.radians(18.0)  # white paint; from the axis to the rim of the port
FLUX = 100.0  # lm of a beam that meets the wall opposite the port

sphere = vtkSphereSource()
sphere.SetRadius(0.1)
sphere.SetStartPhi(math.degrees(PORT))
sphere.SetThetaResolution(60)
sphere.SetPhiResolution(40)
inside = vtkReverseSense()
inside.SetInputConnection(sphere.GetOutputPort())
inside.Update()
wall = inside.GetOutput()

# The job itself: the beam is irradiance on a spot.
spot = get_points(wall)[get_triangle_corners(wall)][:, :, 2].max(axis=1) < -0.0985
areas = get_areas(wall)
beam = numpy.where(spot, FLUX / areas[spot].sum(), 0.0)
result = lt.radiosity(wall, emission=0.0, reflectance=REFLECTANCE, direct_irradiance=beam,
                      accuracy=1e-3)

# Theory of the sphere (Goebel 1967): a multiplier on the first reflection, the same everywhere.
light = get_cell_array(result, "Irradiance")
whole = 4.0 * math.pi * 0.1 ** 2
port = (1.0 - math.cos(PORT)) / 2.0
wanted = REFLECTANCE * FLUX / whole / (1.0 - REFLECTANCE * (1.0 - port))
expect("light on the wall, lm/m2, least", light[~spot].min(), wanted, 0.02)
expect("light on the wall, lm/m2, largest", light[~spot].max(), wanted, 0.02)
print(f"multiplier of the sphere: {wanted * whole / FLUX:.1f}")
draw("integrating_sphere", result, "Radiosity", (1e3, float(beam.max())), "lm/m2",
     (0.5, -1.0, 1.2), logarithmic=True)
