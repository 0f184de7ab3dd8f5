# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""scatter IN OUT: diffuse subsurface scattering."""

from vtklighttransport.shell.files import (
    add_output, check_input, check_output, is_image, read_file, write_patches)
from vtklighttransport.shell.lights import add_lights, has_lights, light_scene
from vtklighttransport.shell.properties import (
    Choice, Color, InputArray, Number, Switch, add_arrays, add_properties, check_properties,
    choose_array, choose_arrays, make_filter)
from vtklighttransport.shell.scene import add_scene, check_mesh, is_remeshed, read_scene
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import get_summary
from vtkmodules.vtkCommonCore import reference

HELP = "diffuse subsurface scattering"
DESCRIPTION = (
    "Adds the array ScatteredIrradiance (flux per unit area that leaves the surface). Give a "
    "light, or a mesh with the cell array Irradiance, or the texel image of an atlas with it.")
PROPERTIES = (
    Choice("--material", "Material", "MATERIAL_",
           "measured material; it wins over the three options below"),
    Color("--scattering", "ScatteringCoefficient",
          "reduced scattering coefficient of red, green and blue, per mm"),
    Color("--absorption", "AbsorptionCoefficient",
          "absorption coefficient of red, green and blue, per mm"),
    Number("--refractive-index", "RefractiveIndex", float, "refractive index of the object"),
    Number("--mm-per-unit", "MillimetersPerUnit", float,
           "length of the mesh's unit in millimetres; 10 for centimetres"),
    Choice("--model", "Model", "MODEL_",
           "the diffuse reflectance profile of a flat surface, or photons in the body itself "
           "(monte-carlo), which must be closed"),
    Choice("--burley-fit", "BurleyFit", "BURLEY_FIT_",
           "what the model of Christensen and Burley is fitted to, which is one for an index of 1"),
    Number("--target-error", "TargetError", float,
           "standard error of the result of monte-carlo, relative"),
    Number("--photons", "NumberOfPhotons", int,
           "photons of monte-carlo, 0 for as many as --target-error asks; of tabulated, 0 for as "
           "many as a second or two allow"),
    Color("--anisotropy", "Anisotropy",
          "mean cosine of the angle of scattering of red, green and blue, for monte-carlo and "
          "tabulated"),
    Number("--seed", "Seed", int, "of the random numbers of monte-carlo and tabulated"),
    Choice("--incidence", "Incidence", "INCIDENCE_",
           "without a light: whether the mesh's array is diffuse irradiance or has entered the "
           "surface"),
    Switch("--thickness", "ComputeThickness", True,
           "add the arrays Thickness (mm) and DiffusionThickness (diffusion lengths)"),
    Number("--link-tolerance", "LinkTolerance", float,
           "bound on the relative error of the links of a patch"),
    Choice("--device", "Device", "DEVICE_",
           "where the links are applied; auto takes OpenGL on a real GPU"),
    Number("--feature-angle", "FeatureAngle", float,
           "edges sharper than this keep their own point values, in degrees"),
)
IRRADIANCE = InputArray(
    "--irradiance", 0,
    "without a light: cell array (of texels: point array) of what falls in "
    "[Irradiance, or TransmittedIrradiance]")


def add_options(parser):
    add_scene(parser, "or texels of its atlas, as vtkSurfaceToAtlas makes them: .vti")
    add_output(parser, "of texels .vti")
    add_lights(parser)
    add_properties(parser, "vtkSubsurfaceScattering", PROPERTIES)
    add_arrays(parser, [IRRADIANCE])
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
        return read_file(options.input, "texels", options, messages)
    return read_scene(options, messages)


def run(options, messages):
    scattering = make_filter(options, "vtkSubsurfaceScattering", PROPERTIES)
    choose_arrays(options, scattering, [IRRADIANCE])
    if options.medium:
        scattering.SetInputData(1, read_file(options.medium, "image", options, messages))
    index = find_refractive_index(scattering)
    surface = light_scene(options, messages, read_input(options, messages), index)
    if has_lights(options):
        if index > 1.0:
            scattering.SetIncidenceToTransmitted()
        else:
            choose_array(scattering, IRRADIANCE.index, "DirectIrradiance")
    result = Stage("scattering", scattering, options.quiet).run(messages, surface)
    return write_patches(options, messages, result, describe(result))


def describe(result):
    if result.GetFieldData().HasArray("NumberOfLinks"):
        work = f"{get_summary(result, 'NumberOfLinks'):.0f} links"
    else:
        work = f"{get_summary(result, 'PhotonsTraced'):.0f} photons"
    return f"{work}, {get_summary(result, 'DeviceUsed')}"


def find_refractive_index(scattering):
    """That of the material, or of the property where there is none."""
    index = reference(scattering.GetRefractiveIndex())
    scattering.GetMaterialProperties(scattering.GetMaterial(), [0.0] * 3, [0.0] * 3, index)
    return index.get()
