#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""An STL part: what a heat sink of 80 degrees Celsius gives off to a room of 20."""

import numpy

import vtklighttransport as lt
from shapes import DATA, draw, expect
from vtklighttransport.arrays import get_areas, get_cell_array

# The job itself.
patches = lt.patches(DATA + "/heat_sink.stl", 1500)
result = lt.radiosity(patches, temperature=353.15, emissivity=0.85, background_temperature=293.15)
flux = get_cell_array(result, "NetFlux")
power = (flux * get_areas(result)).sum() * 1e-6  # the part is in millimetres
print(f"{power:.2f} W")

# What is between fins seems blacker than it is; all else gives its 0.85.
black = 5.670374419e-8 * (353.15 ** 4 - 293.15 ** 4)
matrix = lt.view_factors(patches)
seen = (matrix.sky * matrix.areas).sum() * 1e-6
expect("emissivity of the whole, as seen from the room", power / (seen * black), 0.878, 2e-3)
expect("largest flux, that of the open base", flux.max(), 0.85 * black, 1e-3)
draw("heat_sink", result, "NetFlux", (0.0, float(numpy.max(flux))), "W/m2", (1.0, -1.6, 1.3))
