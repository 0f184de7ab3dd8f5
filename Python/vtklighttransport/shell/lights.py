# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lights in place of an array of irradiance."""

from vtklighttransport.lights import make_light
from vtklighttransport.shell.arguments import parse_light
from vtklighttransport.shell.properties import Number, Switch, add_properties, make_filter
from vtklighttransport.shell.stages import Stage

IRRADIANCE = (
    Number("--light-diameter", "LightAngularDiameter", float,
           "angle that each --light takes in the sky, in degrees; the sun's is 0.53"),
    Switch("--no-shadows", "Shadows", False, "let lights shine through patches"),
)


def add_lights(parser):
    for flag, text in (
            ("--light", "light from the direction (X, Y, Z), infinitely far; INTENSITY is the "
             "irradiance facing it [1]; repeat for more"),
            ("--point-light", "light at a point, in the mesh's unit; irradiance facing it is "
             "INTENSITY / distance^2 [1]; repeat for more")):
        parser.add_argument(flag, metavar="X,Y,Z[,INTENSITY]", type=parse_light, action="append",
                            default=[], help=text)
    add_properties(parser, "vtkDirectIrradiance", IRRADIANCE)


def has_lights(options):
    return bool(options.light or options.point_light)


def light_scene(options, messages, surface, refractive_index=1.0):
    """The surface with its direct irradiance where there are lights, else as it is."""
    if not has_lights(options):
        return surface
    irradiance = make_filter(options, "vtkDirectIrradiance", IRRADIANCE)
    irradiance.SetRefractiveIndex(refractive_index)
    for positional, lights in ((False, options.light), (True, options.point_light)):
        for numbers in lights:
            irradiance.AddLight(make_light(numbers[:3], *numbers[3:], positional=positional))
    return Stage("direct irradiance", irradiance, options.quiet).run(messages, surface)
