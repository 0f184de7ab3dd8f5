# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Tests that run python3 -m vtklighttransport."""

import os
import resource
import subprocess
import sys

from TestingTools import FolderTestCase, read_surface, write_surface


class CommandTestCase(FolderTestCase):
    def save(self, name, surface):
        self.assertTrue(write_surface(self.path(name), surface))
        return self.path(name)

    def load(self, name):
        return read_surface(self.path(name))

    def run_command(self, *arguments, limit=None):
        """`limit`: bytes that a file may have."""
        def limit_files():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
        return subprocess.run(
            [sys.executable, "-m", "vtklighttransport", *arguments],
            capture_output=True, text=True, timeout=120, check=False,
            preexec_fn=limit_files if limit else None,
            # Wide enough for argparse to break no word at a hyphen.
            env={**os.environ, "COLUMNS": "500"})

    def check_failure(self, result, code, message, output="out.vtp"):
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(message, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith("out")],
                         [output] if os.path.exists(self.path(output)) else [])
        errors = [line for line in result.stderr.splitlines() if message in line]
        self.assertTrue(errors[0].startswith("error: ") or code == 2, errors)
