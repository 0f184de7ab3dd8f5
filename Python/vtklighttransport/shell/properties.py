# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Options that set properties of filters, choose their input arrays, or give these values.

Tables of them are what a command offers. Defaults, ranges and choices come from the classes; where
a class was not built, its options are left out.
"""

import vtklighttransport as lt
from vtklighttransport import filters
from vtklighttransport.filters import find_choices, suggest
from vtklighttransport.materials import set_cell_values
from vtklighttransport.shell.arguments import parse_material, parse_numbers, refuse_value
from vtklighttransport.shell.stages import Failure
from vtkmodules.vtkCommonDataModel import vtkDataObject


class Property:
    """An option of one value, of any type."""

    def __init__(self, flag, name, text):
        self.flag = flag
        self.name = name
        self.text = text

    def add_to(self, parser, model):
        parser.add_argument(self.flag, dest=self.name, default=None, **self.describe(model))

    def describe(self, model):
        """What argparse must know; help ends with the default that the model has."""
        raise NotImplementedError

    def set_on(self, algorithm, value):
        getattr(algorithm, "Set" + self.name)(value)

    def get_from(self, algorithm):
        return getattr(algorithm, "Get" + self.name)()

    def is_in_range(self, _model, _value):
        return True


class Number(Property):
    """A number within the range of the property."""

    def __init__(self, flag, name, kind, text):
        super().__init__(flag, name, text)
        self.kind = kind

    def describe(self, model):
        return {"type": self.kind, "metavar": "VALUE",
                "help": f"{self.text} [{self.get_from(model):g}]"}

    def is_in_range(self, model, value):
        return keeps_value(model, self.name, value)


class Length(Number):
    """A length in the mesh's unit; the text tells of the default."""

    def __init__(self, flag, name, text):
        super().__init__(flag, name, float, text)

    def describe(self, model):
        return {"type": self.kind, "metavar": "LENGTH", "help": self.text}

    def is_in_range(self, model, value):
        return 0.0 <= value < float("inf") and super().is_in_range(model, value)


class Color(Property):
    """A number each for red, green and blue."""

    def describe(self, model):
        default = " ".join(f"{value:g}" for value in self.get_from(model))
        return {"nargs": 3, "type": float, "metavar": ("R", "G", "B"),
                "help": f"{self.text} [{default}]"}

    def set_on(self, algorithm, value):
        getattr(algorithm, "Set" + self.name)(*value)


class NumberList(Property):
    """Any number of values, which are added one by one."""

    def describe(self, model):
        return {"type": parse_numbers, "metavar": "A,B,...", "help": self.text}

    def set_on(self, algorithm, value):
        for number in value:
            getattr(algorithm, "Add" + self.name)(number)


class Switch(Property):
    """An option without a value, which sets the property to `value`."""

    def __init__(self, flag, name, value, text):
        super().__init__(flag, name, text)
        self.value = value

    def describe(self, model):
        return {"action": "store_const", "const": self.value, "help": self.text}


class Choice(Property):
    """One of the class constants that begin with `prefix`."""

    def __init__(self, flag, name, prefix, text):
        super().__init__(flag, name, text)
        self.prefix = prefix

    def describe(self, model):
        choices = find_choices(type(model), self.prefix)
        names = sorted(choices, key=choices.get)
        default = next(key for key in names if choices[key] == self.get_from(model))
        return {"choices": names, "help": f"{self.text} [{default}]"}

    def set_on(self, algorithm, value):
        super().set_on(algorithm, find_choices(type(algorithm), self.prefix)[value])


DEVICE = Choice("--device", "Device", "DEVICE_",
                "where the links are applied; auto takes OpenGL on a real GPU")


class InputArray:
    """An option for the cell array with an index of SetInputArrayToProcess, `name` by default: its
    name, or its values."""

    def __init__(self, flag, index, name, text):
        self.flag = flag
        self.index = index
        self.name = name
        self.text = text
        self.destination = f"array{index}"

    def get_name(self, options):
        """The name that was given, None where there is none."""
        names = [given for given in getattr(options, self.destination) if isinstance(given, str)]
        if len(names) > 1:
            raise Failure(f"{self.flag} names two arrays, {names[0]} and {names[1]}: choose one")
        return names[0] if names else None

    def get_values(self, options):
        """Values by regions."""
        values = {}
        for given in getattr(options, self.destination):
            values.update({} if isinstance(given, str) else given)
        return values


def find_class(name):
    try:
        return filters.find_class(name)
    except AttributeError as error:
        raise Failure(str(error)) from error


def keeps_value(model, name, value):
    """Setters move a value into the property's range without a word."""
    getattr(model, "Set" + name)(value)
    return getattr(model, "Get" + name)() == value


def add_properties(parser, class_name, table):
    if hasattr(lt, class_name):
        model = find_class(class_name)()
        for option in table:
            option.add_to(parser, model)
            note_flag(parser, option)


def note_flag(parser, option):
    """Messages of filters name properties and arrays, and not the options for them."""
    flags = parser.get_default("flags") or {}
    parser.set_defaults(flags={**flags, option.name: option.flag})


def get_given(options, table):
    """Pairs of options of the table and their values; those that were not given are left out."""
    pairs = ((option, getattr(options, option.name)) for option in table)
    return [(option, value) for option, value in pairs if value is not None]


def check_properties(options, class_name, table):
    """Wrong usage where a value is out of the property's range."""
    model = find_class(class_name)()
    for option, value in get_given(options, table):
        if not option.is_in_range(model, value):
            refuse_value(options, option.flag, value)


def make_filter(options, class_name, table):
    """A new filter with what the options set."""
    algorithm = find_class(class_name)()
    for option, value in get_given(options, table):
        option.set_on(algorithm, value)
    return algorithm


def add_arrays(parser, table):
    for array in table:
        parser.add_argument(array.flag, metavar="NAME|VALUE|REGION=VALUE", type=parse_material,
                            action="append", default=[], dest=array.destination,
                            help=f"{array.text} [{array.name}]")
        note_flag(parser, array)


def choose_arrays(options, algorithm, table):
    for array in table:
        name = array.get_name(options)
        if name:
            choose_array(algorithm, array.index, name)


def give_values(options, table, data):
    """The surface with the arrays of which values were given. A name that is nearly that of an
    array ends the run: filters do without some arrays."""
    copy = data.NewInstance()
    copy.ShallowCopy(data)
    for array in table:
        name, values = array.get_name(options), array.get_values(options)
        if name:
            check_name(array, name, data)
        if values and not data.IsA("vtkPolyData"):
            raise Failure(f"{array.flag}: values go with a surface; texels need an array of them")
        if values:
            try:
                set_cell_values(copy, name or array.name, values)
            except ValueError as error:
                raise Failure(f"{array.flag}: {error}") from error
    return copy


def check_name(array, name, data):
    attributes = data.GetCellData() if data.IsA("vtkPolyData") else data.GetPointData()
    names = [attributes.GetArrayName(k) or "" for k in range(attributes.GetNumberOfArrays())]
    near = suggest(name, names)
    if name not in names and name.lower() != "none" and near:
        raise Failure(f"{array.flag}: there is no array '{name}', did you mean '{near}'?")


def choose_array(algorithm, index, name):
    algorithm.SetInputArrayToProcess(index, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, name)
