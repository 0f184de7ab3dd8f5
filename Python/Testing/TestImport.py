# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The package has every class of every module that was built."""

import ast
import graphlib
import os
import pathlib
import re
import unittest

import vtklighttransport as lt
from vtklighttransport import _build

from TestingTools import CUBE_CORNERS, CUBE_FACES

SOURCE = pathlib.Path(os.environ["LIGHT_TRANSPORT_SOURCE"])
FOLDERS = {
    "vtkLightTransportFilters": "Filters/Transport",
    "vtkLightTransportMeshing": "Filters/Meshing",
    "vtkLightTransportRendering": "Rendering",
    "vtkLightTransportIO": "IO",
}
FILTERS = {
    "vtkLightTransportFilters": (
        "vtkDirectIrradiance", "vtkRadianceTransfer", "vtkRadiosity", "vtkSingleScattering",
        "vtkSubsurfaceScattering", "vtkViewFactors"),
    "vtkLightTransportMeshing": (
        "vtkAtlasToSurface", "vtkPatchMesher", "vtkSurfaceAtlas", "vtkSurfaceToAtlas"),
    "vtkLightTransportRendering": (),
    "vtkLightTransportIO": ("vtkOpenEXRReader", "vtkOpenEXRWriter"),
}


def find_imports():
    """Pairs of modules of the package of which the first imports the second, at once or later."""
    root = SOURCE / "Python" / "vtklighttransport"
    files = {".".join(("vtklighttransport", *file.relative_to(root).with_suffix("").parts))
             .replace(".__init__", ""): file for file in root.rglob("*.py")}
    for name, file in files.items():
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.ImportFrom) and node.level == 0:
                for alias in node.names:
                    full = f"{node.module}.{alias.name}"
                    imported = full if full in files else node.module
                    if imported in files and imported != "vtklighttransport":
                        yield name, imported


class TestImport(unittest.TestCase):
    def test_version(self):
        self.assertRegex(lt.__version__, r"^\d+\.\d+\.\d+$")

    def test_every_public_header_has_its_class(self):
        self.assertTrue(_build.MODULES)
        for module in _build.MODULES:
            for header in sorted((SOURCE / FOLDERS[module]).glob("vtk*.h")):
                if re.search(r"class \w+_EXPORT " + header.stem, header.read_text()):
                    self.assertTrue(hasattr(lt, header.stem), header.stem)
                    self.assertIn(header.stem, lt.__all__)

    def test_filters(self):
        for module in _build.MODULES:
            for name in FILTERS[module]:
                algorithm = getattr(lt, name)()
                self.assertTrue(algorithm.IsA("vtkAlgorithm"), name)
                self.assertIn(name, str(algorithm))

    def test_modules_that_were_switched_off(self):
        for module, names in FILTERS.items():
            if module not in _build.MODULES:
                for name in names:
                    self.assertFalse(hasattr(lt, name), name)

    def test_no_circles(self):
        """No module of the package imports what imports it, nor does any folder."""
        for find_place in (str, lambda name: ".".join(name.split(".")[:2])):
            arrows = {}
            for name, imported in find_imports():
                if find_place(name) != find_place(imported):
                    arrows.setdefault(find_place(name), set()).add(find_place(imported))
            self.assertTrue(arrows)
            # Raises CycleError, which names the circle.
            graphlib.TopologicalSorter(arrows).prepare()

    @unittest.skipUnless("vtkLightTransportFilters" in _build.MODULES, "module not built")
    def test_constants_and_setters(self):
        radiosity = lt.vtkRadiosity()
        self.assertEqual(radiosity.GetSolver(), lt.vtkRadiosity.SOLVER_AUTO)
        radiosity.SetSolverToGaussSeidel()
        self.assertEqual(radiosity.GetSolver(), 2)
        self.assertEqual(lt.vtkRadiosity.DEVICE_OPENGL, 2)

    @unittest.skipUnless("vtkLightTransportFilters" in _build.MODULES, "module not built")
    def test_arguments_from_other_modules(self):
        # Methods whose argument types the wrapper does not know are left out without a word.
        from vtkmodules.vtkRenderingCore import vtkLight
        irradiance = lt.vtkDirectIrradiance()
        light = vtkLight()
        irradiance.AddLight(light)
        self.assertIs(irradiance.GetLight(0), light)
        radiosity = lt.vtkRadiosity()
        factors = lt.vtkViewFactors()
        radiosity.SetViewFactors(factors)
        self.assertIs(radiosity.GetViewFactors(), factors)

    @unittest.skipUnless("vtkLightTransportFilters" in _build.MODULES, "module not built")
    def test_arrays(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("no numpy")
        from vtklighttransport import arrays
        # The unit cube, seen from inside; one face emits.
        cube = arrays.make_surface(CUBE_CORNERS, CUBE_FACES)
        arrays.set_cell_array(cube, "Emission", numpy.array([1.0, 0, 0, 0, 0, 0]))
        arrays.set_cell_array(cube, "Reflectance", 0.5)
        radiosity = lt.vtkRadiosity()
        radiosity.SetInputData(cube)
        radiosity.SetDeviceToCPU()
        radiosity.SetTolerance(1e-9)
        radiosity.SetViewFactorTolerance(1e-7)
        radiosity.Update()
        result = radiosity.GetOutputDataObject(0)
        value = arrays.get_cell_array(result, "Radiosity").ravel()
        # F of opposite faces of a cube: 0.199825; of neighbours (1 - that) / 4.
        opposite = 0.19982489569838746
        factors = numpy.full((6, 6), (1.0 - opposite) / 4.0)
        for pair in ((0, 1), (2, 3), (4, 5)):
            factors[pair] = factors[pair[::-1]] = opposite
        numpy.fill_diagonal(factors, 0.0)
        emission = numpy.array([1.0, 0, 0, 0, 0, 0])
        exact = numpy.linalg.solve(numpy.eye(6) - 0.5 * factors, emission)
        self.assertLess(numpy.abs(value - exact).max(), 1e-6)
        self.assertEqual(arrays.get_summary(result, "DeviceUsed"), "CPU")
        self.assertEqual(arrays.get_point_array(result, "Radiosity").shape[0], 24)
        with self.assertRaises(KeyError):
            arrays.get_cell_array(result, "Nothing")


if __name__ == "__main__":
    unittest.main()
