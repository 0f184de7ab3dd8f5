# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The one way in which Python writes a file, by the rules of FileReplacement.h.

The new file is written beside its place, under a name that nobody can foresee, and moved there when
all of it is on the disk. Whatever fails before, an older file stays as it was and nothing is left
beside it; signals that end the process wait for that. Symbolic links stay, what they lead to is
replaced; the older file's mode is kept.

Needs nothing but Python.
"""

import contextlib
import errno
import os
import secrets
import signal
import stat
import threading

ENDING_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# What a file system that knows no fsync answers.
WITHOUT_FSYNC = (errno.EINVAL, errno.ENOSYS)
HAS_EFFECTIVE_IDS = os.access in os.supports_effective_ids


@contextlib.contextmanager
def holding_signals_back():
    """What would end the process comes afterwards. (Other threads would take a blocked signal.)"""
    received = []
    before = {}
    if threading.current_thread() is threading.main_thread():
        before = {number: signal.getsignal(number) for number in ENDING_SIGNALS}
        # None: not Python's, and not to be restored by it.
        before = {number: handler for number, handler in before.items() if handler is not None}
    for number in before:
        signal.signal(number, lambda number, _frame: received.append(number))
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in received:
            signal.raise_signal(number)


@holding_signals_back()
def replace_file(file, data):
    """Writes bytes. An OSError names what prevents it; its strerror is for messages."""
    target = os.path.realpath(file)
    older = check_target(file, target)
    unfinished = None
    try:
        descriptor, unfinished = create_beside(target, older)
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(data)
            stream.flush()
            if older:
                take_mode_over(descriptor, older)
            sync(descriptor)
            check_size(descriptor, len(data))
        os.replace(unfinished, target)
        unfinished = None
    except OSError as error:
        raise refuse(file, f"{error.strerror}; its folder must exist, let you write, and have room "
                           f"for {len(data):,} bytes", error.errno) from error
    finally:
        if unfinished:
            with contextlib.suppress(OSError):
                os.remove(unfinished)


def check_place(file):
    """Tells before there is anything to write, as replace_file would, what prevents it."""
    target = os.path.realpath(file)
    check_target(file, target)
    folder = os.path.dirname(target)
    if not os.access(folder, os.W_OK | os.X_OK, effective_ids=HAS_EFFECTIVE_IDS):
        raise refuse(file, "its folder must exist and let you write", errno.EACCES)


def check_target(file, target):
    """The state of an older file, None where there is none."""
    try:
        older = os.lstat(target)
    except OSError as error:
        if error.errno == errno.ENOENT:
            return None
        raise refuse(file, error.strerror, error.errno) from error
    if stat.S_ISLNK(older.st_mode):
        raise refuse(file, "it is a symbolic link that leads nowhere; remove the link")
    if not stat.S_ISREG(older.st_mode):
        raise refuse(file, "the name is that of a folder or device; choose another")
    if older.st_nlink > 1:
        raise refuse(file, f"it has {older.st_nlink} names (hard links), of which the others would "
                           "keep the old content; choose another name, or remove the file first")
    if not os.access(target, os.W_OK, effective_ids=HAS_EFFECTIVE_IDS):
        raise refuse(file, "the file is there and may not be written; choose another name, or "
                           "change its permissions", errno.EACCES)
    return older


def refuse(file, reason, number=errno.EINVAL):
    return OSError(number, reason, file)


def create_beside(target, older):
    """A new file for this user alone where the older one may be private, else as the umask says."""
    mode = 0o600 if older else 0o666
    flags = os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_NOFOLLOW", 0)
    path = os.path.join(os.path.dirname(target), ".unfinished-" + secrets.token_hex(12))
    return os.open(path, flags, mode), path


def take_mode_over(descriptor, older):
    """The owner first: changing it takes the bits of set-user-id away."""
    mode = stat.S_IMODE(older.st_mode)
    created = os.fstat(descriptor)
    if (created.st_uid, created.st_gid) != (older.st_uid, older.st_gid):
        try:
            os.fchown(descriptor, older.st_uid, older.st_gid)
        except OSError:
            # Rights of another group would be wrong.
            mode &= ~(stat.S_IRWXG | stat.S_ISUID | stat.S_ISGID)
    os.fchmod(descriptor, mode)


def sync(descriptor):
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in WITHOUT_FSYNC:
            raise


def check_size(descriptor, wanted):
    found = os.fstat(descriptor).st_size
    if found != wanted:
        raise OSError(errno.EIO, f"{found:,} of {wanted:,} bytes arrived")
