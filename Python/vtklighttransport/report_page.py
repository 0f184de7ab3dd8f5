# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of the report, report.html, and the pictures beside it."""

import os
import platform
import re
from html import escape

import numpy

import vtklighttransport as lt
from vtklighttransport.arrays import get_area_vectors, set_cell_array
from vtklighttransport.report import COLUMNS, ITSELF, name_family, print_value
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkPolyData

STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 60em; margin: 0 auto; }
body { padding: 0 1em 2em; }
h1, h2 { line-height: 1.2; }
img { max-width: 100%; height: auto; }
figure { margin: 1em 0; }
figcaption { color: #555; }
dt { font-weight: bold; }
dd { margin: 0 0 0.5em; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: 14px; white-space: nowrap; }
th, td { padding: 0.15em 0.6em; border-bottom: 1px solid #ddd; text-align: right; }
th.text, td.text { text-align: left; }
"""
# Growth is told of what the largest sizes did: small ones are start-up and little else.
SIZES_TO_FIT = 3
# From the largest error down.
DECADES_OF_ERROR = 3.0


def write_page(report):
    page = Page(report)
    page.add_facts()
    if report.rows:
        page.add_errors()
        page.add_growth()
        page.add_table()
        page.add_pictures()
    page.add_left_out()
    with open(os.path.join(report.options.folder, "report.html"), "w", encoding="utf-8") as stream:
        stream.write(page.finish())


class Page:
    """HTML, well-formed as XML too, from top to bottom."""

    def __init__(self, report):
        self.report = report
        self.rows = report.rows
        self.title = "Radiosity: error against run time, " + os.path.basename(report.options.input)
        self.parts = []
        self.without_pictures = find_reason_for_no_pictures()
        if self.without_pictures:
            report.note("Plots and pictures: " + self.without_pictures)

    def add(self, text):
        self.parts.append(text)

    def add_paragraph(self, text):
        self.add(f"<p>{escape(text)}</p>")

    def finish(self):
        body = "\n".join(self.parts)
        return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8"/>\n'
                '<meta name="viewport" content="width=device-width, initial-scale=1"/>\n'
                f"<title>{escape(self.title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
                f"<h1>{escape(self.title)}</h1>\n{body}\n</body>\n</html>\n")

    def add_figure(self, name, caption, draw):
        """A picture that `draw(file)` makes; the first that cannot be made is the last tried."""
        if self.without_pictures:
            return
        file = os.path.join(self.report.options.folder, name)
        if os.path.exists(file):
            os.remove(file)
        draw(file)
        if self.report.messages.errors:
            self.without_pictures = self.report.take_errors()
            self.report.note("Plots and pictures: " + self.without_pictures)
            # Whatever there is, it is blank.
            if os.path.exists(file):
                os.remove(file)
            return
        self.add(f'<figure><img src="{name}" alt="{escape(caption)}"/>'
                 f"<figcaption>{escape(caption)}</figcaption></figure>")

    def add_rows(self, names, rows):
        """A table: headings, and rows of (text, whether it is a number)."""
        def make_cells(tag, cells):
            return "".join(f"<{tag}>{escape(text)}</{tag}>" if number else
                           f'<{tag} class="text">{escape(text)}</{tag}>' for text, number in cells)
        self.add('<div class="wide"><table>\n<thead><tr>' + make_cells("th", names) +
                 "</tr></thead>\n<tbody>")
        for row in rows:
            self.add("<tr>" + make_cells("td", row) + "</tr>")
        self.add("</tbody></table></div>")

    # Sections

    def add_facts(self):
        options = self.report.options
        sizes = sorted({row["patches"] for row in self.rows})
        facts = {
            "Scene": os.path.basename(options.input),
            "Patches": ", ".join(f"{size:,}" for size in sizes) or "none were computed",
            "Solver": f"to a relative error bound of {options.solver_tolerance:g}",
            "Times": "of one run each" if options.repeat == 1
                     else f"medians of {options.repeat} runs each, dense references of one",
            "Machine": describe_machine(),
            "Versions": f"vtkLightTransport {lt.__version__}, VTK {vtkVersion.GetVTKVersion()}, "
                        f"Python {platform.python_version()}",
        }
        self.add("<h2>What was run</h2>")
        if self.report.interrupted:
            self.add("<p><strong>The run was interrupted: this is what was measured until then."
                     "</strong></p>")
        self.add("<dl>" + "".join(f"<dt>{name}</dt><dd>{escape(text)}</dd>"
                                  for name, text in facts.items()) + "</dl>")
        self.add_paragraph(
            "Errors are differences from a reference on the same patches, so they tell what "
            "links, their tolerances and the solver cost, and nothing of the patches themselves. "
            "L2 is the root mean square over area and bands, relative to that of the reference; "
            "L2 of H is the same for irradiance, which no emission hides; the largest error and "
            "the bound are relative to the largest radiosity. The bound is the solver's own, and "
            "knows nothing of errors of the links.")
        if any(row["method"] == "Progressive" for row in self.rows):
            self.add_paragraph(
                "The iterations of progressive refinement are shots; it has no links.")
        if any(row["reference"] == ITSELF and row["method"] != "Dense" for row in self.rows):
            self.add_paragraph(
                "Above --reference-limit patches nothing dense was computed: there the reference "
                "is the finest result of another method (column \"reference\"), and its own "
                "error is not known.")

    def add_errors(self):
        self.add("<h2>Error against run time</h2>")
        compared = [row for row in self.rows if row["error_l2"] != ""]
        if not compared:
            self.add_paragraph("There is no result beside the reference.")
            return
        self.add_figure(
            "error_time.png", "Error of the radiosity against seconds from the mesh to its arrays; "
            "from coarse to fine tolerances along each line.",
            lambda file: plot_errors(file, compared))

    def add_growth(self):
        groups = group(self.rows)
        groups = {key: rows for key, rows in groups.items()
                  if len({row["patches"] for row in rows}) > 1}
        if not groups:
            return
        self.add("<h2>Growth with the number of patches</h2>")
        for name, column, title in (
                ("growth_links.png", "links", "Links"),
                ("growth_seconds.png", "seconds_links", "Seconds for the links")):
            if any(get_column(self.rows, column)):
                self.add_figure(
                    name, f"{title} against patches.",
                    lambda file, c=column, t=title: plot_growth(file, groups, c, t.lower()))
        columns = ("links", "bytes", "seconds_links", "seconds_solver")
        self.add_paragraph(
            f"Exponents k of patches^k, fitted to the largest {SIZES_TO_FIT} sizes of each line:")
        self.add_rows(
            [("method", False), ("tolerance", True)] + [(COLUMNS[c][0], True) for c in columns],
            [[(family, False), (f"{tolerance:g}", True)] +
             [(print_exponent(rows, column), True) for column in columns]
             for (family, tolerance), rows in groups.items()])

    def add_table(self):
        self.add("<h2>Measurements</h2>")
        self.add_paragraph("Also in report.csv, with more digits.")
        texts = {name for name, (_title, align, _form) in COLUMNS.items() if ">" not in align}
        self.add_rows([(title, name not in texts) for name, (title, _a, _f) in COLUMNS.items()],
                      [[(print_value(row, name), name not in texts) for name in COLUMNS]
                       for row in self.rows])

    def add_pictures(self):
        if self.without_pictures:
            return
        from vtklighttransport.pictures import find_direction, look_at

        solution = self.report.solution
        direction = self.report.options.view or find_direction(solution.surface)
        look = look_at(solution.surface, direction)
        self.add("<h2>Pictures</h2>")
        self.add_figure(
            "solution.png", f"The reference with {solution.row['patches']:,} patches: "
            f"{describe(solution.row)}. Patches are seen from their front only; the brightest "
            "twentieth of the area may be beyond the range of the picture.",
            lambda file: draw_solution(file, solution, look))
        for number, (worst, errors) in enumerate(self.report.worst.values()):
            place = find_middle(worst.surface, int(errors.argmax()))
            caption = (f"Where the error is: {describe(worst.row)}, {worst.row['patches']:,} "
                       f"patches. It is largest, {errors.max():.1e} of the largest radiosity, on "
                       f"patch {int(errors.argmax())} at ({place}).")
            self.add_figure(f"error_{number + 1}.png", caption,
                            lambda file, w=worst, e=errors: draw_error(file, w.surface, e, look))

    def add_left_out(self):
        self.add("<h2>Left out</h2>")
        if not self.report.left_out:
            self.add_paragraph("Nothing.")
            return
        self.add("<ul>" + "".join(f"<li>{escape(text)}</li>" for text in self.report.left_out) +
                 "</ul>")


def find_reason_for_no_pictures():
    """Empty where pictures can be drawn."""
    if not hasattr(lt, "vtkOffScreenOpenGLRenderWindow"):
        return "this build has no Rendering module: it was switched off in CMake"
    return ""


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


def group(rows):
    """Rows by (family, tolerance), from coarse to fine, each in the order of their sizes."""
    groups = {}
    for row in rows:
        groups.setdefault((name_family(row, rows), row["tolerance"]), []).append(row)
    families = [family for family, _tolerance in groups]
    order = sorted(groups, key=lambda key: (families.index(key[0]), -key[1]))
    return {key: groups[key] for key in order}


def get_column(rows, name):
    """Numbers; 0 where there is none, which logarithms leave out."""
    return [row[name] or 0.0 for row in rows]


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


# Plots and pictures. Their modules need the Rendering module, and are imported where it is there.


def plot_errors(file, rows):
    from vtklighttransport.plots import Line, plot_lines

    families = list(dict.fromkeys(name_family(row, rows) for row in rows))
    sizes = sorted({row["patches"] for row in rows})
    lines = []
    for number, family in enumerate(families):
        for size in sizes:
            own = [row for row in rows
                   if name_family(row, rows) == family and row["patches"] == size]
            if own:
                own.sort(key=lambda row: -row["tolerance"])
                lines.append(Line(f"{family}, {size:,} patches", get_column(own, "seconds_all"),
                                  get_column(own, "error_l2"), number,
                                  find_shade(sizes.index(size), len(sizes))))
    plot_lines(file, lines, "seconds in all", "relative error of the radiosity (L2)")


def plot_growth(file, groups, column, title):
    from vtklighttransport.plots import Line, plot_lines

    families = list(dict.fromkeys(family for family, _tolerance in groups))
    lines = []
    for (family, tolerance), rows in groups.items():
        tolerances = sorted((t for f, t in groups if f == family), reverse=True)
        lines.append(Line(f"{family} {tolerance:g}", [row["patches"] for row in rows],
                          get_column(rows, column), families.index(family),
                          find_shade(tolerances.index(tolerance), len(tolerances))))
    plot_lines(file, lines, "patches", title)


def find_shade(index, count):
    return (index + 1) / count


def draw_solution(file, solution, look):
    from vtklighttransport.pictures import render_cell_array, render_light

    if solution.radiosity.shape[1] == 3:
        render_light(file, solution.surface, find_exposure(solution), look, (640, 640))
        return
    surface = copy_with(solution.surface, solution.radiosity.mean(axis=1))
    render_cell_array(file, surface, "Shown", (0.0, find_high(solution)), "B", look)


def find_high(solution):
    """The radiosity that all but the brightest twentieth of the area stays below."""
    values = solution.radiosity.mean(axis=1)
    areas = numpy.linalg.norm(get_area_vectors(solution.surface), axis=1)
    order = numpy.argsort(values)
    share = numpy.cumsum(areas[order]) / areas.sum()
    return float(values[order][numpy.searchsorted(share, 0.95)]) or 1.0


def find_exposure(solution):
    return 0.8 * numpy.pi / find_high(solution)


def draw_error(file, surface, errors, look):
    from vtklighttransport.pictures import render_cell_array

    high = errors.max() or 1.0
    render_cell_array(file, copy_with(surface, errors), "Shown",
                      (high * 10.0 ** -DECADES_OF_ERROR, high), "error", look, logarithmic=True)


def copy_with(surface, values):
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    set_cell_array(copy, "Shown", values)
    return copy
