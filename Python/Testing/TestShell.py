# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""From files as engineers have them to answers: any format, materials as values, JSON."""

import importlib.util
import json
import math
import os
import unittest

import vtklighttransport as lt
from vtklighttransport.meshes import READERS, list_regions
from vtklighttransport.progress import describe_time_left
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet
from vtkmodules.vtkCommonCore import vtkFloatArray
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter

from CommandTools import CommandTestCase
from TestingTools import add_array, get_tuples, make_box, make_surface

HAS_NUMPY = importlib.util.find_spec("numpy") is not None
HAS_MESHIO = importlib.util.find_spec("meshio") is not None

STEFAN_BOLTZMANN = 5.670374419e-8
OPPOSITE = 0.19982489569838746
BESIDE = (1.0 - OPPOSITE) / 4.0


def write_stl(file, solids):
    """Text, a solid for each name, of polygons with four corners."""
    with open(file, "w", encoding="utf-8") as stream:
        for name, polygons in solids.items():
            stream.write(f"solid {name}\n")
            for a, b, c, d in polygons:
                for triangle in ((a, b, c), (a, c, d)):
                    stream.write("facet normal 0 0 0\nouter loop\n")
                    for corner in triangle:
                        stream.write("vertex {} {} {}\n".format(*corner))
                    stream.write("endloop\nendfacet\n")
            stream.write(f"endsolid {name}\n")


class TestShell(CommandTestCase):
    def make_oven(self):
        """A closed box, seen from inside, whose floor is a solid of its own."""
        faces = make_box((0, 0, 0), (1, 1, 1))
        write_stl(self.path("oven.stl"), {"heater": faces[4:5], "walls": faces[:4] + faces[5:]})
        return self.path("oven.stl")

    def run_json(self, *arguments):
        result = self.run_command(*arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def get_values(self, name):
        return [row[0] for row in get_tuples(self.load("out.vtp").GetCellData().GetArray(name))]

    def test_options_for_properties(self):
        """Messages name properties and arrays, and the options for them; others are left alone."""
        cube = self.save("in.vtp", add_array(make_surface(make_box((0, 0, 0), (1, 1, 1))[1:]),
                                             "Temperature", [900.0] * 5))
        result = self.run_command("radiosity", cube, self.path("out.vtp"), "--emissivity", "0.9")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("BackgroundTemperature", result.stderr)
        self.assertIn("--background-temperature", result.stderr)
        self.assertNotIn("--tolerance", result.stderr)
        os.remove(self.path("out.vtp"))
        result = self.run_command("radiosity", cube, self.path("out.vtp"), "--emissivity", "2")
        self.check_failure(result, 1, '"Emissivity"')
        self.assertIn("(options: --emissivity)", result.stderr)

    def test_part_in_one_line(self):
        """No arrays in the file, one value for each material."""
        told = self.run_json("radiosity", self.make_oven(), self.path("out.vtp"),
                             "--temperature", "300", "--emissivity", "0.9")
        self.assertEqual((told["command"], told["patches"]), ("radiosity", 12))
        self.assertEqual(told["EnclosureVerdict"], "Closed")
        for value in self.get_values("NetFlux"):
            self.assertAlmostEqual(value, 0.0, delta=0.5)

    def test_regions(self):
        """Gebhart's answer for a floor that is hot and black, and walls that are cold and black."""
        oven = self.make_oven()
        self.run_json("radiosity", oven, self.path("out.vtp"), "--temperature", "300",
                      "--temperature", "heater=600", "--emissivity", "1")
        fluxes = self.get_values("NetFlux")
        expected = STEFAN_BOLTZMANN * (600.0 ** 4 - 300.0 ** 4)
        for flux in fluxes[:2]:
            self.assertAlmostEqual(flux / expected, 1.0, delta=1e-3)
        # The two triangles of the ceiling, as one.
        self.assertAlmostEqual(sum(fluxes[-2:]) / 2.0 / expected, -OPPOSITE, delta=1e-3)
        for values, message in (
                (("heather=1",), "did you mean 'heater'?"),
                (("heater=1",), "Emissivity of walls is not given"),
                (("heater=1", "0.5,0.5"), "as many everywhere"),
                (("Emis", "Other"), "names two arrays"),
                (("heater=hot",), "no list of numbers")):
            options = [word for value in values for word in ("--emissivity", value)]
            result = self.run_command("radiosity", oven, self.path("new.vtp"),
                                      "--temperature", "300", *options)
            self.assertIn(message, result.stderr)
            self.assertIn(result.returncode, (1, 2))
        cube = self.save("cube.vtp", make_surface(make_box((0, 0, 0), (1, 1, 1))))
        result = self.run_command("radiosity", cube, self.path("new.vtp"), "--emission", "floor=1")
        self.check_failure(result, 1, "the mesh has no regions")
        self.run_json("radiosity", cube, self.path("out.vtp"), "--emission", "1",
                      "--reflectance", "0.5")
        for value in self.get_values("Radiosity"):
            self.assertAlmostEqual(value, 2.0, delta=1e-3)

    def test_files(self):
        """What VTK writes is read, and of volumes the surface."""
        from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
        from vtkmodules.vtkFiltersCore import vtkAppendFilter
        from vtkmodules.vtkIOLegacy import vtkDataSetWriter
        from vtkmodules.vtkIOPLY import vtkPLYWriter
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
        cube = make_surface(make_box((0, 0, 0), (1, 1, 1), outside=True))
        triangles = vtkTriangleFilter()
        triangles.SetInputData(cube)
        grid = vtkAppendFilter()
        grid.AddInputData(cube)
        grid.Update()
        self.assertIsInstance(grid.GetOutput(), vtkUnstructuredGrid)
        for name, writer, source in (("a.vtk", vtkDataSetWriter(), grid),
                                     ("b.vtk", vtkDataSetWriter(), triangles),
                                     ("a.ply", vtkPLYWriter(), triangles),
                                     ("a.vtu", vtkXMLUnstructuredGridWriter(), grid)):
            writer.SetInputConnection(source.GetOutputPort())
            writer.SetFileName(self.path(name))
            if hasattr(writer, "SetDataModeToAscii"):
                writer.SetDataModeToAscii()
            writer.Write()
            self.check_cube(lt.read_mesh(self.path(name)))
        with open(self.path("a.obj"), "w", encoding="utf-8") as stream:
            stream.writelines(f"v {cube.GetPoint(k)[0]} {cube.GetPoint(k)[1]} "
                              f"{cube.GetPoint(k)[2]}\n" for k in range(24))
            stream.writelines(f"f {4 * k + 1} {4 * k + 2} {4 * k + 3} {4 * k + 4}\n"
                              for k in range(6))
        self.check_cube(lt.read_mesh(self.path("a.obj")))
        self.write_foam(make_box((0, 0, 0), (1, 1, 1), outside=True))
        surface = lt.read_mesh(self.path("case.foam"))
        self.check_cube(surface)
        self.assertEqual(sorted(list_regions(surface).values()), ["floor", "walls"])

    def check_cube(self, surface):
        properties = vtkMassProperties()
        triangles = vtkTriangleFilter()
        triangles.SetInputData(surface)
        properties.SetInputConnection(triangles.GetOutputPort())
        properties.Update()
        self.assertAlmostEqual(properties.GetSurfaceArea(), 6.0, delta=1e-5)
        self.assertAlmostEqual(properties.GetVolume(), 1.0, delta=1e-5)

    def write_foam(self, box):
        """A case of OpenFOAM with one cell, whose faces are in two patches."""
        corners = sorted({tuple(corner) for polygon in box for corner in polygon})
        faces = [f"4({' '.join(str(corners.index(tuple(corner))) for corner in polygon)})"
                 for polygon in box]
        header = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
        folder = self.path("constant", "polyMesh")
        os.makedirs(folder)
        os.makedirs(self.path("system"))
        patches = ("floor { type wall; nFaces 1; startFace 0; } "
                   "walls { type wall; nFaces 5; startFace 1; }")
        for name, kind, rows in (
                ("points", "vectorField", ["({} {} {})".format(*corner) for corner in corners]),
                ("faces", "faceList", faces), ("owner", "labelList", ["0"] * 6),
                ("neighbour", "labelList", []), ("boundary", "polyBoundaryMesh", [patches])):
            count = 2 if name == "boundary" else len(rows)
            with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
                stream.write(header.format(kind, name) + f"{count}\n(\n")
                stream.write("\n".join(rows) + "\n)\n")
        with open(self.path("system", "controlDict"), "w", encoding="utf-8") as stream:
            stream.write(header.format("dictionary", "controlDict")
                         + "startFrom latestTime;\nstartTime 0;\nendTime 1;\ndeltaT 1;\n"
                           "writeControl timeStep;\nwriteInterval 1;\n")
        with open(self.path("case.foam"), "w", encoding="utf-8"):
            pass

    def test_readers(self):
        """Each is where it is looked for; a VTK may have been built without some modules."""
        for extension, (module, name) in READERS.items():
            if importlib.util.find_spec("vtkmodules." + module):
                self.assertTrue(hasattr(importlib.import_module("vtkmodules." + module), name),
                                extension)

    def test_blocks(self):
        faces = make_box((0, 0, 0), (1, 1, 1))
        blocks = vtkMultiBlockDataSet()
        for k, (name, polygons) in enumerate((("lamp", faces[5:]), ("room", faces[:5]))):
            blocks.SetBlock(k, make_surface(polygons))
            blocks.GetMetaData(k).Set(blocks.NAME(), name)
        writer = vtkXMLMultiBlockDataWriter()
        writer.SetInputData(blocks)
        writer.SetFileName(self.path("room.vtm"))
        writer.SetDataModeToAscii()
        self.assertEqual(writer.Write(), 1)
        self.run_json("radiosity", self.path("room.vtm"), self.path("out.vtp"), "--emission",
                      "lamp=1", "--emission", "0", "--reflectance", "0.5")
        values = self.get_values("Radiosity")
        self.assertAlmostEqual(sum(values), 2.0, delta=1e-3)
        self.assertEqual(max(values), values[0])

    @unittest.skipUnless(HAS_MESHIO and HAS_NUMPY, "no meshio")
    def test_meshio(self):
        import meshio
        import numpy
        points = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        walls = [[4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        cells = [("quad", [[0, 1, 3, 2]]), ("quad", walls)]
        tags = [numpy.array([1], dtype=numpy.int32), numpy.full(5, 2, dtype=numpy.int32)]
        mesh = meshio.Mesh(numpy.array(points, dtype=float), cells,
                           cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
                           field_data={"floor": numpy.array([1, 2]), "rest": numpy.array([2, 2])})
        meshio.write(self.path("room.msh"), mesh, file_format="gmsh22", binary=False)
        self.run_json("radiosity", self.path("room.msh"), self.path("out.vtp"), "--emission",
                      "floor=1", "--emission", "rest=0", "--reflectance", "0.5")
        self.assertAlmostEqual(sum(self.get_values("Radiosity")), 2.0, delta=1e-3)
        with open(self.path("broken.msh"), "w", encoding="utf-8") as stream:
            stream.write("$MeshFormat\nhello")
        result = self.run_command("radiosity", self.path("broken.msh"), self.path("new.vtp"))
        self.check_failure(result, 1, "broken.msh")

    @unittest.skipUnless(HAS_NUMPY, "no numpy")
    def test_view_factors(self):
        told = self.run_json("view-factors", self.make_oven(), self.path("f.npz"),
                             "--tolerance", "1e-6")
        self.assertEqual(told["groups"]["Group"], ["heater", "walls"])
        self.assertAlmostEqual(told["groups"]["walls"][0], 1.0, delta=1e-5)
        matrix = lt.read_view_factors(self.path("f.npz"))
        self.assertTrue(matrix.check().closed)
        result = self.run_command("view-factors", self.path("oven.stl"), self.path("f.csv"))
        self.assertIn("12 patches, Closed", result.stdout)
        self.assertEqual(len(lt.read_view_factors(self.path("f.csv"))), 12)
        self.run_json("view-factors", self.path("oven.stl"), self.path("out.vtp"))
        for value in self.get_values("ViewFactorSum"):
            self.assertAlmostEqual(value, 1.0, delta=1e-3)
        result = self.run_command("view-factors", self.path("oven.stl"), self.path("f.txt"))
        self.check_failure(result, 2, "is not a .npz or .csv or .vtp file")
        result = self.run_command("view-factors", self.path("oven.stl"), self.path("new.npz"),
                                  "--group", "Regoin")
        self.check_failure(result, 1, "did you mean 'Region'?")

    @unittest.skipUnless(hasattr(lt, "vtkPatchMesher"), "no mesher in this build")
    def test_mesh_and_atlas(self):
        told = self.run_json("mesh", self.make_oven(), self.path("patches.vtp"), "--patches", "400")
        self.assertLess(abs(told["patches"] - 400), 20)
        patches = self.load("patches.vtp")
        self.assertEqual(patches.GetCellData().GetArray("Region").GetRange(), (0.0, 1.0))
        told = self.run_json("atlas", self.path("patches.vtp"), self.path("out.vtp"),
                             "--resolution", "64", "--texels", self.path("texels.vti"))
        self.assertGreaterEqual(told["NumberOfCharts"], 1)
        told = self.run_json("scatter", self.path("oven.stl"), self.path("out.vtp"), "--mesh",
                             "0.3", "--material", "marble", "--irradiance", "1")
        self.assertGreater(min(self.get_values("ScatteredIrradiance")), 0.0)
        result = self.run_command("mesh", self.path("oven.stl"), self.path("new.vtp"),
                                  "--grading", "-1")
        self.check_failure(result, 1, "Grading")

    @unittest.skipUnless(hasattr(lt, "vtkOpenEXRWriter"), "no OpenEXR in this build")
    def test_exr_info(self):
        image = vtkImageData()
        image.SetDimensions(4, 3, 1)
        for name, components in (("RGB", 3), ("depth", 1)):
            array = vtkFloatArray()
            array.SetName(name)
            array.SetNumberOfComponents(components)
            array.SetNumberOfTuples(12)
            for value in range(12 * components):
                array.SetValue(value, 0.5 * value)
            image.GetPointData().AddArray(array)
        writer = lt.vtkOpenEXRWriter()
        writer.SetInputData(image)
        writer.SetFileName(self.path("image.exr"))
        writer.Write()
        told = self.run_json("exr-info", self.path("image.exr"))
        self.assertEqual(told["parts"][0]["size"], [4, 3])
        self.assertEqual(told["parts"][0]["arrays"]["depth"]["ranges"], [[0.0, 5.5]])
        self.assertEqual(told["parts"][0]["arrays"]["RGB"]["components"], 3)
        result = self.run_command("exr-info", self.path("image.exr"), "--quiet")
        self.assertEqual((result.returncode, result.stdout), (0, ""))
        self.assertIn("RGB: 3 x", self.run_command("exr-info", self.path("image.exr")).stdout)
        self.check_failure(self.run_command("exr-info", self.make_oven()), 1, "oven.stl")

    def test_near_misses(self):
        cube = make_surface(make_box((0, 0, 0), (1, 1, 1)))
        add_array(add_array(cube, "emission", [1.0] * 6), "Reflectance", [0.5] * 6)
        source = self.save("in.vtp", add_array(cube, "HeatFlux", [1.0] * 6))
        for options, near in (((), "emission"), (("--emission", "emissn"), "emission"),
                              (("--emission", "emission", "--net-flux", "HeatFlx"), "HeatFlux")):
            result = self.run_command("radiosity", source, self.path("out.vtp"), *options)
            self.check_failure(result, 1, "did you mean")
            self.assertIn(near, result.stderr)

    def test_time_left(self):
        for seconds, fraction, text in ((0.5, 0.5, ""), (10.0, 0.01, ""), (60.0, 1.0, ""),
                                        (30.0, 0.25, "1:30 left"), (60.0, 0.02, "49:00 left"),
                                        (400.0, 0.05, "2:06:40 left")):
            self.assertEqual(describe_time_left(seconds, fraction), text)

    def test_json_is_strict(self):
        from vtklighttransport.__main__ import print_json
        told = json.loads(print_json({"a": [math.nan, (1.0, math.inf)], "b": {"c": 2}}))
        self.assertEqual(told, {"a": [None, [1.0, None]], "b": {"c": 2}})


if __name__ == "__main__":
    unittest.main()
