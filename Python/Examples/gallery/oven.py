#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The furnace row of an oven: three glowing bars, walls that are insulated, and cold goods."""

import vtklighttransport as lt
from shapes import draw, expect, make_plates
from vtklighttransport.arrays import get_areas, get_cell_array
from vtklighttransport.meshes import list_regions

HEATER, GOODS = 1200.0, 400.0


def make_oven():
    """2 m long, 1 m wide and high; bars lie in the ceiling, seen from inside."""
    plates = [("goods", (0, 0, 0), (2, 0, 0), (0, 1, 0), (24, 12)),
              ("walls", (0, 0, 0), (0, 0, 1), (2, 0, 0), (12, 24)),
              ("walls", (2, 1, 0), (0, 0, 1), (-2, 0, 0), (12, 24)),
              ("walls", (0, 1, 0), (0, 0, 1), (0, -1, 0), (12, 12)),
              ("walls", (2, 0, 0), (0, 0, 1), (0, 1, 0), (12, 12))]
    for k in range(7):
        begin, end = (0.0, 0.35, 0.55, 0.9, 1.1, 1.45, 1.65, 2.0)[k:k + 2]
        plates.append(("heater" if k % 2 else "walls", (begin, 0, 1), (0, 1, 0),
                       (end - begin, 0, 0), (12, 4)))
    return make_plates(*plates)


# The job itself: of the walls the flux is given, none.
oven = make_oven()
result = lt.radiosity(
    oven, temperature={"heater": HEATER, "goods": GOODS, "": 300.0}, emissivity=0.8,
    boundary_condition={"walls": 1, "": 0}, enforce_closure=True)

areas, flux = get_areas(result), get_cell_array(result, "NetFlux")
number = {name: key for key, name in list_regions(result).items()}
regions = get_cell_array(result, "Region")
power = {name: (areas * flux)[regions == key].sum() for name, key in number.items()}
walls = get_cell_array(result, "SurfaceTemperature")[regions == number["walls"]]
print(f"goods take {-power['goods'] / 1e3:.2f} kW, walls have {walls.min():.0f} to "
      f"{walls.max():.0f} K")

# Insulated walls give back all; and as a network of resistances, with walls at one temperature.
expect("goods take what the bars give", -power["goods"], power["heater"], 1e-4)
matrix = lt.view_factors(oven, group="Region")
row = matrix.groups["Group"].index(f"{number['heater']:g}")
direct, walled = matrix.groups[f"{number['goods']:g}"][row], matrix.groups["0"]
heater, goods = (areas[regions == number[name]].sum() for name in ("heater", "goods"))
by_wall = [matrix.groups[f"{number['walls']:g}"][matrix.groups["Group"].index(f"{number[name]:g}")]
           for name in ("heater", "goods")]
between = heater * direct + 1.0 / (1.0 / (heater * by_wall[0]) + 1.0 / (goods * by_wall[1]))
network = 5.670374419e-8 * (HEATER ** 4 - GOODS ** 4) / (
    0.2 / 0.8 / heater + 1.0 / between + 0.2 / 0.8 / goods)
expect("power, beside a network of resistances", power["heater"], network, 0.04)
draw("oven", result, "Irradiance", (0.0, 4e4), "W/m2", (0.3, -1.0, 0.25))
