# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of the report, report.html, and the pictures beside it."""

import os
import platform
import re

import numpy

import vtklighttransport as lt
from vtklighttransport.report.html import Page
from vtklighttransport.report.record import COLUMNS, ITSELF, get_column, group, print_value
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion

# Growth is told of what the largest sizes did: small ones are start-up and little else.
SIZES_TO_FIT = 3


def write_page(options, messages, record):
    page = Page("Radiosity: error against run time, " + os.path.basename(options.input),
                options.folder, messages, record.note)
    if not hasattr(lt, "vtkOffScreenOpenGLRenderWindow"):
        page.leave_out_figures(
            "this build has no Rendering module: it was switched off in CMake")
    add_facts(page, options, record)
    if record.rows:
        add_errors(page, record)
        add_growth(page, record)
        add_table(page, record)
        add_pictures(page, options, record)
    add_left_out(page, record)
    page.write("report.html")


def add_facts(page, options, record):
    sizes = sorted({row["patches"] for row in record.rows})
    page.add_heading("What was run")
    if record.interrupted:
        page.add_warning("The run was interrupted: this is what was measured until then.")
    page.add_terms({
        "Scene": os.path.basename(options.input),
        "Patches": ", ".join(f"{size:,}" for size in sizes) or "none were computed",
        "Solver": f"to a relative error bound of {options.solver_tolerance:g}",
        "Times": "of one run each" if options.repeat == 1
                 else f"medians of {options.repeat} runs each, dense references of one",
        "Machine": describe_machine(),
        "Versions": f"vtkLightTransport {lt.__version__}, VTK {vtkVersion.GetVTKVersion()}, "
                    f"Python {platform.python_version()}",
    })
    page.add_paragraph(
        "Errors are differences from a reference on the same patches, so they tell what "
        "links, their tolerances and the solver cost, and nothing of the patches themselves. "
        "L2 is the root mean square over area and bands, relative to that of the reference; "
        "L2 of H is the same for irradiance, which no emission hides; the largest error and "
        "the bound are relative to the largest radiosity. The bound is the solver's own, and "
        "knows nothing of errors of the links.")
    if any(row["method"] == "Progressive" for row in record.rows):
        page.add_paragraph(
            "The iterations of progressive refinement are shots; it has no links.")
    if any(row["reference"] == ITSELF and row["method"] != "Dense" for row in record.rows):
        page.add_paragraph(
            "Above --reference-limit patches nothing dense was computed: there the reference "
            "is the finest result of another method (column \"reference\"), and its own "
            "error is not known.")


def add_errors(page, record):
    page.add_heading("Error against run time")
    compared = [row for row in record.rows if row["error_l2"] != ""]
    if not compared:
        page.add_paragraph("There is no result beside the reference.")
        return
    page.add_figure(
        "error_time.png", "Error of the radiosity against seconds from the mesh to its arrays; "
        "from coarse to fine tolerances along each line.",
        lambda file: import_figures().plot_errors(file, compared))


def add_growth(page, record):
    groups = {key: rows for key, rows in group(record.rows).items()
              if len({row["patches"] for row in rows}) > 1}
    if not groups:
        return
    page.add_heading("Growth with the number of patches")
    for name, column, title in (
            ("growth_links.png", "links", "Links"),
            ("growth_seconds.png", "seconds_links", "Seconds for the links")):
        if any(get_column(record.rows, column)):
            page.add_figure(
                name, f"{title} against patches.",
                lambda file, c=column, t=title:
                    import_figures().plot_growth(file, groups, c, t.lower()))
    columns = ("links", "bytes", "seconds_links", "seconds_solver")
    page.add_paragraph(
        f"Exponents k of patches^k, fitted to the largest {SIZES_TO_FIT} sizes of each line:")
    page.add_rows(
        [("method", False), ("tolerance", True)] + [(COLUMNS[c][0], True) for c in columns],
        [[(family, False), (f"{tolerance:g}", True)] +
         [(print_exponent(rows, column), True) for column in columns]
         for (family, tolerance), rows in groups.items()])


def add_table(page, record):
    page.add_heading("Measurements")
    page.add_paragraph("Also in report.csv, with more digits.")
    texts = {name for name, (_title, align, _form) in COLUMNS.items() if ">" not in align}
    page.add_rows([(title, name not in texts) for name, (title, _a, _f) in COLUMNS.items()],
                  [[(print_value(row, name), name not in texts) for name in COLUMNS]
                   for row in record.rows])


def add_pictures(page, options, record):
    if not page.draws_figures:
        return
    from vtklighttransport.pictures import find_direction, look_at

    solution = record.solution
    look = look_at(solution.surface, options.view or find_direction(solution.surface))
    page.add_heading("Pictures")
    page.add_figure(
        "solution.png", f"The reference with {solution.row['patches']:,} patches: "
        f"{describe(solution.row)}. Patches are seen from their front only; the brightest "
        "twentieth of the area may be beyond the range of the picture.",
        lambda file: import_figures().draw_solution(file, solution, look))
    for number, (worst, errors) in enumerate(record.worst.values()):
        place = find_middle(worst.surface, int(errors.argmax()))
        page.add_figure(
            f"error_{number + 1}.png",
            f"Where the error is: {describe(worst.row)}, {worst.row['patches']:,} patches. It is "
            f"largest, {errors.max():.1e} of the largest radiosity, on patch "
            f"{int(errors.argmax())} at ({place}).",
            lambda file, w=worst, e=errors: import_figures().draw_error(file, w.surface, e, look))


def add_left_out(page, record):
    page.add_heading("Left out")
    if record.left_out:
        page.add_list(record.left_out)
    else:
        page.add_paragraph("Nothing.")


def import_figures():
    """Only where there is something to draw: they need the Rendering module."""
    from vtklighttransport.report import figures
    return figures


def describe(row):
    return f"{row['method']}, tolerance {row['tolerance']:g}, {row['solver']}"


def describe_machine():
    """Processor, cores and system; no names of hosts or people."""
    name = platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as stream:
            match = re.search(r"^model name\s*:\s*(.+)$", stream.read(), re.MULTILINE)
        name = match.group(1) if match else name
    except OSError:
        name = platform.processor() or name
    try:
        cores = len(os.sched_getaffinity(0))
    except AttributeError:
        cores = os.cpu_count()
    return f"{name}, {cores} cores used, {platform.system()}"


def find_middle(surface, cell):
    points = surface.GetCell(cell).GetPoints()
    middle = vtk_to_numpy(points.GetData()).mean(axis=0)
    return ", ".join(f"{value:.4g}" for value in middle)


def fit_exponent(sizes, values):
    """The slope of log(values) over log(sizes); nan where fewer than two can be used."""
    sizes, values = numpy.array(sizes, dtype=float), numpy.array(values, dtype=float)
    used = (values > 0.0) & numpy.isfinite(values)
    sizes, values = sizes[used][-SIZES_TO_FIT:], values[used][-SIZES_TO_FIT:]
    if len(numpy.unique(sizes)) < 2:
        return float("nan")
    return float(numpy.polyfit(numpy.log(sizes), numpy.log(values), 1)[0])


def print_exponent(rows, column):
    exponent = fit_exponent([row["patches"] for row in rows], get_column(rows, column))
    return f"{exponent:.2f}" if numpy.isfinite(exponent) else ""
