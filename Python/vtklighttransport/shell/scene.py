# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The surface of a run: which file, and how it is remeshed."""

from vtklighttransport.shell.files import add_input, read
from vtklighttransport.shell.properties import (
    Length, add_properties, check_properties, make_filter)
from vtklighttransport.shell.stages import Stage

MESHER = (
    Length("--mesh", "TargetEdgeLength",
           "remesh to patches of this edge length first, in the mesh's unit; 0 = diagonal / 50"),
)


def add_scene(parser, *others):
    """`others` are texts of what may be read besides."""
    add_input(parser, *others)
    add_properties(parser, "vtkPatchMesher", MESHER)


def is_remeshed(options):
    # A build without the mesher has no such option.
    return getattr(options, "TargetEdgeLength", None) is not None


def check_mesh(options):
    if is_remeshed(options):
        check_properties(options, "vtkPatchMesher", MESHER)


def read_scene(options, messages):
    """The patches of the file, or those that it is remeshed to."""
    surface = read(options, messages)
    if not is_remeshed(options):
        return surface
    mesher = make_filter(options, "vtkPatchMesher", MESHER)
    return Stage("mesh", mesher, options.quiet).run(messages, surface)
