# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Mesher, radiosity, direct irradiance, scattering and view factors through proxies.

Every array is as it comes from the classes themselves; the tables of groups are as they must be,
and so are time steps.
"""

import PluginTools as tools

import vtklighttransport as lt
from paraview import simple
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
from vtkmodules.vtkRenderingCore import vtkLight

TOLERANCE = 1e-12
# What a run is about, and times.
MEASURED = ("Seconds",)
# From one unit square to another at a distance of 1, and what of it is right in single precision.
OPPOSITE = 0.199824895698387
SINGLE = 1e-6


def run(algorithm, data):
    algorithm.SetInputDataObject(0, data)
    algorithm.Update()
    return algorithm.GetOutputDataObject(0)


def read(reader, name):
    reader.SetFileName(tools.get_data(name))
    reader.Update()
    return reader.GetOutput()


def run_classes():
    mesher = lt.vtkPatchMesher()
    mesher.SetTargetEdgeLength(80.0)
    room = run(mesher, read(vtkXMLPolyDataReader(), "cornell_box.vtp"))
    radiosity = lt.vtkRadiosity()
    radiosity.SetDeviceToCPU()
    results = {"Radiosity": run(radiosity, room), "Convergence": radiosity.GetConvergence()}

    mesher = lt.vtkPatchMesher()
    mesher.SetTargetEdgeLength(0.8)
    bunny = run(mesher, read(vtkPLYReader(), "bunny.ply"))
    irradiance = lt.vtkDirectIrradiance()
    irradiance.SetRefractiveIndex(1.5)
    light = vtkLight()
    light.SetPosition(1.0, 2.0, 3.0)
    light.SetIntensity(2.0)
    point = vtkLight()
    point.PositionalOn()
    point.SetConeAngle(180.0)
    point.SetAttenuationValues(0.0, 0.0, 1.0)
    point.SetPosition(-20.0, 10.0, 5.0)
    point.SetIntensity(300.0)
    point.SetDiffuseColor(1.0, 0.5, 0.25)
    irradiance.AddLight(light)
    irradiance.AddLight(point)
    scattering = lt.vtkSubsurfaceScattering()
    scattering.SetMaterialToMarble()
    scattering.SetMillimetersPerUnit(10.0)
    scattering.SetIncidenceToTransmitted()
    scattering.SetDeviceToCPU()
    results["Subsurface Scattering"] = run(scattering, run(irradiance, bunny))
    return results


def run_proxies():
    reader = simple.XMLPolyDataReader(FileName=[tools.get_data("cornell_box.vtp")])
    mesher = simple.PatchMesher(Input=reader, TargetEdgeLength=80.0)
    radiosity = simple.Radiosity(Input=mesher, Device="CPU")
    results = {
        "Radiosity": simple.servermanager.Fetch(radiosity, idx=0),
        "Convergence": simple.servermanager.Fetch(radiosity, idx=1)}

    reader = simple.PLYReader(FileNames=[tools.get_data("bunny.ply")])
    mesher = simple.PatchMesher(Input=reader, TargetEdgeLength=0.8)
    irradiance = simple.DirectIrradiance(Input=mesher, RefractiveIndex=1.5)
    irradiance.Light1.Position = [1.0, 2.0, 3.0]
    irradiance.Light1.Intensity = 2.0
    irradiance.Light2 = "Point Light"
    irradiance.Light2.Position = [-20.0, 10.0, 5.0]
    irradiance.Light2.Intensity = 300.0
    irradiance.Light2.DiffuseColor = [1.0, 0.5, 0.25]
    scattering = simple.SubsurfaceScattering(
        Input=irradiance, Material="Marble", MillimetersPerUnit=10.0, Incidence="Transmitted",
        Device="CPU")
    results["Subsurface Scattering"] = simple.servermanager.Fetch(scattering)
    return results, irradiance, scattering


def compare(name, expected, found):
    if expected.IsA("vtkTable"):
        groups = (("row", expected.GetRowData(), found.GetRowData()),)
    else:
        groups = (("cell", expected.GetCellData(), found.GetCellData()),
                  ("point", expected.GetPointData(), found.GetPointData()),
                  ("field", expected.GetFieldData(), found.GetFieldData()))
    problems = []
    for kind, first, second in groups:
        wanted, got = tools.get_arrays(first), tools.get_arrays(second)
        if not wanted and kind != "field":
            problems.append(f"{name} has no {kind} array")
        for array_name, array in wanted.items():
            label = f"{name}: {kind} array {array_name}"
            if array_name.endswith(MEASURED):
                continue
            if array.IsA("vtkStringArray"):
                if array_name not in got or got[array_name].GetValue(0) != array.GetValue(0):
                    problems.append(label + " differs")
            else:
                problems.append(tools.compare_arrays(label, array, got.get(array_name), TOLERANCE))
    return [problem for problem in problems if problem]


def test_lights(irradiance, scattering):
    """A light that is changed or exchanged reaches the filter, and what follows runs again."""
    def get_flux():
        fields = simple.servermanager.Fetch(scattering).GetFieldData()
        return fields.GetArray("EnteringFlux").GetTuple(0)

    problems = []
    before = get_flux()
    irradiance.Light2.Intensity = 0.0
    irradiance.Light1.Intensity = 4.0
    irradiance.Light1.DiffuseColor = [0.5, 0.5, 0.5]
    first = get_flux()
    irradiance.Light2 = "No Light"
    irradiance.Light1.Intensity = 2.0
    irradiance.Light1.DiffuseColor = [1.0, 1.0, 1.0]
    second = get_flux()
    if not before[0] > first[0] * 1.01:
        problems.append(f"switching a light down did not lessen the flux: {before}, {first}")
    if any(abs(a - b) > TOLERANCE * a for a, b in zip(first, second)):
        problems.append(f"the same light by other numbers gives another flux: {first}, {second}")
    light = simple.CreateLight()
    light.Coords = "Scene"
    light.Position = [1.0, 2.0, 3.0]
    light.Intensity = 2.0
    irradiance.Lights = [light]
    third = get_flux()
    if any(abs(2.0 * a - b) > 1e-9 * b for a, b in zip(second, third)):
        problems.append(f"ParaView's own light did not add up: {second}, {third}")
    return problems


def make_squares():
    """Two unit squares that face each other, of 9 and 16 patches, with the cell array Zone."""
    bottom = simple.Plane(Origin=[0, 0, 0], Point1=[1, 0, 0], Point2=[0, 1, 0],
                          XResolution=3, YResolution=3)
    top = simple.Plane(Origin=[0, 0, 1], Point1=[0, 1, 1], Point2=[1, 0, 1],
                       XResolution=4, YResolution=4)
    return [simple.Calculator(Input=plane, AttributeType="Cell Data", ResultArrayName="Zone",
                              Function=str(zone)) for plane, zone in ((bottom, 5), (top, 3))]


def test_table(name, factors, bottom, top):
    """Two groups, by their names; top may be None: then both squares are one group."""
    table = simple.servermanager.Fetch(factors, idx=1)
    columns = {key: [array.GetValue(i) for i in range(array.GetNumberOfValues())]
               for key, array in tools.get_arrays(table.GetRowData()).items()}
    if top is None:
        expected = {"Area": {bottom: 2}, bottom: {bottom: OPPOSITE}}
    else:
        expected = {"Area": {bottom: 1, top: 1}, bottom: {bottom: 0, top: OPPOSITE},
                    top: {bottom: OPPOSITE, top: 0}}
    rows = expected["Area"]
    expected["Sky"] = {row: 1 - OPPOSITE for row in rows}
    expected["BackFace"] = {row: 0 for row in rows}
    found = {key: dict(zip(columns.get("Group", ()), values))
             for key, values in columns.items() if key != "Group"}
    if {key: set(column) for key, column in found.items()} != {key: set(rows) for key in expected}:
        return [f"{name}: the table has {columns}"]
    return [f"{name}: {column} of {row} is {found[column][row]}, not {value}"
            for column, values in expected.items() for row, value in values.items()
            if not abs(found[column][row] - value) <= SINGLE]


def test_groups():
    squares = make_squares()
    scene = simple.AppendGeometry(Input=squares)
    factors = simple.ViewFactors(Input=scene)
    problems = test_table("no array of groups", factors, "All", None)
    factors.Group = ["CELLS", "Zone"]
    problems += test_table("an array of groups", factors, "5", "3")
    factors.Input = simple.Calculator(Input=scene, AttributeType="Cell Data",
                                      ResultArrayName="Group", Function="Zone - 8")
    factors.Group = ["CELLS", ""]
    problems += test_table("the array Group", factors, "-3", "-5")
    blocks = simple.GroupDatasets(Input=squares, BlockNames=["floor", "ceiling"])
    return problems + test_table("blocks", simple.ViewFactors(Input=blocks), "floor", "ceiling")


def test_medium():
    """An image on the second input of scattering, connected and not."""
    box = simple.Calculator(Input=simple.Box(), AttributeType="Cell Data",
                            ResultArrayName="Irradiance", Function="1")
    scattering = simple.SubsurfaceScattering(Input=box, Model="Monte Carlo", NumberOfPhotons=3000)

    def get_share():
        fields = simple.servermanager.Fetch(scattering).GetFieldData()
        return fields.GetArray("LeavingShare").GetTuple(0)

    without = get_share()
    image = simple.Wavelet(WholeExtent=[-1, 1, -1, 1, -1, 1])
    scattering.Medium = simple.Calculator(Input=image, AttributeType="Point Data",
                                          ResultArrayName="Absorption", Function="5")
    within = get_share()
    scattering.Medium = None
    problems = []
    if not within[0] < 0.5 * without[0]:
        problems.append(f"a medium that absorbs gives back {within}, and without {without}")
    if get_share() != without:
        problems.append(f"a medium that is taken away still counts: {get_share()}")
    return problems


def test_movement():
    """Time steps of a ball that is twisted: links are kept from one to the next, unless asked."""
    ball = simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData",
        Script="""
import math
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkFiltersSources import vtkSphereSource
sphere = vtkSphereSource()
sphere.SetThetaResolution(24)
sphere.SetPhiResolution(16)
sphere.Update()
output = self.GetPolyDataOutput()
output.DeepCopy(sphere.GetOutput())
turn = self.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
points = output.GetPoints()
for point in range(points.GetNumberOfPoints()):
    x, y, z = points.GetPoint(point)
    c, s = math.cos(turn * z), math.sin(turn * z)
    points.SetPoint(point, c * x - s * y, s * x + c * y, z)
light = vtkDoubleArray()
light.SetName("Irradiance")
for cell in range(output.GetNumberOfCells()):
    light.InsertNextValue(cell % 5)
output.GetCellData().AddArray(light)
""",
        ScriptRequestInformation="""
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
information = self.GetOutputInformation(0)
information.Set(pipeline.TIME_STEPS(), [0.0, 0.2, 0.4], 3)
information.Set(pipeline.TIME_RANGE(), [0.0, 0.4], 2)
""")
    scattering = simple.SubsurfaceScattering(
        Input=ball, Material="Marble", MillimetersPerUnit=20.0, LinkMethod="Adaptive", Device="CPU")

    def get_shares():
        shares = []
        for time in (0.0, 0.2, 0.4):
            scattering.UpdatePipeline(time)
            result = scattering.GetClientSideObject().GetOutputDataObject(0)
            shares.append(tools.get_summary(result, "LinksReused"))
        return shares

    shares = get_shares()
    scattering.ReuseLinks = 0
    fresh = get_shares()
    if shares[0] != 0.0 or not min(shares[1:]) > 0.9 or any(fresh):
        return [f"of the links of time steps {shares} are kept, and where none should be {fresh}"]
    return []


expected_results = run_classes()
found_results, irradiance_proxy, scattering_proxy = run_proxies()
all_problems = []
for key, result in expected_results.items():
    all_problems += compare(key, result, found_results[key])
for key, array_name in (
        ("Radiosity", "Radiosity"), ("Subsurface Scattering", "ScatteredIrradiance")):
    if expected_results[key].GetCellData().GetArray(array_name).GetRange(0)[1] <= 0.0:
        all_problems.append(f"{array_name} is zero everywhere: nothing was compared")
all_problems += test_lights(irradiance_proxy, scattering_proxy)
all_problems += test_groups()
all_problems += test_medium()
all_problems += test_movement()
tools.finish(all_problems)
