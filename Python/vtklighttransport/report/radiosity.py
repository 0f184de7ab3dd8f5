# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of radiosity: ways to link patches, and solvers, beside dense links."""

from vtklighttransport.arrays import relative_error
from vtklighttransport.filters import find_choices
from vtklighttransport.report.record import ITSELF
from vtklighttransport.report.subject import (
    FIRST_COLUMNS, LAST_COLUMNS, Method, Subject, whole)
from vtklighttransport.shell.properties import find_class
from vtklighttransport.summaries import find_summary, get_summary

REFERENCE_SOLVER_TOLERANCE = 1e-8


class Radiosity(Subject):
    TITLE = "Radiosity"
    QUANTITY = "radiosity"
    ARRAY = "Radiosity"
    COLUMNS = {
        **FIRST_COLUMNS,
        "seconds_links": ("links s", ">8", ".3g"),
        "seconds_solver": ("solver s", ">8", ".3g"),
        "solver": ("solver", "<23", ""),
        "bytes": ("bytes", ">8", ".1e"),
        "links": ("links", ">12", ",d"),
        "iterations": ("iterations", ">10", ",d"),
        "error_l2": ("L2 error", ">9", ".1e"),
        "error_max": ("max error", ">9", ".1e"),
        "error_irradiance": ("L2 of H", ">9", ".1e"),
        "error_bound": ("bound", ">9", ".1e"),
        **LAST_COLUMNS,
    }
    GROWTH = (("growth_links.png", "links", "Links"),
              ("growth_seconds.png", "seconds_links", "Seconds for the links"))
    EXPONENTS = ("links", "bytes", "seconds_links", "seconds_solver")

    def __init__(self, options, make_plain_filter):
        super().__init__(options)
        self.make_plain_filter = make_plain_filter
        self.kind = find_class("vtkRadiosity")
        self.methods = self.find_methods()
        dense = self.methods[0]
        self.reference = Method(
            "Dense", dense.property, [options.reference_tolerance],
            dense.settings | {"Tolerance": REFERENCE_SOLVER_TOLERANCE}, dense.family, dense.limit)

    def find_methods(self):
        """Dense first."""
        options = self.options
        hierarchical = {"LinkMethod": self.kind.LINK_METHOD_HIERARCHICAL}
        kinds_of_links = [
            ("Dense", "ViewFactorTolerance", options.dense_tolerances,
             {"LinkMethod": self.kind.LINK_METHOD_DENSE}),
            ("Hierarchical", "LinkTolerance", options.link_tolerances, hierarchical)]
        if options.brightness:
            kinds_of_links.append(("Brightness", "LinkTolerance", options.link_tolerances,
                                   hierarchical | {"RefineByBrightness": True}))
        methods = [self.make_method(name, tolerance, values, settings, solver)
                   for name, tolerance, values, settings in kinds_of_links
                   for solver in options.solvers]
        if options.progressive:
            methods.append(self.make_method(
                "Progressive", "Tolerance", options.progressive_tolerances,
                {"Device": self.kind.DEVICE_OPENGL}, "southwell"))
        return methods

    def make_method(self, name, tolerance, values, settings, solver):
        options = self.options
        settings = {
            "Solver": find_choices(self.kind, "SOLVER_")[solver],
            "Tolerance": options.solver_tolerance,
            "MaximumNumberOfIterations": 100000} | settings
        several = len(options.solvers) > 1 and name != "Progressive"
        method = Method(name, tolerance, sorted(values, reverse=True), settings,
                        f"{name}, {solver}" if several else name)
        if name == "Dense":
            method.limit = options.reference_limit
        return method

    def describe(self, method, result, note):
        if not get_summary(result, "Converged"):
            note("the solver stopped before its tolerance "
                 f"({find_summary(result, 'SolverStatus') or ''}); the row shows how far it came")
        largest = find_largest(result)
        return {
            "solver": self.describe_solver(method, result),
            # What shoots without links has none of their summaries.
            "seconds_links": find_summary(result, "LinkSeconds", "ViewFactorSeconds") or 0.0,
            "seconds_solver": get_summary(result, "SolverSeconds"),
            "bytes": whole(find_summary(result, "LinkBytes", "MatrixBytes")),
            "links": count_links(result),
            "iterations": whole(find_summary(result, "NumberOfShots", "NumberOfIterations")),
            "error_bound": get_summary(result, "ErrorBound") / largest}

    def describe_solver(self, method, result):
        used = get_summary(result, "SolverUsed")
        return f"Auto: {used}" if method.settings["Solver"] == self.kind.SOLVER_AUTO else used

    def compare(self, solution, reference):
        """Errors of patches are relative to the largest radiosity."""
        areas = solution.get_areas()
        exact = reference.get(self.ARRAY)
        errors = abs(solution.get(self.ARRAY) - exact).max(axis=1) / (abs(exact).max() or 1.0)
        solution.row.update(
            error_l2=relative_error(solution.get(self.ARRAY), exact, areas),
            error_irradiance=relative_error(
                solution.get("Irradiance"), reference.get("Irradiance"), areas),
            error_max=float(errors.max()))
        return errors

    def rank(self, row):
        return row["patches"], row["tolerance"]

    def make_terms(self):
        return {"Solver": f"to a relative error bound of {self.options.solver_tolerance:g}"}

    def explain(self, page, rows):
        page.add_paragraph(
            "Errors are differences from a reference on the same patches, so they tell what "
            "links, their tolerances and the solver cost, and nothing of the patches themselves. "
            "L2 is the root mean square over area and bands, relative to that of the reference; "
            "L2 of H is the same for irradiance, which no emission hides; the largest error and "
            "the bound are relative to the largest radiosity. The bound is the solver's own, and "
            "knows nothing of errors of the links.")
        if any(row["method"] == "Progressive" for row in rows):
            page.add_paragraph(
                "The iterations of progressive refinement are shots; it has no links.")
        if any(row["reference"] == ITSELF and row["method"] != "Dense" for row in rows):
            page.add_paragraph(
                "Above --reference-limit patches nothing dense was computed: there the reference "
                "is the finest result of another method (column \"reference\"), and its own "
                "error is not known.")

    def draw_errors(self, file, surface, errors, shown, look):
        from vtklighttransport.report.figures import draw_magnitudes
        draw_magnitudes(file, surface, errors, look)

    def caption_errors(self, row, errors, place):
        return (f"It is largest, {errors.max():.1e} of the largest radiosity, on patch "
                f"{int(errors.argmax())} at ({place}).")


def find_largest(result):
    values = result.GetCellData().GetArray("Radiosity")
    return max((abs(end) for component in range(values.GetNumberOfComponents())
                for end in values.GetRange(component)), default=0.0) or 1.0


def count_links(result):
    """Those of a dense matrix are the pairs of patches that see each other."""
    links = find_summary(result, "NumberOfLinks")
    if not links:
        pairs = [find_summary(result, name) for name in ("PairsUnobstructed", "PairsPartlyVisible")]
        links = None if None in pairs else sum(pairs)
    return whole(links)
