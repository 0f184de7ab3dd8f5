# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Nothing that users give ends the process: little memory, arrays of wrong lengths or names."""

import math
import os
import resource
import unittest

import vtklighttransport as lt
from vtkmodules.vtkCommonCore import (
    vtkDoubleArray,
    vtkLogger,
    vtkOutputWindow,
    vtkStringArray,
    vtkStringOutputWindow,
)
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkLight

MEGABYTE = 1 << 20
LIMITS = (50, 100, 200, 500, 2000)  # megabytes beyond what is there after loading


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


# Filter, points along the sides of the sphere, properties that keep the work short.
FILTERS = (
    ("vtkDirectIrradiance", 200, {}),
    ("vtkViewFactors", 40, {"Tolerance": 0.5}),
    ("vtkRadiosity", 40, {"ViewFactorTolerance": 0.5}),
    ("vtkRadiosity", 60, {"LinkMethod": 2, "LinkTolerance": 0.5}),  # hierarchical
    ("vtkSubsurfaceScattering", 60, {"LinkTolerance": 0.01}),
    ("vtkPatchMesher", 60, {"TargetEdgeLength": 0.05}),
    ("vtkSurfaceAtlas", 40, {}),
)


def run_in_little_memory(case, megabytes, surface):
    """How a child process ended that has this much; it says nothing."""
    child = os.fork()
    if child == 0:
        with open("/proc/self/status", encoding="ascii") as status:
            used = next(int(line.split()[1]) for line in status if line.startswith("VmSize"))
        limit = used * 1024 + megabytes * MEGABYTE
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
        made = make_filter(case[0], surface, **case[2])
        made.Update()
        has_cells = made.GetOutputDataObject(0).GetNumberOfCells() > 0
        has_error = "ERROR" in vtkOutputWindow.GetInstance().GetOutput()
        os._exit(0 if has_cells != has_error else 3)
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
        for case in FILTERS:
            surface = make_sphere(case[1])
            for megabytes in LIMITS:
                with self.subTest(filter=case[0], megabytes=megabytes, properties=case[2]):
                    self.assertEqual(run_in_little_memory(case, megabytes, surface), 0)

    def test_arrays_of_wrong_length(self):
        for name in sorted({case[0] for case in FILTERS}):
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
