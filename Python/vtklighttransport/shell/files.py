# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and images from files and into files."""

import contextlib
import errno
import os
import warnings

from vtklighttransport.meshes import READERS, check_extension, get_extension, read_mesh
from vtklighttransport.replacement import check_place, replace_file
from vtklighttransport.shell.stages import Failure, Stage, Summary, telling_progress
from vtklighttransport.summaries import list_summaries
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader, vtkXMLImageDataWriter, vtkXMLPolyDataWriter)


def add_input(parser, *others):
    """`others` are texts of what may be read besides."""
    parser.add_argument("input", help="; ".join(
        ["surface mesh: " + ", ".join(READERS) + ", and what meshio reads where it is there",
         *others]))


def check_input(options):
    try:
        check_extension(options.input)
    except ValueError as error:
        options.parser.error(f"argument input: {error}")


def is_image(file):
    return get_extension(file) == ".vti"


def read(options, messages):
    """The surface in the input file."""
    with telling_progress("read", options.quiet) as bar, warnings.catch_warnings(record=True) as w:
        warnings.simplefilter("always")
        try:
            surface = read_mesh(options.input, bar)
        except (OSError, ValueError) as error:
            raise Failure(str(error)) from error
        if messages.errors:
            raise Failure(f"cannot read {options.input}")
    for warning in w:
        messages.warn(str(warning.message))
    return surface


def read_image(file, kind, options, messages):
    """What is in the file, which must not be empty."""
    if not os.path.isfile(file):
        raise Failure(f"cannot read {file}: no such file")
    reader = vtkXMLImageDataReader()
    reader.SetFileName(file)
    try:
        data = Stage("read", reader, options.quiet).run(messages)
    except Failure as failure:
        raise Failure(f"cannot read {file}") from failure
    if data.GetNumberOfPoints() == 0:
        raise Failure(f"cannot read {file}: no {kind} in it")
    return data


def add_output(parser, *others, kind=".vtp"):
    parser.add_argument("output", help="; ".join(["result: " + kind, *others]))


def check_output(options, *extensions):
    extensions = extensions or (".vtp",)
    if get_extension(options.output) not in extensions:
        options.parser.error(f"argument output: '{options.output}' is not a "
                             f"{' or '.join(extensions)} file")
    check_file(options.output)


def check_file(file):
    with naming(file):
        check_place(file)


@contextlib.contextmanager
def naming(file):
    """An OSError ends the run, with the name of the file that could not be written."""
    try:
        yield
    except OSError as error:
        raise Failure(f"cannot write {file}: {error.strerror}") from error


def write_data(file, data):
    """A .vtp or .vti file; an OSError tells what prevents it.

    VTK's writer ends the process where a disk is full: it gets no disk to write to.
    """
    writer = vtkXMLImageDataWriter() if is_image(file) else vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    # Encoded: with the libexpat1 of Debian 12's security updates VTK 9.2 cannot read raw files.
    writer.SetDataModeToBinary()
    writer.WriteToOutputStringOn()
    if writer.Write() != 1:
        raise OSError(errno.EIO, "VTK cannot write the data", file)
    replace_file(file, writer.GetOutputString().encode())


def write(options, messages, data):
    """The result in its file, or what was there before."""
    with naming(options.output):
        write_data(options.output, data)
    if messages.errors:
        raise Failure(f"cannot write {options.output}")


def write_patches(options, messages, result, text):
    """Writes what a filter has added to patches, and tells of it."""
    write(options, messages, result)
    kind, count = "patches", result.GetNumberOfCells()
    if is_image(options.output):
        kind, count = "texels", result.GetNumberOfPoints()
    return Summary(f"{options.output}: {count} {kind}, {text}",
                   {"output": options.output, kind: count, **list_summaries(result)})
