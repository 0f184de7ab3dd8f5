# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""report IN FOLDER: error of radiosity, or of subsurface scattering, against run time.

Each kind of report is a module of this folder and has

TITLE                   of its options in the help
CLASS                   the filter
LEVELS                  default of --levels
VALUES                  its options that are a Value
add_options(group)      its arguments; those of every report are here
check(options)          as that of a command, of all but VALUES
make_subject(options)   what the report is of; needs numpy
light(options, messages, surface, subject)  the surface as the filters take it
"""

from vtklighttransport.commands.report import radiosity, scattering
from vtklighttransport.commands.report.values import Count, Tolerances, check_values
from vtklighttransport.shell.arguments import parse_direction
from vtklighttransport.shell.files import check_input
from vtklighttransport.shell.properties import DEVICE, add_properties
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Failure

HELP = "error of radiosity, or of scattering, against run time"
DESCRIPTION = (
    "Computes the radiosity of a scene, or with --scatter the light that a closed translucent body "
    "scatters, by several methods, at several tolerances, on the scene as it is and subdivided, "
    "and writes report.csv, report.html and their pictures. Ctrl-C ends it with what was measured "
    "until then.")
KINDS = {"": radiosity, "--scatter": scattering}
VALUES = (
    Tolerances("--link-tolerances", "LinkTolerance", [1e-1, 1e-2, 1e-3],
               "hierarchical links, or with --scatter of the models' links"),
    Count("--levels", 0, 12, None, "how many times triangles are divided in four "
          f"[{radiosity.LEVELS}, with --scatter {scattering.LEVELS}]"),
    Count("--repeat", 1, 1000, 1, "runs of which times are the median"),
)


def add_options(parser):
    add_scene(parser)
    parser.add_argument("folder", help="where the report goes; made when missing")
    parser.add_argument("--scatter", dest="kind", action="store_const", const="--scatter",
                        default="", help="of subsurface scattering; without, of radiosity")
    for value in VALUES:
        value.add_to(parser)
    add_properties(parser, "vtkRadiosity", [DEVICE])
    parser.add_argument("--view", metavar="X,Y,Z", type=parse_direction,
                        help="direction that pictures are seen from [where the scene is open]")
    groups = {name: Group(parser.add_argument_group(module.TITLE))
              for name, module in KINDS.items()}
    for name, group in groups.items():
        KINDS[name].add_options(group)
    parser.set_defaults(groups=groups)


class Group:
    """A group of options that remembers them."""

    def __init__(self, group):
        self.group = group
        self.actions = []

    def add_argument(self, *names, **settings):
        self.actions.append(self.group.add_argument(*names, **settings))

    def find_given(self, options):
        return [action.option_strings[0] for action in self.actions
                if getattr(options, action.dest) != action.default]


def check(options):
    check_input(options)
    refuse_options_of_others(options)
    kind = KINDS[options.kind]
    if options.levels is None:
        options.levels = kind.LEVELS
    check_values(options, kind.CLASS, VALUES + kind.VALUES)
    kind.check(options)
    check_mesh(options)


def refuse_options_of_others(options):
    for name, group in options.groups.items():
        if name != options.kind:
            for flag in group.find_given(options):
                options.parser.error(f"argument {flag}: goes {'with' if name else 'without'} "
                                     "--scatter")


def run(options, messages):
    try:
        from vtklighttransport import report
    except ImportError as error:
        raise Failure(f"a report needs numpy: {error}") from error
    kind = KINDS[options.kind]
    subject = kind.make_subject(options)
    surface = kind.light(options, messages, read_scene(options, messages), subject)
    return report.run(options, messages, subject, surface)
