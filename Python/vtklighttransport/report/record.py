# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What has been measured: the rows of report.csv, and what was left out."""

import csv
import dataclasses
import io
import os

import numpy

from vtklighttransport.replacement import replace_file

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
ITSELF = "is the reference"


@dataclasses.dataclass
class Solution:
    """A result on one size of the scene, in numbers, and the row of the table that tells of it."""

    row: dict
    surface: object
    radiosity: numpy.ndarray
    irradiance: numpy.ndarray


class Record:
    """Rows are written and shown as they come: whatever ends the run, the file has those so far."""

    def __init__(self, folder, quiet):
        self.file = os.path.join(folder, "report.csv")
        self.quiet = quiet
        self.rows = []
        self.left_out = []
        self.interrupted = False
        # The last that others were compared with.
        self.solution = None
        # By method: the coarsest result on the largest size, and its error on each patch.
        self.worst = {}
        self.table = io.StringIO(newline="")
        self.writer = csv.DictWriter(self.table, COLUMNS)

    def begin_table(self):
        self.writer.writeheader()
        self.write_table()
        self.show(format(title, align) for title, align, _form in COLUMNS.values())

    def add_row(self, row):
        self.rows.append(row)
        self.writer.writerow({name: f"{value:.6g}" if isinstance(value, float) else value
                              for name, value in row.items()})
        self.write_table()
        self.show(format(print_value(row, name), align)
                  for name, (_title, align, _form) in COLUMNS.items())

    def keep_if_worse(self, method, solution, errors):
        def rank(row):
            return row["patches"], row["tolerance"]
        key = (method.name, method.solver)
        if key not in self.worst or rank(solution.row) > rank(self.worst[key][0].row):
            self.worst[key] = (solution, errors)

    def note(self, text):
        """What was left out, and why; once."""
        if text not in self.left_out:
            self.left_out.append(text)
            self.show(["left out:", text])

    def show(self, cells):
        if not self.quiet:
            print(" ".join(cells).rstrip(), flush=True)

    def write_table(self):
        replace_file(self.file, self.table.getvalue().encode())


def print_value(row, name):
    """As people read it; nothing where there is no value."""
    return "" if row[name] == "" else format(row[name], COLUMNS[name][2])


def name_family(row, rows):
    """The method of a row; with its solver where the method has been run with several."""
    def get_solver(row):
        return row["solver"].split(":")[0]
    solvers = {get_solver(other) for other in rows if other["method"] == row["method"]}
    return row["method"] + (f", {get_solver(row)}" if len(solvers) > 1 else "")


def find_families(rows):
    """The families of the rows, in the order of the rows."""
    return list(dict.fromkeys(name_family(row, rows) for row in rows))


def group(rows):
    """Rows by (family, tolerance), from coarse to fine, each in the order of their sizes."""
    groups = {}
    for row in rows:
        groups.setdefault((name_family(row, rows), row["tolerance"]), []).append(row)
    families = find_families(rows)
    order = sorted(groups, key=lambda key: (families.index(key[0]), -key[1]))
    return {key: groups[key] for key in order}


def get_column(rows, name):
    """Numbers; 0 where there is none, which logarithms leave out."""
    return [row[name] or 0.0 for row in rows]
