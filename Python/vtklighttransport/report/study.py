# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Goes through methods, tolerances and sizes of a scene.

Each row is a fresh filter, from the mesh to its arrays, and is written as it is measured. Its error
is the difference from a reference on the same patches: what methods and tolerances cost, not what
patches of one value do.
"""

import dataclasses
import statistics
import sys
import time

from vtklighttransport.arrays import divide_triangles
from vtklighttransport.report.record import ITSELF, Solution
from vtklighttransport.shell.stages import Failure, Stage
from vtklighttransport.summaries import get_summary, without_summaries
from vtkmodules.vtkFiltersCore import vtkTriangleFilter


@dataclasses.dataclass
class Reference:
    name: str
    solution: Solution


class Study:
    def __init__(self, options, messages, record, subject):
        self.options = options
        self.messages = messages
        self.record = record
        self.subject = subject

    def run(self, surface):
        if surface.GetNumberOfPolys() < surface.GetNumberOfCells():
            surface = triangulate(surface)
        surface = without_summaries(surface)
        methods = self.warm_up(surface)
        self.record.begin_table()
        self.measure_size(methods, surface)
        triangles = triangulate(surface)
        for _ in range(self.options.levels):
            triangles = divide_triangles(triangles)
            self.measure_size(methods, triangles)

    def warm_up(self, surface):
        """The methods that work at some tolerance; where the first does not, it is the input."""
        working = []
        for method in self.subject.methods:
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
                self.run_once(method, tolerance, surface)
                return True
            except Failure:
                continue
        return False

    def measure_size(self, methods, surface):
        patches = surface.GetNumberOfCells()
        reference = self.find_reference(surface)
        for method in methods:
            if patches > method.limit:
                self.record.note(f"{method.name}, {patches:,} patches: above --reference-limit "
                                 f"({method.limit:,})")
                continue
            # Without a reference the finest comes first: the others are compared with it.
            for tolerance in method.tolerances if reference else method.tolerances[::-1]:
                reference = (self.measure(method, tolerance, surface, reference,
                                          self.options.repeat) or reference)
        if reference is None:
            self.record.note(f"{patches:,} patches: no method for so many")

    def find_reference(self, surface):
        """None where there are too many patches for it."""
        method = self.subject.reference
        if surface.GetNumberOfCells() > method.limit:
            return None
        return self.measure(method, method.tolerances[0], surface, None, 1)

    def measure(self, method, tolerance, surface, reference, repeat):
        """A row of the table; returns the reference that it is where there was none."""
        try:
            solution = self.solve(method, tolerance, surface, repeat)
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
        errors = self.subject.compare(solution, reference.solution)
        self.record.add_row(row)
        self.record.keep_picture(solution, errors, self.subject.rank)
        return None

    def solve(self, method, tolerance, surface, repeat):
        """The seconds are medians over the runs; all else is of the last one."""
        rows = []
        for _ in range(repeat):
            result, seconds, cpu_seconds = self.run_once(method, tolerance, surface)
            row = self.record.make_row(method, tolerance)
            row.update(self.subject.describe(method, result, lambda text: self.record.note(
                f"{method.name} {tolerance:g}, {surface.GetNumberOfCells():,} patches: {text}")))
            row.update(patches=result.GetNumberOfCells(), seconds_all=seconds,
                       seconds_cpu=cpu_seconds, device=get_summary(result, "DeviceUsed"))
            rows.append(row)
        for name in row:
            if name.startswith("seconds_"):
                row[name] = statistics.median(own[name] for own in rows)
        return Solution(row, result)

    def run_once(self, method, tolerance, surface):
        stage = Stage(f"{method.name} {tolerance:g}", self.subject.make_filter(method, tolerance),
                      self.options.quiet or not sys.stderr.isatty())
        begin, cpu_begin = time.perf_counter(), time.process_time()
        result = stage.run(self.messages, surface)
        return result, time.perf_counter() - begin, time.process_time() - cpu_begin


def triangulate(surface):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(surface)
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.Update()
    return triangles.GetOutput()
