# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whole jobs as functions, and as `light_transport` of PyVista's meshes."""

import importlib.util
import math
import os
import pathlib
import subprocess
import sys
import threading
import unittest
import warnings

import vtklighttransport as lt
from vtklighttransport import _build, _vtk
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkRenderingCore import vtkLight

from TestingTools import add_array, get_tuples, make_box, make_surface

HAS_NUMPY = importlib.util.find_spec("numpy") is not None
HAS_PYVISTA = importlib.util.find_spec("pyvista") is not None
SOURCE = pathlib.Path(os.environ["LIGHT_TRANSPORT_SOURCE"])
STEFAN_BOLTZMANN = 5.670374419e-8


def make_cube(outside=False):
    return make_surface(make_box((0, 0, 0), (1, 1, 1), outside=outside))


def get_values(surface, name):
    return [row[0] for row in get_tuples(surface.GetCellData().GetArray(name))]


class TestJobs(unittest.TestCase):
    def test_radiosity(self):
        cube = make_cube()
        result = lt.radiosity(cube, emission=[1, 0, 0, 0, 0, 0], reflectance=0.5, solver="jacobi",
                              device="cpu", tolerance=1e-9, view_factor_tolerance=1e-6)
        self.assertAlmostEqual(sum(get_values(result, "Radiosity")), 2.0, delta=1e-5)
        self.assertEqual(result.GetFieldData().GetAbstractArray("SolverUsed").GetValue(0), "Jacobi")
        self.assertEqual(cube.GetCellData().GetNumberOfArrays(), 0)

    def test_kinds_of_values(self):
        """Bands, names of arrays, regions, blocks."""
        result = lt.radiosity(make_cube(), emission=(1.0, 2.0, 3.0), reflectance=0.5)
        for band, value in enumerate(get_tuples(result.GetCellData().GetArray("Radiosity"))[0]):
            self.assertAlmostEqual(value, 2.0 * (band + 1), delta=1e-2)
        named = add_array(make_cube(), "Glow", [1.0] * 6)
        self.assertAlmostEqual(
            get_values(lt.radiosity(named, emission="Glow", reflectance=0), "Radiosity")[0], 1.0)
        blocks = vtkMultiBlockDataSet()
        faces = make_box((0, 0, 0), (1, 1, 1))
        for k, (name, polygons) in enumerate((("floor", faces[4:5]), ("rest", faces[:4]),
                                              ("top", faces[5:]))):
            blocks.SetBlock(k, make_surface(polygons))
            blocks.GetMetaData(k).Set(blocks.NAME(), name)
        result = lt.radiosity(blocks, temperature={"floor": 600, "": 300}, emissivity=1.0)
        expected = STEFAN_BOLTZMANN * (600.0 ** 4 - 300.0 ** 4)
        self.assertAlmostEqual(get_values(result, "NetFlux")[0] / expected, 1.0, delta=1e-3)

    def test_lists(self):
        """Properties that are added one by one."""
        body = make_cube(outside=True)
        sky = STEFAN_BOLTZMANN * 250.0 ** 4
        # That a body is seen from outside is what they are about.
        warnings.simplefilter("ignore", lt.LightTransportWarning)
        self.addCleanup(warnings.resetwarnings)
        result = lt.radiosity(body, temperature=350, emissivity=0.6,
                              background_radiance=sky / math.pi)
        expected = 0.6 * (STEFAN_BOLTZMANN * 350.0 ** 4 - sky)
        self.assertAlmostEqual(get_values(result, "NetFlux")[0], expected, delta=1e-9)
        result = lt.radiosity(body, temperature=350, emissivity=0.6, band_limits=[0, 8, math.inf],
                              background_radiance=[2 * sky / math.pi, sky / math.pi])
        self.assertAlmostEqual(get_values(result, "TotalNetFlux")[0], expected - 1.2 * sky,
                               delta=1e-9)

    def test_two_sided(self):
        sheet = make_surface([[(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]])
        result = lt.radiosity(sheet, emission=1, emission_back=3, reflectance=0.5, two_sided=True)
        self.assertEqual(get_values(result, "Radiosity"), [1.0])
        self.assertEqual(get_values(result, "RadiosityBack"), [3.0])

    def test_light_and_scattering(self):
        cube = make_cube(outside=True)
        lit = lt.irradiance(cube, lights=[(0, 0, 1, 2.0)])
        self.assertAlmostEqual(max(get_values(lit, "DirectIrradiance")), 2.0)
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(0, 0, 1)
        by_light = lt.scatter(cube, lights=[light], material="marble", millimeters_per_unit=10)
        by_value = lt.scatter(cube, irradiance=1.0, material="skimmilk", millimeters_per_unit=10)
        for result in (by_light, by_value):
            values = get_values(result, "ScatteredIrradiance")
            self.assertTrue(0.0 < max(values) < 1.0, values)
        room = lt.radiosity(make_cube(), reflectance=0.5, lights=[(0.1, 0.2, 1)], shadows=False)
        self.assertGreater(min(get_values(room, "Radiosity")), 0.0)

    @unittest.skipUnless(hasattr(lt, "vtkPatchMesher"), "no mesher in this build")
    def test_patches_and_atlas(self):
        patches = lt.patches(make_cube(outside=True), 600)
        self.assertLess(abs(patches.GetNumberOfCells() - 600), 31)
        unfolded = lt.atlas(patches, resolution=64)
        self.assertTrue(unfolded.GetPointData().HasArray("AtlasCoordinates"))

    def test_what_is_refused(self):
        cube = make_cube()
        for keywords, kind, message in (
                ({"emissn": 1}, TypeError, "did you mean 'emission'"),
                ({"emission": 1, "reflectance": 1.5}, lt.LightTransportError, "from 0 to 1"),
                ({"emission": float("nan"), "reflectance": 0}, lt.LightTransportError, "finite"),
                ({"emission": "Glow", "reflectance": 0}, lt.LightTransportError, "Glow"),
                ({"emission": {"floor": 1}, "reflectance": 0}, ValueError, "no regions"),
                ({"emission": object(), "reflectance": 0}, TypeError, ""),
                ({"emission": ["bright"], "reflectance": 0}, ValueError, "a number"),
                ({"emission": {}, "reflectance": 0}, ValueError, "is empty"),
                ({"lights": (1, 1, 1), "reflectance": 0}, ValueError, "lights is a list"),
                ({"lights": [(1, 1)], "reflectance": 0}, ValueError, "lights is a list"),
                ({"emission": 1, "reflectance": 0, "solver": "magic"}, ValueError, "jacobi")):
            with self.subTest(keywords), self.assertRaisesRegex(kind, message):
                lt.radiosity(cube, **keywords)

    @unittest.skipUnless(HAS_NUMPY, "no numpy")
    def test_values_of_points(self):
        import numpy
        with self.assertRaisesRegex(ValueError, "point_data_to_cell_data"):
            lt.radiosity(make_cube(), emission=numpy.ones(24), reflectance=0.5)

    def test_units(self):
        """Celsius where kelvin is meant."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            lt.radiosity(make_cube(), temperature=20, emissivity=0.9)
        self.assertTrue(any("273.15" in str(warning.message) for warning in caught))

    def test_in_a_thread(self):
        """Where Python takes no signals."""
        results = []
        thread = threading.Thread(target=lambda: results.append(
            lt.radiosity(make_cube(), emission=1, reflectance=0.5)))
        thread.start()
        thread.join()
        self.assertEqual(len(results), 1)

    def test_interrupted(self):
        """Ctrl-C in an interactive session ends the filter, not the session."""
        script = """if True:
            import os, signal, threading
            import vtklighttransport as lt
            from TestingTools import make_box, make_surface
            box = make_surface(make_box((0, 0, 0), (1, 1, 1), count=40)
                               + make_box((.3, .3, .3), (.6, .6, .6), outside=True, count=20))
            threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
            try:
                lt.radiosity(box, emission=1, reflectance=0.5, link_method="dense",
                             view_factor_tolerance=1e-8)
            except KeyboardInterrupt:
                print("stopped")
            print(lt.radiosity(make_surface(make_box((0, 0, 0), (1, 1, 1))), emission=1,
                               reflectance=0).GetNumberOfCells())
            """
        result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                                timeout=100, check=False)
        self.assertEqual(result.stdout, "stopped\n6\n", result.stderr)

    def test_another_vtk(self):
        place = "/elsewhere/vtkmodules/vtkCommonCore.so"
        here = os.path.realpath(_build.VTK_LIBRARY)
        _vtk.refuse_another(_build.VTK_VERSION, {here}, place)
        _vtk.refuse_another(_build.VTK_VERSION, set(), place)
        for version, libraries in (("8.2.0", {here}), (_build.VTK_VERSION, {"/elsewhere/lib.so"})):
            with self.assertRaisesRegex(ImportError, "elsewhere.*pip uninstall vtk") as caught:
                _vtk.refuse_another(version, libraries, place)
            self.assertIn(_build.VTK_LIBRARY, str(caught.exception))


STAND_IN = """
import sys, types
pyvista = types.ModuleType("pyvista")
registered = {}
def register_dataset_accessor(name, target):
    def decorate(kind):
        registered[name, target] = kind
        return kind
    return decorate
pyvista.DataObject = object
pyvista.register_dataset_accessor = register_dataset_accessor
pyvista.wrap = lambda data: ("wrapped", data)
sys.modules["pyvista"] = pyvista
"""


@unittest.skipUnless(HAS_NUMPY, "no numpy")
class TestMetadata(unittest.TestCase):
    def test_entry_point(self):
        """What PyVista looks for, and what it loads then; a stand-in has all that this uses."""
        script = STAND_IN + """if True:
            from importlib import import_module
            from importlib.metadata import entry_points
            import vtklighttransport as lt
            from TestingTools import make_box, make_surface
            point, = entry_points(group="pyvista.accessors", name="light_transport")
            import_module(point.value)
            accessor = registered["light_transport", object](
                make_surface(make_box((0, 0, 0), (1, 1, 1))))
            kind, result = accessor.radiosity(emission=1, reflectance=0.5)
            print(point.value, kind, result.GetNumberOfCells(),
                  accessor.view_factors().mesh[0], accessor.radiosity.__doc__[:11])
            """
        result = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True,
                                timeout=100, check=False)
        self.assertEqual(
            result.stdout, "vtklighttransport.accessor wrapped 6 wrapped The surface\n",
            result.stderr)

    def test_wheels(self):
        """Both wheels say the same, but for what CGAL changes."""
        try:
            import tomllib
        except ImportError:
            self.skipTest("Python 3.11 reads TOML")
        both = []
        for folder in (SOURCE, SOURCE / "Python" / "gpl"):
            told = tomllib.loads((folder / "pyproject.toml").read_text())
            project, build = told["project"], told["tool"]["scikit-build"]
            both.append({**project, "build": {**build["cmake"]["define"]},
                         "exclude": build["wheel"]["exclude"]})
        self.assertEqual([told.pop("name") for told in both],
                         ["vtklighttransport", "vtklighttransport-gpl"])
        self.assertEqual([told.pop("license") for told in both],
                         ["BSD-3-Clause", "GPL-3.0-or-later"])
        self.assertEqual([told.pop("build")["VTKLIGHTTRANSPORT_ENABLE_MESHING"] for told in both],
                         ["OFF", "ON"])
        for told in both:
            for name in ("description", "readme", "license-files"):
                told.pop(name, None)
        self.assertEqual(*both)

    def test_types(self):
        """Editors know every class."""
        folder = pathlib.Path(lt.__file__).parent
        if not (folder / "stubs.stamp").exists() and not list(folder.glob("vtk*.pyi")):
            self.skipTest("this build left the types out")
        text = "".join(file.read_text() for file in folder.glob("vtk*.pyi"))
        for name in lt.__all__:
            if name.startswith("vtk"):
                self.assertIn(f"class {name}(", text)
        self.assertIn("def SetTolerance(self, _arg:float)", text)
        names = (folder / "__init__.pyi").read_text()
        for name in lt._LATER:
            self.assertIn(f" import {name} as {name}", names)


@unittest.skipUnless(HAS_PYVISTA and HAS_NUMPY, "no pyvista")
class TestPyVista(unittest.TestCase):
    """PyVista itself finds the accessor by the entry point of the package's metadata."""

    @classmethod
    def setUpClass(cls):
        import pyvista
        cls.pyvista = pyvista

    def test_accessor(self):
        box = self.pyvista.Box(bounds=(0, 1, 0, 2, 0, 3), quads=True).flip_faces()
        self.assertNotIn("vtklighttransport.accessor", dir(box))
        result = box.light_transport.radiosity(emission=[1, 0, 0, 0, 0, 0], reflectance=0.5)
        self.assertIsInstance(result, self.pyvista.PolyData)
        self.assertEqual(result.point_data["Radiosity"].shape[0], result.n_points)
        total = (result.cell_data["Radiosity"] * box.compute_cell_sizes()["Area"] * 0.5).sum()
        self.assertAlmostEqual(total, 6.0, delta=1e-2)
        matrix = box.light_transport.view_factors(tolerance=1e-5)
        self.assertTrue(matrix.check().closed)
        self.assertIn("SkyFraction", matrix.mesh.cell_data)
        with self.assertRaisesRegex(ValueError, "point_data_to_cell_data"):
            box.light_transport.radiosity(emission=box.points[:, 0], reflectance=0.5)

    def test_other_data_sets(self):
        """Volumes have surfaces, blocks are regions."""
        grid = self.pyvista.ImageData(dimensions=(3, 3, 3))
        lit = grid.light_transport.irradiance(lights=[self.pyvista.Light(
            position=(0, 0, 1), light_type="scene light"), (1, 0, 0)])
        self.assertEqual(lit.n_cells, 24)
        self.assertAlmostEqual(lit.cell_data["DirectIrradiance"].max(), 1.0)
        blocks = self.pyvista.MultiBlock({"lamp": self.pyvista.Plane(direction=(0, 0, -1)),
                                          "floor": self.pyvista.Plane(center=(0, 0, -1))})
        result = blocks.light_transport.radiosity(emission={"lamp": 1, "floor": 0}, reflectance=0.5)
        self.assertGreater(result.cell_data["Radiosity"].min(), 0.0)
        self.assertEqual(list(result.field_data["RegionNames"]), ["lamp", "floor"])

    @unittest.skipUnless(hasattr(lt, "vtkPatchMesher"), "no mesher in this build")
    def test_scattering(self):
        sphere = self.pyvista.Sphere()
        patches = sphere.light_transport.patches(n=500)
        self.assertLess(abs(patches.n_cells - 500), 26)
        unfolded = patches.light_transport.atlas(resolution=64)
        self.assertIsNotNone(unfolded.active_texture_coordinates)
        result = unfolded.light_transport.scatter(
            material="marble", lights=[(0, 0, 1)], millimeters_per_unit=20)
        self.assertGreater(result.cell_data["ScatteredIrradiance"].max(), 0.0)


if __name__ == "__main__":
    unittest.main()
