# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Loads the plugin that is its argument, as TestModulePaths.py wants it."""

import os
import sys

from paraview import servermanager, simple

simple.LoadPlugin(sys.argv[1], remote=False, ns=globals())
found = servermanager.ProxyManager().NewProxy("filters", "LightTransportRadiosity")
print("sys.path:", *sys.path, sep="\n")
sys.stdout.flush()
# pvpython's exit code says nothing after an exception.
os._exit(0 if found else 1)
