# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Goes through methods, tolerances and sizes of a scene.

Each row is a fresh vtkRadiosity, from the mesh to its arrays, and is written as it is measured. Its
error is the difference from a reference on the same patches: what methods and tolerances cost, not
what patches of constant radiosity do.
"""

import dataclasses

from vtklighttransport.arrays import divide_triangles, get_areas, relative_error
from vtklighttransport.report.record import ITSELF, Solution
from vtklighttransport.shell.stages import Failure
from vtklighttransport.summaries import without_summaries
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

REFERENCE_SOLVER_TOLERANCE = 1e-8


@dataclasses.dataclass
class Reference:
    name: str
    solution: Solution


class Study:
    def __init__(self, options, messages, record, solver):
        self.options = options
        self.messages = messages
        self.record = record
        self.solver = solver

    def run(self, methods, surface):
        if surface.GetNumberOfPolys() < surface.GetNumberOfCells():
            surface = triangulate(surface)
        surface = without_summaries(surface)
        methods = self.warm_up(methods, surface)
        self.record.begin_table()
        self.measure_size(methods, surface)
        triangles = triangulate(surface)
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
                self.record.note(f"{method.name}: {self.messages.take()}")
        return working

    def try_out(self, method, surface):
        """Leaves errors of the last attempt where all fail."""
        for tolerance in method.tolerances:
            self.messages.errors.clear()
            try:
                self.solver.solve(method, tolerance, surface)
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
                self.record.note(f"Dense, {patches:,} patches: above --reference-limit "
                                 f"({self.options.reference_limit:,})")
                continue
            for tolerance in tolerances:
                reference = self.measure(method, tolerance, surface, reference) or reference
        if reference is None:
            self.record.note(f"{patches:,} patches: no method for so many")

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
            solution = self.solver.solve(method, tolerance, surface, solver_tolerance,
                                         repeat or self.options.repeat)
        except Failure:
            self.record.note(
                f"{method.name} {tolerance:g}, {surface.GetNumberOfCells():,} patches: "
                f"{self.messages.take()}")
            return None
        row = solution.row
        if reference is None:
            row["reference"] = ITSELF
            self.record.add_row(row)
            self.record.solution = solution
            return Reference(f"{method.name} {tolerance:g}", solution)
        row["reference"] = reference.name
        errors = compare(solution, reference.solution)
        self.record.add_row(row)
        self.record.keep_if_worse(method, solution, errors)
        return None


def compare(solution, reference):
    """Fills in the errors of the row; returns that of each patch, relative to the largest."""
    areas = get_areas(solution.surface)
    errors = abs(solution.radiosity - reference.radiosity).max(axis=1)
    errors /= abs(reference.radiosity).max() or 1.0
    solution.row.update(
        error_l2=relative_error(solution.radiosity, reference.radiosity, areas),
        error_irradiance=relative_error(solution.irradiance, reference.irradiance, areas),
        error_max=float(errors.max()))
    return errors


def triangulate(surface):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(surface)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    return triangles.GetOutput()
