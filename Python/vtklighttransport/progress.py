# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The one progress bar, and the one way in which Python waits for a filter; needs no numpy."""

import contextlib
import signal
import sys
import threading
import time

# The first moments tell little of how long the rest takes.
SILENT_SECONDS = 1.0
SILENT_FRACTION = 0.02


class ProgressBar:
    """A line on stderr: what is at work, how far it is, and how long the rest will take."""

    WIDTH = 40

    def __init__(self, name):
        self.name = name
        self.begin = time.monotonic()

    def show(self, fraction):
        fraction = min(max(fraction, 0.0), 1.0)
        done = int(fraction * self.WIDTH)
        left = describe_time_left(time.monotonic() - self.begin, fraction)
        print(f"\r{self.name:<20} [{'#' * done}{'.' * (self.WIDTH - done)}] {fraction:4.0%} "
              f"{left:<12}", end="", file=sys.stderr, flush=True)

    @staticmethod
    def end():
        print(file=sys.stderr)


def describe_time_left(seconds, fraction):
    """'1:07 left', or nothing while that would be a guess."""
    if seconds < SILENT_SECONDS or not SILENT_FRACTION <= fraction < 1.0:
        return ""
    left = round(seconds * (1.0 - fraction) / fraction)
    minutes, left = divmod(left, 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours}:{minutes:02}:{left:02} left" if hours else f"{minutes}:{left:02} left"


def update(algorithm, bar=None):
    """Runs the filter. Ctrl-C ends it in order, and then raises KeyboardInterrupt."""
    def on_progress(_algorithm, _event):
        # A signal that a thread of a filter took Python does not see before it takes its lock anew.
        time.sleep(0)
        if bar:
            bar.show(algorithm.GetProgress())

    observer = algorithm.AddObserver("ProgressEvent", on_progress)
    try:
        with stopping(algorithm):
            algorithm.Update()
    finally:
        algorithm.RemoveObserver(observer)
        if bar:
            bar.end()


@contextlib.contextmanager
def stopping(algorithm):
    """Only the main thread may say what a signal does; in another one Ctrl-C is as it was. And so
    it is where it ends the process at once."""
    interrupted = []

    def on_interrupt(_signal, _frame):
        interrupted.append(True)
        algorithm.SetAbortExecute(1)

    listens = (threading.current_thread() is threading.main_thread()
               and signal.getsignal(signal.SIGINT) != signal.SIG_DFL)
    before = signal.signal(signal.SIGINT, on_interrupt) if listens else None
    try:
        yield
    finally:
        if listens:
            # None: not Python's, and not to be restored by it.
            signal.signal(signal.SIGINT, before or signal.SIG_DFL)
    if interrupted:
        raise KeyboardInterrupt
