# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""view-factors IN OUT: the fraction of what leaves each patch that reaches each other."""

from vtklighttransport.meshes import check_cell_array, list_regions
from vtklighttransport.shell.files import (
    add_output, check_input, check_output, get_extension, naming, write)
from vtklighttransport.shell.properties import (
    Choice, Number, Switch, add_properties, check_properties, choose_array, make_filter)
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Failure, Stage, Summary
from vtklighttransport.summaries import get_summary, list_summaries

HELP = "view factors between all patches"
DESCRIPTION = (
    "Writes the view factors of all pairs as NumPy's .npz or as a table, or the surface with the "
    "arrays ViewFactorSum, ViewFactorError, SkyFraction and BackFaceFraction; and prints those "
    "between groups of patches.")
PROPERTIES = (
    Number("--tolerance", "Tolerance", float, "bound on the absolute error of each row"),
    Choice("--links", "LinkMethod", "LINK_METHOD_",
           "pairs integrated, links between clusters, or counts of rays"),
    Number("--link-tolerance", "LinkTolerance", float,
           "error that the last two are allowed, relative"),
    Switch("--closure", "EnforceClosure", True,
           "make each row sum to 1 with what it sees of the sky"),
    Switch("--two-sided", "TwoSided", True, "each polygon is two faces; backs are rows n to 2 n"),
)
MATRICES = (".npz", ".csv")
# Of the table of groups, beside the groups.
COLUMNS = ("Group", "Area", "Sky", "BackFace")


def add_options(parser):
    add_scene(parser)
    add_output(parser, kind="matrix: .npz or .csv; surface: .vtp")
    add_properties(parser, "vtkViewFactors", PROPERTIES)
    parser.add_argument("--group", metavar="NAME",
                        help="cell array of integers that divides patches into groups [Group, else "
                             "Region]")


def check(options):
    check_input(options)
    check_output(options, *MATRICES, ".vtp")
    check_mesh(options)
    check_properties(options, "vtkViewFactors", PROPERTIES)


def run(options, messages):
    factors = make_filter(options, "vtkViewFactors", PROPERTIES)
    surface = read_scene(options, messages)
    arrays = surface.GetCellData()
    group = options.group or ("Region" if arrays.HasArray("Region") and
                              not arrays.HasArray("Group") else None)
    if options.group:
        check_group(surface, group)
    if group:
        choose_array(factors, 0, group)
    result = Stage("view factors", factors, options.quiet).run(messages, surface)
    save(options, messages, factors, result)
    groups = take_groups(factors.GetGroupTable(), name_groups(group, surface))
    verdict = get_summary(result, "EnclosureVerdict")
    text = f"{options.output}: {result.GetNumberOfCells()} patches, {verdict}"
    return Summary("\n".join([text, *print_groups(groups)]),
                   {"output": options.output, "patches": result.GetNumberOfCells(),
                    "groups": groups, **list_summaries(result)})


def check_group(surface, name):
    try:
        check_cell_array([surface], name)
    except ValueError as error:
        raise Failure(f"--group: {error}") from error


def save(options, messages, factors, result):
    if get_extension(options.output) not in MATRICES:
        write(options, messages, result)
        return
    try:
        from vtklighttransport.factors.matrix import make_matrix
    except ImportError as error:
        raise Failure(f"a matrix needs numpy: {error}") from error
    matrix = make_matrix(factors)
    with naming(options.output):
        if get_extension(options.output) == ".csv":
            matrix.to_csv(options.output)
        else:
            matrix.save(options.output)


def name_groups(group, surface):
    """What the numbers in the table stand for."""
    regions = list_regions(surface) if group == "Region" else {}
    if len({*regions.values(), *COLUMNS}) < len(regions) + len(COLUMNS):
        return {}
    return {f"{number:g}": name for number, name in regions.items()}


def take_groups(table, names):
    """The columns of the table by their names."""
    rows = range(table.GetNumberOfRows())
    groups = {"Group": [table.GetValue(row, 0).ToString() for row in rows]}
    groups["Group"] = [names.get(group, group) for group in groups["Group"]]
    for k in range(1, table.GetNumberOfColumns()):
        name = table.GetColumnName(k)
        groups[names.get(name, name)] = [table.GetValue(row, k).ToDouble() for row in rows]
    return groups


def print_groups(groups):
    """A line for each, and one of titles."""
    widths = [max(10, len(name)) for name in groups]
    yield "  ".join(name.rjust(width) for name, width in zip(groups, widths))
    for row in zip(*groups.values()):
        cells = [value if isinstance(value, str) else f"{value:.4g}" for value in row]
        yield "  ".join(cell.rjust(width) for cell, width in zip(cells, widths))
