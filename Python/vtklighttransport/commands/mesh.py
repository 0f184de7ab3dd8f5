# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""mesh IN OUT: patches of even size from any surface."""

from vtklighttransport.shell.files import add_input, add_output, check_input, check_output, read
from vtklighttransport.shell.files import write_patches
from vtklighttransport.shell.properties import (
    Choice, Length, Number, Switch, add_properties, check_properties, make_filter)
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import get_summary

HELP = "repairs a surface and remeshes it to patches of chosen size"
DESCRIPTION = (
    "Writes triangles that keep sharp edges and the borders of regions (cell array Region), with "
    "the cell arrays of the input and OriginalCellIds.")
PROPERTIES = (
    Length("--edge-length", "TargetEdgeLength",
           "edge length of the patches, in the mesh's unit; 0 = diagonal / 50 [0]"),
    Number("--patches", "TargetNumberOfPatches", int,
           "how many patches should come out, 0 for as many as the edge length gives"),
    Choice("--size-field", "SizeField", "SIZE_FIELD_", "where edge lengths come from"),
    Length("--approximation-error", "ApproximationError",
           "how far patches may lie from the surface, with curvature; 0 = edge length / 100 [0]"),
    Length("--minimum-edge-length", "MinimumEdgeLength",
           "the smallest edge length that curvature leads to; 0 = edge length / 10 [0]"),
    Number("--grading", "Grading", float, "how much the edge length may grow per unit of distance"),
    Switch("--coarse-planes", "CoarsePlanarRegions", True, "larger patches inside of planes"),
    Number("--feature-angle", "FeatureAngle", float, "edges sharper than this stay, in degrees"),
    Number("--iterations", "NumberOfIterations", int, "how often edges and points are moved"),
    Switch("--no-repair", "Repair", False, "a surface with defects is an error"),
    Switch("--keep-holes", "FillHoles", False, "do not fill small holes"),
    Length("--hole-size", "HoleSize", "radius of the largest of them; 0 = diagonal / 100 [0]"),
    Length("--weld-tolerance", "WeldTolerance",
           "how far apart points may be that are one; 0 = as the coordinates say [0]"),
    Choice("--self-intersections", "SelfIntersections", "SELF_INTERSECTIONS_",
           "what is done with triangles that intersect"),
    Switch("--flip-normals", "FlipNormals", True, "turn all patches over"),
)


def add_options(parser):
    add_input(parser)
    add_output(parser)
    add_properties(parser, "vtkPatchMesher", PROPERTIES)


def check(options):
    check_input(options)
    check_output(options)
    check_properties(options, "vtkPatchMesher", PROPERTIES)


def run(options, messages):
    mesher = make_filter(options, "vtkPatchMesher", PROPERTIES)
    result = Stage("mesh", mesher, options.quiet).run(messages, read(options, messages))
    return write_patches(options, messages, result,
                         f"edge length {get_summary(result, 'TargetEdgeLength'):.4g}")
