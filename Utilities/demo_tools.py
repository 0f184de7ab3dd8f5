# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the parts of demo.py share: filters that run, results that agree, numbers and files."""

import csv
import os
import time

import numpy

from vtklighttransport.meshes import make_reader
from vtklighttransport.shell.files import write_data
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonDataModel import vtkPolyData

DATA = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Data")

# Two devices, or two solvers, agree when no value differs by more than this fraction of the
# largest one.
AGREEMENT = 1e-5


class DemoError(RuntimeError):
    """Something that the demonstration shows does not hold."""


def update(algorithm):
    """Run a filter, and return the seconds; an error that it reports is an exception here."""
    errors = []

    @calldata_type(VTK_STRING)
    def remember(_caller, _event, text):
        errors.append(text)

    tag = algorithm.AddObserver("ErrorEvent", remember)
    begin = time.perf_counter()
    algorithm.Update()
    seconds = time.perf_counter() - begin
    algorithm.RemoveObserver(tag)
    if errors:
        raise DemoError(errors[0].strip())
    return seconds


def snapshot(algorithm):
    """A copy of a filter's surface, so that the filter can run again."""
    surface = vtkPolyData()
    surface.ShallowCopy(algorithm.GetOutput())
    return surface


def read_surface(file):
    reader = make_reader(file)
    update(reader)
    return reader.GetOutput()


def demand_agreement(what, values, reference):
    """The largest difference, as a fraction of the largest value."""
    found = numpy.abs(values - reference).max() / numpy.abs(reference).max()
    print(f"  {what}: they differ by {found:.1e} of the largest value")
    if not found <= AGREEMENT:
        raise DemoError(f"{what}: the difference is above {AGREEMENT:.0e}")
    return found


class Folder:
    """Where the results go, and what has been written there."""

    def __init__(self, path):
        self.path = path
        self.files = []
        os.makedirs(path, exist_ok=True)

    def name(self, file):
        self.files.append(file)
        return os.path.join(self.path, file)

    def write_data(self, file, surface):
        write_data(self.name(file), surface)

    def write_table(self, file, rows):
        with open(self.name(file), "w", newline="", encoding="utf-8") as stream:
            table = csv.DictWriter(stream, rows[0].keys())
            table.writeheader()
            table.writerows(rows)

    def show(self):
        print("\nFiles")
        for file in self.files:
            path = os.path.join(self.path, file)
            print(f"  {path}  {os.path.getsize(path) / 1024:.0f} KiB")


class Summary:
    """The numbers of the run, for people as they come and as a table at the end."""

    def __init__(self):
        self.rows = []

    def add(self, scene, quantity, value, unit):
        self.rows.append({"Scene": scene, "Quantity": quantity, "Value": value, "Unit": unit})

    def show(self):
        print("\nSummary")
        for row in self.rows:
            value = row["Value"]
            text = value if isinstance(value, str) else f"{value:.6g}"
            print(f"  {row['Scene']:18s} {row['Quantity']:44s} {text} {row['Unit']}")
