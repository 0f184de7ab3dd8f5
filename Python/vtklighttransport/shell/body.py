# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What scattering and its report ask of a translucent body: material, and light that falls in."""

from vtklighttransport.lights import find_material, take_light_of
from vtklighttransport.shell.lights import add_lights, has_lights, light_scene
from vtklighttransport.shell.properties import (
    Choice, Color, InputArray, Number, add_arrays, choose_arrays, give_values,
    make_filter)

MODEL = Choice("--model", "Model", "MODEL_",
               "the diffuse reflectance profile of a flat surface, or photons in the body itself "
               "(monte-carlo), which must be closed")
BODY = (
    Choice("--material", "Material", "MATERIAL_",
           "measured material; it wins over the three options below"),
    Color("--scattering", "ScatteringCoefficient",
          "reduced scattering coefficient of red, green and blue, per mm"),
    Color("--absorption", "AbsorptionCoefficient",
          "absorption coefficient of red, green and blue, per mm"),
    Number("--refractive-index", "RefractiveIndex", float, "refractive index of the object"),
    Number("--mm-per-unit", "MillimetersPerUnit", float,
           "length of the mesh's unit in millimetres; 10 for centimetres"),
    Choice("--burley-fit", "BurleyFit", "BURLEY_FIT_",
           "what the model of Christensen and Burley is fitted to, which is one for an index of 1"),
    Color("--anisotropy", "Anisotropy",
          "mean cosine of the angle of scattering of red, green and blue, for monte-carlo and "
          "tabulated"),
    Number("--seed", "Seed", int, "of the random numbers of monte-carlo and tabulated"),
    Choice("--incidence", "Incidence", "INCIDENCE_",
           "without a light: whether the mesh's array is diffuse irradiance or has entered the "
           "surface"),
)
IRRADIANCE = InputArray(
    "--irradiance", 0, "Irradiance",
    "without a light: what falls in (of texels: point array); where none is given, "
    "TransmittedIrradiance too")


def add_light_that_falls_in(parser):
    add_lights(parser)
    add_arrays(parser, [IRRADIANCE])


def make_scattering(options, table):
    """A filter with what the options set, for a surface as light_body makes it."""
    scattering = make_filter(options, "vtkSubsurfaceScattering", table)
    choose_arrays(options, scattering, [IRRADIANCE])
    if has_lights(options):
        take_light_of(scattering)
    return scattering


def light_body(options, messages, surface, scattering):
    surface = give_values(options, [IRRADIANCE], surface)
    return light_scene(options, messages, surface, find_material(scattering)[2])
