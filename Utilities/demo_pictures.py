# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of results, off screen, for demo.py and for the tests."""

import vtklighttransport as lt
from vtklighttransport.pictures import (
    color_by_array,
    make_actor,
    make_window,
    render_light,
    write_picture,
)
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer


def look_into_cornell_box(renderer):
    """The published camera: 35 mm focal length over a film of 25 mm."""
    camera = renderer.GetActiveCamera()
    camera.SetPosition(278.0, 273.0, -800.0)
    camera.SetFocalPoint(278.0, 273.0, 0.0)
    camera.SetViewUp(0.0, 1.0, 0.0)
    camera.SetViewAngle(39.3)
    renderer.ResetCameraClippingRange()


def render_colored_by_array(file, surface, name, color_range, look, size=512):
    """As ParaView colours a surface by an array. `look` places the camera."""
    actor = make_actor(surface)
    actor.GetProperty().BackfaceCullingOff()
    color_by_array(actor, name, color_range)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = make_window(renderer, (size, size))
    look(renderer)
    write_picture(window, file)
    window.Finalize()


def render_cornell_box(file, surface, size=512):
    """Radiosity as light: the lamp is far beyond white, the room fills the range."""
    render_light(file, surface, 8.0, look_into_cornell_box, (size, size))


def render_cornell_box_while_solving(file, surface, radiosity, size=512):
    """The same, solved in the first frame."""
    solving = lt.vtkRadiosityPass()
    solving.SetRadiosity(radiosity)
    solving.SetFrameBudget(1e6)
    solving.SetExposure(8.0)
    renderer = vtkRenderer()
    renderer.AddActor(make_actor(surface))
    renderer.SetPass(solving)
    look_into_cornell_box(renderer)
    write_picture(make_window(renderer, (size, size)), file)


def render_bunny(file, surface, refractive_index, light, size=512):
    """What is scattered, weighted for the eye, added to the mirror-like reflection of the light."""
    scattered = lt.vtkSubsurfaceScatteringPass()
    scattered.SetRefractiveIndex(refractive_index)
    scattered.SetExposure(2.5)
    draw_bunny(file, make_smooth_actor(surface), scattered, light, size)


def render_bunny_while_scattering(file, surface, material, light, size=512, exposure=20.0,
                                  lighting=None, bumps=None):
    """The same, scattered while it is drawn: the surface has an atlas."""
    actor = make_smooth_actor(surface)
    if bumps:
        actor.GetProperty().SetNormalTexture(bumps)
    scattered = lt.vtkSubsurfaceScatteringPass()
    scattered.SetMaterial(actor, material)
    if lighting:
        scattered.SetLighting(lighting)
    scattered.SetIrradianceMapSize(128)
    scattered.SetScatteredMapSize(64)
    scattered.SetExposure(exposure)
    draw_bunny(file, actor, scattered, light, size)


def make_smooth_actor(surface):
    """With normals, and mirror-like reflection alone."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    normals.ConsistencyOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetAmbient(0.0)
    look.SetDiffuse(0.0)
    look.SetSpecular(0.15)
    look.SetSpecularPower(30.0)
    return actor


def draw_bunny(file, actor, scattered, light, size):
    renderer = vtkRenderer()
    renderer.AutomaticLightCreationOff()
    renderer.AddLight(light)
    renderer.AddActor(actor)
    renderer.SetPass(scattered)
    window = make_window(renderer, (size, size))
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, 8.0, 30.0)
    camera.SetFocalPoint(0.0, 4.8, 0.0)
    camera.SetViewAngle(24.0)
    renderer.ResetCameraClippingRange()
    write_picture(window, file)
    window.Finalize()
