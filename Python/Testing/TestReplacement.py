# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files are replaced whole or stay as they were, whatever has their name."""

import os
import resource
import signal
import socket
import stat
import unittest
import unittest.mock

from vtklighttransport.replacement import replace_file

from TestingTools import FolderTestCase

NOBODY = 65534


def run_apart(work):
    """What a function raises in a process of its own: the errno of an OSError, 0 without."""
    child = os.fork()
    if child == 0:
        code = 0
        try:
            work()
        except OSError as error:
            code = error.errno
        finally:
            os._exit(code)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


class TestReplacement(FolderTestCase):
    def make(self, name, content=b"old"):
        with open(self.path(name), "wb") as stream:
            stream.write(content)
        return self.path(name)

    def read(self, name):
        with open(self.path(name), "rb") as stream:
            return stream.read()

    def check_refused(self, name, reason):
        before = sorted(os.listdir(self.folder))
        state = os.lstat(self.path(name))
        with self.assertRaisesRegex(OSError, reason) as caught:
            replace_file(self.path(name), b"new")
        self.assertEqual(caught.exception.filename, self.path(name))
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        after = os.lstat(self.path(name))
        self.assertEqual((after.st_ino, after.st_mode), (state.st_ino, state.st_mode))

    def test_new(self):
        before = os.umask(0o027)
        try:
            replace_file(self.path("new"), b"content")
        finally:
            os.umask(before)
        self.assertEqual(self.read("new"), b"content")
        self.assertEqual(stat.S_IMODE(os.stat(self.path("new")).st_mode), 0o640)
        self.assertEqual(os.listdir(self.folder), ["new"])

    def test_mode_is_kept(self):
        for mode in (0o600, 0o644, 0o664, 0o755):
            os.chmod(self.make("file"), mode)
            replace_file(self.path("file"), b"new")
            self.assertEqual(stat.S_IMODE(os.stat(self.path("file")).st_mode), mode)
            self.assertEqual(self.read("file"), b"new")

    def test_links(self):
        """A chain of links, relative and to another folder; one that leads to nothing yet."""
        os.mkdir(self.path("sub"))
        self.make("sub/file")
        os.symlink("sub/file", self.path("one"))
        os.symlink(self.path("one"), self.path("two"))
        os.symlink("sub/later", self.path("three"))
        replace_file(self.path("two"), b"new")
        replace_file(self.path("three"), b"later")
        for name in ("one", "two", "three"):
            self.assertTrue(os.path.islink(self.path(name)))
        self.assertEqual((self.read("sub/file"), self.read("sub/later")), (b"new", b"later"))

    def test_refused(self):
        os.mkfifo(self.path("pipe"))
        os.mkdir(self.path("folder"))
        with socket.socket(socket.AF_UNIX) as server:
            server.bind(self.path("socket"))
            os.symlink("loop", self.path("loop"))
            os.link(self.make("first"), self.path("second"))
            os.symlink("pipe", self.path("link to pipe"))
            for name in ("pipe", "folder", "socket", "link to pipe"):
                self.check_refused(name, "folder or device")
        self.check_refused("loop", "leads nowhere")
        self.check_refused("first", "hard links")
        self.assertEqual(self.read("second"), b"old")
        self.assertTrue(stat.S_ISFIFO(os.lstat(self.path("pipe")).st_mode))
        with self.assertRaisesRegex(OSError, "No such file.*folder must exist"):
            replace_file(self.path("missing/file"), b"new")
        with self.assertRaises(OSError):
            replace_file("/dev/null", b"new")
        self.assertTrue(stat.S_ISCHR(os.stat("/dev/null").st_mode))

    def test_without_permission(self):
        """Of the folder, and of the file, for an ordinary user."""
        self.make("file")
        os.mkdir(self.path("closed"))
        os.chmod(self.path("closed"), 0o755)
        os.chmod(self.make("closed/file"), 0o666)
        os.mkdir(self.path("open"))
        os.chmod(self.path("open"), 0o777)
        os.chmod(self.make("open/file"), 0o444)
        os.chmod(self.folder, 0o755)

        def write(name):
            if os.geteuid() == 0:
                os.setuid(NOBODY)
            else:
                os.chmod(self.path("closed"), 0o555)
            replace_file(self.path(name), b"new")

        for name in ("closed/file", "closed/new", "open/file"):
            self.assertNotEqual(run_apart(lambda name=name: write(name)), 0, name)
        self.assertEqual((self.read("closed/file"), self.read("open/file")), (b"old", b"old"))
        self.assertEqual(os.listdir(self.path("closed")), ["file"])
        self.assertEqual(run_apart(lambda: write("open/new")), 0)
        self.assertEqual(os.listdir(self.path("open")).count("new"), 1)

    def test_full_disk(self):
        """A limit on the size of files stands in for one: the write fails in the middle."""
        self.make("file")

        def write(name):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
            replace_file(self.path(name), bytes(5000))

        for name in ("file", "new"):
            self.assertNotEqual(run_apart(lambda name=name: write(name)), 0)
        self.assertEqual(os.listdir(self.folder), ["file"])
        self.assertEqual(self.read("file"), b"old")

    def test_signals(self):
        """One that comes while the file is written ends the process, and leaves nothing behind."""
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            self.make("file")

            def write(number=number):
                signal.signal(number, signal.SIG_DFL)
                with unittest.mock.patch.object(
                        os, "fsync", lambda _file: os.kill(os.getpid(), number)):
                    replace_file(self.path("file"), b"new")

            self.assertEqual(run_apart(write), -number)
            self.assertEqual(os.listdir(self.folder), ["file"])
            self.assertEqual(self.read("file"), b"new")


if __name__ == "__main__":
    unittest.main()
