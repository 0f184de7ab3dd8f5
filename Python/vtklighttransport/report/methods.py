# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The ways to compute radiosity, each from the mesh to its arrays."""

import dataclasses
import statistics
import sys
import time

from vtklighttransport.arrays import get_cell_array
from vtklighttransport.report.record import COLUMNS, Solution
from vtklighttransport.shell.properties import find_choices, find_class
from vtklighttransport.shell.stages import Stage
from vtklighttransport.summaries import find_summary, get_summary


@dataclasses.dataclass
class Method:
    """A way to compute radiosity, and the property that its tolerances are of."""

    name: str
    property: str
    tolerances: list
    settings: dict
    solver: str = "auto"


def find_methods(options):
    """Dense first: it is the reference as well. Tolerances from coarse to fine."""
    kind = find_class("vtkRadiosity")
    hierarchical = {"LinkMethod": kind.LINK_METHOD_HIERARCHICAL}
    kinds_of_links = [
        ("Dense", "ViewFactorTolerance", options.dense_tolerances,
         {"LinkMethod": kind.LINK_METHOD_DENSE}),
        ("Hierarchical", "LinkTolerance", options.link_tolerances, hierarchical)]
    if options.brightness:
        kinds_of_links.append(("Brightness", "LinkTolerance", options.link_tolerances,
                               {**hierarchical, "RefineByBrightness": True}))
    methods = [Method(name, tolerance, sorted(values, reverse=True), settings, solver)
               for name, tolerance, values, settings in kinds_of_links
               for solver in options.solvers]
    if options.progressive:
        methods.append(Method(
            "Progressive", "Tolerance", sorted(options.progressive_tolerances, reverse=True),
            {"Device": kind.DEVICE_OPENGL}, "southwell"))
    return methods


class Solver:
    """Computes solutions, each by a fresh filter."""

    def __init__(self, options, messages, note, make_radiosity):
        self.options = options
        self.messages = messages
        self.note = note
        self.make_radiosity = make_radiosity

    def solve(self, method, tolerance, surface, solver_tolerance=None, repeat=1):
        """The times are medians over the runs."""
        times = []
        for _ in range(repeat):
            result, seconds = self.run_once(method, tolerance, surface, solver_tolerance)
            # What shoots without links has none of their summaries.
            times.append((find_summary(result, "LinkSeconds", "ViewFactorSeconds") or 0.0,
                          get_summary(result, "SolverSeconds"), seconds))
        if not get_summary(result, "Converged"):
            self.note(f"{method.name} {tolerance:g}, {surface.GetNumberOfCells():,} patches: the "
                      "solver stopped before its tolerance "
                      f"({find_summary(result, 'SolverStatus') or ''}); the row shows how far it "
                      "came")
        values = get_cell_array(result, "Radiosity").reshape(result.GetNumberOfCells(), -1)
        row = make_row(method, tolerance, result, abs(values).max() or 1.0)
        row["seconds_links"], row["seconds_solver"], row["seconds_all"] = (
            statistics.median(column) for column in zip(*times))
        irradiance = get_cell_array(result, "Irradiance").reshape(values.shape)
        return Solution(row, result, values, irradiance)

    def run_once(self, method, tolerance, surface, solver_tolerance):
        radiosity = self.make_filter(method, tolerance, solver_tolerance)
        stage = Stage(f"{method.name} {tolerance:g}", radiosity,
                      self.options.quiet or not sys.stderr.isatty())
        begin = time.perf_counter()
        result = stage.run(self.messages, surface)
        return result, time.perf_counter() - begin

    def make_filter(self, method, tolerance, solver_tolerance):
        radiosity = self.make_radiosity()
        radiosity.SetSolver(find_choices(type(radiosity), "SOLVER_")[method.solver])
        radiosity.SetTolerance(solver_tolerance or self.options.solver_tolerance)
        radiosity.SetMaximumNumberOfIterations(100000)
        for name, value in method.settings.items():
            getattr(radiosity, "Set" + name)(value)
        getattr(radiosity, "Set" + method.property)(tolerance)
        return radiosity


def make_row(method, tolerance, result, largest):
    """What the result's own summaries tell; times, errors and the reference are still to come."""
    row = dict.fromkeys(COLUMNS, "")
    row.update(
        method=method.name, solver=describe_solver(method, result), tolerance=tolerance,
        patches=result.GetNumberOfCells(),
        bytes=whole(find_summary(result, "LinkBytes", "MatrixBytes")), links=count_links(result),
        iterations=whole(find_summary(result, "NumberOfShots", "NumberOfIterations")),
        error_bound=get_summary(result, "ErrorBound") / largest,
        device=get_summary(result, "DeviceUsed"))
    return row


def describe_solver(method, result):
    used = get_summary(result, "SolverUsed")
    return f"Auto: {used}" if method.solver == "auto" else used


def whole(value):
    return "" if value is None else int(value)


def count_links(result):
    """Those of a dense matrix are the pairs of patches that see each other."""
    links = find_summary(result, "NumberOfLinks")
    if not links:
        pairs = [find_summary(result, name) for name in ("PairsUnobstructed", "PairsPartlyVisible")]
        links = None if None in pairs else sum(pairs)
    return whole(links)
