# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of subsurface scattering: models."""

from vtklighttransport.commands.report.values import Tolerance, Tolerances
from vtklighttransport.shell.body import (
    BODY, add_light_that_falls_in, light_body, make_scattering)
from vtklighttransport.shell.properties import (
    DEVICE, add_properties, check_properties, find_choices, find_class)

TITLE = "scattering (--scatter); give a light, or a mesh with the cell array Irradiance"
CLASS = "vtkSubsurfaceScattering"
LEVELS = 0
VALUES = (
    Tolerances("--target-errors", "TargetError", [0.1, 0.05, 0.03], "Monte Carlo"),
    Tolerance("--reference-error", "TargetError", 0.02, "the Monte Carlo reference"),
)


def add_options(group):
    group.add_argument("--models", type=lambda text: text.split(","), metavar="NAME,...",
                       help="as --model of scatter, beside Monte Carlo [all]")
    for value in VALUES:
        value.add_to(group)
    add_light_that_falls_in(group)
    add_properties(group, CLASS, BODY)


def check(options):
    check_properties(options, CLASS, BODY)
    models = find_choices(find_class(CLASS), "MODEL_")
    for name in options.models or ():
        if name not in models:
            options.parser.error(f"argument --models: '{name}' is none of {', '.join(models)}")


def make_subject(options):
    from vtklighttransport.report.scattering import Scattering
    return Scattering(options, lambda: make_scattering(options, (DEVICE, *BODY)))


def light(options, messages, surface, subject):
    return light_body(options, messages, surface, subject.make_plain_filter())
