# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of the report, report.html, and the pictures beside it."""

import os
import platform
import re

import numpy

import vtklighttransport as lt
from vtklighttransport.report.html import Page
from vtklighttransport.report.record import get_column, group
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion

# Growth is told of what the largest sizes did: small ones are start-up and little else.
SIZES_TO_FIT = 3


def write_page(options, messages, record, subject):
    page = Page(f"{subject.TITLE}: error against run time, " + os.path.basename(options.input),
                options.folder, messages, record.note)
    if not hasattr(lt, "vtkOffScreenOpenGLRenderWindow"):
        page.leave_out_figures(
            "this build has no Rendering module: it was switched off in CMake")
    add_facts(page, options, record, subject)
    if record.rows:
        add_errors(page, record, subject)
        add_growth(page, record, subject)
        add_table(page, record)
        add_pictures(page, options, record, subject)
    add_left_out(page, record)
    page.write("report.html")


def add_facts(page, options, record, subject):
    sizes = sorted({row["patches"] for row in record.rows})
    page.add_heading("What was run")
    if record.interrupted:
        page.add_warning("The run was interrupted: this is what was measured until then.")
    page.add_terms({
        "Scene": os.path.basename(options.input),
        "Patches": ", ".join(f"{size:,}" for size in sizes) or "none were computed",
        **subject.make_terms(),
        "Times": "of one run each" if options.repeat == 1
                 else f"medians of {options.repeat} runs each, references of one",
        "Machine": describe_machine(),
        "Versions": f"vtkLightTransport {lt.__version__}, VTK {vtkVersion.GetVTKVersion()}, "
                    f"Python {platform.python_version()}",
    })
    subject.explain(page, record.rows)


def add_errors(page, record, subject):
    page.add_heading("Error against run time")
    compared = [row for row in record.rows if row["error_l2"] != ""]
    if not compared:
        page.add_paragraph("There is no result beside the reference.")
        return
    if not any(row.get(name) for row in compared for name in ("error_l2", "error_l2_high")):
        page.add_paragraph("Nothing differs from the reference.")
        return
    page.add_figure(
        "error_time.png",
        f"Error of the {subject.QUANTITY} against {subject.TIME[1]}, from the mesh to its arrays; "
        "from coarse to fine tolerances along each line.",
        lambda file: import_figures().plot_errors(file, compared, subject))


def add_growth(page, record, subject):
    groups = {key: rows for key, rows in group(record.rows).items()
              if len({row["patches"] for row in rows}) > 1}
    if not groups:
        return
    page.add_heading("Growth with the number of patches")
    for name, column, title in subject.GROWTH:
        if any(get_column(record.rows, column)):
            page.add_figure(
                name, f"{title} against patches.",
                lambda file, c=column, t=title:
                    import_figures().plot_growth(file, groups, c, t))
    page.add_paragraph(
        f"Exponents k of patches^k, fitted to the largest {SIZES_TO_FIT} sizes of each line:")
    page.add_rows(
        [("method", False), ("tolerance", True)] +
        [(record.columns[column][0], True) for column in subject.EXPONENTS],
        [[(family, False), (f"{tolerance:g}", True)] +
         [(print_exponent(rows, column), True) for column in subject.EXPONENTS]
         for (family, tolerance), rows in groups.items()])


def add_table(page, record):
    page.add_heading("Measurements")
    page.add_paragraph("Also in report.csv, with more digits.")
    texts = {name for name, (_title, align, _form) in record.columns.items() if ">" not in align}
    page.add_rows(
        [(title, name not in texts) for name, (title, _a, _f) in record.columns.items()],
        [[(record.print_value(row, name), name not in texts) for name in record.columns]
         for row in record.rows])


def add_pictures(page, options, record, subject):
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
        lambda file: import_figures().draw_solution(file, solution, subject.ARRAY, look))
    shown = [errors for _solution, errors in record.pictured.values()]
    for number, (pictured, errors) in enumerate(record.pictured.values()):
        place = find_middle(pictured.surface, int(abs(errors).argmax()))
        page.add_figure(
            f"error_{number + 1}.png",
            f"Where the error is: {describe(pictured.row)}, {pictured.row['patches']:,} patches. " +
            subject.caption_errors(pictured.row, errors, place),
            lambda file, s=pictured.surface, e=errors:
                subject.draw_errors(file, s, e, shown, look))


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
    return f"{row['family']}, tolerance {row['tolerance']:g}"


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
