# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Filters with progress, errors as plain lines."""

import sys
import time

from vtklighttransport.filters import plain
from vtklighttransport.progress import ProgressBar, update
from vtklighttransport.shell.interrupts import ends_process
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import (
    VTK_STRING, vtkLogger, vtkOutputWindow, vtkStringOutputWindow)


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

    def take(self):
        """The errors so far, in one line; they are dealt with then."""
        text = "; ".join(self.errors)
        self.errors.clear()
        return text


class Stage:
    """One filter of the run, with its line of progress on stderr."""

    def __init__(self, name, algorithm, quiet):
        self.name = name
        self.algorithm = algorithm
        self.bar = not quiet and sys.stderr.isatty()
        self.line = not quiet and not self.bar

    def run(self, messages, data=None):
        if data is not None:
            self.algorithm.SetInputDataObject(0, data)
        begin = time.monotonic()
        update(self.algorithm, ProgressBar(self.name) if self.bar else None,
               stop=not ends_process())
        messages.check()
        if self.line:
            print(f"{self.name}: {time.monotonic() - begin:.1f} s", file=sys.stderr)
        return self.algorithm.GetOutputDataObject(0)
