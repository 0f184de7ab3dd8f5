# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m vtklighttransport report: its table, its page, its pictures and its messages."""

import math
import os
import re
import unittest

import numpy

import vtklighttransport as lt
from vtklighttransport.arrays import (
    divide_triangles, get_area_vectors, get_cell_array, make_surface, set_cell_array)

from ReportTools import ReportTestCase
from TestingTools import CUBE_CORNERS, CUBE_FACES

NUMBERS = ("tolerance", "patches", "seconds_links", "seconds_solver", "seconds_all",
           "seconds_cpu", "bytes", "links", "iterations", "error_bound")
ERRORS = ("error_l2", "error_max", "error_irradiance")


def make_room(bands=3):
    """A lit cube seen from inside, without its far side (z = 1), and a screen that hides much."""
    points = CUBE_CORNERS + [(0.3, 0.2, 0.5), (0.7, 0.2, 0.45), (0.7, 0.8, 0.5), (0.3, 0.8, 0.55)]
    polygons = [face for face in CUBE_FACES if face != (4, 6, 7, 5)]
    polygons = [(a, b, c) for a, b, c, d in polygons] + [(a, c, d) for a, b, c, d in polygons]
    polygons += [(8, 9, 10), (8, 10, 11), (10, 9, 8), (11, 10, 8)]
    room = make_surface(points, polygons)
    emission = numpy.zeros((len(polygons), bands))
    emission[[2, 7]] = numpy.linspace(1.0, 2.0, bands)
    set_cell_array(room, "Emission", emission)
    set_cell_array(room, "Reflectance", numpy.full(len(polygons), 0.6))
    return room


class TestReport(ReportTestCase):
    ARGUMENTS = ("--device", "cpu")
    COLUMNS = {"method", "solver", "reference", "device", *NUMBERS, *ERRORS}

    def check_rows(self, rows):
        for row in rows:
            for name in NUMBERS:
                self.assertTrue(math.isfinite(float(row[name])), (name, row))
            self.assertLessEqual(float(row["seconds_links"]) + float(row["seconds_solver"]),
                                 float(row["seconds_all"]) + 1e-3)
            self.assertGreater(int(row["links"]), 0)
            self.assertGreater(int(row["bytes"]), 0)
            self.assertLess(float(row["error_bound"]), 1e-6)
            self.assertEqual(row["device"], "CPU")

    def test_report(self):
        source = self.save("room.vtp", make_room())
        result = self.run_command(
            source, "--levels", "1", "--dense-tolerances", "1e-1,1e-3",
            "--link-tolerances", "1e-1,1e-3", "--reference-tolerance", "1e-4")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_table()
        self.check_rows(rows)
        self.assertEqual(sorted({int(row["patches"]) for row in rows}), [14, 56])
        methods = {row["method"] for row in rows}
        self.assertEqual(methods, {"Dense", "Hierarchical"}
                         if hasattr(lt.vtkRadiosity, "SetLinkMethod") else {"Dense"})
        for patches in ("14", "56"):
            own = [row for row in rows if row["patches"] == patches]
            self.check_errors(own)
            # What is printed is the table.
            self.assertGreaterEqual(len(re.findall(rf"^\w.* {patches} .* CPU$", result.stdout,
                                                   re.MULTILINE)), len(own))
        text, pictures = self.read_page()
        for words in ("room.vtp", "14, 56", "Dense 0.0001", "cores used", lt.__version__):
            self.assertIn(words, text)
        self.assertNotIn(self.folder, text)
        self.assertEqual(len(pictures), 4 + len(methods))
        self.check_pictures(pictures)

    def check_errors(self, rows):
        reference = rows[0]
        self.assertEqual((reference["method"], reference["tolerance"]), ("Dense", "0.0001"))
        self.assertEqual([reference[name] for name in ERRORS], [""] * 3)
        for method in dict.fromkeys(row["method"] for row in rows):
            own = [row for row in rows[1:] if row["method"] == method]
            self.assertEqual([row["tolerance"] for row in own], ["0.1", "0.001"])
            for name in ERRORS:
                coarse, fine = (float(row[name]) for row in own)
                self.assertLess(fine, coarse / 3.0)
                # Irradiance is off by about the tolerance; a bounce leaves 0.6 of that.
                self.assertLess(coarse, 0.1 / (1.0 - 0.6))
                self.assertLess(fine, 1e-3 / (1.0 - 0.6))
        for row in rows[1:]:
            self.assertEqual(row["reference"], "Dense 0.0001")

    def test_above_the_limit(self):
        """Nothing dense there: the finest of the other methods is the reference."""
        source = self.save("room.vtp", make_room(1))
        result = self.run_command(source, "--levels", "1", "--dense-tolerances", "1e-1",
                                  "--link-tolerances", "1e-1,1e-3", "--reference-limit", "20")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("left out: Dense, 56 patches: above --reference-limit (20)", result.stdout)
        rows = [row for row in self.read_table() if row["patches"] == "56"]
        text, pictures = self.read_page()
        self.assertIn("above --reference-limit (20)", text)
        self.check_pictures(pictures)
        if not hasattr(lt.vtkRadiosity, "SetLinkMethod"):
            self.assertEqual(rows, [])
            self.assertIn("56 patches: no method for so many", text)
            return
        self.assertEqual([(row["method"], row["tolerance"], row["reference"]) for row in rows],
                         [("Hierarchical", "0.001", "is the reference"),
                          ("Hierarchical", "0.1", "Hierarchical 0.001")])
        self.assertIn("finest result of another method", text)

    def test_without_context(self):
        source = self.save("room.vtp", make_room())
        arguments = ("--levels", "0", "--dense-tolerances", "1e-1", "--link-tolerances", "1e-1")
        result = self.run_command(source, *arguments, window="none")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.check_rows(self.read_table())
        text, pictures = self.read_page()
        self.assertEqual(pictures, [])
        self.assertEqual(text.count("Plots and pictures: No OpenGL context"), 1)
        self.assertEqual(sorted(os.listdir(self.path("report"))), ["report.csv", "report.html"])

    def test_interrupted(self):
        """Rows are written as they come; the page tells of them."""
        source = self.save("room.vtp", make_room())
        command = self.make_command(source, "--levels", "5", "--dense-tolerances", "1e-1,1e-4",
                                    "--reference-tolerance", "1e-5")
        self.interrupt(command, " 56 ")
        rows = self.read_table()
        self.check_rows(rows)
        self.assertEqual({row["patches"] for row in rows}, {"14", "56"})

    def test_failures(self):
        bare = self.save("bare.vtp", make_surface([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]))
        room = self.save("room.vtp", make_room())
        with open(self.path("taken"), "w", encoding="utf-8"):
            pass
        self.check_failures((
            ((bare,), "report", 1, "error: There is no reflectance"),
            ((self.path("none.vtp"),), "report", 1, "none.vtp: no such file"),
            ((room,), "taken", 1, "taken: it is a file, not a folder"),
            ((room,), "taken/report", 1, "taken/report: Not a directory"),
            ((room, "--levels", "-1"), "report", 2, "--levels: -1 is out of range"),
            ((room, "--dense-tolerances", "1e-2,5"), "report", 2, "tolerances: 5 is out of"),
            ((room, "--dense-tolerances", "1e-2;5"), "report", 2, "'1e-2;5' is no list of"),
            ((room, "--solvers", "auto,magic"), "report", 2, "'magic' is none of auto, "),
            ((room, "--material", "marble"), "report", 2, "--material: goes with --scatter"),
            ((room, "--view", "1,2"), "report", 2, "'1,2' is not X,Y,Z")))


class TestArrays(unittest.TestCase):
    def test_divided_triangles(self):
        room = make_room()
        finer = divide_triangles(room)
        self.assertEqual(finer.GetNumberOfCells(), 4 * room.GetNumberOfCells())
        # Corners and edges; the two sides of the screen share theirs.
        self.assertEqual(finer.GetNumberOfPoints(), 12 + 12 + 5 + 5)
        vectors = numpy.repeat(get_area_vectors(room), 4, axis=0) / 4.0
        numpy.testing.assert_allclose(get_area_vectors(finer), vectors, atol=1e-15)
        for name in ("Emission", "Reflectance"):
            numpy.testing.assert_array_equal(
                get_cell_array(finer, name), numpy.repeat(get_cell_array(room, name), 4, axis=0))

    def test_area_vectors(self):
        # A square in a plane of normal (0, 0.6, 0.8), far away, and a triangle.
        square = numpy.array([(0, 0, 0), (2, 0, 0), (2, 1.6, -1.2), (0, 1.6, -1.2)]) + 1e6
        for points, expected in ((square, (0, 2.4, 3.2)),
                                 ([(0, 0, 0), (0, 3, 0), (0, 0, 5)], (7.5, 0, 0))):
            vectors = get_area_vectors(make_surface(points, [range(len(points))]))
            numpy.testing.assert_allclose(vectors, [expected], atol=1e-9)


if __name__ == "__main__":
    unittest.main()
