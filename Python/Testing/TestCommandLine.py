# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m vtklighttransport from end to end: results, exit codes, messages."""

import math
import os
import pkgutil
import signal
import subprocess
import sys
import time
import unittest

import vtklighttransport as lt
from vtklighttransport import commands
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

from CommandTools import CommandTestCase
from TestingTools import (
    CUBE_CORNERS, CUBE_FACES, add_array, get_tuples, join_points, make_surface)


def make_cube(outside=False, first=0.0):
    """The unit cube, seen from inside or from outside."""
    corners = [(x or first, y, z) for x, y, z in CUBE_CORNERS]
    return join_points(corners, [face[::-1] if outside else face for face in CUBE_FACES])


def get_values(surface, name):
    return get_tuples(surface.GetCellData().GetArray(name))


class TestCommandLine(CommandTestCase):
    def make_lit_cube(self):
        cube = add_array(make_cube(), "Emission", [1, 0, 0, 0, 0, 0])
        return self.save("in.vtp", add_array(cube, "Reflectance", [0.5] * 6))

    def test_help(self):
        result = self.run_command("radiosity", "--help")
        self.assertEqual(result.returncode, 0)
        for text in ("--tolerance", "[0.0001]", "gauss-seidel", "degrees [60]", "kelvin"):
            self.assertIn(text, result.stdout)
        result = self.run_command("scatter", "--help")
        for text in ("--material", "marble", "[custom]", "per mm [1 1 1]", "millimetres; 10 for"):
            self.assertIn(text, " ".join(result.stdout.split()))
        self.assertEqual(self.run_command("--version").stdout.strip(), lt.__version__)

    def test_commands(self):
        """Each module of the folder is a command, and says what it is."""
        files = {module.name for module in pkgutil.iter_modules(commands.__path__)}
        self.assertEqual(files, set(commands.MODULES))
        overview = " ".join(self.run_command("--help").stdout.split())
        for name, module in commands.load_commands().items():
            self.assertIn(f" {name} {module.HELP} ", overview)
            result = self.run_command(name, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn(module.DESCRIPTION, " ".join(result.stdout.split()))

    def test_interrupted(self):
        # Enough patches for a second or more of view factors.
        wall = [[(x, y, z), (x + 1, y, z), (x + 1, y + 1, z), (x, y + 1, z)]
                for x in range(40) for y in range(40) for z in (0.0, 9.0)]
        wall = [square if square[0][2] == 0.0 else square[::-1] for square in wall]
        surface = add_array(make_surface(wall), "Emission", [1.0] * len(wall))
        source = self.save("in.vtp", add_array(surface, "Reflectance", [0.5] * len(wall)))
        command = [sys.executable, "-m", "vtklighttransport", "radiosity", source,
                   self.path("out.vtp"), "--view-factor-tolerance", "1e-8"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as process:
            self.assertIn("read: ", process.stderr.readline())
            process.send_signal(signal.SIGINT)
            output, errors = process.communicate(timeout=100)
        self.assertEqual((process.returncode, output, errors), (130, "", "interrupted\n"))
        self.assertEqual(os.listdir(self.folder), ["in.vtp"])

    def test_full_disk(self):
        """The old result stays; a limit on the size of files stands in for a full disk."""
        source = self.make_lit_cube()
        with open(self.path("out.vtp"), "w", encoding="utf-8") as stream:
            stream.write("old")
        result = self.run_command("radiosity", source, self.path("out.vtp"), limit=1000)
        self.check_failure(result, 1, "cannot write")
        self.assertIn("have room for", result.stderr)
        with open(self.path("out.vtp"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "old")
        self.assertEqual(sorted(os.listdir(self.folder)), ["in.vtp", "out.vtp"])

    def test_interrupted_while_loading(self):
        """Python tells of each module that it has loaded."""
        for module in ("vtkmodules.vtkCommonCore", "vtklighttransport.vtkLightTransportFilters",
                       "argparse"):
            command = [sys.executable, "-X", "importtime", "-m", "vtklighttransport",
                       "radiosity", "--help"]
            with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  text=True) as process:
                for line in process.stderr:
                    if line.rpartition("|")[2].strip() == module:
                        break
                process.send_signal(signal.SIGINT)
                errors = process.communicate(timeout=100)[1]
            self.assertEqual(process.returncode, 130, module)
            self.assertNotIn("Traceback", errors)

    @unittest.skipUnless(hasattr(lt, "vtkPatchMesher"), "no mesher in this build")
    def test_interrupted_at_any_moment(self):
        """The result is there and whole, or not at all; and so is what was there before."""
        source = self.make_lit_cube()
        before = self.save("out.vtp", make_cube())
        begin = time.monotonic()
        self.run_command("radiosity", source, self.path("full.vtp"), "--mesh", "0.1")
        duration = time.monotonic() - begin
        whole = self.load("full.vtp").GetNumberOfCells()
        os.remove(self.path("full.vtp"))
        command = [sys.executable, "-m", "vtklighttransport", "radiosity", source, before,
                   "--mesh", "0.1", "--quiet"]
        for k in range(8):
            with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
                # Not while Python itself begins.
                time.sleep(duration * (0.3 + 0.1 * k))
                process.send_signal(signal.SIGINT)
                process.communicate(timeout=100)
            self.assertIn(process.returncode, (0, 130))
            self.assertEqual(sorted(os.listdir(self.folder)), ["in.vtp", "out.vtp"])
            cells = self.load("out.vtp").GetNumberOfCells()
            self.assertIn(cells, (whole,) if process.returncode == 0 else (6, whole))

    def test_radiosity(self):
        source = self.make_lit_cube()
        result = self.run_command(
            "radiosity", source, self.path("out.vtp"), "--solver", "jacobi", "--device", "cpu",
            "--tolerance", "1e-9", "--view-factor-tolerance", "1e-7")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("6 patches", result.stdout)
        self.assertIn("radiosity: ", result.stderr)
        values = get_values(self.load("out.vtp"), "Radiosity")
        # The opposite face and the four others, by elimination with the cube's two view factors.
        opposite = 0.19982489569838746
        beside = (1.0 - opposite) / 4.0
        # Unknowns a (emitter), b (opposite), c (beside): a = 1 + (f b + 4 g c) / 2 and so on.
        others = 1.0 - (opposite + 2.0 * beside) / 2.0
        a_minus_b = 1.0 / (1.0 + opposite / 2.0)
        a_plus_b_factor = 4.0 * beside / (1.0 - opposite / 2.0)
        a_plus_b = (1.0 / (1.0 - opposite / 2.0)) / (1.0 - a_plus_b_factor * beside / 2.0 / others)
        side = beside / 2.0 * a_plus_b / others
        self.assertAlmostEqual(values[0][0], (a_plus_b + a_minus_b) / 2.0, delta=1e-6)
        self.assertAlmostEqual(values[1][0], (a_plus_b - a_minus_b) / 2.0, delta=1e-6)
        self.assertAlmostEqual(values[4][0], side, delta=1e-6)
        # Nothing leaks, so the radiosities sum to the emission over 1 - rho.
        self.assertAlmostEqual(sum(value[0] for value in values), 2.0, delta=1e-6)

    def test_other_array_names(self):
        cube = add_array(make_cube(), "Glow", [1, 0, 0, 0, 0, 0])
        source = self.save("in.vtp", add_array(cube, "Albedo", [0.5] * 6))
        result = self.run_command("radiosity", source, self.path("out.vtp"), "--quiet",
                                  "--emission", "Glow", "--reflectance", "Albedo")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))
        values = get_values(self.load("out.vtp"), "Radiosity")
        self.assertAlmostEqual(values[0][0], 1.0909, delta=1e-3)

    def test_thermal(self):
        # A warm body under a cold sky, one of its faces insulated from behind, in two bands.
        sky, body = 5.670374419e-8 * 250.0**4, 5.670374419e-8 * 350.0**4
        cube = add_array(make_cube(outside=True), "Temperature", [350.0] * 6)
        add_array(cube, "Kind", [0, 0, 1, 0, 0, 0])
        source = self.save("in.vtp", add_array(cube, "Emissivity", [0.6] * 6))
        result = self.run_command(
            "radiosity", source, self.path("out.vtp"), "--background-temperature", "250",
            "--boundary-condition", "Kind", "--net-flux", "None")
        self.assertEqual(result.returncode, 0, result.stderr)
        fluxes = get_values(self.load("out.vtp"), "NetFlux")
        temperatures = get_values(self.load("out.vtp"), "SurfaceTemperature")
        for face in range(6):
            flux, temperature = (0.0, 250.0) if face == 2 else (0.6 * (body - sky), 350.0)
            self.assertAlmostEqual(fluxes[face][0], flux, delta=1e-9)
            self.assertAlmostEqual(temperatures[face][0], temperature, delta=1e-9)
        result = self.run_command(
            "radiosity", source, self.path("out.vtp"), "--band-limits", "0,8,inf",
            "--background-radiance", f"{2.0 * sky / math.pi},{sky / math.pi}")
        self.assertEqual(result.returncode, 0, result.stderr)
        totals = get_values(self.load("out.vtp"), "TotalNetFlux")
        self.assertAlmostEqual(totals[3][0], 0.6 * (body - 3.0 * sky), delta=1e-9)
        result = self.run_command(
            "radiosity", source, self.path("out.vtp"), "--band-limits", "red,blue")
        self.check_failure(result, 2, "'red,blue' is no list of numbers")

    def test_unknown_options(self):
        for words, message in (
                (("--temprature", "300"), "--temprature (did you mean --temperature?) 300"),
                (("--emisivity=0.9",), "--emisivity=0.9 (did you mean --emissivity?)"),
                (("--shiny", "1"), "unrecognized arguments: --shiny 1")):
            result = self.run_command("radiosity", "in.vtp", self.path("out.vtp"), *words)
            self.check_failure(result, 2, message)

    @unittest.skipUnless(hasattr(lt, "vtkPatchMesher"), "no mesher in this build")
    def test_mesh(self):
        result = self.run_command(
            "radiosity", self.make_lit_cube(), self.path("out.vtp"), "--mesh", "0.3",
            "--device", "cpu")
        self.assertEqual(result.returncode, 0, result.stderr)
        surface = self.load("out.vtp")
        self.assertGreater(surface.GetNumberOfCells(), 100)
        self.assertEqual(surface.GetCellData().GetArray("OriginalCellIds").GetRange(), (0.0, 5.0))

    def test_scatter(self):
        source = self.save("in.vtp", make_cube(outside=True))
        # Ten millimetres to the unit: a face is some 20 mean free paths of marble wide.
        result = self.run_command(
            "scatter", source, self.path("out.vtp"), "--material", "marble", "--mm-per-unit", "10",
            "--light", "-1,0,0,2", "--light-diameter", "0.53", "--device", "cpu")
        self.assertEqual(result.returncode, 0, result.stderr)
        surface = self.load("out.vtp")
        direct = get_values(surface, "DirectIrradiance")
        for value in direct[4]:
            self.assertAlmostEqual(value, 2.0, delta=1e-12)
        self.assertEqual(max(direct[5]), 0.0)
        # Half of the disc is above the horizon of the faces at the sides.
        grazing = 2.0 * math.sin(math.radians(0.265)) * 2.0 / (3.0 * math.pi)
        for face in range(4):
            self.assertAlmostEqual(direct[face][0], grazing, delta=0.2 * grazing)
        # Normal incidence at n = 1.5: four hundredths are reflected.
        for value in get_values(surface, "TransmittedIrradiance")[4]:
            self.assertAlmostEqual(value, 2.0 * 0.96, delta=1e-9)
        scattered = get_values(surface, "ScatteredIrradiance")[4]
        self.assertTrue(all(0.0 < value < 2.0 * 0.96 for value in scattered), scattered)

    def test_scatter_without_light(self):
        cube = add_array(make_cube(outside=True), "Light", [1.0] * 6)
        source = self.save("in.vtp", cube)
        result = self.run_command(
            "scatter", source, self.path("out.vtp"), "--irradiance", "Light",
            "--scattering", "2", "2", "2", "--absorption", "1e-2", "1e-2", "1e-2")
        self.assertEqual(result.returncode, 0, result.stderr)
        values = get_values(self.load("out.vtp"), "ScatteredIrradiance")
        self.assertLess(max(map(max, values)) - min(map(min, values)), 1e-6)

    def test_scatter_models(self):
        cube = add_array(make_cube(outside=True), "Light", [1.0] * 6)
        source = self.save("in.vtp", cube)
        results = set()
        for options in (("--model", "dipole"), ("--model", "better-dipole"),
                        ("--model", "photon-beam-diffusion"), ("--model", "christensen-burley"),
                        ("--model", "christensen-burley", "--burley-fit", "searchlight"),
                        ("--model", "tabulated", "--photons", "10000")):
            result = self.run_command(
                "scatter", source, self.path("out.vtp"), "--irradiance", "Light", *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            results.add(round(get_values(self.load("out.vtp"), "ScatteredIrradiance")[0][0], 6))
        self.assertEqual(len(results), 6, results)

    def test_scatter_medium(self):
        cube = add_array(make_cube(outside=True), "Light", [1.0] * 6)
        source = self.save("in.vtp", cube)
        image = vtkImageData()
        image.SetDimensions(2, 2, 3)
        image.SetSpacing(1.0, 1.0, 0.5)
        scattering = vtkDoubleArray()
        scattering.SetName("Scattering")
        scattering.InsertNextValue(3.0)
        scattering.InsertNextValue(0.0)
        image.GetCellData().AddArray(scattering)
        writer = vtkXMLImageDataWriter()
        writer.SetInputData(image)
        writer.SetFileName(self.path("medium.vti"))
        writer.SetDataModeToAscii()
        self.assertEqual(writer.Write(), 1)
        shares = []
        for options in ((), ("--medium", self.path("medium.vti"))):
            result = self.run_command(
                "scatter", source, self.path("out.vtp"), "--irradiance", "Light",
                "--model", "monte-carlo", "--photons", "2000", "--refractive-index", "1", *options)
            self.assertEqual(result.returncode, 0, result.stderr)
            values = get_values(self.load("out.vtp"), "ScatteredIrradiance")
            shares.append(values[1][0] / values[0][0])
        # The top is clear in the image, and like the bottom without it.
        self.assertLess(min(shares), 0.7)
        self.assertGreater(max(shares), 0.8)
        out = self.path("out.vtp")
        self.check_failure(
            self.run_command("scatter", source, out, "--medium", "x.obj"), 2, "not a .vti file")
        self.check_failure(
            self.run_command("scatter", source, out, "--medium", self.path("no.vti")), 1,
            "no such file")

    @unittest.skipUnless(hasattr(lt, "vtkSurfaceToAtlas"), "the mesher was switched off")
    def test_scatter_texels(self):
        atlas = lt.vtkSurfaceAtlas()
        atlas.SetInputData(add_array(make_cube(outside=True), "Light", [6, 5, 4, 3, 2, 1]))
        atlas.SetResolution(16)
        texels = lt.vtkSurfaceToAtlas()
        texels.SetInputConnection(atlas.GetOutputPort())
        source, out = self.path("texels.vti"), self.path("out.vti")
        writer = vtkXMLImageDataWriter()
        writer.SetInputConnection(texels.GetOutputPort())
        writer.SetFileName(source)
        writer.SetDataModeToAscii()
        self.assertEqual(writer.Write(), 1)
        options = ("--irradiance", "Light", "--mm-per-unit", "5", "--device", "cpu")
        result = self.run_command("scatter", source, out, *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("256 texels, ", result.stdout)
        scattering = lt.vtkSubsurfaceScattering()
        scattering.SetInputConnection(texels.GetOutputPort())
        scattering.SetInputArrayToProcess(0, 0, 0, vtkDataObject.POINT, "Light")
        scattering.SetMillimetersPerUnit(5.0)
        scattering.SetDeviceToCPU()
        scattering.Update()
        expected = scattering.GetOutputDataObject(0).GetPointData().GetArray("ScatteredIrradiance")
        reader = vtkXMLImageDataReader()
        reader.SetFileName(out)
        reader.Update()
        found = reader.GetOutput().GetPointData().GetArray("ScatteredIrradiance")
        self.assertEqual(found.GetNumberOfTuples(), 256)
        for texel in range(256):
            for value, wanted in zip(found.GetTuple(texel), expected.GetTuple(texel)):
                self.assertAlmostEqual(value, wanted, delta=1e-9)
        for arguments, code, message in (
                (("scatter", source, self.path("out.vtp")), 2, "is not a .vti file"),
                (("scatter", source, out, "--light", "0,0,1"), 2, "need the surface"),
                (("scatter", source, out, "--mesh", "1"), 2, "need the surface"),
                (("radiosity", source, self.path("out.vtp")), 2, "is none of"),
                (("scatter", source, out, *options, "--model", "monte-carlo"), 1,
                 "give the surface")):
            self.check_failure(self.run_command(*arguments), code, message, "out.vti")

    def test_usage(self):
        source = self.make_lit_cube()
        out = self.path("out.vtp")
        for arguments, message in (
                ((), "COMMAND"),
                (("radiosity", source), "output"),
                (("radiosity", source, out, "--solver", "magic"), "invalid choice"),
                (("radiosity", source, out, "--tolerance", "5"), "--tolerance: 5 is out of range"),
                (("radiosity", source, self.path("out.ply")), "is not a .vtp file"),
                (("radiosity", self.path("in.xyz"), out), "is none of"),
                (("scatter", source, out, "--light", "1,2"), "is not X,Y,Z"),
                (("scatter", source, out, "--light", "0,0,0"), "is not X,Y,Z")):
            self.check_failure(self.run_command(*arguments), 2, message)

    def test_failures(self):
        out = self.path("out.vtp")
        missing = self.path("none.vtp")
        self.check_failure(self.run_command("radiosity", missing, out), 1, "no such file")
        bare = self.save("bare.vtp", make_cube())
        self.check_failure(self.run_command("radiosity", bare, out), 1, "Reflectance")
        self.check_failure(self.run_command("scatter", bare, out), 1, "Irradiance")
        broken = add_array(make_cube(first=math.nan), "Emission", [1.0] * 6)
        broken = self.save("nan.vtp", add_array(broken, "Reflectance", [0.5] * 6))
        self.check_failure(self.run_command("radiosity", broken, out), 1, "finite")
        garbage = self.path("garbage.vtp")
        with open(garbage, "w", encoding="utf-8") as stream:
            stream.write("<VTKFile type='PolyData'><broken")
        self.check_failure(self.run_command("radiosity", garbage, out), 1, "garbage.vtp")
        lit = self.make_lit_cube()
        # Before anything is computed: nothing would come of it.
        os.mkdir(self.path("folder.vtp"))
        for out, reason in (("no/such/out.vtp", "folder must exist"),
                            ("folder.vtp", "that of a folder")):
            result = self.run_command("radiosity", lit, self.path(out))
            self.check_failure(result, 1, reason)
            self.assertNotIn("read: ", result.stderr)

    def test_failure_keeps_the_older_file(self):
        with open(self.path("out.vtp"), "w", encoding="utf-8") as stream:
            stream.write("older")
        bare = self.save("bare.vtp", make_cube())
        result = self.run_command("radiosity", bare, self.path("out.vtp"))
        self.check_failure(result, 1, "Reflectance")
        with open(self.path("out.vtp"), encoding="utf-8") as stream:
            self.assertEqual(stream.read(), "older")


if __name__ == "__main__":
    unittest.main()
