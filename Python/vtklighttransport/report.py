# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of a scene: error against run time, for methods x tolerances x sizes.

Each row is a fresh vtkRadiosity, from the mesh to its arrays, and is written as it is measured. Its
error is the difference from a reference on the same patches: what methods and tolerances cost, not
what patches of constant radiosity do.
"""

import csv
import dataclasses
import os
import statistics
import sys
import time

import numpy

from vtklighttransport.arrays import divide_triangles, get_area_vectors, get_cell_array
from vtklighttransport.shell import (
    Failure, Stage, find_choices, find_class, get_summary)
from vtkmodules.vtkCommonDataModel import vtkFieldData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

# Column of the CSV: heading, alignment and format in print.
COLUMNS = {
    "method": ("method", "<12", ""),
    "solver": ("solver", "<23", ""),
    "tolerance": ("tolerance", ">9", "g"),
    "patches": ("patches", ">9", ",d"),
    "seconds_links": ("links s", ">8", ".3g"),
    "seconds_solver": ("solver s", ">8", ".3g"),
    "seconds_all": ("all s", ">8", ".3g"),
    "bytes": ("bytes", ">8", ".1e"),
    "links": ("links", ">12", ",d"),
    "iterations": ("iterations", ">10", ",d"),
    "error_l2": ("L2 error", ">9", ".1e"),
    "error_max": ("max error", ">9", ".1e"),
    "error_irradiance": ("L2 of H", ">9", ".1e"),
    "error_bound": ("bound", ">9", ".1e"),
    "reference": ("reference", "<18", ""),
    "device": ("device", "", ""),
}
REFERENCE_SOLVER_TOLERANCE = 1e-8
ITSELF = "is the reference"


@dataclasses.dataclass
class Method:
    """A way to compute radiosity, and the property that its tolerances are of."""

    name: str
    property: str
    tolerances: list
    settings: dict
    solver: str = "auto"


@dataclasses.dataclass
class Solution:
    """A result on one size of the scene, in numbers, and the row of the table that tells of it."""

    row: dict
    surface: object
    radiosity: numpy.ndarray
    irradiance: numpy.ndarray


@dataclasses.dataclass
class Reference:
    name: str
    solution: Solution


class Report:
    """What has been measured so far."""

    def __init__(self, options, messages, make_radiosity):
        self.options = options
        self.messages = messages
        self.make_radiosity = make_radiosity
        self.rows = []
        self.left_out = []
        self.interrupted = False
        self.solution = None
        # By method: the coarsest result on the largest size, and its error on each patch.
        self.worst = {}
        self.stream = None
        self.writer = None

    def note(self, text):
        """What was left out, and why; once."""
        if text not in self.left_out:
            self.left_out.append(text)
            self.show(["left out:", text])

    def begin_table(self):
        self.stream = open(os.path.join(self.options.folder, "report.csv"), "w", newline="",
                           encoding="utf-8")
        self.writer = csv.DictWriter(self.stream, COLUMNS)
        self.writer.writeheader()
        self.stream.flush()
        self.show(format(title, align) for title, align, _form in COLUMNS.values())

    def add_row(self, row):
        self.rows.append(row)
        self.writer.writerow({name: f"{value:.6g}" if isinstance(value, float) else value
                              for name, value in row.items()})
        self.stream.flush()
        self.show(format(print_value(row, name), align)
                  for name, (_title, align, _form) in COLUMNS.items())

    def show(self, cells):
        if not self.options.quiet:
            print(" ".join(cells).rstrip(), flush=True)

    # What is measured

    def run(self, surface):
        if surface.GetNumberOfPolys() < surface.GetNumberOfCells():
            surface = get_triangles(surface)
        surface = without_summaries(surface)
        methods = self.warm_up(find_methods(self.options, self.note), surface)
        self.begin_table()
        self.measure_size(methods, surface)
        triangles = get_triangles(surface)
        for _ in range(self.options.levels):
            triangles = divide_triangles(triangles)
            self.measure_size(methods, triangles)

    def warm_up(self, methods, surface):
        """The methods that work at some tolerance; where the first does not, it is the input."""
        working = []
        for method in methods:
            if self.try_out(method, surface):
                working.append(method)
            elif not working:
                raise Failure
            else:
                self.note(f"{method.name}: {self.take_errors()}")
        return working

    def try_out(self, method, surface):
        """Leaves errors of the last attempt where all fail."""
        for tolerance in method.tolerances:
            self.messages.errors.clear()
            try:
                self.compute(method, tolerance, surface)
                return True
            except Failure:
                continue
        return False

    def measure_size(self, methods, surface):
        patches = surface.GetNumberOfCells()
        reference = self.find_reference(methods, surface)
        for method in methods:
            tolerances = method.tolerances
            if reference is None:
                # The finest comes first: the others are compared with it.
                tolerances = tolerances[::-1]
            if method.name == "Dense" and patches > self.options.reference_limit:
                self.note(f"Dense, {patches:,} patches: above --reference-limit "
                          f"({self.options.reference_limit:,})")
                continue
            for tolerance in tolerances:
                reference = self.measure(method, tolerance, surface, reference) or reference
        if reference is None:
            self.note(f"{patches:,} patches: no method for so many")

    def find_reference(self, methods, surface):
        """Dense links at a tight tolerance; none where they would be too many."""
        dense = methods[0]
        if surface.GetNumberOfCells() > self.options.reference_limit:
            return None
        return self.measure(dense, self.options.reference_tolerance, surface, None,
                            REFERENCE_SOLVER_TOLERANCE, repeat=1)

    def measure(self, method, tolerance, surface, reference, solver_tolerance=None, repeat=None):
        """A row of the table; returns the reference that it is where there was none."""
        try:
            solution = self.compute(method, tolerance, surface, solver_tolerance,
                                    repeat or self.options.repeat)
        except Failure:
            self.note(f"{method.name} {tolerance:g}, {surface.GetNumberOfCells():,} patches: "
                      f"{self.take_errors()}")
            return None
        row = solution.row
        if reference is None:
            row["reference"] = ITSELF
            self.add_row(row)
            self.solution = solution
            return Reference(f"{method.name} {tolerance:g}", solution)
        row["reference"] = reference.name
        errors = self.compare(solution, reference.solution)
        self.add_row(row)
        self.keep_if_worse(method, solution, errors)
        return None

    def keep_if_worse(self, method, solution, errors):
        def rank(row):
            return row["patches"], row["tolerance"]
        key = (method.name, method.solver)
        if key not in self.worst or rank(solution.row) > rank(self.worst[key][0].row):
            self.worst[key] = (solution, errors)

    def compute(self, method, tolerance, surface, solver_tolerance=None, repeat=1):
        """The times are medians over the runs."""
        times = []
        for _ in range(repeat):
            radiosity = self.make_filter(method, tolerance, solver_tolerance)
            stage = Stage(f"{method.name} {tolerance:g}", radiosity,
                          self.options.quiet or not sys.stderr.isatty())
            begin = time.perf_counter()
            result = stage.run(self.messages, surface)
            seconds = time.perf_counter() - begin
            # What shoots without links has none of their summaries.
            times.append((get_first(result, "LinkSeconds", "ViewFactorSeconds") or 0.0,
                          get_summary(result, "SolverSeconds"), seconds))
        if not get_summary(result, "Converged"):
            self.note(f"{method.name} {tolerance:g}, {surface.GetNumberOfCells():,} patches: the "
                      "solver stopped before its tolerance "
                      f"({get_first(result, 'SolverStatus')}); the row shows how far it came")
        values = get_cell_array(result, "Radiosity").reshape(result.GetNumberOfCells(), -1)
        row = dict.fromkeys(COLUMNS, "")
        links, solver, everything = (statistics.median(column) for column in zip(*times))
        row.update(
            method=method.name, solver=describe_solver(method, result), tolerance=tolerance,
            patches=surface.GetNumberOfCells(), seconds_links=links, seconds_solver=solver,
            seconds_all=everything, bytes=whole(get_first(result, "LinkBytes", "MatrixBytes")),
            links=count_links(result),
            iterations=whole(get_first(result, "NumberOfShots", "NumberOfIterations")),
            error_bound=get_summary(result, "ErrorBound") / (abs(values).max() or 1.0),
            device=get_summary(result, "DeviceUsed"))
        irradiance = get_cell_array(result, "Irradiance").reshape(values.shape)
        return Solution(row, result, values, irradiance)

    def make_filter(self, method, tolerance, solver_tolerance):
        radiosity = self.make_radiosity()
        radiosity.SetSolver(find_choices(type(radiosity), "SOLVER_")[method.solver])
        radiosity.SetTolerance(solver_tolerance or self.options.solver_tolerance)
        radiosity.SetMaximumNumberOfIterations(100000)
        for name, value in method.settings.items():
            getattr(radiosity, "Set" + name)(value)
        getattr(radiosity, "Set" + method.property)(tolerance)
        return radiosity

    def compare(self, solution, reference):
        """Fills in the errors of the row; returns that of each patch, relative to the largest."""
        areas = numpy.linalg.norm(get_area_vectors(solution.surface), axis=1)[:, None]
        errors = abs(solution.radiosity - reference.radiosity).max(axis=1)
        errors /= abs(reference.radiosity).max() or 1.0
        solution.row.update(
            error_l2=relative_error(solution.radiosity, reference.radiosity, areas),
            error_irradiance=relative_error(solution.irradiance, reference.irradiance, areas),
            error_max=float(errors.max()))
        return errors

    def take_errors(self):
        text = "; ".join(self.messages.errors)
        self.messages.errors.clear()
        return text


def print_value(row, name):
    """As people read it; nothing where there is no value."""
    return "" if row[name] == "" else format(row[name], COLUMNS[name][2])


def name_family(row, rows):
    """The method of a row; with its solver where the method has been run with several."""
    def get_solver(row):
        return row["solver"].split(":")[0]
    solvers = {get_solver(other) for other in rows if other["method"] == row["method"]}
    return row["method"] + (f", {get_solver(row)}" if len(solvers) > 1 else "")


def describe_solver(method, result):
    used = get_summary(result, "SolverUsed")
    return f"Auto: {used}" if method.solver == "auto" else used


def relative_error(values, exact, weights):
    """Root mean square over the area, relative to that of the exact values."""
    return float(numpy.sqrt((weights * (values - exact) ** 2).sum()
                            / ((weights * exact ** 2).sum() or 1.0)))


def get_first(result, *names):
    """The first of these summaries that the result has."""
    return next((value for value in (get_summary(result, name) for name in names)
                 if value is not None), "")


def whole(value):
    return "" if value == "" else int(value)


def count_links(result):
    """Those of a dense matrix are the pairs of patches that see each other."""
    pairs = [get_first(result, name) for name in ("PairsUnobstructed", "PairsPartlyVisible")]
    return whole(get_first(result, "NumberOfLinks") or ("" if "" in pairs else sum(pairs)))


def find_methods(options, note):
    """Dense first: it is the reference as well. Tolerances from coarse to fine."""
    kind = find_class("vtkRadiosity")
    has_links = hasattr(kind, "SetLinkMethod")
    kinds_of_links = [("Dense", "ViewFactorTolerance", options.dense_tolerances,
                       {"LinkMethod": kind.LINK_METHOD_DENSE} if has_links else {})]
    if has_links:
        settings = {"LinkMethod": kind.LINK_METHOD_HIERARCHICAL}
        kinds_of_links.append(("Hierarchical", "LinkTolerance", options.link_tolerances, settings))
        if options.brightness:
            kinds_of_links.append(("Brightness", "LinkTolerance", options.link_tolerances,
                                   {**settings, "RefineByBrightness": True}))
    else:
        note("Hierarchical: this build has no LinkMethod")
    methods = [Method(name, tolerance, sorted(values, reverse=True), settings, solver)
               for name, tolerance, values, settings in kinds_of_links
               for solver in options.solvers]
    if options.progressive:
        methods.append(Method(
            "Progressive", "Tolerance", sorted(options.progressive_tolerances, reverse=True),
            {"Device": kind.DEVICE_OPENGL}, "southwell"))
    return methods


def without_summaries(surface):
    """A copy that nothing is known of from earlier runs."""
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    copy.SetFieldData(vtkFieldData())
    return copy


def get_triangles(surface):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(surface)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    return triangles.GetOutput()


def run(options, messages, make_radiosity, surface):
    """The command: measures, then writes the page, also of what an interrupted run has measured.

    `make_radiosity()` is a filter of which the report sets links, solver and tolerances.
    """
    from vtklighttransport.report_page import write_page

    report = Report(options, messages, make_radiosity)
    try:
        os.makedirs(options.folder, exist_ok=True)
        try:
            report.run(surface)
        except KeyboardInterrupt:
            if not report.rows:
                raise
            report.interrupted = True
            print("interrupted: the page shows what was measured so far", file=sys.stderr)
        write_page(report)
    except FileExistsError as error:
        raise Failure(f"cannot write {options.folder}: it is a file, not a folder") from error
    except OSError as error:
        name = error.filename or options.folder
        raise Failure(f"cannot write {name}: {error.strerror}") from error
    finally:
        if report.stream:
            report.stream.close()
    if report.interrupted:
        raise KeyboardInterrupt
    return f"{os.path.join(options.folder, 'report.html')}: {len(report.rows)} rows"
