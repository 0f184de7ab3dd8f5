# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""A scan with defects becomes closed patches and an atlas: a part of demo.py."""

import gzip
import os
import shutil
import tempfile

import numpy

import vtklighttransport as lt
from vtklighttransport.arrays import (
    get_areas,
    get_cell_array,
    get_points,
    get_summary,
    get_triangle_corners,
    set_cell_array,
)
from vtklighttransport.pictures import make_actor, make_window, write_picture
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFeatureEdges
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkTexture

from demo_tools import DATA, DemoError, read_surface, snapshot, update

# An integral over the surface may change by this on its way to the texels and back.
KEPT = 1e-6
SQUARES = 64


def read_scan(name):
    with gzip.open(name) as packed, tempfile.TemporaryDirectory() as folder:
        plain = os.path.join(folder, "scan.ply")
        with open(plain, "wb") as stream:
            shutil.copyfileobj(packed, stream)
        return read_surface(plain)


def count_edges(surface):
    """Edges at the border, and edges of more than two triangles."""
    counts = []
    for kind in ("Boundary", "NonManifold"):
        edges = vtkFeatureEdges()
        edges.SetInputData(surface)
        edges.FeatureEdgesOff()
        edges.ManifoldEdgesOff()
        edges.BoundaryEdgesOff()
        edges.NonManifoldEdgesOff()
        getattr(edges, kind + "EdgesOn")()
        edges.Update()
        counts.append(edges.GetOutput().GetNumberOfLines())
    return tuple(counts)


def paint_charts(maps):
    """A colour for each chart, in squares of two shades."""
    charts = vtk_to_numpy(maps.GetPointData().GetArray("ChartId"))
    side = maps.GetDimensions()[0]
    colors = numpy.random.RandomState(4).randint(90, 255, (charts.max() + 1, 3))
    row, column = numpy.divmod(numpy.arange(side * side), side)
    shade = 1.0 - 0.25 * ((row * SQUARES // side + column * SQUARES // side) % 2)
    image = vtkImageData()
    image.SetDimensions(side, side, 1)
    pixels = (colors[charts] * shade[:, None]).astype(numpy.uint8)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels, deep=True))
    return image


def render_atlas(file, surface, maps, direction, up):
    texture = vtkTexture()
    texture.SetInputData(paint_charts(maps))
    texture.InterpolateOff()
    actor = make_actor(surface)
    actor.SetTexture(texture)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(actor)
    window = make_window(renderer, (960, 720), samples=4)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(direction)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(up)
    renderer.ResetCamera()
    camera.Zoom(1.4)
    write_picture(window, file)
    window.Finalize()


def transfer(surface):
    """An integral over the texels, and the cells' values when they are back from there."""
    to_texels = lt.vtkSurfaceToAtlas()
    to_texels.SetInputData(surface)
    update(to_texels)
    back = lt.vtkAtlasToSurface()
    back.SetInputData(0, surface)
    back.SetInputConnection(1, to_texels.GetOutputPort())
    update(back)
    texels = to_texels.GetOutput().GetPointData()
    at_texels = vtk_to_numpy(texels.GetArray("OriginalHeight"))
    texel_areas = vtk_to_numpy(texels.GetArray("Area"))
    return (at_texels * texel_areas).sum(), get_cell_array(back.GetOutput(), "OriginalHeight")


def demand_kept_integral(surface):
    """How much the integral of the height changes on the way to texels and back, of its size."""
    heights = get_points(surface)[get_triangle_corners(surface), 1].mean(axis=1)
    set_cell_array(surface, "OriginalHeight", heights)
    areas = get_areas(surface)
    exact = (areas * heights).sum()
    at_texels, returned = transfer(surface)
    change = max(abs(at_texels - exact), abs((areas * returned).sum() - exact))
    change /= (areas * abs(heights)).sum()
    if not change <= KEPT:
        raise DemoError(f"the integral over the dragon changes by {change:.1e} in the atlas")
    return change


def write_maps(file, maps):
    writer = lt.vtkOpenEXRWriter()
    writer.SetFileName(file)
    writer.SetInputData(maps)
    writer.SetMipLevels(True)
    writer.SetWeightArray("Area")
    writer.Write()


def show_atlas(folder, summary):
    print("Stanford dragon: from scan to atlas")
    scan = read_scan(os.path.join(DATA, "dragon_vrip_res3.ply.gz"))
    borders, bad = count_edges(scan)
    print(
        f"  scan: {scan.GetNumberOfCells()} triangles, {borders} edges at borders,"
        f" {bad} of more than two triangles"
    )
    mesher = lt.vtkPatchMesher()
    mesher.SetInputData(scan)
    meshing = update(mesher)
    patches = mesher.GetOutput()
    if count_edges(patches) != (0, 0):
        raise DemoError("the dragon's patches are no closed manifold")
    atlas = lt.vtkSurfaceAtlas()
    atlas.SetInputData(patches)
    unfolding = update(atlas)
    surface = snapshot(atlas)
    change = demand_kept_integral(surface)

    folder.write_data("dragon_atlas.vtp", surface)
    write_maps(folder.name("dragon_maps.exr"), atlas.GetMaps())
    render_atlas(
        folder.name("dragon_atlas.png"), surface, atlas.GetMaps(), (0.3, 0.2, 1.0), (0.0, 1.0, 0.0)
    )
    name = "dragon"
    summary.add(name, "patches of the mended scan", patches.GetNumberOfCells(), "")
    summary.add(name, "meshing", meshing, "s")
    summary.add(name, "atlas and texel maps", unfolding, "s")
    for quantity in (
        "NumberOfCharts",
        "L2Stretch",
        "AreaDistortion",
        "TexelUse",
        "DeepestLeakFreeLevel",
    ):
        summary.add(name, quantity, get_summary(surface, quantity), "")
    summary.add(name, "change of an integral, to texels and back", change, "of it")
