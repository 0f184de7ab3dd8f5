# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Filters from keywords: properties by their names, errors as exceptions, warnings as warnings.

    radiosity = make_filter("vtkRadiosity", solver="gauss-seidel", tolerance=1e-6)
    result = run_filter(radiosity, surface, progress=True)

A keyword is the name of a property in small letters, `view_factor_tolerance` for
ViewFactorTolerance; what is added one by one may be a list, `band_limits=[0, 8, inf]`. Values of
enumerations are their names, "conjugate-gradient", or numbers. Needs no numpy.
"""

import difflib
import re
import warnings

import vtklighttransport as lt
from vtklighttransport.progress import ProgressBar, update
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_STRING


class LightTransportError(RuntimeError):
    """What a filter says is wrong, where, and what to do."""


class LightTransportWarning(UserWarning):
    """What a filter doubts."""


def find_class(name):
    """AttributeError where the build left its module out."""
    if not hasattr(lt, name):
        raise AttributeError(f"this build has no {name}: its module was switched off in CMake (of "
                             "pip's wheels vtklighttransport-gpl has the mesher and the atlas)")
    return getattr(lt, name)


def make_filter(name, **properties):
    """A new filter. TypeError tells of a property that it does not have, ValueError of a value."""
    algorithm = find_class(name)()
    for keyword, value in properties.items():
        set_property(algorithm, keyword, value)
    return algorithm


def set_property(algorithm, keyword, value):
    name = find_property(algorithm, keyword)
    if hasattr(algorithm, "Add" + name):
        for number in [value] if isinstance(value, (int, float)) else value:
            getattr(algorithm, "Add" + name)(number)
        return
    if isinstance(value, str):
        value = find_choice(type(algorithm), keyword, value)
    values = tuple(value) if hasattr(value, "__len__") else (value,)
    getattr(algorithm, "Set" + name)(*values)
    # Setters move a value into the property's range without a word.
    kept = getattr(algorithm, "Get" + name)()
    if kept != (values if len(values) > 1 else values[0]):
        raise ValueError(f"{keyword}={value!r} is out of range: the nearest value is {kept}")


def find_property(algorithm, keyword):
    """Those of the project: what vtkAlgorithm can set besides is no property."""
    names = {}
    for name in dir(algorithm):
        match = re.fullmatch(r"(?:Set|Add)([A-Z]\w*)", name)
        if match and "To" + match[1] not in name and is_own(algorithm, name):
            names[to_keyword(match[1])] = match[1]
            if name.startswith("Add"):
                names[to_keyword(match[1]) + "s"] = match[1]
    if keyword not in names:
        near = suggest(keyword, names)
        raise TypeError(f"{type(algorithm).__name__} has no property '{keyword}'"
                        + (f"; did you mean '{near}'?" if near else ""))
    return names[keyword]


def is_own(algorithm, name):
    """Whether the method is of a class of this package."""
    return any(name in vars(kind) for kind in type(algorithm).__mro__
               if kind.__module__.startswith("vtklighttransport"))


def to_keyword(name):
    """TargetNumberOfPatches: target_number_of_patches."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def find_choices(kind, prefix):
    """Values of an enumeration by their names."""
    return {key[len(prefix):].lower().replace("_", "-"): getattr(kind, key)
            for key in dir(kind) if key.startswith(prefix)}


def find_choice(kind, keyword, value):
    choices = find_choices(kind, keyword.upper() + "_")
    name = value.lower().replace("_", "-").replace(" ", "-")
    if name not in choices:
        raise ValueError(f"{keyword}='{value}' is none of {', '.join(sorted(choices))}")
    return choices[name]


def suggest(name, names):
    """The one that was meant, most likely; None where none is near."""
    lower = {known.lower(): known for known in names}
    near = difflib.get_close_matches(name.lower(), lower, n=1, cutoff=0.7)
    return lower[near[0]] if near else None


def run_filter(algorithm, data=None, progress=False):
    """The output of port 0. LightTransportError has what the filter reports. `progress` may be a
    bar."""
    errors, doubts = [], []
    observers = [algorithm.AddObserver("ErrorEvent", make_listener(errors)),
                 algorithm.AddObserver("WarningEvent", make_listener(doubts))]
    # It only says that the filter has failed.
    executive = algorithm.GetExecutive()
    repeated = executive.AddObserver("ErrorEvent", make_listener([]))
    try:
        if data is not None:
            algorithm.SetInputDataObject(0, data)
        if progress is True:
            progress = ProgressBar(algorithm.GetClassName()[3:])
        update(algorithm, progress or None)
    finally:
        for observer in observers:
            algorithm.RemoveObserver(observer)
        executive.RemoveObserver(repeated)
    for text in doubts:
        warnings.warn(text, LightTransportWarning, stacklevel=3)
    if errors:
        raise LightTransportError("; ".join(errors))
    return algorithm.GetOutputDataObject(0)


def make_listener(texts):
    @calldata_type(VTK_STRING)
    def listen(_caller, _event, text):
        texts.append(plain(text))
    return listen


def plain(text):
    """A VTK message without the place in the source and without line breaks."""
    match = re.search(r"\((?:0x)?[0-9a-fA-F]+\): (.*)", text, re.DOTALL)
    return " ".join((match.group(1) if match else text).split())
