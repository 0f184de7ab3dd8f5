# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Whether vtkmodules is the VTK that this package was built against: with two of them in one
process objects of one are none of the other, and it ends sooner or later."""

import os
import sys

from vtklighttransport._build import VTK_LIBRARY, VTK_VERSION


def check():
    """ImportError names both. vtkmodules.vtkCommonCore is loaded already."""
    core = sys.modules["vtkmodules.vtkCommonCore"]
    refuse_another(core.vtkVersion.GetVTKVersion(), list_loaded(), core.__file__)


def refuse_another(version, libraries, place):
    """`libraries`: files of VTK's core in this process, empty where that is not known."""
    same_version = version.split(".")[:2] == VTK_VERSION.split(".")[:2]
    is_there = os.path.realpath(VTK_LIBRARY) in libraries
    if same_version and (is_there or not libraries or not os.path.exists(VTK_LIBRARY)):
        return
    raise ImportError(
        f"vtklighttransport was built against VTK {VTK_VERSION}, {VTK_LIBRARY}, but vtkmodules is "
        f"VTK {version}, {place}: two VTKs in one process do not go together. Remove the one that "
        "is not wanted from Python's path (pip uninstall vtk), or build vtklighttransport against "
        "the other one.")


def list_loaded():
    """Where the system tells (Linux)."""
    try:
        with open("/proc/self/maps", encoding="utf-8", errors="replace") as stream:
            paths = {line.split(None, 5)[5].strip() for line in stream if "vtkCommonCore" in line}
    except OSError:
        return set()
    return {os.path.realpath(path) for path in paths
            if os.path.basename(path).startswith("libvtkCommonCore")}
