# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Options that choose what a report measures: counts and tolerances."""

from vtklighttransport.shell.arguments import (
    check_range, parse_numbers, parse_whole_numbers, refuse_value)
from vtklighttransport.shell.properties import find_class, keeps_value


class Value:
    METAVAR = "VALUE"

    def __init__(self, flag, kind, default, text):
        self.flag = flag
        self.kind = kind
        self.default = default
        self.text = text

    def add_to(self, parser):
        shown = f" [{self.show()}]" if self.default is not None else ""
        parser.add_argument(self.flag, type=self.kind, default=self.default, metavar=self.METAVAR,
                            help=self.text + shown)

    def show(self):
        return f"{self.default:g}"

    def get(self, options):
        return getattr(options, self.flag.lstrip("-").replace("-", "_"))

    def check(self, options, model):
        """Wrong usage where it is out of range, which for tolerances is that of the filter's
        property."""
        raise NotImplementedError


class Count(Value):
    def __init__(self, flag, low, high, default, text):
        super().__init__(flag, int, default, text)
        self.low = low
        self.high = high

    def check(self, options, model):
        check_range(options, self.flag, self.get(options), self.low, self.high)


class Tolerance(Value):
    def __init__(self, flag, name, default, text):
        super().__init__(flag, float, default, f"{name} of {text}")
        self.name = name

    def check(self, options, model):
        check_tolerance(options, model, self, self.get(options))


class Tolerances(Value):
    METAVAR = "VALUE,..."

    def __init__(self, flag, name, default, text):
        super().__init__(flag, parse_numbers, default, f"{name} of {text}")
        self.name = name

    def show(self):
        return print_numbers(self.default)

    def check(self, options, model):
        for value in self.get(options):
            check_tolerance(options, model, self, value)


class Counts(Tolerances):
    def __init__(self, flag, name, default, text):
        super().__init__(flag, name, default, text)
        self.kind = parse_whole_numbers


def print_numbers(values):
    return ",".join(f"{value:g}" for value in values)


def check_tolerance(options, model, option, value):
    if not keeps_value(model, option.name, value):
        refuse_value(options, option.flag, value)


def check_values(options, class_name, values):
    model = find_class(class_name)()
    for value in values:
        value.check(options, model)
