#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration: a Cornell box, two bunnies and a dragon, from mesh to arrays, pictures and tables.

    demo.py FOLDER

writes into FOLDER (made when missing) and ends by listing its files. Exit status 1 when devices disagree or energy is not kept.
"""

import csv
import math
import os
import sys
import time

import numpy

import vtklighttransport as lt
from vtklighttransport.arrays import get_cell_array, get_point_array, get_summary, make_surface
from vtkmodules.util.misc import calldata_type
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, reference
from vtkmodules.vtkCommonDataModel import vtkGenericCell, vtkPolyData, vtkStaticCellLocator
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkLight

import demo_atlas
import demo_pictures
import demo_plots

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")

# Two devices, or two solvers, agree when no value differs by more than this fraction of the largest one.
AGREEMENT = 1e-5


class DemoError(RuntimeError):
    """Something that the demonstration shows does not hold."""


def update(algorithm):
    """Run a filter; an error that it reports is an exception here."""
    errors = []

    @calldata_type(VTK_STRING)
    def remember(_caller, _event, text):
        errors.append(text)

    tag = algorithm.AddObserver("ErrorEvent", remember)
    begin = time.perf_counter()
    algorithm.Update()
    seconds = time.perf_counter() - begin
    algorithm.RemoveObserver(tag)
    if errors:
        raise DemoError(errors[0].strip())
    return seconds


def snapshot(algorithm):
    """A copy of a filter's surface, so that the filter can run again."""
    surface = vtkPolyData()
    surface.ShallowCopy(algorithm.GetOutput())
    return surface


def triangle_corners(surface):
    """Point ids of the cells of a triangle mesh: cells x 3."""
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def triangles(surface):
    """Corners of the cells of a triangle mesh: cells x 3 x 3."""
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[triangle_corners(surface)]


def cell_areas(surface):
    a, b, c = numpy.moveaxis(triangles(surface), 1, 0)
    return 0.5 * numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1)


def difference(values, reference):
    """The largest difference, as a fraction of the largest value."""
    return numpy.abs(values - reference).max() / numpy.abs(reference).max()


def demand_agreement(what, values, reference):
    found = difference(values, reference)
    print(f"  {what}: they differ by {found:.1e} of the largest value")
    if not found <= AGREEMENT:
        raise DemoError(f"{what}: the difference is above {AGREEMENT:.0e}")
    return found


class Folder:
    """Where the results go, and what has been written there."""

    def __init__(self, path):
        self.path = path
        self.files = []
        os.makedirs(path, exist_ok=True)

    def name(self, file):
        self.files.append(file)
        return os.path.join(self.path, file)

    def write_surface(self, file, surface):
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(self.name(file))
        writer.SetInputData(surface)
        # Encoded, not raw: with the libexpat1 of Debian 12's security updates VTK 9.2 cannot read raw files.
        writer.SetDataModeToBinary()
        if not writer.Write():
            raise DemoError(f"cannot write {file}")

    def write_table(self, file, rows):
        with open(self.name(file), "w", newline="", encoding="utf-8") as stream:
            table = csv.DictWriter(stream, rows[0].keys())
            table.writeheader()
            table.writerows(rows)


# Radiosity


class RadiosityScene:
    """The Cornell box, meshed for about `patches` patches, with its view factors."""

    def __init__(self, patches):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(DATA, "cornell_box.vtp"))
        mesher = lt.vtkPatchMesher()
        mesher.SetInputConnection(reader.GetOutputPort())
        mesher.SetTargetNumberOfPatches(patches)
        self.meshing_seconds = update(mesher)
        self.surface = snapshot(mesher)
        self.factors = lt.vtkViewFactors()
        self.factors.SetInputData(self.surface)
        # Less than what shadow boundaries cost that patches do not follow.
        self.factors.SetTolerance(1e-3)
        update(self.factors)
        self.factor_seconds = get_summary(self.factors.GetOutput(), "ViewFactorSeconds")

    def solve(self, solver, device, tolerance):
        """The surface with its radiosity, and the history of the solver: columns by name."""
        radiosity = lt.vtkRadiosity()
        radiosity.SetInputData(self.surface)
        radiosity.SetViewFactors(self.factors)
        radiosity.SetSolver(solver)
        radiosity.SetDevice(device)
        radiosity.SetTolerance(tolerance)
        radiosity.SetMaximumNumberOfIterations(10000)
        update(radiosity)
        surface = snapshot(radiosity)
        if not get_summary(surface, "Converged"):
            raise DemoError(f"{get_summary(surface, 'SolverUsed')} did not converge")
        table = radiosity.GetConvergence()
        history = {
            table.GetColumnName(i): vtk_to_numpy(table.GetColumn(i)).astype(float)
            for i in range(table.GetNumberOfColumns())
        }
        return surface, history


# Label, solver, device.
SOLVERS = [
    ("Jacobi, CPU", lt.vtkRadiosity.SOLVER_JACOBI, lt.vtkRadiosity.DEVICE_CPU),
    ("Jacobi, OpenGL", lt.vtkRadiosity.SOLVER_JACOBI, lt.vtkRadiosity.DEVICE_OPENGL),
    ("Gauss-Seidel, CPU", lt.vtkRadiosity.SOLVER_GAUSS_SEIDEL, lt.vtkRadiosity.DEVICE_CPU),
    ("Auto, CPU", lt.vtkRadiosity.SOLVER_AUTO, lt.vtkRadiosity.DEVICE_CPU),
]


def solve_with_all(scene, folder):
    """All solvers to a tight tolerance. Gives the default solver's surface, and how much the others differ from it."""
    results = {}
    histories = {}
    for label, solver, device in SOLVERS:
        surface, history = scene.solve(solver, device, 1e-7)
        results[label] = surface
        histories[label] = history
        used = get_summary(surface, "DeviceUsed")
        print(
            f"  {label}: {len(history['Iteration'])} iterations, {history['Seconds'][-1]:.3f} s on {used}"
        )
    default = results["Auto, CPU"]
    differences = {
        label: demand_agreement(
            f"{label} and the default solver",
            get_cell_array(results[label], "Radiosity"),
            get_cell_array(default, "Radiosity"),
        )
        for label in results
        if label != "Auto, CPU"
    }
    folder.write_table("cornell_convergence.csv", history_rows(histories))
    demo_plots.plot_convergence(folder.name("cornell_convergence.png"), histories)
    return default, differences


def history_rows(histories):
    return [
        {"Solver": label, **{name: float(column[i]) for name, column in history.items()}}
        for label, history in histories.items()
        for i in range(len(history["Iteration"]))
    ]


# Error against a finer solution


def subdivide(corners):
    """Each triangle in four: n x 3 x 3 become 4n x 3 x 3."""
    a, b, c = numpy.moveaxis(corners, 1, 0)
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return numpy.concatenate([numpy.stack(part, axis=1) for part in parts])


def barycentric(corners, points):
    """Barycentric coordinates of points in the planes of triangles: n x 3."""
    a, b, c = numpy.moveaxis(corners, 1, 0)
    normal = numpy.cross(b - a, c - a)
    square = (normal**2).sum(axis=1)
    second = (numpy.cross(points - a, c - a) * normal).sum(axis=1) / square
    third = (numpy.cross(b - a, points - a) * normal).sum(axis=1) / square
    return numpy.stack([1.0 - second - third, second, third], axis=1)


def reflected(surface):
    """Radiosity without emission: the lamp's own light is known, and would hide the errors of all else."""
    return get_cell_array(surface, "Radiosity") - get_cell_array(surface, "Emission")


class FineSolution:
    """A solution on many patches, to be averaged over the patches of a coarser mesh of the same scene.

    Within a patch it is taken as linear: the slope of the point values about the value of the cell.
    """

    PIECES = 16

    def __init__(self, surface):
        self.surface = surface
        self.corners = triangles(surface)
        self.regions = get_cell_array(surface, "Region")
        self.values = reflected(surface)
        at_corners = get_point_array(surface, "Radiosity")[triangle_corners(surface)]
        self.slopes = at_corners - at_corners.mean(axis=1, keepdims=True)

    def average_over(self, surface):
        """The means over the cells of another mesh, from equal pieces of each cell."""
        points = subdivide(subdivide(triangles(surface))).mean(axis=1)
        regions = numpy.tile(get_cell_array(surface, "Region"), self.PIECES)
        cells = self.find_cells(points, regions)
        weights = barycentric(self.corners[cells], points)
        values = self.values[cells] + (weights[:, :, None] * self.slopes[cells]).sum(axis=1)
        return values.reshape(self.PIECES, surface.GetNumberOfCells(), -1).mean(axis=0)

    def find_cells(self, points, regions):
        """The cell of the same region that each point lies on."""
        found = numpy.empty(len(points), dtype=int)
        for region in numpy.unique(regions):
            own = numpy.flatnonzero(self.regions == region)
            part = make_surface(
                vtk_to_numpy(self.surface.GetPoints().GetData()),
                triangle_corners(self.surface)[own],
            )
            wanted = numpy.flatnonzero(regions == region)
            found[wanted] = own[closest_cells(part, points[wanted])]
        return found


def closest_cells(surface, points):
    locator = vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    closest, generic = [0.0, 0.0, 0.0], vtkGenericCell()
    cell, sub, distance = reference(0), reference(0), reference(0.0)
    found = numpy.empty(len(points), dtype=int)
    for i, point in enumerate(points):
        locator.FindClosestPoint(point, closest, generic, cell, sub, distance)
        found[i] = cell.get()
    return found


def relative_error(values, exact, areas):
    """Root mean square over the surface and the bands, relative to that of the exact values."""
    weights = areas[:, None]
    return math.sqrt((weights * (values - exact) ** 2).sum() / (weights * exact**2).sum())


def show_error_against_time(folder, scenes, fine_count):
    print(f"Cornell box: error against a solution with about {fine_count} patches")
    scene = RadiosityScene(fine_count)
    surface, _ = scene.solve(lt.vtkRadiosity.SOLVER_AUTO, lt.vtkRadiosity.DEVICE_CPU, 1e-6)
    fine = FineSolution(surface)
    print(
        f"  {surface.GetNumberOfCells()} patches: form factors {scene.factor_seconds:.2f} s,"
        f" solver {get_summary(surface, 'SolverSeconds'):.2f} s"
    )
    rows = []
    for scene in scenes:
        exact = fine.average_over(scene.surface)
        for label, solver, device in SOLVERS:
            surface, history = scene.solve(solver, device, 1e-5)
            rows.append(error_row(label, scene, surface, history, exact))
    folder.write_table("cornell_error_time.csv", rows)
    demo_plots.plot_error_against_time(folder.name("cornell_error_time.png"), rows)
    return rows


def error_row(label, scene, surface, history, exact):
    solver_seconds = get_summary(surface, "SolverSeconds")
    row = {
        "Patches": surface.GetNumberOfCells(),
        "Solver": label,
        "MeshingSeconds": round(scene.meshing_seconds, 4),
        "FormFactorSeconds": round(scene.factor_seconds, 4),
        "SolverSeconds": round(solver_seconds, 5),
        "TotalSeconds": round(scene.meshing_seconds + scene.factor_seconds + solver_seconds, 4),
        "Iterations": len(history["Iteration"]),
        "RelativeError": relative_error(reflected(surface), exact, cell_areas(surface)),
    }
    print(
        f"  {row['Patches']:5d} patches, {label:18s} solver {solver_seconds:8.4f} s,"
        f" total {row['TotalSeconds']:7.2f} s, error {100 * row['RelativeError']:.2f} %"
    )
    return row


# Subsurface scattering


def light_from(direction):
    """A directional white light of unit irradiance."""
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.PositionalOff()
    light.SetPosition(direction)
    light.SetFocalPoint(0.0, 0.0, 0.0)
    light.SetIntensity(1.0)
    return light


def illuminate(surface, light, refractive_index):
    direct = lt.vtkDirectIrradiance()
    direct.SetInputData(surface)
    direct.AddLight(light)
    direct.SetRefractiveIndex(refractive_index)
    seconds = update(direct)
    return snapshot(direct), seconds


class Translucent:
    """An object of one material; its links are computed once and serve all lights and devices."""

    def __init__(self, material):
        self.filter = lt.vtkSubsurfaceScattering()
        self.filter.SetMaterial(material)
        self.filter.SetMillimetersPerUnit(10.0)
        self.filter.SetIncidenceToTransmitted()
        self.scattering, self.absorption, index = [0.0] * 3, [0.0] * 3, reference(0.0)
        self.filter.GetMaterialProperties(material, self.scattering, self.absorption, index)
        self.refractive_index = index.get()

    def light(self, surface, direction):
        return illuminate(surface, light_from(direction), self.refractive_index)

    def scatter(self, surface, device):
        self.filter.SetInputData(surface)
        self.filter.SetDevice(device)
        seconds = update(self.filter)
        return snapshot(self.filter), seconds

    def flat_reflectance(self):
        """What a flat, endless surface gives back of the light that enters (Jensen et al. 2001), per band."""
        n = self.refractive_index
        internal = -1.4399 / n**2 + 0.7099 / n + 0.6681 + 0.0636 * n
        mismatch = (1.0 + internal) / (1.0 - internal)
        scattering, absorption = numpy.array(self.scattering), numpy.array(self.absorption)
        albedo = scattering / (scattering + absorption)
        root = numpy.sqrt(3.0 * (1.0 - albedo))
        return albedo / 2.0 * (1.0 + numpy.exp(-4.0 / 3.0 * mismatch * root)) * numpy.exp(-root)


# The bunny is curved over many mean free paths: it gives back nearly what a flat surface does, a little more in its folds.
CURVATURE_ALLOWANCE = 0.1


def demand_energy(what, surface, expected):
    """Per band, what leaves of what enters; it must be near the fraction of a flat surface, and below 1."""
    areas = cell_areas(surface)[:, None]
    entering = (areas * get_cell_array(surface, "TransmittedIrradiance")).sum(axis=0)
    leaving = (areas * get_cell_array(surface, "ScatteredIrradiance")).sum(axis=0)
    ratio = leaving / entering
    numbers = ", ".join(f"{r:.3f} ({e:.3f})" for r, e in zip(ratio, expected))
    print(f"  {what}: flux entering {entering[0]:.2f}; leaving / entering, in brackets of a flat surface: {numbers}")
    if not numpy.all(ratio < 1.0) or not numpy.allclose(ratio, expected, rtol=CURVATURE_ALLOWANCE):
        raise DemoError(f"{what}: the energy that leaves is not what the material gives back")
    return ratio


class Summary:
    """The numbers of the run, for people as they come and as a table at the end."""

    def __init__(self):
        self.rows = []

    def add(self, scene, quantity, value, unit):
        self.rows.append({"Scene": scene, "Quantity": quantity, "Value": value, "Unit": unit})

    def show(self):
        print("\nSummary")
        for row in self.rows:
            value = row["Value"]
            text = value if isinstance(value, str) else f"{value:.6g}"
            print(f"  {row['Scene']:18s} {row['Quantity']:44s} {text} {row['Unit']}")


FROM_FRONT = (-0.4, 0.8, 1.0)
FROM_BEHIND = (0.3, 0.5, -1.0)


def read_bunny():
    reader = vtkPLYReader()
    reader.SetFileName(os.path.join(DATA, "bunny.ply"))
    update(reader)
    return reader.GetOutput()


def show_bunny(folder, summary, name, material):
    print(f"Bunny, {name}")
    bunny = read_bunny()
    translucent = Translucent(material)
    lit, direct_seconds = translucent.light(bunny, FROM_FRONT)
    surface, cpu_seconds = translucent.scatter(lit, translucent.filter.DEVICE_CPU)
    on_device, device_seconds = translucent.scatter(lit, translucent.filter.DEVICE_OPENGL)
    found = demand_agreement(
        f"CPU and {get_summary(on_device, 'DeviceUsed')}",
        get_cell_array(on_device, "ScatteredIrradiance"),
        get_cell_array(surface, "ScatteredIrradiance"),
    )
    expected = translucent.flat_reflectance()
    ratio = demand_energy("light from the front", surface, expected)
    behind, _ = translucent.light(bunny, FROM_BEHIND)
    behind, _ = translucent.scatter(behind, translucent.filter.DEVICE_CPU)
    ratio_behind = demand_energy("light from behind", behind, expected)

    file = "bunny_" + name.replace(" ", "")
    folder.write_surface(file + ".vtp", surface)
    demo_pictures.render_bunny(
        folder.name(file + ".png"), surface, translucent.refractive_index, light_from(FROM_FRONT)
    )
    scene = "bunny, " + name
    summary.add(scene, "patches", surface.GetNumberOfCells(), "")
    summary.add(scene, "direct irradiance", direct_seconds, "s")
    summary.add(scene, "links, all pairs", get_summary(surface, "LinkSeconds"), "s")
    summary.add(scene, "links and scattering, CPU", cpu_seconds, "s")
    summary.add(scene, "scattering again with OpenGL", device_seconds, "s")
    summary.add(scene, "bound on the links' relative error", get_summary(surface, "LinkErrorBound"), "")
    summary.add(scene, "largest difference of CPU and OpenGL", found, "of the largest value")
    for band, color in enumerate(("red", "green", "blue")):
        summary.add(scene, f"leaving / entering, front, {color}", ratio[band], "")
        summary.add(scene, f"leaving / entering, behind, {color}", ratio_behind[band], "")


def show_cornell_box(folder, summary, scene):
    print(f"Cornell box, {scene.surface.GetNumberOfCells()} patches")
    print(f"  meshing {scene.meshing_seconds:.2f} s, form factors {scene.factor_seconds:.2f} s")
    surface, differences = solve_with_all(scene, folder)
    folder.write_surface("cornell_box.vtp", surface)
    demo_pictures.render_cornell_box(folder.name("cornell_box.png"), surface)
    name = "Cornell box"
    summary.add(name, "patches", surface.GetNumberOfCells(), "")
    summary.add(name, "meshing", scene.meshing_seconds, "s")
    summary.add(name, "form factors", scene.factor_seconds, "s")
    summary.add(name, "solver (default)", get_summary(surface, "SolverSeconds"), "s")
    for label, found in differences.items():
        summary.add(name, f"largest difference to {label}", found, "of the largest value")


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    begin = time.perf_counter()
    folder = Folder(arguments[0])
    summary = Summary()
    try:
        scenes = [RadiosityScene(patches) for patches in (250, 500, 1000, 2000)]
        show_cornell_box(folder, summary, scenes[-1])
        for row in show_error_against_time(folder, scenes, 8000):
            label = f"error, {row['Patches']} patches, {row['Solver']}"
            summary.add("Cornell box", label, row["RelativeError"], "")
        scattering = lt.vtkSubsurfaceScattering
        show_bunny(folder, summary, "marble", scattering.MATERIAL_MARBLE)
        show_bunny(folder, summary, "skim milk", scattering.MATERIAL_SKIMMILK)
        demo_atlas.show_atlas(folder, summary, DATA, sys.modules[__name__])
    except DemoError as error:
        print(f"demo.py: {error}", file=sys.stderr)
        return 1
    summary.add("all", "time", time.perf_counter() - begin, "s")
    summary.show()
    folder.write_table("summary.csv", summary.rows)
    print("\nFiles")
    for file in folder.files:
        size = os.path.getsize(os.path.join(folder.path, file))
        print(f"  {os.path.join(folder.path, file)}  {size / 1024:.0f} KiB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
