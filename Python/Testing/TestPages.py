# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The pages that people copy from: what stands there runs."""

import importlib.util
import os
import pathlib
import re
import shlex
import subprocess
import sys
import unittest

import vtklighttransport as lt

from TestingTools import FolderTestCase

SOURCE = pathlib.Path(os.environ["LIGHT_TRANSPORT_SOURCE"])
PAGES = SOURCE / "Documentation" / "start"
README = SOURCE / "README.md"
WITHOUT_DISPLAY = """
import pyvista, vtklighttransport
pyvista.OFF_SCREEN = True
vtklighttransport.vtkOffScreenOpenGLRenderWindow.RegisterAsDefault()
"""
HAS_PYVISTA = importlib.util.find_spec("pyvista") is not None


def find_blocks(page, language):
    text = (PAGES / page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```", text, re.M | re.S)


class TestPages(FolderTestCase):
    def setUp(self):
        super().setUp()
        os.symlink(SOURCE / "Data", self.path("Data"))

    def run_here(self, *arguments):
        result = subprocess.run([sys.executable, *arguments], cwd=self.folder, text=True,
                                capture_output=True, timeout=200, check=False)
        self.assertEqual(result.returncode, 0, (arguments, result.stderr))
        return result.stdout

    def test_shell(self):
        # Of the commands that read what others have written; an image is not among the data.
        text = "\n".join(find_blocks("shell.md", "sh")).replace("\\\n", " ")
        commands = [shlex.split(line, comments=True) for line in text.splitlines()
                    if line.startswith("lt ")]
        self.assertGreater(len(commands), 8)
        for _, *words in commands:
            if words[0] not in ("exr-info", "report"):
                words = words[:words.index("|")] if "|" in words else words
                self.assertTrue(self.run_here("-m", "vtklighttransport", *words))
        self.assertTrue(os.path.exists(self.path("texels.vti")))

    def test_readme(self):
        commands = [line.split() for block in find_blocks(README, "sh")
                    for line in block.splitlines() if " -m " in line]
        self.assertEqual(len(commands), 2)
        for _, *words in commands:
            self.assertTrue(self.run_here(*words))
        self.assertIn("right", self.run_here("-c", "".join(find_blocks(README, "python"))))

    def test_python(self):
        jobs, *blocks = find_blocks("python.md", "python")
        self.assertIn("right", self.run_here("-c", jobs))
        if HAS_PYVISTA and hasattr(lt, "vtkOffScreenOpenGLRenderWindow"):
            self.run_here("-c", WITHOUT_DISPLAY + "".join(blocks))


if __name__ == "__main__":
    unittest.main()
