# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of radiosity: ways to link patches, and solvers."""

from vtklighttransport.commands.report.values import Count, Tolerance, Tolerances
from vtklighttransport.filters import find_choices
from vtklighttransport.shell.enclosure import ARRAYS, ENCLOSURE
from vtklighttransport.shell.properties import (
    DEVICE, add_arrays, add_properties, check_properties, choose_arrays, find_class,
    give_values, make_filter)

TITLE = "radiosity"
CLASS = "vtkRadiosity"
LEVELS = 2
LINK_TOLERANCES = [1e-1, 1e-2, 1e-3]
VALUES = (
    Tolerances("--dense-tolerances", "ViewFactorTolerance", [1e-2, 1e-3], "dense links"),
    Tolerances("--progressive-tolerances", "Tolerance", [1e-1, 1e-2], "--progressive"),
    Tolerance("--solver-tolerance", "Tolerance", 1e-6, "the solver"),
    Tolerance("--reference-tolerance", "ViewFactorTolerance", 1e-4, "the dense reference"),
    Count("--reference-limit", 0, float("inf"), 6000,
          "patches up to which dense links are computed; beyond, the finest result of the other "
          "methods is the reference"),
)


def add_options(group):
    group.add_argument("--solvers", type=lambda text: text.split(","), default=["auto"],
                       metavar="NAME,...",
                       help="as --solver of radiosity, each with all kinds of links [auto]")
    for value in VALUES:
        value.add_to(group)
    group.add_argument("--brightness", action="store_true",
                       help="also hierarchical links that are refined where light is")
    group.add_argument("--progressive", action="store_true",
                       help="also progressive refinement on the GPU (Southwell, OpenGL)")
    add_properties(group, CLASS, ENCLOSURE)
    add_arrays(group, ARRAYS)


def check(options):
    check_properties(options, CLASS, ENCLOSURE)
    solvers = find_choices(find_class(CLASS), "SOLVER_")
    for name in options.solvers:
        if name not in solvers:
            options.parser.error(f"argument --solvers: '{name}' is none of {', '.join(solvers)}")


def make_subject(options):
    from vtklighttransport.report.radiosity import Radiosity
    return Radiosity(options, lambda: make_enclosure(options))


def make_enclosure(options):
    """A filter for the scene, without what the report chooses itself."""
    radiosity = make_filter(options, CLASS, (DEVICE, *ENCLOSURE))
    choose_arrays(options, radiosity, ARRAYS)
    return radiosity


def light(options, _messages, surface, _subject):
    """Scenes have their own light."""
    return give_values(options, ARRAYS, surface)
