# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report of subsurface scattering: ways to link patches."""

from vtklighttransport.commands.report import body
from vtklighttransport.commands.report.body import CLASS, LEVELS, light  # noqa: F401 (of a kind)
from vtklighttransport.commands.report.values import Counts
from vtklighttransport.shell.body import MODEL
from vtklighttransport.shell.properties import add_properties

TITLE = "links of scattering (--scatter-links)"
LINK_TOLERANCES = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3]
VALUES = (
    Counts("--numbers-of-links", "NumberOfLinks", [16, 64, 256], "uniform links"),
)


def add_options(group):
    for value in VALUES:
        value.add_to(group)
    add_properties(group, CLASS, [MODEL])


def check(options):
    body.check(options, MODEL)
    if getattr(options, MODEL.name) == "monte-carlo":
        options.parser.error(f"argument {MODEL.flag}: monte-carlo follows photons, not links")


def make_subject(options):
    from vtklighttransport.report.scattering_links import ScatteringLinks
    return ScatteringLinks(options, lambda: body.make_filter(options, MODEL))
