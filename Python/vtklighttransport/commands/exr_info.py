# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""exr-info FILE: what is in an OpenEXR image."""

import os

from vtklighttransport.shell.properties import find_class
from vtklighttransport.shell.stages import Failure, Stage, Summary

HELP = "what is in an OpenEXR image"
DESCRIPTION = (
    "Prints parts, size, mip levels and arrays of channels with their ranges, as vtkOpenEXRReader "
    "reads them.")


def add_options(parser):
    parser.add_argument("input", help="image: .exr")


def check(_options):
    find_class("vtkOpenEXRReader")


def run(options, messages):
    if not os.path.isfile(options.input):
        raise Failure(f"cannot read {options.input}: no such file")
    reader = find_class("vtkOpenEXRReader")()
    reader.SetFileName(options.input)
    parts = [describe(reader, Stage("read", reader, options.quiet).run(messages))]
    for part in range(1, reader.GetNumberOfParts()):
        reader.SetPart(part)
        parts.append(describe(reader, Stage("read", reader, options.quiet).run(messages)))
    return Summary("\n".join(line for part in parts for line in print_part(options.input, part)),
                   {"input": options.input, "parts": parts})


def describe(reader, image):
    data = image.GetPointData()
    arrays = [data.GetArray(k) for k in range(data.GetNumberOfArrays())]
    display = image.GetFieldData().GetArray("DisplayWindow")
    return {
        "part": reader.GetPart(), "name": reader.GetPartName(reader.GetPart()),
        "size": list(image.GetDimensions()[:2]), "data_window": list(image.GetExtent()[:4]),
        "display_window": [int(end) for end in display.GetTuple(0)],
        "levels": reader.GetNumberOfLevels(),
        "arrays": {array.GetName(): {
            "components": array.GetNumberOfComponents(),
            "type": array.GetDataTypeAsString(),
            "ranges": [list(array.GetRange(k)) for k in range(array.GetNumberOfComponents())]}
            for array in arrays}}


def print_part(file, part):
    name = f" '{part['name']}'" if part["name"] else ""
    yield (f"{file}, part {part['part']}{name}: {part['size'][0]} x {part['size'][1]}, "
           f"{part['levels']} level{'s' if part['levels'] > 1 else ''}, display window "
           f"{part['display_window']}")
    for array, told in part["arrays"].items():
        low = min(pair[0] for pair in told["ranges"])
        high = max(pair[1] for pair in told["ranges"])
        yield (f"  {array}: {told['components']} x {told['type']}, from {low:.6g} to {high:.6g}")
