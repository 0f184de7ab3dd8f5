# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What has been measured: the rows of report.csv, and what was left out."""

import csv
import dataclasses
import io
import os

import numpy

from vtklighttransport.arrays import get_areas, get_cell_array
from vtklighttransport.replacement import replace_file

ITSELF = "is the reference"


@dataclasses.dataclass
class Solution:
    """A result on one size of the scene, and the row of the table that tells of it."""

    row: dict
    surface: object

    def get(self, name):
        """Cells x components."""
        values = get_cell_array(self.surface, name)
        return values.reshape(len(values), -1)

    def has(self, name):
        return bool(self.surface.GetCellData().HasArray(name))

    def get_areas(self):
        return get_areas(self.surface)


class Record:
    """Rows are written and shown as they come: whatever ends the run, the file has those so far."""

    def __init__(self, folder, columns, quiet):
        self.file = os.path.join(folder, "report.csv")
        self.columns = columns
        self.quiet = quiet
        self.rows = []
        self.left_out = []
        self.interrupted = False
        # The last that others were compared with.
        self.solution = None
        # By family: what is shown as a picture, (solution, error on each patch).
        self.pictured = {}
        self.table = io.StringIO(newline="")
        # A row has its family, too.
        self.writer = csv.DictWriter(self.table, columns, extrasaction="ignore")

    def begin_table(self):
        self.writer.writeheader()
        self.write_table()
        self.show(format(title, align) for title, align, _form in self.columns.values())

    def make_row(self, method, tolerance):
        return dict.fromkeys(self.columns, "") | {
            "method": method.name, "family": method.family or method.name, "tolerance": tolerance}

    def add_row(self, row):
        self.rows.append(row)
        self.writer.writerow({name: f"{value:.6g}" if isinstance(value, float) else value
                              for name, value in row.items()})
        self.write_table()
        self.show(format(self.print_value(row, name), align)
                  for name, (_title, align, _form) in self.columns.items())

    def keep_picture(self, solution, errors, rank):
        family = solution.row["family"]
        if family not in self.pictured or rank(solution.row) > rank(self.pictured[family][0].row):
            self.pictured[family] = (solution, errors)

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

    def print_value(self, row, name):
        """As people read it; nothing where there is no value."""
        return "" if row[name] == "" else format(row[name], self.columns[name][2])


def find_families(rows):
    """The families of the rows, in the order of the rows."""
    return list(dict.fromkeys(row["family"] for row in rows))


def group(rows):
    """Rows by (family, tolerance), from coarse to fine, each in the order of their sizes."""
    groups = {}
    for row in rows:
        groups.setdefault((row["family"], row["tolerance"]), []).append(row)
    families = find_families(rows)
    order = sorted(groups, key=lambda key: (families.index(key[0]), -key[1]))
    return {key: groups[key] for key in order}


def get_column(rows, name):
    """Numbers; 0 where there is none, which logarithms leave out."""
    return numpy.array([row[name] or 0.0 for row in rows], dtype=float)
