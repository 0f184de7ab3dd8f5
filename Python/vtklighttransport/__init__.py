# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Radiosity and diffuse subsurface scattering on surface meshes.

Every class of every module that was built is here:

    import vtklighttransport as lt
    radiosity = lt.vtkRadiosity()

A module that was switched off when the package was built is left out; one that was built and
cannot be loaded raises ImportError. Short forms of whole jobs (`jobs`, `factors`):

    surface = lt.radiosity("part.stl", temperature=300, emissivity=0.9)
    matrix = lt.view_factors("part.stl")

``arrays`` holds helpers for getting numbers in and out of data sets. ``python3 -m vtklighttransport
--help`` runs the filters from the shell. With PyVista, its meshes have them as
``mesh.light_transport``.
"""

import importlib
import os
import sys

# Python's -m says so in the place of the program's name while it looks for the command's package.
if (sys.argv[:1] == ["-m"] and {__name__, "-m" + __name__}.intersection(sys.orig_argv)
        and hasattr(os, "fork")):
    from .shell.interrupts import work_in_another_process
    work_in_another_process()

# The modules these bring in must be there before ours: a wrapped class needs its base class.
import vtkmodules.vtkCommonCore
import vtkmodules.vtkCommonDataModel
import vtkmodules.vtkCommonExecutionModel  # noqa: F401

from ._build import MODULES as _MODULES
from ._build import VERSION as __version__
from ._vtk import check as _check_vtk

_check_vtk()

_REQUIRED = {
    "vtkLightTransportFilters": ("vtkCommonMath", "vtkRenderingCore"),
    "vtkLightTransportRendering": ("vtkRenderingOpenGL2",),
    "vtkLightTransportIO": ("vtkIOCore", "vtkIOImage"),
}

__all__ = ["__version__"]
for _module in _MODULES:
    for _name in _REQUIRED.get(_module, ()):
        importlib.import_module("vtkmodules." + _name)
    for _name, _value in vars(importlib.import_module("." + _module, __name__)).items():
        if _name.startswith("vtk"):
            globals()[_name] = _value
            __all__.append(_name)
del _module, _name, _value

# What is loaded when it is asked for; some of it needs numpy.
_LATER = {
    "LightTransportError": "filters",
    "LightTransportWarning": "filters",
    "ViewFactorMatrix": "factors",
    "atlas": "jobs",
    "irradiance": "jobs",
    "patches": "jobs",
    "radiosity": "jobs",
    "read_mesh": "meshes",
    "read_view_factors": "factors",
    "scatter": "jobs",
    "view_factors": "factors",
}
__all__ += _LATER


def __getattr__(name):
    if name not in _LATER:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(importlib.import_module("." + _LATER[name], __name__), name)
