# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces and images from files and into files."""

import contextlib
import errno
import importlib
import os

from vtklighttransport.replacement import check_place, replace_file
from vtklighttransport.shell.stages import Failure, Stage
from vtkmodules.vtkIOXML import vtkXMLImageDataWriter, vtkXMLPolyDataWriter

READERS = {
    ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtk": ("vtkIOLegacy", "vtkPolyDataReader"),
    ".ply": ("vtkIOPLY", "vtkPLYReader"),
    ".stl": ("vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkIOGeometry", "vtkOBJReader"),
}
IMAGE_READERS = {".vti": ("vtkIOXML", "vtkXMLImageDataReader")}


def add_input(parser, *others):
    """`others` are texts of what may be read besides."""
    parser.add_argument("input", help="; ".join(["surface mesh: " + ", ".join(READERS), *others]))


def check_input(options):
    if get_extension(options.input) not in READERS:
        options.parser.error(f"argument input: '{options.input}' is none of {', '.join(READERS)}")


def is_image(file):
    return get_extension(file) in IMAGE_READERS


def get_extension(file):
    return os.path.splitext(file)[1].lower()


def make_reader(file):
    """The reader for the file's extension."""
    module, name = (READERS | IMAGE_READERS)[get_extension(file)]
    reader = getattr(importlib.import_module("vtkmodules." + module), name)()
    reader.SetFileName(file)
    return reader


def read(options, messages):
    return read_file(options.input, "surface", options, messages)


def read_file(file, kind, options, messages):
    """What is in the file, which must not be empty."""
    if not os.path.isfile(file):
        raise Failure(f"cannot read {file}: no such file")
    try:
        data = Stage("read", make_reader(file), options.quiet).run(messages)
    except Failure as failure:
        raise Failure(f"cannot read {file}") from failure
    if data.GetNumberOfPoints() == 0:
        raise Failure(f"cannot read {file}: no {kind} in it")
    return data


def add_output(parser, *others):
    parser.add_argument("output", help="; ".join(["result: .vtp", *others]))


def check_output(options, extension=".vtp"):
    if get_extension(options.output) != extension:
        options.parser.error(f"argument output: '{options.output}' is not a {extension} file")
    with naming(options.output):
        check_place(options.output)


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
    """Writes what a filter has added to patches; returns the line that tells of it."""
    write(options, messages, result)
    kind, count = "patches", result.GetNumberOfCells()
    if is_image(options.output):
        kind, count = "texels", result.GetNumberOfPoints()
    return f"{options.output}: {count} {kind}, {text}"
