# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""vtkViewFactors from Python: single factors, groups, closure, files, and what errors say."""

import os
import resource
import stat
import unittest

import vtklighttransport as lt
from vtklighttransport.summaries import get_summary
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet, vtkPolyData

from TestingTools import FolderTestCase, add_array, make_box, make_surface

# Opposite and neighboring faces of a cube.
OPPOSITE = 0.19982489569838746
BESIDE = (1.0 - OPPOSITE) / 4.0
# Single precision entries.
SINGLE = 1e-7


def make_cube(size=1.0):
    return make_surface(make_box((0, 0, 0), (size, size, size)))


def make_room():
    """A cube seen from inside, with a block in it that hides much."""
    return make_surface(make_box((0, 0, 0), (1, 1, 1), count=3) +
                        make_box((0.3, 0.3, 0.2), (0.6, 0.7, 0.5), outside=True, count=2))


def get_values(surface, name):
    array = surface.GetCellData().GetArray(name)
    return [array.GetValue(i) for i in range(array.GetNumberOfTuples())]


def get_table(factors):
    """The table of groups as a dictionary of its columns."""
    table = factors.GetGroupTable()
    return {table.GetColumnName(k): [table.GetColumn(k).GetValue(row)
                                     for row in range(table.GetNumberOfRows())]
            for k in range(table.GetNumberOfColumns())}


def get_matrix(factors):
    count = factors.GetOutputDataObject(0).GetNumberOfCells()
    return [[factors.GetViewFactor(i, j) for j in range(count)] for i in range(count)]


class TestViewFactors(FolderTestCase):
    def setUp(self):
        super().setUp()
        self.errors = []

    @calldata_type(VTK_STRING)
    def on_error(self, _caller, _event, text):
        self.errors.append(text)

    def make_factors(self, data=None, tolerance=1e-6):
        factors = lt.vtkViewFactors()
        factors.SetTolerance(tolerance)
        factors.AddObserver("ErrorEvent", self.on_error)
        # It only says that the filter has failed.
        factors.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        if data is not None:
            factors.SetInputDataObject(data)
            factors.Update()
        return factors

    def take_error(self, *parts):
        """There was one error, and it names all these: a problem and what to do about it."""
        self.assertEqual(len(self.errors), 1, self.errors)
        text = self.errors.pop()
        for part in parts:
            self.assertIn(part, text)

    def check_close(self, found, expected, tolerance=SINGLE):
        self.assertEqual(len(found), len(expected))
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=tolerance)

    def test_factors(self):
        factors = self.make_factors(make_cube())
        self.assertEqual(self.errors, [])
        for i in range(6):
            self.check_close([factors.GetViewFactor(i, j) for j in range(6)],
                             [0.0 if i == j else OPPOSITE if i // 2 == j // 2 else BESIDE
                              for j in range(6)])
        self.assertEqual([factors.GetViewFactor(*pair) for pair in ((-1, 0), (0, 6))], [0.0, 0.0])
        result = factors.GetOutputDataObject(0)
        self.check_close(get_values(result, "ViewFactorSum"), [1.0] * 6, 1e-6)
        self.assertEqual(get_summary(result, "PairsExamined"), 15.0)
        self.assertEqual(get_summary(result, "RaysCast"), 0.0)

    def test_groups_by_array(self):
        cube = add_array(make_cube(2.0), "Group", [7, 7, -2, -2, -2, -2])
        table = get_table(self.make_factors(cube))
        self.assertEqual(list(table), ["Group", "Area", "-2", "7", "Sky", "BackFace"])
        self.assertEqual(table["Group"], ["-2", "7"])
        self.check_close(table["Area"], [16.0, 8.0], 1e-12)
        self.check_close(table["-2"], [OPPOSITE + 2 * BESIDE, 4 * BESIDE], 1e-6)
        self.check_close(table["7"], [2 * BESIDE, OPPOSITE], 1e-6)
        self.check_close(table["Sky"] + table["BackFace"], [0.0] * 4, 1e-6)

    def test_groups_by_another_array(self):
        cube = add_array(make_cube(), "Wall", [1, 1, 2, 2, 3, 3])
        factors = self.make_factors(cube)
        self.assertEqual(get_table(factors)["Group"], ["All"])
        self.check_close(get_table(factors)["All"], [1.0], 1e-6)
        factors.SetInputArrayToProcess(0, 0, 0, 1, "Wall")
        factors.Update()
        table = get_table(factors)
        self.assertEqual(table["Group"], ["1", "2", "3"])
        self.check_close(table["1"], [OPPOSITE, 2 * BESIDE, 2 * BESIDE], 1e-6)
        self.assertEqual(self.errors, [])

    def test_groups_by_blocks(self):
        faces = make_box((0, 0, 0), (1, 1, 1))
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_surface(faces[:2]))
        blocks.SetBlock(1, make_surface(faces[2:]))
        blocks.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), "ends")
        table = get_table(self.make_factors(blocks))
        self.assertEqual(table["Group"], ["ends", "Block 1"])
        self.check_close(table["ends"], [OPPOSITE, 2 * BESIDE], 1e-6)
        self.check_close(table["Block 1"], [4 * BESIDE, OPPOSITE + 2 * BESIDE], 1e-6)

    def test_sky(self):
        faces = make_box((0, 0, 0), (1, 1, 1))[:2]
        table = get_table(self.make_factors(add_array(make_surface(faces), "Group", [1, 2])))
        self.check_close(table["2"], [OPPOSITE, 0.0])
        self.check_close(table["Sky"], [1.0 - OPPOSITE] * 2)
        self.check_close(table["BackFace"], [0.0] * 2)

    def test_closure(self):
        tolerance = 1e-3
        room = make_room()
        raw = self.make_factors(room, tolerance)
        closed = self.make_factors(tolerance=tolerance)
        closed.EnforceClosureOn()
        closed.SetInputData(room)
        closed.Update()
        self.assertEqual(self.errors, [])
        sums = get_values(raw.GetOutputDataObject(0), "ViewFactorSum")
        result = closed.GetOutputDataObject(0)
        self.assertEqual(get_values(result, "ViewFactorSum"), sums)
        errors = get_values(result, "ViewFactorError")
        self.assertTrue(all(abs(total - 1.0) <= error for total, error in zip(sums, errors)))
        self.assertGreater(max(abs(total - 1.0) for total in sums), 1e-5)
        matrix = get_matrix(closed)
        self.check_close([sum(row) for row in matrix], [1.0] * len(matrix), 1e-6)
        # The diagonal holds what single precision has rounded away.
        self.assertGreaterEqual(min(map(min, matrix)), -1e-7)
        # Faces of the room and of the block differ in area.
        areas = [1 / 9] * 54 + [0.3 * size / 4 for size in (0.4,) * 8 + (0.3,) * 8 + (0.4,) * 8]
        for i, row in enumerate(matrix):
            for j in range(i):
                self.assertAlmostEqual(areas[i] * row[j], areas[j] * matrix[j][i], delta=1e-15)
        self.assertGreater(get_summary(result, "ClosureChange"), 0.0)
        self.assertLess(get_summary(result, "ClosureGap"), 1e-6)

    def test_save_and_load(self):
        room = add_array(make_room(), "Group", [0] * 54 + [1] * 24)
        first = self.make_factors(room, 1e-3)
        self.assertTrue(first.Save(self.path("room.factors")))
        self.assertEqual(os.listdir(self.folder), ["room.factors"])
        second = self.make_factors()
        self.assertTrue(second.Load(self.path("room.factors")))
        second.SetInputData(room)
        second.Update()
        self.assertEqual(self.errors, [])
        self.assertEqual(get_matrix(second), get_matrix(first))
        self.assertEqual(get_table(second), get_table(first))
        results = [factors.GetOutputDataObject(0) for factors in (first, second)]
        for name in ("ViewFactorSum", "ViewFactorError", "SkyFraction", "BackFaceFraction"):
            self.assertEqual(*(get_values(result, name) for result in results))
        for name in ("PairsPartlyVisible", "MatrixBytes", "ViewFactorSeconds"):
            self.assertEqual(*(get_summary(result, name) for result in results))

    def test_loaded_factors_in_radiosity(self):
        room = add_array(make_room(), "Emission", [1.0] * 9 + [0.0] * 69)
        add_array(room, "Reflectance", [0.5] * 78)
        self.assertTrue(self.make_factors(room, 1e-3).Save(self.path("room.factors")))
        loaded = self.make_factors()
        self.assertTrue(loaded.Load(self.path("room.factors")))
        values = []
        for factors in (None, loaded):
            radiosity = lt.vtkRadiosity()
            radiosity.SetViewFactors(factors)
            radiosity.SetViewFactorTolerance(1e-3)
            radiosity.SetTolerance(1e-9)
            radiosity.SetDeviceToCPU()
            radiosity.SetInputData(room)
            radiosity.Update()
            values.append(get_values(radiosity.GetOutputDataObject(0), "Radiosity"))
        self.assertGreater(min(values[0]), 0.0)
        self.check_close(*values, 2e-3)

    def test_loaded_factors_of_another_method(self):
        self.assertTrue(self.make_factors(make_cube()).Save(self.path("cube.factors")))
        factors = self.make_factors()
        factors.SetLinkMethodToSampled()
        self.assertTrue(factors.Load(self.path("cube.factors")))
        radiosity = lt.vtkRadiosity()
        radiosity.SetViewFactors(factors)
        radiosity.SetLinkMethodToSampled()
        radiosity.SetInputData(make_cube())
        radiosity.AddObserver("ErrorEvent", self.on_error)
        radiosity.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        radiosity.Update()
        self.take_error("LinkMethod", "to Auto", "Load(nullptr)", "cube.factors\" are Dense")

    def test_another_geometry(self):
        self.assertTrue(self.make_factors(make_cube()).Save(self.path("cube.factors")))
        factors = self.make_factors(tolerance=1e-3)
        self.assertTrue(factors.Load(self.path("cube.factors")))
        factors.SetInputData(make_room())
        factors.Update()
        self.take_error("cube.factors", "another geometry", "give the mesh", "compute them")
        self.assertIsNone(
            factors.GetOutputDataObject(0).GetCellData().GetArray("ViewFactorSum"))
        self.assertTrue(factors.Load(None))
        factors.Update()
        self.assertEqual(self.errors, [])
        self.check_close(get_values(factors.GetOutputDataObject(0), "ViewFactorSum"), [1.0] * 78,
                         1e-3)

    def test_errors_of_save(self):
        factors = self.make_factors()
        self.assertFalse(factors.Save(self.path("none.factors")))
        self.take_error("no view factors to save", "call Update first")
        factors = self.make_factors(make_cube())
        self.assertFalse(factors.Save(""))
        self.take_error("name of the file", "is empty")
        self.assertFalse(factors.Save(self.path("no/such/cube.factors")))
        self.take_error("cube.factors", "cannot be written", "folder must exist")
        self.assertEqual(os.listdir(self.folder), [])

    def test_save_replaces_files_alone(self):
        factors = self.make_factors(make_cube())
        file = self.path("cube.factors")
        self.assertTrue(factors.Save(file))
        os.chmod(file, 0o640)
        os.symlink("cube.factors", self.path("link"))
        self.assertTrue(factors.Save(self.path("link")))
        self.assertTrue(os.path.islink(self.path("link")))
        self.assertEqual(os.stat(file).st_mode & 0o777, 0o640)
        os.link(file, self.path("twin"))
        self.assertFalse(factors.Save(file))
        self.take_error("cannot be written", "hard links")
        os.mkfifo(self.path("pipe"))
        for name in (self.path("pipe"), self.folder, "/dev/null"):
            self.assertFalse(factors.Save(name))
            self.take_error("cannot be written", "folder or device")
        self.assertTrue(stat.S_ISFIFO(os.lstat(self.path("pipe")).st_mode))
        self.assertEqual(sorted(os.listdir(self.folder)), ["cube.factors", "link", "pipe", "twin"])

    def test_save_on_a_full_disk(self):
        factors = self.make_factors(make_cube())
        file = self.path("cube.factors")
        self.assertTrue(factors.Save(file))
        with open(file, "rb") as stream:
            before = stream.read()
        # Python ignores the signal: a write beyond the limit fails as on a full disk.
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        for room in (0, 100, len(before) - 1):
            resource.setrlimit(resource.RLIMIT_FSIZE, (room, limits[1]))
            try:
                saved = factors.Save(file)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, limits)
            self.assertFalse(saved)
            self.take_error("cannot be written", "make room")
        with open(file, "rb") as stream:
            self.assertEqual(stream.read(), before)
        self.assertEqual(os.listdir(self.folder), ["cube.factors"])

    def test_errors_of_load(self):
        factors = self.make_factors(make_cube())
        self.assertTrue(factors.Save(self.path("good.factors")))
        with open(self.path("good.factors"), "rb") as stream:
            good = stream.read()
        middle = len(good) // 2
        flipped = good[:middle] + bytes((good[middle] ^ 16,)) + good[middle + 1:]
        for content, parts in (
                (None, ("no such file", "Check the name")),
                (b"something else entirely, but not shorter than a line",
                 ("not a file of view factors", "Check the name")),
                (good[:-100], ("cut short", "Compute the view factors again", "another copy")),
                (good + b"x", ("behind its end", "Compute the view factors again")),
                (flipped, ("Compute the view factors again", "another copy")),
                (good.replace(b"factors 3", b"factors 9"), ("not version 3", "Compute"))):
            if content is not None:
                with open(self.path("bad.factors"), "wb") as stream:
                    stream.write(content)
            self.assertFalse(factors.Load(self.path("bad.factors")))
            self.take_error("bad.factors", *parts)
        # Nobody writes to the pipe: whoever opens it waits for ever.
        os.mkfifo(self.path("pipe"))
        for name in (self.path("pipe"), self.folder):
            self.assertFalse(factors.Load(name))
            self.take_error("no such file", "Check the name")
        # What it had is still there.
        factors.Update()
        self.check_close([factors.GetViewFactor(0, 1)], [OPPOSITE])

    def test_errors_of_groups(self):
        for components, value in ((1, 0.5), (2, 1.0)):
            cube = add_array(make_cube(), "Group", [value] * 6, components)
            factors = self.make_factors(cube)
            self.take_error('"Group"', "one component", "integer")
            self.assertEqual(factors.GetGroupTable().GetNumberOfRows(), 0)
        cube = add_array(make_cube(), "Group", [1, 2, 3, 4, 5, float("nan")])
        self.make_factors(cube)
        self.take_error('"Group"', "finite")

    def test_errors_of_the_input(self):
        self.make_factors(vtkPolyData())
        self.take_error("no polygons")
        broken = make_box((0, 0, 0), (1, 1, 1))
        broken[3][0][1] = float("nan")
        self.make_factors(make_surface(broken))
        self.take_error("finite")


if __name__ == "__main__":
    unittest.main()
