# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Radiosity of the Cornell box by all solvers, and its error against time: a part of demo.py."""

import os

import vtklighttransport as lt
from vtklighttransport.arrays import get_areas, get_cell_array, get_summary, relative_error
from vtklighttransport.meshes import make_reader
from vtkmodules.util.numpy_support import vtk_to_numpy

import demo_pictures
import demo_plots
from demo_fine_solution import FineSolution, get_reflected
from demo_tools import DATA, DemoError, demand_agreement, snapshot, update

# Label, solver, device.
SOLVERS = [
    ("Jacobi, CPU", lt.vtkRadiosity.SOLVER_JACOBI, lt.vtkRadiosity.DEVICE_CPU),
    ("Jacobi, OpenGL", lt.vtkRadiosity.SOLVER_JACOBI, lt.vtkRadiosity.DEVICE_OPENGL),
    ("Gauss-Seidel, CPU", lt.vtkRadiosity.SOLVER_GAUSS_SEIDEL, lt.vtkRadiosity.DEVICE_CPU),
    ("Auto, CPU", lt.vtkRadiosity.SOLVER_AUTO, lt.vtkRadiosity.DEVICE_CPU),
]


class RadiosityScene:
    """The Cornell box, meshed for about `patches` patches, with its view factors."""

    def __init__(self, patches):
        reader = make_reader(os.path.join(DATA, "cornell_box.vtp"))
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


def solve_with_all(scene, folder):
    """All solvers to a tight tolerance: the default's surface, and how much the others differ."""
    results = {}
    histories = {}
    for label, solver, device in SOLVERS:
        surface, history = scene.solve(solver, device, 1e-7)
        results[label] = surface
        histories[label] = history
        used = get_summary(surface, "DeviceUsed")
        seconds = history["Seconds"][-1]
        print(f"  {label}: {len(history['Iteration'])} iterations, {seconds:.3f} s on {used}")
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
    folder.write_table("cornell_convergence.csv", make_history_rows(histories))
    demo_plots.plot_convergence(folder.name("cornell_convergence.png"), histories)
    return default, differences


def make_history_rows(histories):
    return [
        {"Solver": label, **{name: float(column[i]) for name, column in history.items()}}
        for label, history in histories.items()
        for i in range(len(history["Iteration"]))
    ]


def show_cornell_box(folder, summary, scene):
    print(f"Cornell box, {scene.surface.GetNumberOfCells()} patches")
    print(f"  meshing {scene.meshing_seconds:.2f} s, form factors {scene.factor_seconds:.2f} s")
    surface, differences = solve_with_all(scene, folder)
    folder.write_data("cornell_box.vtp", surface)
    demo_pictures.render_cornell_box(folder.name("cornell_box.png"), surface)
    name = "Cornell box"
    summary.add(name, "patches", surface.GetNumberOfCells(), "")
    summary.add(name, "meshing", scene.meshing_seconds, "s")
    summary.add(name, "form factors", scene.factor_seconds, "s")
    summary.add(name, "solver (default)", get_summary(surface, "SolverSeconds"), "s")
    for label, found in differences.items():
        summary.add(name, f"largest difference to {label}", found, "of the largest value")


def show_error_against_time(folder, summary, scenes, fine_count):
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
            rows.append(make_error_row(label, scene, surface, history, exact))
    folder.write_table("cornell_error_time.csv", rows)
    demo_plots.plot_error_against_time(folder.name("cornell_error_time.png"), rows)
    for row in rows:
        label = f"error, {row['Patches']} patches, {row['Solver']}"
        summary.add("Cornell box", label, row["RelativeError"], "")


def make_error_row(label, scene, surface, history, exact):
    solver_seconds = get_summary(surface, "SolverSeconds")
    row = {
        "Patches": surface.GetNumberOfCells(),
        "Solver": label,
        "MeshingSeconds": round(scene.meshing_seconds, 4),
        "FormFactorSeconds": round(scene.factor_seconds, 4),
        "SolverSeconds": round(solver_seconds, 5),
        "TotalSeconds": round(scene.meshing_seconds + scene.factor_seconds + solver_seconds, 4),
        "Iterations": len(history["Iteration"]),
        "RelativeError": relative_error(get_reflected(surface), exact, get_areas(surface)),
    }
    print(
        f"  {row['Patches']:5d} patches, {label:18s} solver {solver_seconds:8.4f} s,"
        f" total {row['TotalSeconds']:7.2f} s, error {100 * row['RelativeError']:.2f} %"
    )
    return row
