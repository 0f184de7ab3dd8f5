# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What tests of reports share: runs of the command, and what they write."""

import csv
import os
import signal
import subprocess
import sys
from xml.etree import ElementTree

import numpy

from TestingTools import FolderTestCase, make_box, make_surface, read_picture, write_surface
from vtklighttransport.arrays import get_area_vectors, set_cell_array

# 20 mean free paths a side.
MEDIUM = ("--mm-per-unit", "20", "--refractive-index", "1", "--scattering", "0.9", "0.95", "0.98",
          "--absorption", "0.1", "0.05", "0.02")


def make_cube(count):
    """Lit from one side, more in red than in blue."""
    cube = make_surface(make_box((0, 0, 0), (1, 1, 1), outside=True, count=count))
    vectors = get_area_vectors(cube)
    normals = vectors / numpy.linalg.norm(vectors, axis=1)[:, None]
    light = numpy.maximum(normals @ (0.6, 0.64, 0.48), 0.0)
    set_cell_array(cube, "Irradiance", light[:, None] * (1.0, 0.8, 0.5))
    return cube


class ReportTestCase(FolderTestCase):
    # Arguments of all runs, and the columns of the table.
    ARGUMENTS = ()
    COLUMNS = set()

    def save(self, name, surface):
        self.assertTrue(write_surface(self.path(name), surface))
        return self.path(name)

    def make_command(self, source, *arguments, folder="report"):
        return [sys.executable, "-m", "vtklighttransport", "report", source, self.path(folder),
                *self.ARGUMENTS, *arguments]

    def run_command(self, *arguments, window="", **options):
        environment = dict(os.environ)
        if window:
            environment["VTK_DEFAULT_OPENGL_WINDOW"] = window
        return subprocess.run(self.make_command(*arguments, **options), capture_output=True,
                              text=True, timeout=200, check=False, env=environment)

    def read_table(self):
        with open(self.path("report", "report.csv"), newline="", encoding="utf-8") as stream:
            reader = csv.DictReader(stream)
            self.assertEqual(set(reader.fieldnames), self.COLUMNS)
            return list(reader)

    def read_page(self):
        """The page must be well-formed; returns its text and the pictures that it shows."""
        page = ElementTree.parse(self.path("report", "report.html")).getroot()
        return " ".join(page.itertext()), [image.get("src") for image in page.iter("img")]

    def check_pictures(self, names):
        for name in names:
            values = read_picture(self.path("report", name)).reshape(-1, 3)
            self.assertGreater(values.std(), 5.0, name)
            self.assertGreater(len(numpy.unique(values, axis=0)), 10, name)

    def interrupt(self, command, text):
        """The run after Ctrl-C when a line with the text has come."""
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as process:
            while text not in (line := process.stdout.readline()):
                self.assertNotEqual(line, "", "it ended by itself")
            process.send_signal(signal.SIGINT)
            _rest, errors = process.communicate(timeout=100)
        self.assertEqual(process.returncode, 130, errors)
        self.assertNotIn("Traceback", errors)
        self.assertIn("The run was interrupted", self.read_page()[0])

    def check_failures(self, cases):
        """Of (arguments, folder, exit code, message); no page must be left."""
        for arguments, folder, code, message in cases:
            result = self.run_command(*arguments, folder=folder)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(message, result.stderr)
            self.assertNotIn("Traceback", result.stderr)
            self.assertFalse(os.path.exists(self.path("report", "report.html")))
