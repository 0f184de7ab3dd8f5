# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C at any moment.

Python itself answers a signal between two of its own steps, and loading a library, reading a file
or computing are one step each, however long. So the command works in a process of its own, which
the signal ends at once where nothing is left behind, and the process that the shell started does
nothing but wait for it and tell what became of it. Where something is to be made of what is there,
the work says so (`tidying_up`) and gets Python's KeyboardInterrupt.

This is loaded before all else: it needs nothing but Python.
"""

import contextlib
import os
import signal
import sys

EXIT_CODE = 130
FORWARDED = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def work_in_another_process():
    """Returns in the new process; in the one that calls, never."""
    waited_for = (*FORWARDED, signal.SIGCHLD)
    before = signal.pthread_sigmask(signal.SIG_BLOCK, waited_for)
    parent = os.getpid()
    child = os.fork()
    if child:
        leave_as(wait_for(child, waited_for))
    # Should the first one be killed, this one must not go on.
    if sys.platform == "linux":
        import ctypes  # which takes a while, and Ctrl-C is answered only now
        set_parent_death_signal = 1
        ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(EXIT_CODE)
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, before)


def wait_for(child, signals):
    """The status of the process once it has ended."""
    while True:
        received = signal.sigwaitinfo(signals)
        if received.si_signo == signal.SIGCHLD:
            ended, status = os.waitpid(child, os.WNOHANG)
            if ended:
                return status
        elif received.si_code <= 0:
            # Sent to this process alone. (What a terminal sends, the other one has, too.)
            os.kill(child, received.si_signo)


def leave_as(status):
    """Ends this process as the other one ended."""
    if not os.WIFSIGNALED(status):
        os._exit(os.WEXITSTATUS(status))
    number = os.WTERMSIG(status)
    if number == signal.SIGINT:
        # Behind the progress that may stand there.
        newline = "\n" if sys.stderr.isatty() else ""
        os.write(2, f"{newline}interrupted\n".encode())
        os._exit(EXIT_CODE)
    with contextlib.suppress(OSError, ValueError):
        signal.signal(number, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
    os.kill(os.getpid(), number)
    os._exit(128 + number)


def ends_process():
    """Whether Ctrl-C ends this process at once."""
    return signal.getsignal(signal.SIGINT) == signal.SIG_DFL


@contextlib.contextmanager
def tidying_up():
    """What must not be left half done: here Ctrl-C raises KeyboardInterrupt."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
