# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Filters with progress, errors as plain lines."""

import re
import signal
import sys
import time

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

    WIDTH = 40

    def __init__(self, name, algorithm, quiet):
        self.name = name
        self.algorithm = algorithm
        self.bar = not quiet and sys.stderr.isatty()
        self.line = not quiet and not self.bar
        self.aborted = False
        algorithm.AddObserver("ProgressEvent", self.on_progress)

    def on_progress(self, _algorithm, _event):
        # A signal that a thread of a filter took Python does not see before it takes its lock anew.
        time.sleep(0)
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
        begin = time.monotonic()
        if ends_process():
            self.algorithm.Update()
        else:
            before = signal.signal(signal.SIGINT, self.on_interrupt)
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
