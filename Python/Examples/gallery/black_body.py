#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A black body of grey walls: what comes out of a hot hollow sphere through its opening."""

import math

import vtklighttransport as lt
from shapes import expect
from vtklighttransport.arrays import get_cell_array
from vtkmodules.vtkFiltersCore import vtkReverseSense
from vtkmodules.vtkFiltersSources import vtkSphereSource

EMISSIVITY, TEMPERATURE, OPENING = 0.7, 1300.0, 20.0

sphere = vtkSphereSource()
sphere.SetStartPhi(OPENING)  # degrees from the axis
sphere.SetThetaResolution(48)
sphere.SetPhiResolution(32)
inside = vtkReverseSense()
inside.SetInputConnection(sphere.GetOutputPort())
inside.Update()

# The job itself; the world outside is cold.
result = lt.radiosity(inside.GetOutput(), temperature=TEMPERATURE, emissivity=EMISSIVITY,
                      background_temperature=1.0, accuracy=1e-3)

# In a sphere every patch sees every other alike: B = eps sigma T^4 / (1 - (1 - eps) F).
black = 5.670374419e-8 * TEMPERATURE ** 4
seen = (1.0 + math.cos(math.radians(OPENING))) / 2.0
wanted = EMISSIVITY / (1.0 - (1.0 - EMISSIVITY) * seen)
radiosity = get_cell_array(result, "Radiosity")
expect("emissivity of the opening, least", radiosity.min() / black, wanted, 1.5e-3)
expect("emissivity of the opening, largest", radiosity.max() / black, wanted, 1.5e-3)
