# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The one way in which Python writes a file, by the rules of FileReplacement.h.

The new file is written beside its place, under a name that nobody can foresee, and moved there when
all of it is on the disk. Whatever fails before, an older file stays as it was and nothing is left
beside it. Symbolic links stay, what they lead to is replaced; the older file's mode is kept.

Needs nothing but Python.
"""

import contextlib
import errno
import os
import secrets
import stat

# What a file system that knows no fsync answers.
WITHOUT_FSYNC = (errno.EINVAL, errno.ENOSYS)


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
    if not os.access(target, os.W_OK, effective_ids=os.access in os.supports_effective_ids):
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
