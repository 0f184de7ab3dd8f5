# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What reports of subsurface scattering share: the body, and light that falls in."""

from vtklighttransport.shell.body import (
    BODY, add_light_that_falls_in, light_body, make_scattering)
from vtklighttransport.shell.properties import DEVICE, add_properties, check_properties

TITLE = "of scattering; give a light, or a mesh with the cell array Irradiance"
CLASS = "vtkSubsurfaceScattering"
LEVELS = 0


def add_options(group):
    add_light_that_falls_in(group)
    add_properties(group, CLASS, BODY)


def check(options, *properties):
    """Of the body, and more properties."""
    check_properties(options, CLASS, (*BODY, *properties))


def make_filter(options, *properties):
    return make_scattering(options, (DEVICE, *BODY, *properties))


def light(options, messages, surface, subject):
    return light_body(options, messages, surface, subject.make_plain_filter())
