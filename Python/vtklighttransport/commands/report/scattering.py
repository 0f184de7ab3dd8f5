# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of subsurface scattering: models."""

from vtklighttransport.commands.report import body
from vtklighttransport.commands.report.body import CLASS, LEVELS, light  # noqa: F401 (of a kind)
from vtklighttransport.commands.report.values import Tolerance, Tolerances
from vtklighttransport.shell.properties import find_choices, find_class

TITLE = "models of scattering (--scatter)"
LINK_TOLERANCES = [1e-1, 1e-2, 1e-3]
VALUES = (
    Tolerances("--target-errors", "TargetError", [0.1, 0.05, 0.03], "Monte Carlo"),
    Tolerance("--reference-error", "TargetError", 0.02, "the Monte Carlo reference"),
)


def add_options(group):
    group.add_argument("--models", type=lambda text: text.split(","), metavar="NAME,...",
                       help="as --model of scatter, beside Monte Carlo [all]")
    for value in VALUES:
        value.add_to(group)


def check(options):
    body.check(options)
    models = find_choices(find_class(CLASS), "MODEL_")
    for name in options.models or ():
        if name not in models:
            options.parser.error(f"argument --models: '{name}' is none of {', '.join(models)}")


def make_subject(options):
    from vtklighttransport.report.scattering import Scattering
    return Scattering(options, lambda: body.make_filter(options))
