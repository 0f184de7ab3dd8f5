# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Filters with progress, errors as plain lines, and what is told at the end."""

import contextlib
import dataclasses
import re
import sys
import time

from vtklighttransport.filters import plain
from vtklighttransport.progress import ProgressBar, update
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import (
    VTK_STRING, vtkLogger, vtkOutputWindow, vtkStringOutputWindow)


class Failure(Exception):
    """What ends the run with exit code 1, after a line for each error."""


class Messages:
    """Takes what VTK reports, from whichever object, and keeps errors as plain lines. `flags` are
    the options for the properties and arrays that these lines may name."""

    def __init__(self, flags=None):
        self.flags = flags or {}
        self.errors = []
        self.warnings = []
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
            self.errors.append(self.explain(text))

    @calldata_type(VTK_STRING)
    def on_warning(self, _window, _event, text):
        self.warn(self.explain(text))

    def explain(self, text):
        """A plain line, with the options for what it names at its end."""
        line = plain(text)
        words = set(re.findall(r"\w+", line))
        named = dict.fromkeys(flag for name, flag in self.flags.items() if name in words)
        return f"{line} (options: {', '.join(named)})" if named else line

    def warn(self, text):
        self.warnings.append(text)
        print("warning: " + text, file=sys.stderr)

    def check(self):
        if self.errors:
            raise Failure

    def take(self):
        """The errors so far, in one line; they are dealt with then."""
        text = "; ".join(self.errors)
        self.errors.clear()
        return text


@dataclasses.dataclass
class Summary:
    """What a command has done: as text for people, as values for scripts."""

    text: str
    values: dict


@contextlib.contextmanager
def telling_progress(name, quiet):
    """Gives a bar where there is a terminal, None where there is none, and a line at the end."""
    shown = not quiet and sys.stderr.isatty()
    begin = time.monotonic()
    yield ProgressBar(name) if shown else None
    if not quiet and not shown:
        print(f"{name}: {time.monotonic() - begin:.1f} s", file=sys.stderr)


class Stage:
    """One filter of the run, with its line of progress on stderr."""

    def __init__(self, name, algorithm, quiet):
        self.name = name
        self.algorithm = algorithm
        self.quiet = quiet

    def run(self, messages, data=None):
        if data is not None:
            self.algorithm.SetInputDataObject(0, data)
        with telling_progress(self.name, self.quiet) as bar:
            update(self.algorithm, bar)
            messages.check()
        return self.algorithm.GetOutputDataObject(0)
