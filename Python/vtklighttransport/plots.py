# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plots of lines on logarithmic axes, by VTK's charts, as PNG.

Needs numpy and the Rendering module.
"""

import colorsys
import math

import numpy

import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 (charts are drawn by what registers here)
from vtklighttransport.pictures import make_window, write_picture
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartXY, vtkPlotPoints
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkRenderingContext2D import vtkContextActor
from vtkmodules.vtkRenderingCore import vtkRenderer

SIZE = (1200, 800)
MARKERS = (vtkPlotPoints.CIRCLE, vtkPlotPoints.SQUARE, vtkPlotPoints.DIAMOND)
# Told apart by people with any colour vision, next to one another and from white.
HUES = (0.58, 0.06, 0.42, 0.82)


class Line:
    """Points to join: a family has its hue and its marker, members of it go from light to dark."""

    def __init__(self, label, x, y, family=0, shade=1.0):
        self.label = label
        self.x = numpy.asarray(x, dtype=float)
        self.y = numpy.asarray(y, dtype=float)
        self.marker = MARKERS[family % len(MARKERS)]
        self.color = colorsys.hsv_to_rgb(HUES[family % len(HUES)], 0.45 + 0.5 * shade,
                                         0.95 - 0.4 * shade)


def plot_lines(file, lines, x_title, y_title, title="", size=SIZE):
    """A PNG of the lines. Points that a logarithmic axis cannot show are left out."""
    chart = vtkChartXY()
    chart.SetTitle(title)
    chart.GetTitleProperties().SetFontSize(22)
    points = []
    for line in lines:
        shown = (line.x > 0.0) & (line.y > 0.0) & numpy.isfinite(line.x) & numpy.isfinite(line.y)
        if shown.any():
            order = numpy.flatnonzero(shown)
            points.append(numpy.stack([line.x[order], line.y[order]]))
            add_line(chart, line, *points[-1])
    if not points:
        raise ValueError("there is nothing to plot")
    together = numpy.concatenate(points, axis=1)
    set_axis(chart.GetAxis(vtkAxis.BOTTOM), x_title, together[0])
    set_axis(chart.GetAxis(vtkAxis.LEFT), y_title, together[1])
    set_legend(chart)
    draw(file, chart, size)


def add_line(chart, line, x, y):
    table = vtkTable()
    for name, values in (("x", x), ("y", y)):
        column = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
        column.SetName(name)
        table.AddColumn(column)
    plot = chart.AddPlot(vtkChart.LINE if len(x) > 1 else vtkChart.POINTS)
    plot.SetInputData(table, 0, 1)
    plot.SetLabel(line.label)
    plot.GetPen().SetColorF(*line.color)
    plot.SetWidth(3.0)
    plot.SetMarkerStyle(line.marker)
    plot.SetMarkerSize(11.0)


def find_range(values):
    """From and to, with room for markers; at least half a decade."""
    low, high = math.log10(values.min()), math.log10(values.max())
    room = max(0.06 * (high - low), 0.5 * (0.5 - (high - low)))
    return low - room, high + room


def find_ticks(low, high):
    """Whole decades where there are enough of them, else more of each."""
    ticks = []
    for digits in ((1,), (1, 3), (1, 2, 5), range(1, 10)):
        if len(ticks) < 3:
            ticks = [digit * 10.0 ** power for power in range(math.floor(low), math.ceil(high))
                     for digit in digits if low <= math.log10(digit) + power <= high]
    return ticks


def set_axis(axis, title, values):
    low, high = find_range(values)
    axis.SetTitle(title)
    axis.GetTitleProperties().SetFontSize(22)
    axis.GetTitleProperties().BoldOff()
    axis.GetLabelProperties().SetFontSize(20)
    axis.SetLogScale(True)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetUnscaledRange(10.0 ** low, 10.0 ** high)
    places, labels = vtkDoubleArray(), vtkStringArray()
    for tick in find_ticks(low, high):
        places.InsertNextValue(math.log10(tick))
        labels.InsertNextValue(f"{tick:g}")
    axis.SetCustomTickPositions(places, labels)
    axis.GetGridPen().SetColorF(0.85, 0.85, 0.85)


def set_legend(chart):
    chart.SetShowLegend(True)
    legend = chart.GetLegend()
    legend.SetInline(False)
    legend.SetHorizontalAlignment(vtkChartLegend.RIGHT)
    legend.SetVerticalAlignment(vtkChartLegend.TOP)
    legend.GetLabelProperties().SetFontSize(18)


def draw(file, chart, size):
    actor = vtkContextActor()
    actor.GetScene().AddItem(chart)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(actor)
    actor.GetScene().SetRenderer(renderer)
    window = make_window(renderer, size, samples=4)
    write_picture(window, file)
    window.Finalize()
