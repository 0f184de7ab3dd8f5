# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a report is of: the ways to compute it, and what is told of each."""

import dataclasses
import math

from vtklighttransport.filters import find_choices

# Columns of the CSV, heading, alignment and format in print: those that every report begins and
# ends with. Medians are taken of the columns of seconds.
FIRST_COLUMNS = {
    "method": ("method", "<20", ""),
    "tolerance": ("tolerance", ">9", "g"),
    "patches": ("patches", ">9", ",d"),
    "seconds_all": ("all s", ">8", ".3g"),
    "seconds_cpu": ("CPU s", ">8", ".3g"),
}
LAST_COLUMNS = {
    "reference": ("reference", "<18", ""),
    "device": ("device", "", ""),
}


@dataclasses.dataclass
class Method:
    """A way to compute it: which property its tolerances are of, and properties that it sets."""

    name: str
    property: str
    # From coarse to fine.
    tolerances: list
    settings: dict = dataclasses.field(default_factory=dict)
    # Its line in plots.
    family: str = ""
    # Patches up to which it is tried: --reference-limit.
    limit: float = math.inf


class Subject:
    """What a kind of report tells of a surface. Methods work on the cells of any of its sizes."""

    # Of the page and of plots.
    TITLE = ""
    QUANTITY = ""
    # The array that methods are compared by.
    ARRAY = ""
    COLUMNS = {}
    # The column that errors are shown against, and its title.
    TIME = ("seconds_all", "seconds in all")
    # Columns whose growth with the number of patches is plotted, and told as an exponent.
    GROWTH = ()
    EXPONENTS = ()

    def __init__(self, options):
        self.options = options
        # The first one tells whether the input will do.
        self.methods = []
        # A method with one tolerance, which the others are compared with on the same patches.
        self.reference = None

    def make_filter(self, method, tolerance):
        """A fresh filter."""
        algorithm = self.make_plain_filter()
        for name, value in method.settings.items():
            getattr(algorithm, "Set" + name)(value)
        getattr(algorithm, "Set" + method.property)(tolerance)
        return algorithm

    def make_plain_filter(self):
        """A filter with what the options set, without what methods set."""
        raise NotImplementedError

    def describe(self, method, result, note):
        """Values of columns that the result tells by itself; `note(text)` for the list of what was
        left out."""
        raise NotImplementedError

    def compare(self, solution, reference):
        """Fills in the errors of the solution's row; returns that of each patch, for a picture."""
        raise NotImplementedError

    def rank(self, row):
        """The row of each method that has the highest one is shown as a picture of errors."""
        raise NotImplementedError

    def make_terms(self):
        """What the page says beside the scene and the machine: {term: text}."""
        raise NotImplementedError

    def explain(self, page, rows):
        """Paragraphs on what the columns mean."""
        raise NotImplementedError

    def draw_errors(self, file, surface, errors, shown, look):
        """A picture of the errors of patches; `shown` has those of all such pictures."""
        raise NotImplementedError

    def caption_errors(self, row, errors, place):
        """Of that picture; `place` is where they are largest."""
        raise NotImplementedError


def find_constants(kind, prefix):
    """Numbers of class constants by names: {"BetterDipole": MODEL_BETTER_DIPOLE, ...}."""
    return {"".join(part.capitalize() for part in name.split("-")): value
            for name, value in find_choices(kind, prefix).items()}


def whole(value):
    """As the table takes it, where it is there."""
    return "" if value is None else int(value)
