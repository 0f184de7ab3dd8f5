# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Nothing that users give ends the process: little memory, arrays of wrong lengths or names."""

import math
import os
import resource
import tempfile
import unittest

import vtklighttransport as lt
from vtkmodules.vtkCommonCore import (
    vtkDoubleArray,
    vtkLogger,
    vtkOutputWindow,
    vtkStringArray,
    vtkStringOutputWindow,
)
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersSources import vtkSphereSource, vtkTessellatedBoxSource
from vtkmodules.vtkRenderingCore import vtkLight

MEGABYTE = 1 << 20
# Megabytes beyond what is there after loading.
LIMITS = (0, 10, 15, 20, 30, 50, 100, 200, 500, 2000)
CELLS = 1  # of the kinds of elements of vtkDataObject
ZIP = lt.vtkOpenEXRWriter.COMPRESSION_ZIP
DWAB = lt.vtkOpenEXRWriter.COMPRESSION_DWAB
FILTERS = ("vtkDirectIrradiance", "vtkPatchMesher", "vtkRadiosity", "vtkSubsurfaceScattering",
           "vtkSurfaceAtlas", "vtkViewFactors")


def fill(data, name, value=0.5, components=1, tuples=None, kind=vtkDoubleArray):
    array = kind()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(data.GetNumberOfTuples() if tuples is None else tuples)
    if kind is vtkDoubleArray:
        array.Fill(value)
    data.AddArray(array)


def make_sphere(side):
    source = vtkSphereSource()
    source.SetThetaResolution(side)
    source.SetPhiResolution(side)
    source.Update()
    surface = source.GetOutput()
    surface.GetPointData().Initialize()
    for name in ("Reflectance", "Emission", "Irradiance"):
        fill(surface.GetCellData(), name, tuples=surface.GetNumberOfCells())
    return surface


def make_filter(name, surface, **properties):
    made = getattr(lt, name)()
    made.SetInputDataObject(surface)
    if name == "vtkDirectIrradiance":
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetPosition(2, 3, 4)
        made.AddLight(light)
    for key, value in properties.items():
        getattr(made, "Set" + key)(value)
    return made


def make_box(side):
    """Points are duplicated at its edges."""
    source = vtkTessellatedBoxSource()
    source.SetLevel(side)
    source.QuadsOn()
    source.Update()
    surface = source.GetOutput()
    for name in ("Reflectance", "Emission", "Irradiance"):
        fill(surface.GetCellData(), name, tuples=surface.GetNumberOfCells())
    fill(surface.GetPointData(), "Weight", components=4, tuples=surface.GetNumberOfPoints())
    return surface


def make_image(side):
    image = vtkImageData()
    image.SetDimensions(side, side, 1)
    fill(image.GetPointData(), "Pixels", components=4, tuples=side * side)
    image.GetPointData().SetActiveScalars("Pixels")
    return image


def make_atlas(side):
    made = make_filter("vtkSurfaceAtlas", make_sphere(side), Resolution=64)
    made.Update()
    return made.GetOutputDataObject(0)


def make_transfer():
    made = lt.vtkAtlasToSurface()
    made.SetInputDataObject(0, make_atlas(20))
    made.SetInputDataObject(1, make_image(64))
    return made


def make_writer(compression, folder):
    made = lt.vtkOpenEXRWriter()
    made.SetInputDataObject(make_image(512))
    made.SetFileName(os.path.join(folder, f"{compression}.exr"))
    made.SetCompression(compression)
    return made


def make_reader(compression, folder):
    made = lt.vtkOpenEXRReader()
    writer = make_writer(compression, folder)
    writer.Write()
    made.SetFileName(writer.GetFileName())
    return made


# With properties that keep the work short.
CASES = {
    "lights": lambda _: make_filter("vtkDirectIrradiance", make_sphere(100)),
    "creases": lambda _: make_filter("vtkDirectIrradiance", make_box(30)),
    "view factors": lambda _: make_filter("vtkViewFactors", make_sphere(30), Tolerance=0.5),
    "radiosity": lambda _: make_filter("vtkRadiosity", make_sphere(30), ViewFactorTolerance=0.5),
    "clusters": lambda _: make_filter("vtkRadiosity", make_sphere(40),
                                      LinkMethod=lt.vtkRadiosity.LINK_METHOD_HIERARCHICAL,
                                      LinkTolerance=0.5),
    "scattering": lambda _: make_filter("vtkSubsurfaceScattering", make_sphere(40),
                                        LinkTolerance=0.01),
    "mesher": lambda _: make_filter("vtkPatchMesher", make_box(10), TargetEdgeLength=0.1),
    "atlas": lambda _: make_filter("vtkSurfaceAtlas", make_sphere(20)),
    "texels of a surface": lambda _: make_filter("vtkSurfaceToAtlas", make_atlas(20),
                                                 Resolution=512),
    "surface of texels": lambda _: make_transfer(),
    "reader": lambda folder: make_reader(DWAB, folder),
    "writer": lambda folder: make_writer(DWAB, folder),
    "writer of lines": lambda folder: make_writer(ZIP, folder),
}


def is_number(getter):
    try:
        return isinstance(getter(), float)
    except TypeError:  # it takes arguments
        return False


def run_in_little_memory(made, megabytes, message="ERROR"):
    """How a child process ended that has this much; it says nothing but an error."""
    child = os.fork()
    if child == 0:
        with open("/proc/self/status", encoding="ascii") as status:
            used = next(int(line.split()[1]) for line in status if line.startswith("VmSize"))
        limit = used * 1024 + megabytes * MEGABYTE
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        if made.IsA("vtkWriter"):
            made.Write()
            has_result = made.GetErrorCode() == 0
        else:
            made.Update()
            has_result = made.GetOutputDataObject(0).GetNumberOfElements(CELLS) > 0
        has_error = message in vtkOutputWindow.GetInstance().GetOutput()
        os._exit(0 if has_result != has_error else 3)
    status = os.waitpid(child, 0)[1]
    return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


class TestHostileInput(unittest.TestCase):
    def setUp(self):
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        self.messages = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.messages)

    def update(self, made):
        made.Update()
        return self.messages.GetOutput()

    def test_little_memory(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, make in CASES.items():
                made = make(folder)
                for megabytes in LIMITS:
                    with self.subTest(case=name, megabytes=megabytes):
                        self.assertEqual(run_in_little_memory(made, megabytes), 0)

    def test_more_triangles_than_memory(self):
        for properties in ({"TargetEdgeLength": 1e-3}, {"TargetNumberOfPatches": 10000000}):
            made = make_filter("vtkPatchMesher", make_box(1), **properties)
            with self.subTest(**properties):
                self.assertEqual(run_in_little_memory(made, 500, "triangles need"), 0)

    def test_arrays_of_wrong_length(self):
        for name in FILTERS:
            for kind in (vtkDoubleArray, vtkStringArray):
                for association in ("cell", "point"):
                    for more in (-1, 1):
                        surface = make_sphere(8)
                        is_cell = association == "cell"
                        data = surface.GetCellData() if is_cell else surface.GetPointData()
                        count = surface.GetNumberOfElements(1 if is_cell else 0)
                        fill(data, "Wrong", tuples=count + more, kind=kind)
                        made = make_filter(name, surface)
                        with self.subTest(filter=name, association=association, more=more):
                            text = self.update(made)
                            self.assertIn(f'{association} array "Wrong" has {count + more}', text)
                            self.assertEqual(made.GetOutputDataObject(0).GetNumberOfCells(), 0)
                            self.setUp()

    def test_properties_that_are_no_numbers(self):
        """VTK's clamping lets them through."""
        for name in (*FILTERS, "vtkSingleScattering"):
            made = make_filter(name, make_sphere(8))
            for key in [entry[3:] for entry in dir(made) if entry.startswith("Set")]:
                getter = getattr(made, "Get" + key, None)
                if key.startswith("Progress") or not getter or not is_number(getter):
                    continue
                usual = getter()
                getattr(made, "Set" + key)(math.nan)
                with self.subTest(filter=name, property=key):
                    self.assertIn(f"{key} is n", self.update(made))
                    self.assertEqual(made.GetOutputDataObject(0).GetNumberOfCells(), 0)
                getattr(made, "Set" + key)(usual)
                self.setUp()

    def test_near_misses(self):
        surface = make_sphere(8)
        surface.GetCellData().RemoveArray("Emission")
        fill(surface.GetCellData(), "Emissions", tuples=surface.GetNumberOfCells())
        text = self.update(make_filter("vtkRadiosity", surface))
        self.assertIn('There is "Emissions": did you mean it?', text)

    def test_net_flux_without_temperature(self):
        surface = make_sphere(8)
        cells = surface.GetCellData()
        cells.RemoveArray("Emission")
        for name in ("Emissivity", "BoundaryCondition", "PrescribedNetFlux"):
            fill(cells, name, 1.0, tuples=surface.GetNumberOfCells())
        text = self.update(make_filter("vtkRadiosity", surface))
        self.assertIn('no temperature: add a cell array "Temperature"', text)

    def test_results_are_finite(self):
        made = make_filter("vtkSubsurfaceScattering", make_sphere(8))
        made.SetMaterial(0)
        made.SetAbsorptionCoefficient(1e300, 2.0, 1.0)
        text = self.update(made)
        values = made.GetOutputDataObject(0).GetCellData().GetArray("ScatteredIrradiance")
        self.assertTrue(
            math.isfinite(values.GetComponent(0, 0)) if values else "is not finite" in text
        )


if __name__ == "__main__":
    unittest.main()
