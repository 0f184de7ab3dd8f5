# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the commands of the shell share.

arguments   values of options: lists of numbers, vectors
properties  options that set properties of filters, or choose their input arrays
scene       the surface: which file, and how it is remeshed
lights      lights in place of an array of irradiance
enclosure   what radiosity and its report ask of a scene
body        what scattering and its report ask of a translucent body
files       surfaces from files and into files
stages      filters with progress, errors as plain lines
interrupts  Ctrl-C
"""
