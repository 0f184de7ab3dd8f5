#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""PyVista: light from behind comes through the ears of a bunny, scattered while it is drawn."""

import os
import sys

import numpy
import pyvista

import vtklighttransport as lt
from shapes import DATA

# Pictures without a display.
lt.vtkOffScreenOpenGLRenderWindow.RegisterAsDefault()
mesh = pyvista.read(DATA + "/bunny.ply")
surface = mesh.light_transport.patches(n=2000).light_transport.atlas(resolution=64)
plotter = pyvista.Plotter(off_screen=True, window_size=(480, 480), lighting="none")
plotter.add_light(pyvista.Light(position=(-3, 19, -20), focal_point=(-0.2, 4.8, 0),
                                light_type="scene light"))
actor, scattering = surface.light_transport.add_translucent(
    plotter, material="marble", millimeters_per_unit=3, link_method="adaptive", exposure=10,
    map_size=64)
plotter.camera_position = [(-0.2, 7, 30), (-0.2, 4.8, 0), (0, 1, 0)]
plotter.camera.view_angle = 24
os.makedirs(sys.argv[1], exist_ok=True)
picture = plotter.screenshot(os.path.join(sys.argv[1], "pyvista_bunny.png"))
# Some of the bunny, and not all alike.
dark = (numpy.asarray(picture)[:, :, :3] < 250).any(axis=2)
assert 0.2 < dark.mean() < 0.6 and numpy.asarray(picture)[dark].std() > 10, dark.mean()
assert scattering.GetNumberOfScatteringRuns() == 1
