# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m vtklighttransport report --scatter-links: its table, its page, its messages."""

import unittest

from ReportTools import MEDIUM, ReportTestCase, make_cube


class TestLinksReport(ReportTestCase):
    ARGUMENTS = ("--scatter-links", "--device", "cpu", *MEDIUM)
    COLUMNS = {"method", "tolerance", "patches", "seconds_all", "seconds_cpu", "seconds_links",
               "seconds_apply", "links", "links_per_receiver", "bytes", "error_l2", "error_max",
               "error_stated", "error_compression", "reference", "device"}
    METHODS = {"AllPairs": ("1e-1", "1e-2"), "Uniform": ("4", "32"),
               "UniformCompressed": ("4", "32"), "Adaptive": ("1e-1", "1e-2"),
               "AdaptiveCompressed": ("1e-1", "1e-2"), "AdaptiveForLight": ("1e-1", "1e-2")}

    def test_report(self):
        source = self.save("cube.vtp", make_cube(6))
        result = self.run_command(source, "--link-tolerances", "1e-2,1e-1", "--numbers-of-links",
                                  "32,4", "--model", "better-dipole")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_table()
        self.assertEqual((rows[0]["method"], rows[0]["tolerance"], rows[0]["reference"]),
                         ("AllPairs", "0.0001", "is the reference"))
        found = [(row["method"], float(row["tolerance"])) for row in rows[1:]]
        self.assertEqual(found, [(name, float(value)) for name, values in self.METHODS.items()
                                 for value in values])
        for coarse, fine in zip(rows[1::2], rows[2::2]):
            self.check_pair(coarse, fine)
        text, pictures = self.read_page()
        for words in ("cube.vtp", "20 mm per unit", "AllPairs 0.0001", "code book", "CPU seconds"):
            self.assertIn(words, text)
        self.assertEqual(len(pictures), 2 + len(self.METHODS))
        self.check_pictures(pictures)

    def check_pair(self, coarse, fine):
        """More links, less error, and what is stated holds."""
        self.assertGreater(int(fine["links"]), int(coarse["links"]))
        self.assertGreater(float(coarse["error_l2"]), 1.5 * float(fine["error_l2"]), coarse)
        for row in (coarse, fine):
            coded = row["error_compression"]
            self.assertEqual(bool(coded), "Compressed" in row["method"])
            self.assertLess(float(row["error_l2"]),
                            1.1 * float(row["error_stated"]) + float(coded or 0.0))

    def test_failures(self):
        cube = self.save("cube.vtp", make_cube(1))
        self.check_failures((
            ((cube, "--target-errors", "0.1"), "report", 2,
             "--target-errors: goes with --scatter\n"),
            ((cube, "--model", "monte-carlo"), "report", 2, "follows photons, not links"),
            ((cube, "--numbers-of-links", "16,0"), "report", 2, "--numbers-of-links: 0 is out of"),
            ((cube, "--numbers-of-links", "16,x"), "report", 2, "is no list of whole numbers"),
            ((cube, "--solvers", "jacobi"), "report", 2,
             "--solvers: goes without --scatter-links")))


if __name__ == "__main__":
    unittest.main()
