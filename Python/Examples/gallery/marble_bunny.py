#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A bunny of marble, 15 cm high, in the light of a light from one side."""

import os
import sys

import vtklighttransport as lt
from shapes import DATA, expect
from vtklighttransport.arrays import get_areas, get_cell_array
from vtklighttransport.pictures import look_at, render_light

# The job itself: the file is in centimetres.
result = lt.scatter(DATA + "/bunny.ply", lights=[(1, 1, 1)], material="marble",
                    millimeters_per_unit=10)

areas = get_areas(result)
entered = (get_cell_array(result, "TransmittedIrradiance") * areas[:, None]).sum()
left = (get_cell_array(result, "ScatteredIrradiance") * areas[:, None]).sum()
expect("part of what entered that leaves", left / entered, 0.838, 0.01)
if len(sys.argv) > 1:
    os.makedirs(sys.argv[1], exist_ok=True)
    render_light(os.path.join(sys.argv[1], "marble_bunny.png"), result, 2.0,
                 look_at(result, (0.2, 0.2, 1.0)), name="ScatteredIrradiance")
