# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""report IN FOLDER: error of radiosity against run time."""

from vtklighttransport.shell.arguments import (
    check_range, parse_direction, parse_numbers, refuse_value)
from vtklighttransport.shell.enclosure import ARRAYS, ENCLOSURE
from vtklighttransport.shell.files import check_input
from vtklighttransport.shell.properties import (
    add_arrays, add_properties, check_properties, choose_arrays, find_choices, find_class,
    keeps_value, make_filter)
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Failure

HELP = "error of radiosity against run time"
DESCRIPTION = (
    "Computes the radiosity of a scene by several methods, at several tolerances, on the scene "
    "as it is and subdivided, and writes report.csv, report.html and their pictures. Ctrl-C "
    "ends it with what was measured until then.")
# Flag, property, values, help.
TOLERANCES = (
    ("--dense-tolerances", "ViewFactorTolerance", [1e-2, 1e-3],
     "ViewFactorTolerance of dense links"),
    ("--link-tolerances", "LinkTolerance", [1e-1, 1e-2, 1e-3],
     "LinkTolerance of hierarchical links"),
    ("--progressive-tolerances", "Tolerance", [1e-1, 1e-2], "Tolerance of --progressive"),
)
# Flag, property, value, help.
TOLERANCES_OF_ALL = (
    ("--solver-tolerance", "Tolerance", 1e-6, "Tolerance of the solver"),
    ("--reference-tolerance", "ViewFactorTolerance", 1e-4,
     "ViewFactorTolerance of the dense reference"),
)
# Flag, from, to, value, help.
COUNTS = (
    ("--reference-limit", 0, float("inf"), 6000,
     "patches up to which dense links are computed; beyond, the finest result of the other "
     "methods is the reference"),
    ("--levels", 0, 12, 2, "how many times triangles are divided in four"),
    ("--repeat", 1, 1000, 1, "runs of which times are the median"),
)


def add_options(parser):
    add_scene(parser)
    parser.add_argument("folder", help="where the report goes; made when missing")
    parser.add_argument("--solvers", type=lambda text: text.split(","), default=["auto"],
                        metavar="NAME,...",
                        help="as --solver of radiosity, each with all kinds of links [auto]")
    for flag, _name, values, text in TOLERANCES:
        shown = ",".join(f"{value:g}" for value in values)
        parser.add_argument(flag, type=parse_numbers, default=values, metavar="VALUE,...",
                            help=f"{text} [{shown}]")
    parser.add_argument("--brightness", action="store_true",
                        help="also hierarchical links that are refined where light is")
    parser.add_argument("--progressive", action="store_true",
                        help="also progressive refinement on the GPU (Southwell, OpenGL)")
    for flag, _name, value, text in TOLERANCES_OF_ALL:
        add_number(parser, flag, float, value, text)
    for flag, _low, _high, value, text in COUNTS:
        add_number(parser, flag, int, value, text)
    add_properties(parser, "vtkRadiosity", ENCLOSURE)
    parser.add_argument("--view", metavar="X,Y,Z", type=parse_direction,
                        help="direction that pictures are seen from [where the scene is open]")
    add_arrays(parser, ARRAYS)


def add_number(parser, flag, kind, value, text):
    parser.add_argument(flag, type=kind, default=value, metavar="VALUE",
                        help=f"{text} [{value:g}]")


def get_value(options, flag):
    return getattr(options, flag.lstrip("-").replace("-", "_"))


def check(options):
    check_input(options)
    for flag, low, high, _value, _text in COUNTS:
        check_range(options, flag, get_value(options, flag), low, high)
    check_properties(options, "vtkRadiosity", ENCLOSURE)
    model = find_class("vtkRadiosity")()
    solvers = find_choices(type(model), "SOLVER_")
    for name in options.solvers:
        if name not in solvers:
            options.parser.error(f"argument --solvers: '{name}' is none of {', '.join(solvers)}")
    for flag, name, _values, _text in TOLERANCES:
        for value in get_value(options, flag):
            check_tolerance(options, model, flag, name, value)
    for flag, name, _value, _text in TOLERANCES_OF_ALL:
        check_tolerance(options, model, flag, name, get_value(options, flag))
    check_mesh(options)


def check_tolerance(options, model, flag, name, value):
    if not keeps_value(model, name, value):
        refuse_value(options, flag, value)


def run(options, messages):
    try:
        from vtklighttransport import report
    except ImportError as error:
        raise Failure(f"a report needs numpy: {error}") from error
    return report.run(options, messages, lambda: make_enclosure(options),
                      read_scene(options, messages))


def make_enclosure(options):
    """A filter for the scene, without what the report chooses itself."""
    radiosity = make_filter(options, "vtkRadiosity", ENCLOSURE)
    choose_arrays(options, radiosity, ARRAYS)
    return radiosity
