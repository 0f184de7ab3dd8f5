# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""atlas IN OUT: a surface unfolded into a square of texels."""

from vtklighttransport.shell.files import (
    add_output, check_file, check_input, check_output, is_image, naming, write_data, write_patches)
from vtklighttransport.shell.properties import (
    Number, add_properties, check_properties, make_filter)
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import get_summary

HELP = "unfolds a surface into a square of texels"
DESCRIPTION = (
    "Adds the point array AtlasCoordinates and the cell array ChartId; with --texels also writes "
    "the image whose texels scatter takes for patches.")
PROPERTIES = (
    Number("--resolution", "Resolution", int, "texels a side, a power of two"),
    Number("--maximum-stretch", "MaximumStretch", float, "charts of more L2 stretch are divided"),
)


def add_options(parser):
    add_scene(parser)
    add_output(parser)
    add_properties(parser, "vtkSurfaceAtlas", PROPERTIES)
    parser.add_argument("--texels", metavar="FILE",
                        help="image (.vti) of Position, Normal, Area and ChartId of each texel "
                             "and of the mesh's arrays")


def check(options):
    check_input(options)
    check_output(options)
    check_mesh(options)
    check_properties(options, "vtkSurfaceAtlas", PROPERTIES)
    if options.texels:
        if not is_image(options.texels):
            options.parser.error(f"argument --texels: '{options.texels}' is not a .vti file")
        check_file(options.texels)


def run(options, messages):
    atlas = make_filter(options, "vtkSurfaceAtlas", PROPERTIES)
    surface = read_scene(options, messages)
    result = Stage("atlas", atlas, options.quiet).run(messages, surface)
    if options.texels:
        to_texels = make_filter(options, "vtkSurfaceToAtlas", ())
        texels = Stage("texels", to_texels, options.quiet).run(messages, result)
        with naming(options.texels):
            write_data(options.texels, texels)
    return write_patches(
        options, messages, result,
        f"{get_summary(result, 'NumberOfCharts')} charts, "
        f"stretch {get_summary(result, 'L2Stretch'):.3f}")
