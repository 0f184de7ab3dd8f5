# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""radiosity IN OUT: diffuse interreflection."""

from vtklighttransport.shell.enclosure import ARRAYS, ENCLOSURE
from vtklighttransport.shell.files import add_output, check_input, check_output, write_patches
from vtklighttransport.shell.lights import add_lights, light_scene
from vtklighttransport.shell.properties import (
    DEVICE, Choice, Number, add_arrays, add_properties, check_properties, choose_arrays,
    give_values, make_filter)
from vtklighttransport.shell.scene import add_scene, check_mesh, read_scene
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import get_summary

HELP = "diffuse interreflection: B = E + rho F B"
DESCRIPTION = (
    "Adds the arrays Radiosity, Irradiance and NetFlux (flux per unit area). The mesh has the "
    "cell arrays Emission and Reflectance, or Temperature and Emissivity; with a light "
    "Emission may be missing. Each may be given instead as a value, of all patches or, with "
    "REGION=VALUE, of a region (a solid of an STL, a block, a physical group); repeat for more.")
PROPERTIES = (
    Choice("--solver", "Solver", "SOLVER_",
           "how the equation is solved; auto is conjugate gradients"),
    Number("--tolerance", "Tolerance", float,
           "error bound to stop at, as a fraction of the largest radiosity"),
    Number("--iterations", "MaximumNumberOfIterations", int, "iterations at most"),
    Number("--view-factor-tolerance", "ViewFactorTolerance", float,
           "bound on the absolute error of each row of view factors; 0 as the accuracy asks"),
    Number("--feature-angle", "FeatureAngle", float,
           "edges sharper than this keep their own point values, in degrees"),
    DEVICE,
    *ENCLOSURE,
)


def add_options(parser):
    add_scene(parser)
    add_output(parser)
    add_lights(parser)
    add_properties(parser, "vtkRadiosity", PROPERTIES)
    add_arrays(parser, ARRAYS)


def check(options):
    check_input(options)
    check_output(options)
    check_mesh(options)
    check_properties(options, "vtkRadiosity", PROPERTIES)


def run(options, messages):
    radiosity = make_filter(options, "vtkRadiosity", PROPERTIES)
    choose_arrays(options, radiosity, ARRAYS)
    surface = give_values(options, ARRAYS, read_scene(options, messages))
    surface = light_scene(options, messages, surface)
    result = Stage("radiosity", radiosity, options.quiet).run(messages, surface)
    return write_patches(
        options, messages, result,
        f"{get_summary(result, 'NumberOfIterations'):.0f} iterations, "
        f"error bound {get_summary(result, 'ErrorBound'):.2g}, "
        f"{get_summary(result, 'DeviceUsed')}")
