# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plots and pictures of the report. Needs the Rendering module."""

import numpy

from vtklighttransport.arrays import set_cell_array
from vtklighttransport.pictures import render_cell_array, render_light
from vtklighttransport.plots import Line, plot_lines
from vtklighttransport.report.record import find_families, get_column
from vtkmodules.vtkCommonDataModel import vtkPolyData

# From the largest error down.
DECADES_OF_ERROR = 3.0


def plot_errors(file, rows, subject):
    """Error against seconds: a line for each family and size."""
    sizes = sorted({row["patches"] for row in rows})
    lines = []
    for number, family in enumerate(find_families(rows)):
        for size in sizes:
            own = [row for row in rows if row["family"] == family and row["patches"] == size]
            if own:
                own.sort(key=lambda row: -row["tolerance"])
                label = f"{family}, {size:,} patches" if len(sizes) > 1 else family
                lines.append(make_line(own, subject, label, number,
                                       find_shade(sizes.index(size), len(sizes))))
    plot_lines(file, lines, subject.TIME[1], f"relative error of the {subject.QUANTITY} (L2)")


def make_line(rows, subject, label, family, shade):
    """With bars where errors are known to a range only."""
    ends = [get_column(rows, name) for name in ("error_l2_low", "error_l2_high")
            if name in subject.COLUMNS]
    return Line(label, get_column(rows, subject.TIME[0]), get_column(rows, "error_l2"), family,
                shade, *ends)


def plot_growth(file, groups, column, title):
    """A column against the number of patches: a line for each group."""
    families = list(dict.fromkeys(family for family, _tolerance in groups))
    lines = []
    for (family, tolerance), rows in groups.items():
        tolerances = sorted((t for f, t in groups if f == family), reverse=True)
        lines.append(Line(f"{family} {tolerance:g}", [row["patches"] for row in rows],
                          get_column(rows, column), families.index(family),
                          find_shade(tolerances.index(tolerance), len(tolerances))))
    plot_lines(file, lines, "patches", title[0].lower() + title[1:])


def find_shade(index, count):
    return (index + 1) / count


def draw_solution(file, solution, name, look):
    values = solution.get(name)
    high = find_high(values.mean(axis=1), solution.get_areas())
    if values.shape[1] == 3:
        render_light(file, solution.surface, 0.8 * numpy.pi / high, look, (640, 640), name)
        return
    surface = copy_with(solution.surface, values.mean(axis=1))
    render_cell_array(file, surface, "Shown", (0.0, high), name, look)


def find_high(values, areas):
    """What all but the brightest twentieth of the area stays below."""
    order = numpy.argsort(values)
    share = numpy.cumsum(areas[order]) / areas.sum()
    return float(values[order][numpy.searchsorted(share, 0.95)]) or 1.0


def draw_magnitudes(file, surface, errors, look):
    high = errors.max() or 1.0
    render_cell_array(file, copy_with(surface, errors), "Shown",
                      (high * 10.0 ** -DECADES_OF_ERROR, high), "error", look, logarithmic=True)


def draw_signed(file, surface, errors, high, look):
    render_cell_array(file, copy_with(surface, errors), "Shown", (-high, high), "error", look)


def copy_with(surface, values):
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    set_cell_array(copy, "Shown", values)
    return copy
