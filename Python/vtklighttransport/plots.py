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
HUES = (0.58, 0.06, 0.42, 0.82, 0.14, 0.7)


class Line:
    """Points to join: a family has its hue and its marker, members of it go from light to dark.

    Bars reach from `low` to `high` where they are given.
    """

    def __init__(self, label, x, y, family=0, shade=1.0, low=None, high=None):
        self.label = label
        self.x = numpy.asarray(x, dtype=float)
        self.y = numpy.asarray(y, dtype=float)
        self.low = self.y if low is None else numpy.asarray(low, dtype=float)
        self.high = self.y if high is None else numpy.asarray(high, dtype=float)
        self.marker = MARKERS[family % len(MARKERS)]
        self.color = colorsys.hsv_to_rgb(HUES[family % len(HUES)], 0.45 + 0.5 * shade,
                                         0.95 - 0.4 * shade)


def plot_lines(file, lines, x_title, y_title, title="", size=SIZE):
    """A PNG of the lines. Points that a logarithmic axis cannot show are left out; a bar that goes
    on below them ends with the axis."""
    chart = vtkChartXY()
    chart.SetTitle(title)
    chart.GetTitleProperties().SetFontSize(22)
    x = numpy.concatenate([line.x[can_show(line.x, ends)] for line in lines
                           for ends in (line.y, line.high)])
    y = numpy.concatenate([ends[can_show(line.x, ends)] for line in lines
                           for ends in (line.y, line.high)])
    if not len(y):
        raise ValueError("there is nothing to plot")
    set_axis(chart.GetAxis(vtkAxis.BOTTOM), x_title, x)
    set_axis(chart.GetAxis(vtkAxis.LEFT), y_title, y)
    bottom = 10.0 ** find_range(y)[0]
    for line in lines:
        add_bars(chart, line, bottom)
        add_line(chart, line)
    set_legend(chart)
    draw(file, chart, size)


def can_show(x, y):
    return (x > 0.0) & (y > 0.0) & numpy.isfinite(x) & numpy.isfinite(y)


def add_line(chart, line):
    shown = can_show(line.x, line.y)
    plot = add_plot(chart, vtkChart.LINE if shown.sum() > 1 else vtkChart.POINTS, line,
                    line.x[shown], line.y[shown])
    plot.SetLabel(line.label)
    plot.SetWidth(3.0)
    plot.SetMarkerStyle(line.marker)
    plot.SetMarkerSize(11.0)


def add_bars(chart, line, bottom):
    shown = can_show(line.x, line.high) & (line.low < line.high)
    if not shown.any():
        return
    ends = numpy.stack([numpy.maximum(line.low, bottom), line.high], axis=1)[shown]
    plot = add_plot(chart, vtkChart.LINE, line, numpy.repeat(line.x[shown], 2), ends.ravel())
    plot.PolyLineOff()
    plot.SetWidth(5.0)
    plot.SetOpacity(0.4)
    plot.SetLegendVisibility(False)


def add_plot(chart, kind, line, x, y):
    table = vtkTable()
    for name, values in (("x", x), ("y", y)):
        column = numpy_to_vtk(numpy.ascontiguousarray(values), deep=True)
        column.SetName(name)
        table.AddColumn(column)
    plot = chart.AddPlot(kind)
    plot.SetInputData(table, 0, 1)
    plot.GetPen().SetColorF(*line.color)
    return plot


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
