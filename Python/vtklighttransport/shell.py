# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the commands of the shell share: files in, filters with progress, errors as plain lines."""

import importlib
import os
import re
import signal
import sys
import time

import vtklighttransport as lt
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import (
    VTK_STRING, vtkLogger, vtkOutputWindow, vtkStringOutputWindow)
from vtkmodules.vtkCommonDataModel import vtkDataObject

READERS = {
    ".vtp": ("vtkIOXML", "vtkXMLPolyDataReader"),
    ".vtk": ("vtkIOLegacy", "vtkPolyDataReader"),
    ".ply": ("vtkIOPLY", "vtkPLYReader"),
    ".stl": ("vtkIOGeometry", "vtkSTLReader"),
    ".obj": ("vtkIOGeometry", "vtkOBJReader"),
}


class Failure(Exception):
    """What ends the run with exit code 1, after a line for each error."""


class Messages:
    """Takes what VTK reports, from whichever object, and keeps errors as plain lines."""

    def __init__(self):
        self.errors = []
        # Otherwise each message is on stderr a second time, with its place in the source.
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        self.window.AddObserver("ErrorEvent", self.on_error)
        self.window.AddObserver("WarningEvent", self.on_warning)

    @calldata_type(VTK_STRING)
    def on_error(self, _window, _event, text):
        # The pipeline repeats each failure in its own words.
        if "returned failure for request" not in text:
            self.errors.append(plain(text))

    @calldata_type(VTK_STRING)
    def on_warning(self, _window, _event, text):
        print("warning: " + plain(text), file=sys.stderr)

    def check(self):
        if self.errors:
            raise Failure


class Stage:
    """One filter of the run, with its line of progress on stderr."""

    WIDTH = 40

    def __init__(self, name, algorithm, quiet):
        self.name = name
        self.algorithm = algorithm
        self.bar = not quiet and sys.stderr.isatty()
        self.line = not quiet and not self.bar
        self.aborted = False
        algorithm.AddObserver("ProgressEvent", self.on_progress)

    def on_progress(self, _algorithm, _event):
        if self.bar:
            fraction = min(max(self.algorithm.GetProgress(), 0.0), 1.0)
            done = int(fraction * self.WIDTH)
            print(f"\r{self.name:<20} [{'#' * done}{'.' * (self.WIDTH - done)}] {fraction:4.0%}",
                  end="", file=sys.stderr, flush=True)

    def on_interrupt(self, _signal, _frame):
        self.aborted = True
        self.algorithm.SetAbortExecute(1)

    def run(self, messages, data=None):
        if data is not None:
            self.algorithm.SetInputDataObject(0, data)
        before = signal.signal(signal.SIGINT, self.on_interrupt)
        begin = time.monotonic()
        self.algorithm.Update()
        signal.signal(signal.SIGINT, before)
        if self.bar:
            print(file=sys.stderr)
        if self.aborted:
            raise KeyboardInterrupt
        messages.check()
        if self.line:
            print(f"{self.name}: {time.monotonic() - begin:.1f} s", file=sys.stderr)
        return self.algorithm.GetOutputDataObject(0)


def plain(text):
    """A VTK message without the place in the source and without line breaks."""
    match = re.search(r"\((?:0x)?[0-9a-fA-F]+\): (.*)", text, re.DOTALL)
    return " ".join((match.group(1) if match else text).split())


def find_class(name):
    if not hasattr(lt, name):
        raise Failure(f"this build has no {name}: its module was switched off in CMake")
    return getattr(lt, name)


def find_choices(kind, prefix):
    return {key[len(prefix):].lower().replace("_", "-"): getattr(kind, key)
            for key in dir(kind) if key.startswith(prefix)}


def read(options, messages):
    module, name = READERS[os.path.splitext(options.input)[1].lower()]
    if not os.path.isfile(options.input):
        raise Failure(f"cannot read {options.input}: no such file")
    reader = getattr(importlib.import_module("vtkmodules." + module), name)()
    reader.SetFileName(options.input)
    try:
        data = Stage("read", reader, options.quiet).run(messages)
    except Failure as failure:
        raise Failure(f"cannot read {options.input}") from failure
    if data.GetNumberOfPoints() == 0:
        raise Failure(f"cannot read {options.input}: no surface in it")
    return data


def choose_arrays(options, algorithm, table):
    for _flag, index, _text in table:
        name = getattr(options, f"array{index}")
        if name:
            algorithm.SetInputArrayToProcess(
                index, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, name)


def get_summary(data, name):
    array = data.GetFieldData().GetAbstractArray(name)
    return array.GetValue(0) if array else None
