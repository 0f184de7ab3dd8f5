#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Light in the shadow of a crater: what its lit wall scatters to where the sun never shines."""

import math

import vtklighttransport as lt
from shapes import draw, expect
from vtklighttransport.arrays import get_areas, get_cell_array
from vtkmodules.vtkFiltersCore import vtkReverseSense
from vtkmodules.vtkFiltersSources import vtkSphereSource

RADIUS, RIM = 5.0, math.radians(44.0)  # km; from the centre of the sphere to the rim
ALBEDO, SUN, ELEVATION = 0.3, 1361.0, math.radians(12.0)


def make_crater():
    """The part of a sphere below its rim, seen from above."""
    bowl = vtkSphereSource()
    bowl.SetRadius(RADIUS)
    bowl.SetStartPhi(180.0 - math.degrees(RIM))
    bowl.SetEndPhi(180.0)
    bowl.SetThetaResolution(60)
    bowl.SetPhiResolution(16)
    inside = vtkReverseSense()
    inside.SetInputConnection(bowl.GetOutputPort())
    inside.Update()
    return inside.GetOutput()


# The job itself.
sun = (math.cos(ELEVATION), 0.0, math.sin(ELEVATION), SUN)
result = lt.radiosity(make_crater(), lights=[sun], emission=0.0, reflectance=ALBEDO)
direct, scattered, radiosity = (
    get_cell_array(result, name)[:, 0] for name in ("DirectIrradiance", "Irradiance", "Radiosity"))

# In a sphere every patch sees every other alike, so what is scattered is the same everywhere
# (Ingersoll, Svitek and Murray 1992).
area = 2.0 * math.pi * RADIUS ** 2 * (1.0 - math.cos(RIM))
opening = math.pi * (RADIUS * math.sin(RIM)) ** 2
seen = area / (4.0 * math.pi * RADIUS ** 2)
mean = SUN * math.sin(ELEVATION) * opening / area
shadow = direct == 0.0
areas = get_areas(result)
print(f"{shadow.sum() / len(shadow):.0%} of the patches never see this sun")
expect("mean of the direct light", (direct * areas).sum() / areas.sum(), mean, 0.02)
expect("light in the shadow", (scattered * areas)[shadow].sum() / areas[shadow].sum(),
       seen * ALBEDO * mean / (1.0 - ALBEDO * seen), 0.02)
draw("crater", result, "Radiosity", (1.0, float(radiosity.max())), "W/m2", (-0.4, -1.0, 1.2),
     logarithmic=True)
