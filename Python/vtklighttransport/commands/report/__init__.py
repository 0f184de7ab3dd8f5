# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""report IN FOLDER: error of radiosity, or of subsurface scattering, against run time.

Each kind of report is a module of this folder and has

TITLE                   of its options in the help
CLASS                   the filter
LEVELS                  default of --levels
LINK_TOLERANCES         default of --link-tolerances
VALUES                  its options that are a Value
add_options(group)      its arguments; those of every report are here
check(options)          as that of a command, of all but VALUES
make_subject(options)   what the report is of; needs numpy
light(options, messages, surface, subject)  the surface as the filters take it

What reports of scattering share is in `body`.
"""

from vtklighttransport.commands.report import body, radiosity, scattering, scattering_links
from vtklighttransport.commands.report.values import (
    Count, Tolerances, check_values, print_numbers)
from vtklighttransport.shell.arguments import parse_direction
from vtklighttransport.shell.files import check_input
from vtklighttransport.shell.properties import DEVICE, add_properties
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Failure

HELP = "error of radiosity, or of scattering, against run time"
DESCRIPTION = (
    "Computes the radiosity of a scene, or the light that a translucent body scatters, with "
    "--scatter by its models, with --scatter-links by ways to link its patches, at several "
    "tolerances, on the scene as it is and subdivided, and writes report.csv, report.html and "
    "their pictures. Ctrl-C ends it with what was measured until then.")
KINDS = {"": radiosity, "--scatter": scattering, "--scatter-links": scattering_links}
VALUES = (
    Tolerances("--link-tolerances", "LinkTolerance", None,
               "hierarchical links, with --scatter of the models' links, with --scatter-links of "
               f"all pairs and adaptive ones [{print_numbers(radiosity.LINK_TOLERANCES)}, with "
               f"--scatter-links {print_numbers(scattering_links.LINK_TOLERANCES)}]"),
    Count("--levels", 0, 12, None, "how many times triangles are divided in four "
          f"[{radiosity.LEVELS}, of scattering {scattering.LEVELS}]"),
    Count("--repeat", 1, 1000, 1, "runs of which times are the median"),
)


def add_options(parser):
    add_scene(parser)
    parser.add_argument("folder", help="where the report goes; made when missing")
    parser.add_argument("--scatter", dest="kind", action="store_const", const="--scatter",
                        default="",
                        help="of models of subsurface scattering; without, of radiosity")
    parser.add_argument("--scatter-links", dest="kind", action="store_const",
                        const="--scatter-links", help="of links of subsurface scattering")
    for value in VALUES:
        value.add_to(parser)
    add_properties(parser, "vtkRadiosity", [DEVICE])
    parser.add_argument("--view", metavar="X,Y,Z", type=parse_direction,
                        help="direction that pictures are seen from [where the scene is open]")
    parser.set_defaults(groups=[
        Group(parser, radiosity, [""]),
        Group(parser, body, ["--scatter", "--scatter-links"]),
        Group(parser, scattering, ["--scatter"]),
        Group(parser, scattering_links, ["--scatter-links"])])


class Group:
    """A group of options that remembers them, and of which kinds of report they are."""

    def __init__(self, parser, module, kinds):
        self.kinds = kinds
        self.group = parser.add_argument_group(module.TITLE)
        self.actions = []
        module.add_options(self)

    def add_argument(self, *names, **settings):
        self.actions.append(self.group.add_argument(*names, **settings))

    def get_default(self, name):
        return self.group.get_default(name)

    def set_defaults(self, **values):
        self.group.set_defaults(**values)

    def find_given(self, options):
        return [action.option_strings[0] for action in self.actions
                if getattr(options, action.dest) != action.default]


def check(options):
    check_input(options)
    refuse_options_of_others(options)
    kind = KINDS[options.kind]
    if options.levels is None:
        options.levels = kind.LEVELS
    if options.link_tolerances is None:
        options.link_tolerances = kind.LINK_TOLERANCES
    check_values(options, kind.CLASS, VALUES + kind.VALUES)
    kind.check(options)
    check_mesh(options)


def refuse_options_of_others(options):
    for group in options.groups:
        if options.kind not in group.kinds:
            wanted = ("with " + " or ".join(group.kinds) if group.kinds[0]
                      else "without " + options.kind)
            for flag in group.find_given(options):
                options.parser.error(f"argument {flag}: goes {wanted}")


def run(options, messages):
    try:
        from vtklighttransport import report
    except ImportError as error:
        raise Failure(f"a report needs numpy: {error}") from error
    kind = KINDS[options.kind]
    subject = kind.make_subject(options)
    surface = kind.light(options, messages, read_scene(options, messages), subject)
    return report.run(options, messages, subject, surface)
