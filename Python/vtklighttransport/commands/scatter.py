# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""scatter IN OUT: diffuse subsurface scattering."""

from vtklighttransport.shell.body import (
    BODY, MODEL, add_light_that_falls_in, light_body, make_scattering)
from vtklighttransport.shell.files import (
    add_output, check_input, check_output, is_image, read_image, write_patches)
from vtklighttransport.shell.lights import has_lights
from vtklighttransport.shell.properties import (
    DEVICE, Choice, Number, Switch, add_properties, check_properties)
from vtklighttransport.shell.scene import add_scene, check_mesh, is_remeshed, read_scene
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import get_summary

HELP = "diffuse subsurface scattering"
DESCRIPTION = (
    "Adds the array ScatteredIrradiance (flux per unit area that leaves the surface). Give a "
    "light, or a mesh with the cell array Irradiance, or the texel image of an atlas with it.")
PROPERTIES = (
    MODEL,
    *BODY,
    Number("--target-error", "TargetError", float,
           "standard error of the result of monte-carlo, relative"),
    Number("--photons", "NumberOfPhotons", int,
           "photons of monte-carlo, 0 for as many as --target-error asks; of tabulated, 0 for as "
           "many as a second or two allow"),
    Switch("--thickness", "ComputeThickness", True,
           "add the arrays Thickness (mm) and DiffusionThickness (diffusion lengths)"),
    Switch("--drop-links-through-air", "DropLinksThroughAir", True,
           "leave out links through the air between parts of the body; LinksThroughAir tells what "
           "they carry"),
    Choice("--links", "LinkMethod", "LINK_METHOD_",
           "from whom a patch receives light: all patches, the same clusters for all, or clusters "
           "that are small near by; auto takes the cheaper one of dense and adaptive"),
    Number("--number-of-links", "NumberOfLinks", int,
           "clusters of uniform links, and links of a patch that adaptive ones have at most"),
    Switch("--refine-by-irradiance", "RefineByIrradiance", True,
           "choose clusters by the light that falls in, too: fewer links, or a smaller error"),
    Switch("--compress-links", "CompressLinks", True,
           "keep links from clusters in one or two bytes each"),
    Number("--compression-tolerance", "CompressionTolerance", float,
           "bound on the error that compressed links make in even light, 0 for none"),
    Number("--link-tolerance", "LinkTolerance", float,
           "relative error of what links bring to a patch, 0 for 1e-4 (dense) or 1e-2"),
    DEVICE,
    Number("--feature-angle", "FeatureAngle", float,
           "edges sharper than this keep their own point values, in degrees"),
)


def add_options(parser):
    add_scene(parser, "or texels of its atlas, as vtkSurfaceToAtlas makes them: .vti")
    add_output(parser, "of texels .vti")
    add_light_that_falls_in(parser)
    add_properties(parser, "vtkSubsurfaceScattering", PROPERTIES)
    parser.add_argument(
        "--medium", metavar="FILE",
        help="for monte-carlo, a medium that varies: image (.vti) in the mesh's unit with the "
             "arrays Scattering (reduced) and Absorption, per mm; around it, and for one that it "
             "does not have, the options above hold")


def check(options):
    if is_image(options.input):
        check_texels(options)
    else:
        check_input(options)
        check_output(options)
    check_mesh(options)
    check_properties(options, "vtkSubsurfaceScattering", PROPERTIES)
    if options.medium and not is_image(options.medium):
        options.parser.error(f"argument --medium: '{options.medium}' is not a .vti file")


def check_texels(options):
    check_output(options, ".vti")
    if has_lights(options) or is_remeshed(options):
        options.parser.error(
            f"argument input: '{options.input}' is an image of texels, and lights and --mesh need "
            "the surface")


def read_input(options, messages):
    """The surface, or the texels of one."""
    if is_image(options.input):
        return read_image(options.input, "texels", options, messages)
    return read_scene(options, messages)


def run(options, messages):
    scattering = make_scattering(options, PROPERTIES)
    if options.medium:
        scattering.SetInputData(1, read_image(options.medium, "image", options, messages))
    surface = light_body(options, messages, read_input(options, messages), scattering)
    result = Stage("scattering", scattering, options.quiet).run(messages, surface)
    return write_patches(options, messages, result, describe(result))


def describe(result):
    if result.GetFieldData().HasArray("NumberOfLinks"):
        work = f"{get_summary(result, 'NumberOfLinks'):.0f} links"
    else:
        work = f"{get_summary(result, 'PhotonsTraced'):.0f} photons"
    return f"{work}, {get_summary(result, 'DeviceUsed')}"
