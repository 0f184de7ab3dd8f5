# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of surfaces and their arrays, off screen, as PNG.

Needs numpy and the Rendering module.
"""

import math

import numpy

import vtklighttransport as lt
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (text is drawn by what registers here,
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 and surfaces by the mappers of OpenGL)
from vtklighttransport.arrays import get_area_vectors, get_points
from vtklighttransport.replacement import replace_file
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkColorTransferFunction, vtkPolyDataMapper, vtkRenderer, vtkWindowToImageFilter)

# Of a whole circle, in degrees: that of the eye for a picture held at arm's length.
VIEW_ANGLE = 36.0

VIRIDIS = ((68, 1, 84), (71, 45, 123), (59, 82, 139), (44, 114, 142), (33, 145, 140),
           (40, 174, 128), (94, 201, 98), (173, 220, 48), (253, 231, 37))

# Where the bar that explains colours begins, from left to right.
BAR_BEGIN = 0.8


def make_window(renderer, size, samples=0):
    window = lt.vtkOffScreenOpenGLRenderWindow()
    window.SetSize(*size)
    window.SetMultiSamples(samples)
    window.AddRenderer(renderer)
    return window


def write_picture(window, file):
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.SetInputBufferTypeToRGB()
    grab.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.WriteToMemoryOn()
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()
    replace_file(file, bytes(memoryview(writer.GetResult())))


def find_direction(surface):
    """Towards the viewer: where the patches face on the whole, as out of the open side of a box.

    What is closed, or open to all sides, faces nowhere; then from the front, right and above.
    """
    areas = get_area_vectors(surface)
    total = areas.sum(axis=0)
    if numpy.linalg.norm(total) < 0.02 * numpy.linalg.norm(areas, axis=1).sum():
        return numpy.array([1.0, 0.8, 1.5])
    return total


def look_at(surface, direction, up=None):
    """What places a camera so that the surface, seen from a direction, fills the picture; `up` is
    y where nothing else is given, or z where that is seen from above."""
    points = get_points(surface)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    back = numpy.asarray(direction, dtype=float)
    back = back / numpy.linalg.norm(back)
    if up is None:
        up = [0.0, 1.0, 0.0] if abs(back[1]) < 0.9 else [0.0, 0.0, 1.0]
    right = numpy.cross(up, back)
    right /= numpy.linalg.norm(right)
    offsets = points - middle
    aside = numpy.maximum(abs(offsets @ right), abs(offsets @ numpy.cross(back, right)))
    slope = 0.95 * math.tan(math.radians(VIEW_ANGLE / 2.0))
    distance = (offsets @ back + aside / slope).max()

    def look(renderer):
        camera = renderer.GetActiveCamera()
        camera.SetPosition(middle + distance * back)
        camera.SetFocalPoint(middle)
        camera.SetViewUp(up)
        camera.SetViewAngle(VIEW_ANGLE)
        renderer.ResetCameraClippingRange()

    return look


def make_actor(surface):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    # One-sided, as patches are: so one looks into a room through its nearest wall.
    actor.GetProperty().BackfaceCullingOn()
    return actor


def render_light(file, surface, exposure, look, size=(512, 512), name="Radiosity"):
    """What leaves the surface as light, by vtkRadiosityPass. `look` places the camera."""
    light = lt.vtkRadiosityPass()
    light.SetArrayName(name)
    light.SetExposure(exposure)
    renderer = vtkRenderer()
    renderer.AddActor(make_actor(surface))
    renderer.SetPass(light)
    window = make_window(renderer, size)
    look(renderer)
    write_picture(window, file)
    window.Finalize()


def make_colors(color_range, logarithmic):
    """Viridis, which is even to the eye, also in grey and to who sees no red; where the range
    begins below 0, which then is its midst, from blue to red through white."""
    if color_range[0] < 0.0:
        colors = vtkColorTransferFunction()
        colors.SetColorSpaceToDiverging()
        colors.AddRGBPoint(color_range[0], 0.12, 0.22, 0.72)
        colors.AddRGBPoint(color_range[1], 0.72, 0.05, 0.12)
        return colors
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    places = numpy.linspace(0.0, 255.0, len(VIRIDIS))
    channels = [numpy.interp(range(256), places, channel) / 255.0 for channel in zip(*VIRIDIS)]
    for k, color in enumerate(zip(*channels)):
        table.SetTableValue(k, *color)
    if logarithmic:
        table.SetScaleToLog10()
    table.SetTableRange(color_range)
    return table


def color_by_array(actor, name, color_range, cells=False, logarithmic=False):
    """As ParaView colours a surface by an array: by a table of colours, which is returned."""
    table = make_colors(color_range, logarithmic)
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    if cells:
        mapper.SetScalarModeToUseCellFieldData()
    else:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.InterpolateScalarsBeforeMappingOn()
    mapper.SelectColorArray(name)
    mapper.SetLookupTable(table)
    mapper.SetScalarRange(color_range)
    actor.GetProperty().LightingOff()
    return table


def make_color_bar(table, title):
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    # An odd number where there is a midst to tell.
    bar.SetNumberOfLabels(5 if table.GetRange()[0] < 0.0 else 4)
    bar.SetLabelFormat("%.3g")
    bar.UnconstrainedFontSizeOn()
    for text, size in ((bar.GetTitleTextProperty(), 20), (bar.GetLabelTextProperty(), 16)):
        text.SetColor(0.0, 0.0, 0.0)
        text.SetFontSize(size)
        text.ItalicOff()
        text.ShadowOff()
        text.BoldOff()
    bar.SetVerticalTitleSeparation(12)
    bar.SetPosition(0.05, 0.1)
    bar.SetWidth(0.9)
    bar.SetHeight(0.8)
    return bar


def render_cell_array(file, surface, name, color_range, title, look, logarithmic=False,
                      size=(800, 640)):
    """Flat colours, a patch each, beside a bar that explains them."""
    actor = make_actor(surface)
    table = color_by_array(actor, name, color_range, cells=True, logarithmic=logarithmic)
    scene, legend = vtkRenderer(), vtkRenderer()
    scene.AddActor(actor)
    scene.SetViewport(0.0, 0.0, BAR_BEGIN, 1.0)
    legend.AddActor2D(make_color_bar(table, title))
    legend.SetViewport(BAR_BEGIN, 0.0, 1.0, 1.0)
    for renderer in (scene, legend):
        renderer.SetBackground(1.0, 1.0, 1.0)
    window = make_window(scene, size, samples=4)
    window.AddRenderer(legend)
    look(scene)
    write_picture(window, file)
    window.Finalize()
