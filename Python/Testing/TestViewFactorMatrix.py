# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""View factors as a matrix: from meshes, in files, of other programs, judged and repaired."""

import importlib.util
import subprocess
import sys
import unittest
import warnings

import numpy

import vtklighttransport as lt
from vtklighttransport.filters import find_choices
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from TestingTools import FolderTestCase, add_array, make_box, make_surface

OPPOSITE = 0.19982489569838746
BESIDE = (1.0 - OPPOSITE) / 4.0
CUBE = numpy.full((6, 6), BESIDE)
for _axis in (0, 2, 4):
    CUBE[_axis:_axis + 2, _axis:_axis + 2] = [[0.0, OPPOSITE], [OPPOSITE, 0.0]]

HAS_SCIPY = importlib.util.find_spec("scipy") is not None
HAS_PANDAS = importlib.util.find_spec("pandas") is not None

VIEW3D = """View3D 3.3.2 0 1 0 3      \x20
1 2 1
0.000000 1.000000 0.000000
0.500000 0.000000 0.500000
0.000000 1.000000 0.000000
0.900 0.900 0.900
"""
FOAM_FACTORS = """/* a comment */
FoamFile
{
    version 2.0;
    format  ascii;
    class   scalarListList;
    object  F;
}
// * * //
3
(
1(1)
2{0.5}
1
(
1
)
)
"""
FOAM_FACES = """FoamFile { format ascii; class labelListList; object globalFaceFaces; }
3 ( 1(1) 2(0 2) 1{1} )
"""
THREE = [[0.0, 1.0, 0.0], [0.5, 0.0, 0.5], [0.0, 1.0, 0.0]]


def make_cube(size=1.0):
    return make_surface(make_box((0, 0, 0), (size, size, size)))


class TestViewFactorMatrix(FolderTestCase):
    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as stream:
            stream.write(text)
        return self.path(name)

    def check_equal(self, found, expected):
        numpy.testing.assert_array_equal(numpy.asarray(found), numpy.asarray(expected))
        for name in ("areas", "sky", "back_faces", "errors"):
            numpy.testing.assert_array_equal(getattr(found, name), getattr(expected, name))

    def test_cube(self):
        cube = add_array(make_cube(2.0), "Wall", [1, 1, 2, 2, 2, 2])
        matrix = lt.view_factors(cube, tolerance=1e-6, group="Wall")
        numpy.testing.assert_allclose(matrix, CUBE, atol=1e-7)
        numpy.testing.assert_allclose(matrix.areas, 4.0, rtol=1e-12)
        self.assertAlmostEqual(matrix[0, 1], OPPOSITE, delta=1e-7)
        numpy.testing.assert_allclose(matrix @ numpy.ones(6), 1.0, atol=1e-6)
        numpy.testing.assert_allclose(matrix.sky + matrix.back_faces, 0.0, atol=1e-6)
        self.assertEqual(matrix.groups["Group"], ["1", "2"])
        numpy.testing.assert_allclose(matrix.groups["Area"], [8.0, 16.0])
        self.assertEqual(matrix.summary["EnclosureVerdict"], "Closed")
        verdict = matrix.check()
        self.assertTrue(verdict.ok and verdict.closed, verdict)
        self.assertLess(verdict.reciprocity, 1e-15)
        self.assertFalse(matrix.is_sparse)

    def test_memory(self):
        """Rows go where the array's memory is, and nowhere else."""
        factors = lt.vtkViewFactors()
        rows, areas = vtkDoubleArray(), vtkDoubleArray()
        rows.SetNumberOfComponents(6)
        rows.SetNumberOfTuples(2)
        rows.Fill(7.0)
        self.assertFalse(factors.GetViewFactors(0, rows))
        factors.SetInputData(make_cube())
        factors.Update()
        for first in (-1, 5, 6, (1 << 63) - 1):
            self.assertFalse(factors.GetViewFactors(first, rows))
        self.assertEqual(rows.GetTuple(1), (7.0,) * 6)
        self.assertTrue(factors.GetViewFactors(4, rows))
        self.assertAlmostEqual(rows.GetComponent(0, 5), OPPOSITE, delta=1e-3)
        self.assertFalse(factors.GetPatchAreas(areas))
        areas.SetNumberOfTuples(6)
        self.assertTrue(factors.GetPatchAreas(areas))
        self.assertAlmostEqual(areas.GetRange()[1], 1.0, delta=1e-12)
        rows.SetNumberOfComponents(5)
        self.assertFalse(factors.GetViewFactors(0, rows))
        self.assertFalse(factors.GetViewFactors(0, None) or factors.GetPatchAreas(None))

    def test_kinds_of_scenes(self):
        """Blocks, backs, none at all, one patch, coordinates of maps."""
        faces = make_box((0, 0, 0), (1, 1, 1))
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, make_surface(faces[:2]))
        blocks.SetBlock(3, make_surface(faces[2:]))
        numpy.testing.assert_allclose(lt.view_factors(blocks, tolerance=1e-6), CUBE, atol=1e-7)
        far = make_surface([[(x + 6e5, y + 6e6, z) for x, y, z in face] for face in faces])
        numpy.testing.assert_allclose(lt.view_factors(far), CUBE, atol=1e-3)
        sheet = make_surface(faces[:1])
        self.assertEqual(numpy.asarray(lt.view_factors(sheet)).tolist(), [[0.0]])
        both = lt.view_factors(sheet, two_sided=True)
        self.assertEqual(len(both), 2)
        numpy.testing.assert_allclose(both.areas, 1.0)
        with self.assertRaisesRegex(lt.LightTransportError, "polygon"):
            lt.view_factors(make_surface([]))

    @unittest.skipUnless(HAS_SCIPY, "no scipy")
    def test_sparse(self):
        """Where most pairs see nothing of each other: rooms side by side."""
        rooms = [box for k in range(8) for box in make_box((2 * k, 0, 0), (2 * k + 1, 1, 1))]
        matrix = lt.view_factors(make_surface(rooms), tolerance=1e-6)
        self.assertTrue(matrix.is_sparse)
        self.assertEqual(matrix.factors.nnz, 8 * 30)
        numpy.testing.assert_allclose(matrix, numpy.kron(numpy.eye(8), CUBE), atol=1e-7)
        matrix.save(self.path("f.npz"))
        self.check_equal(lt.read_view_factors(self.path("f.npz")), matrix)
        import scipy.sparse
        theirs = scipy.sparse.load_npz(self.path("f.npz"))
        numpy.testing.assert_array_equal(theirs.toarray(), matrix)
        scipy.sparse.save_npz(self.path("theirs.npz"), theirs)
        again = lt.read_view_factors(self.path("theirs.npz"), areas=matrix.areas)
        self.assertTrue(again.check().ok)
        self.assertEqual(str(again.check()), str(lt.ViewFactorMatrix(
            matrix.factors.toarray(), matrix.areas).check()))
        matrix.factors.data[3] *= -1.0
        self.assertFalse(matrix.check().ok)
        self.assertTrue(matrix.repaired(closed=True).check().closed)

    def test_links(self):
        """Of every kind a matrix comes out, and its rows sum to 1."""
        room = make_surface(make_box((0, 0, 0), (1, 1, 1), count=6))
        exact = numpy.asarray(lt.view_factors(room, tolerance=1e-5))
        for kind in find_choices(lt.vtkViewFactors, "LINK_METHOD_"):
            matrix = lt.view_factors(room, link_method=kind)
            numpy.testing.assert_allclose(matrix.sums + matrix.sky + matrix.back_faces, 1.0,
                                          atol=1e-3)
            self.assertLess(abs(matrix.check().reciprocity), 1e-12)
            self.assertLess(abs(numpy.asarray(matrix) - exact).sum(axis=1).mean(), 0.2, kind)

    def test_files(self):
        matrix = lt.view_factors(make_surface(make_box((0, 0, 0), (1, 2, 3))[:5]))
        matrix.save(self.path("f.npz"))
        self.check_equal(lt.read_view_factors(self.path("f.npz")), matrix)
        matrix.to_csv(self.path("f.csv"))
        again = lt.read_view_factors(self.path("f.csv"))
        numpy.testing.assert_allclose(again, matrix, rtol=1e-8)
        numpy.testing.assert_allclose(again.sky, matrix.sky, rtol=1e-8)
        matrix.to_csv(self.path("pairs.csv"), pairs=True)
        with open(self.path("pairs.csv"), encoding="utf-8") as stream:
            lines = stream.read().splitlines()
        self.assertEqual((lines[0], len(lines)), ("From,To,ViewFactor", 21))
        numpy.save(self.path("f.npy"), CUBE)
        read = lt.read_view_factors(self.path("f.npy"), areas=make_cube())
        numpy.testing.assert_allclose(read.areas, 1.0)
        self.assertTrue(read.check().ok)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(2, make_cube())
        read = lt.read_view_factors(self.path("f.npy"), areas=blocks)
        numpy.testing.assert_allclose(read.areas, 1.0)
        writer = vtkXMLPolyDataWriter()
        writer.SetInputData(make_cube())
        writer.SetDataModeToBinary()
        writer.SetFileName(self.path("cube.vtp"))
        writer.Write()
        read = lt.read_view_factors(self.path("f.npy"), areas=self.path("cube.vtp"))
        numpy.testing.assert_allclose(read.areas, 1.0)

    def test_other_programs(self):
        matrix = lt.read_view_factors(self.write("view3d.out", VIEW3D))
        self.assertEqual(numpy.asarray(matrix).tolist(), THREE)
        self.assertEqual(matrix.areas.tolist(), [1.0, 2.0, 1.0])
        self.assertTrue(matrix.check().closed)
        self.write("globalFaceFaces", FOAM_FACES)
        matrix = lt.read_view_factors(self.write("F", FOAM_FACTORS))
        self.assertEqual(numpy.asarray(matrix).tolist(), THREE)
        self.assertIn("give the areas", str(matrix.check()))
        with self.assertRaisesRegex(ValueError, "needs the areas"):
            matrix.repaired()

    def test_what_cannot_be_read(self):
        self.write("globalFaceFaces", FOAM_FACES)
        for name, text, message in (
                ("cut.out", VIEW3D[:60], "cut short"),
                ("binary.out", VIEW3D.replace("3.3.2 0", "3.3.2 1"), "is binary"),
                ("emit.out", VIEW3D.replace("0 1 0 3", "0 1 1 3"), "emittances"),
                ("word.out", VIEW3D.replace("0.5", "half"), "is damaged"),
                ("F1", FOAM_FACTORS[:-8], "cut short"),
                ("F2", FOAM_FACTORS.replace("2{0.5}", "1{0.5}"), "differ in length"),
                ("F3", FOAM_FACTORS.replace("1(1)", "2(1)"), "says 2"),
                ("F4", FOAM_FACTORS.replace("ascii", "binary"), "is binary"),
                ("row.csv", "1,2\n3\n", "none of the forms"),
                ("wide.csv", "1,2,3\n3,4,5\n", "square"),
                ("text.csv", "hello\n", "none of the forms"),
                ("damaged.npz", "PK hello", "is damaged")):
            with self.subTest(name), self.assertRaisesRegex(ValueError, message):
                lt.read_view_factors(self.write(name, text))
        with self.assertRaisesRegex(FileNotFoundError, "globalFaceFaces"):
            lt.read_view_factors(self.path("F1"), faces=self.path("nowhere"))
        numpy.save(self.path("objects.npy"), numpy.array([[None]]), allow_pickle=True)
        with self.assertRaisesRegex(ValueError, "objects"):
            lt.read_view_factors(self.path("objects.npy"))

    def test_verdict(self):
        areas = numpy.ones(6)
        for change, number in (((0, 1, -0.1), "negative"), ((0, 1, numpy.nan), "not_finite"),
                               ((2, 3, 0.4), "row_excess"), ((0, 1, 0.0), "reciprocity")):
            factors = CUBE.copy()
            factors[change[:2]] = change[2]
            verdict = lt.ViewFactorMatrix(factors, areas).check()
            self.assertFalse(verdict.ok, number)
            self.assertGreater(getattr(verdict, number), 0.1)
            self.assertIn("WRONG", str(verdict))
        verdict = lt.ViewFactorMatrix(0.5 * CUBE, areas).check()
        self.assertTrue(verdict.ok and not verdict.closed)
        self.assertIn("openings", str(verdict))
        for wrong in ((CUBE[:2], None), (CUBE, [1.0]), (CUBE, -areas)):
            with self.assertRaises(ValueError):
                lt.ViewFactorMatrix(*wrong)

    def test_repair(self):
        """Noise of a Monte Carlo program goes away, and what is right stays."""
        areas = numpy.array([1.0, 1.0, 4.0, 4.0, 2.0, 2.0])
        matrix = lt.view_factors(make_surface(make_box((0, 0, 0), (4, 2, 1))), tolerance=1e-7)
        noise = numpy.random.default_rng(1).uniform(0.9, 1.1, (6, 6))
        noisy = lt.ViewFactorMatrix(numpy.asarray(matrix) * noise, matrix.areas)
        self.assertFalse(noisy.check().ok)
        mended = noisy.repaired(closed=True)
        verdict = mended.check(1e-10)
        self.assertTrue(verdict.ok and verdict.closed, verdict)
        self.assertLess(abs(numpy.asarray(mended) - matrix).max(),
                        abs(numpy.asarray(noisy) - matrix).max())
        self.assertTrue(noisy.repaired().check(1e-10).ok)
        right = lt.ViewFactorMatrix(0.5 * CUBE, areas / areas)
        numpy.testing.assert_allclose(right.repaired(), 0.5 * CUBE, rtol=1e-15)
        with self.assertRaisesRegex(ValueError, "finite"):
            lt.ViewFactorMatrix(CUBE * numpy.nan, areas).repaired()

    def test_group_table(self):
        matrix = lt.view_factors(make_cube())
        if not HAS_PANDAS:
            with self.assertRaisesRegex(ImportError, "python3-pandas"):
                matrix.group_table()
            return
        self.assertAlmostEqual(matrix.group_table().loc["All", "All"], 1.0, delta=1e-3)

    def test_properties(self):
        for wrong, kind, message in (({"tolranc": 1e-3}, TypeError, "did you mean 'tolerance'"),
                                     ({"tolerance": 5.0}, ValueError, "nearest value is 0.1"),
                                     ({"cluster_tree": "magic"}, ValueError, "spatial"),
                                     ({"group": "Wall"}, ValueError, "no cell array 'Wall'")):
            with self.subTest(wrong), self.assertRaisesRegex(kind, message):
                lt.view_factors(make_cube(), **wrong)
        with self.assertRaisesRegex(TypeError, "name of a file"):
            lt.view_factors(7)
        with self.assertRaisesRegex(FileNotFoundError, "no such file"):
            lt.view_factors(self.path("none.stl"))
        with self.assertRaisesRegex(ValueError, "is none of"):
            lt.view_factors("part.xyzw")

    def test_warnings(self):
        inside_out = make_surface(make_box((0, 0, 0), (1, 1, 1), outside=True)
                                  + make_box((-1, -1, -1), (2, 2, 2), outside=True))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            lt.view_factors(inside_out)
        self.assertTrue(any("back" in str(warning.message) for warning in caught))
        self.assertTrue(all(warning.filename == __file__ for warning in caught))

    def test_nothing_is_loaded_unasked(self):
        """Beyond what VTK's own modules load: those of 9.6 take numpy where it is there."""
        script = ("import sys, vtkmodules.vtkRenderingCore; before = set(sys.modules); "
                  "import vtklighttransport; "
                  "print({'numpy', 'scipy', 'pandas', 'pyvista'} & set(sys.modules) - before)")
        result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.stdout, result.stderr), ("set()\n", ""))


if __name__ == "__main__":
    unittest.main()
