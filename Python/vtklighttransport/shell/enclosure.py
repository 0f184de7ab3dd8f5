# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What radiosity and its report ask of a scene: links, bands, what is outside, arrays."""

from vtklighttransport.jobs import RADIOSITY_ARRAYS
from vtklighttransport.shell.properties import Choice, InputArray, Number, NumberList, Switch

ENCLOSURE = (
    Choice("--links", "LinkMethod", "LINK_METHOD_",
           "a link for each pair of patches, between clusters, or from rays (sampled); auto is "
           "what a tolerance asks for, else dense for few patches and sampled for many"),
    Number("--accuracy", "Accuracy", float,
           "relative error of the radiosity by its links, without what is emitted"),
    Number("--link-tolerance", "LinkTolerance", float,
           "relative error of the irradiance that hierarchical or sampled links are allowed; 0 as "
           "the accuracy asks"),
    Switch("--errors", "ComputeErrors", True, "arrays of standard errors"),
    Switch("--by-brightness", "RefineByBrightness", True,
           "refine hierarchical links where light is"),
    Switch("--two-sided", "TwoSided", True,
           "each polygon is two faces, the back with arrays of its own (ReflectanceBack, ...)"),
    Switch("--closure", "EnforceClosure", True,
           "make the view factors of each patch sum to 1 with what it sees of the sky"),
    NumberList("--band-limits", "BandLimit",
               "limits of spectral bands for temperatures: wavelengths in micrometres, such as "
               "0,8,14,inf"),
    Number("--background-temperature", "BackgroundTemperature", float,
           "temperature in kelvin of what is seen through the openings of the scene"),
    NumberList("--background-radiance", "BackgroundRadiance",
               "radiance that enters through them: a value, or one per band with commas between"),
)
ARRAYS = tuple(InputArray(flag, *RADIOSITY_ARRAYS[keyword], text) for flag, keyword, text in (
    ("--emission", "emission", "emitted flux per area"),
    ("--reflectance", "reflectance", "diffuse reflectance, 0 to 1"),
    ("--temperature", "temperature", "temperatures in kelvin"),
    ("--emissivity", "emissivity", "emissivity, 0 to 1"),
    ("--boundary-condition", "boundary_condition",
     "0 where the temperature is given, 1 where the net flux is"),
    ("--net-flux", "prescribed_net_flux", "given net fluxes, W/m2; 0 without one"),
))
