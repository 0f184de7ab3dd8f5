# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plots and pictures of the report. Needs the Rendering module."""

import numpy

from vtklighttransport.arrays import get_areas, set_cell_array
from vtklighttransport.pictures import render_cell_array, render_light
from vtklighttransport.plots import Line, plot_lines
from vtklighttransport.report.record import find_families, get_column, name_family
from vtkmodules.vtkCommonDataModel import vtkPolyData

# From the largest error down.
DECADES_OF_ERROR = 3.0


def plot_errors(file, rows):
    """Error against seconds: a line for each family and size."""
    sizes = sorted({row["patches"] for row in rows})
    lines = []
    for number, family in enumerate(find_families(rows)):
        for size in sizes:
            own = [row for row in rows
                   if name_family(row, rows) == family and row["patches"] == size]
            if own:
                own.sort(key=lambda row: -row["tolerance"])
                lines.append(Line(f"{family}, {size:,} patches", get_column(own, "seconds_all"),
                                  get_column(own, "error_l2"), number,
                                  find_shade(sizes.index(size), len(sizes))))
    plot_lines(file, lines, "seconds in all", "relative error of the radiosity (L2)")


def plot_growth(file, groups, column, title):
    """A column against the number of patches: a line for each group."""
    families = list(dict.fromkeys(family for family, _tolerance in groups))
    lines = []
    for (family, tolerance), rows in groups.items():
        tolerances = sorted((t for f, t in groups if f == family), reverse=True)
        lines.append(Line(f"{family} {tolerance:g}", [row["patches"] for row in rows],
                          get_column(rows, column), families.index(family),
                          find_shade(tolerances.index(tolerance), len(tolerances))))
    plot_lines(file, lines, "patches", title)


def find_shade(index, count):
    return (index + 1) / count


def draw_solution(file, solution, look):
    if solution.radiosity.shape[1] == 3:
        exposure = 0.8 * numpy.pi / find_high(solution)
        render_light(file, solution.surface, exposure, look, (640, 640))
        return
    surface = copy_with(solution.surface, solution.radiosity.mean(axis=1))
    render_cell_array(file, surface, "Shown", (0.0, find_high(solution)), "B", look)


def find_high(solution):
    """The radiosity that all but the brightest twentieth of the area stays below."""
    values = solution.radiosity.mean(axis=1)
    areas = get_areas(solution.surface)
    order = numpy.argsort(values)
    share = numpy.cumsum(areas[order]) / areas.sum()
    return float(values[order][numpy.searchsorted(share, 0.95)]) or 1.0


def draw_error(file, surface, errors, look):
    high = errors.max() or 1.0
    render_cell_array(file, copy_with(surface, errors), "Shown",
                      (high * 10.0 ** -DECADES_OF_ERROR, high), "error", look, logarithmic=True)


def copy_with(surface, values):
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    set_cell_array(copy, "Shown", values)
    return copy
