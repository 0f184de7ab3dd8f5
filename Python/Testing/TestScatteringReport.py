# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m vtklighttransport report --scatter: its table, its page, its pictures, its messages.

And how the errors of a reference are told from those of what is compared with it.
"""

import math
import unittest

import numpy

from vtklighttransport.arrays import set_cell_array
from vtklighttransport.report.scattering import Difference

from ReportTools import MEDIUM, ReportTestCase, make_cube
from TestingTools import make_box, make_surface

NUMBERS = ("tolerance", "patches", "seconds_all", "seconds_cpu", "error_stated")
ERRORS = ("error_l2", "error_l2_low", "error_l2_high", "error_worst_band", "error_reference",
          "ratio_total", "ratio_total_error")
MODELS = ["Dipole", "BetterDipole", "PhotonBeamDiffusion", "ChristensenBurley", "Tabulated"]


class TestScatteringReport(ReportTestCase):
    ARGUMENTS = ("--scatter", "--device", "cpu", *MEDIUM)
    COLUMNS = {"method", "links", "photons", "worst_band", "reference", "device",
               *NUMBERS, *ERRORS}

    def check_rows(self, rows):
        for row in rows:
            for name in NUMBERS:
                self.assertTrue(math.isfinite(float(row[name])), (name, row))
            self.assertEqual(bool(row["photons"]), row["method"] == "MonteCarlo")
            self.assertEqual(bool(row["links"]), row["method"] != "MonteCarlo")
        self.assertEqual((rows[0]["method"], rows[0]["reference"]),
                         ("MonteCarlo", "is the reference"))
        for row in rows[1:]:
            low, error, high = (float(row[name])
                                for name in ("error_l2_low", "error_l2", "error_l2_high"))
            self.assertLessEqual(low, error)
            self.assertLess(error, high)
            self.assertGreaterEqual(float(row["error_worst_band"]), error * (1.0 - 1e-5))

    def test_report(self):
        source = self.save("cube.vtp", make_cube(4))
        result = self.run_command(source, "--reference-error", "0.02", "--target-errors",
                                  "0.05,0.025", "--link-tolerances", "1e-1,1e-3")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_table()
        self.check_rows(rows)
        self.assertEqual(list(dict.fromkeys(row["method"] for row in rows)),
                         ["MonteCarlo", *MODELS])
        self.check_monte_carlo(rows[:3])
        self.check_models(rows[3:])
        text, pictures = self.read_page()
        for words in ("cube.vtp", "Custom: reduced scattering 0.9, 0.95, 0.98", "20 mm per unit",
                      "MonteCarlo 0.02", "error of chance", "CPU seconds"):
            self.assertIn(words, text)
        self.assertNotIn(self.folder, text)
        self.assertEqual(len(pictures), 2 + 1 + len(MODELS))
        self.check_pictures(pictures)

    def check_monte_carlo(self, rows):
        """Errors are what was asked for, whichever photons there are; the worst band counts."""
        _reference, coarse, fine = rows
        for row in (coarse, fine):
            self.assertLess(float(row["error_reference"]), 0.02)
            self.assertGreater(float(row["error_reference"]), 0.01)
            tolerance = float(row["tolerance"])
            self.assertLessEqual(float(row["error_stated"]), tolerance)
            self.assertLess(float(row["error_l2"]), 1.3 * tolerance)
            self.assertGreater(float(row["error_l2"]), 0.5 * tolerance)
            self.assertLess(abs(float(row["ratio_total"]) - 1.0),
                            4.0 * float(row["ratio_total_error"]))
        # Half the error takes four times as many; what few photons tell of it is rough.
        photons = int(fine["photons"]) / int(coarse["photons"])
        self.assertGreater(photons, 2.5)
        self.assertLess(photons, 6.0)
        self.assertLess(float(fine["ratio_total_error"]), float(coarse["ratio_total_error"]))

    def check_models(self, rows):
        best = {}
        for name in MODELS:
            coarse, fine = (row for row in rows if row["method"] == name)
            self.assertGreater(int(fine["links"]), int(coarse["links"]))
            self.assertLess(float(fine["error_stated"]), float(coarse["error_stated"]))
            self.assertLess(float(fine["error_stated"]), 2e-3)
            best[name] = fine
        # What a flat medium gives back for light from all directions is nearest by far; at this
        # index what is fitted to it comes next, and the dipole, which knows no single scattering,
        # last.
        self.assertLess(float(best["Tabulated"]["error_l2_high"]),
                        float(best["Dipole"]["error_l2_low"]) / 2.0)
        self.assertLess(float(best["Dipole"]["ratio_total"]), 0.9)
        # At edges light leaves that a flat medium would keep.
        self.assertLess(float(best["Tabulated"]["ratio_total"]), 1.0)
        self.assertGreater(float(best["Tabulated"]["ratio_total"]), 0.9)

    def test_sizes(self):
        """Each size has a reference of its own."""
        source = self.save("cube.vtp", make_cube(1))
        result = self.run_command(
            source, "--levels", "1", "--reference-error", "0.1", "--target-errors", "0.3",
            "--link-tolerances", "1e-2", "--models", "better-dipole,dipole")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = self.read_table()
        self.assertEqual([(row["method"], row["patches"]) for row in rows],
                         [(name, patches) for patches in ("6", "48")
                          for name in ("MonteCarlo", "MonteCarlo", "Dipole", "BetterDipole")])
        self.assertIn("Exponents k", self.read_page()[0])

    def test_dark(self):
        """There is nothing to plot."""
        cube = make_cube(1)
        set_cell_array(cube, "Irradiance", 0.0)
        result = self.run_command(self.save("dark.vtp", cube), "--models", "dipole")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual({row["error_l2"] for row in self.read_table()}, {"", "0"})
        self.assertIn("Nothing differs from the reference.", self.read_page()[0])

    def test_interrupted(self):
        source = self.save("cube.vtp", make_cube(4))
        self.interrupt(self.make_command(source, "--reference-error", "0.1", "--target-errors",
                                         "0.3,0.001", "--models", "dipole"), "MonteCarlo 0.1")
        rows = self.read_table()
        self.check_rows(rows)
        self.assertEqual([row["tolerance"] for row in rows], ["0.1", "0.3"])

    def test_failures(self):
        cube = self.save("cube.vtp", make_cube(1))
        bare = self.save("bare.vtp", make_surface(make_box((0, 0, 0), (1, 1, 1), outside=True)))
        hole = make_surface(make_box((0, 0, 0), (1, 1, 1), outside=True)[:-1])
        set_cell_array(hole, "Irradiance", 1.0)
        self.check_failures((
            ((bare,), "report", 1, "error: The input has no cell array \"Irradiance\""),
            ((self.save("hole.vtp", hole),), "report", 1, "error: The surface is open"),
            ((cube, "--dense-tolerances", "1e-2"), "report", 2,
             "--dense-tolerances: goes without --scatter"),
            ((cube, "--target-errors", "0.1,2"), "report", 2, "--target-errors: 2 is out of"),
            ((cube, "--link-tolerances", "0.5"), "report", 2, "--link-tolerances: 0.5 is out of"),
            ((cube, "--numbers-of-links", "16"), "report", 2,
             "--numbers-of-links: goes with --scatter-links"),
            ((cube, "--models", "dipole,magic"), "report", 2, "'magic' is none of ")))


class TestDifference(unittest.TestCase):
    """Of a reference with errors of chance: what is found is right on the mean, and the range
    holds the truth as often as it says."""

    TIMES = 400

    def measure(self, off, share):
        """Shares of ranges with the truth, and the mean square of errors over the true one. All
        bands of a patch are moved together by a `share` of their error."""
        chance = numpy.random.default_rng(1)
        areas = chance.uniform(0.5, 2.0, 300)
        exact = chance.uniform(0.1, 1.0, (300, 3))
        values = exact * (1.0 + off * chance.standard_normal((300, 3)))
        errors = 0.05 * numpy.sqrt(exact)
        truth = math.sqrt((areas @ (values - exact) ** 2).sum() / (areas @ exact ** 2).sum())
        held, excess = 0, []
        for _ in range(self.TIMES):
            noise = (math.sqrt(share) * chance.standard_normal((300, 1)) +
                     math.sqrt(1.0 - share) * chance.standard_normal((300, 3)))
            found = Difference(values, exact + errors * noise, errors, areas)
            low, high = found.find_range()
            held += low <= truth <= high
            excess.append(found.excess)
        return held / self.TIMES, numpy.mean(excess), truth ** 2

    def test_ranges(self):
        for off in (0.0, 0.02, 0.2):
            for share in (0.0, 1.0):
                held, excess, truth = self.measure(off, share)
                self.assertGreater(held, 0.9, (off, share))
                # The noise alone is 6e-3.
                self.assertLess(abs(excess - truth), 2e-4, (off, share))


if __name__ == "__main__":
    unittest.main()
