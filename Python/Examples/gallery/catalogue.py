#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""View factors of a catalogue: squares that face each other, or meet at an edge."""

import vtklighttransport as lt
from shapes import draw, expect, make_plates
from vtklighttransport.arrays import get_cell_array, set_cell_array

FLOOR = ("floor", (0, 0, 0), (1, 0, 0), (0, 1, 0), (8, 8))
# Howell's catalogue, C-11 and C-14, for unit squares.
CASES = {"ceiling": (("ceiling", (0, 0, 1), (0, 1, 0), (1, 0, 0), (8, 8)), 0.19982489569838746),
         "wall": (("wall", (0, 0, 0), (0, 1, 0), (0, 0, 1), (8, 8)), 0.20004377607540316)}

for name, (plate, known) in CASES.items():
    # The job itself.
    matrix = lt.view_factors(make_plates(FLOOR, plate), group="Region", tolerance=1e-6)
    expect(f"floor to {name}", matrix.groups["1"][0], known, 1e-6)

print(matrix.check(1e-6))
other = get_cell_array(matrix.mesh, "Region") == 1
set_cell_array(matrix.mesh, "ToWall", matrix[:, other].sum(axis=1))
draw("catalogue", matrix.mesh, "ToWall", (0.0, 0.5), "F to the wall", (1.0, -0.8, 0.9))
