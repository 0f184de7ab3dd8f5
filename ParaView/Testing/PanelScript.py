# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by ParaView's window at its start, before it plays events (see CMakeLists.txt).

Makes a filter, so that its panel is shown, and writes the events: every property has a widget,
which is seen if the property applies.
"""

import os
from xml.sax.saxutils import quoteattr

from paraview import simple

WINDOW = "pqClientMainWindow/"
PANEL = WINDOW + "propertiesDock/propertiesPanel/"
PROXY_PANEL = PANEL + ("scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/"
                       "PropertiesFrame/ProxyPanel/")
# Filters, and what does not apply while all properties are as they are at first.
HIDDEN = {
    "PatchMesher": {"EdgeLengthArray", "ApproximationError", "MinimumEdgeLength"},
    "SurfaceAtlas": set(),
    "SurfaceToAtlas": set(),
    "ViewFactors": {"LinkTolerance", "ClusterTree"},
    "DirectIrradiance": set(),
    "Radiosity": set(),
    "SubsurfaceScattering": {"BurleyFit", "LinkMethod", "TargetError", "NumberOfPhotons",
                             "Anisotropy", "Seed"},
}
# What is chosen in a panel, and who is seen then.
CHOICES = (
    ("PatchMesher", "SizeField", "Array", {"EdgeLengthArray": True, "TargetEdgeLength": False}),
    ("PatchMesher", "SizeField", "Curvature",
     {"ApproximationError": True, "MinimumEdgeLength": True, "EdgeLengthArray": False}),
    ("Radiosity", "LinkMethod", "Dense", {"LinkTolerance": False, "ViewFactorTolerance": True}),
    ("Radiosity", "LinkMethod", "Hierarchical",
     {"LinkTolerance": True, "ViewFactorTolerance": False, "EnforceClosure": False}),
    ("SubsurfaceScattering", "Material", "Marble", {"ScatteringCoefficient": False}),
    ("SubsurfaceScattering", "Model", "Christensen Burley", {"BurleyFit": True}),
    ("SubsurfaceScattering", "Model", "Monte Carlo",
     {"BurleyFit": False, "TargetError": True, "NumberOfPhotons": True, "Anisotropy": True,
      "LinkTolerance": False}),
    ("SubsurfaceScattering", "Model", "Tabulated",
     {"BurleyFit": False, "TargetError": False, "Anisotropy": True, "LinkTolerance": True}),
)
# What is chosen at first, where it is the name of an array.
ARRAYS = (("PatchMesher", "RegionArray", "Region"), ("ViewFactors", "GroupArray", "Group"),
          ("Radiosity", "EmissionArray", "Emission"))


def make_event(name, command, arguments):
    return f"<pqevent object={quoteattr(name)} command={quoteattr(command)} " \
           f"arguments={quoteattr(arguments)} />"


def make_check(name, key, value):
    return f"<pqcheck object={quoteattr(name)} property={quoteattr(key)} " \
           f"arguments={quoteattr(value)} />"


def check_visibility(prop, visible):
    return make_check(PROXY_PANEL + prop, "visible", "true" if visible else "false")


def list_shown_properties(proxy):
    """Those that ParaView means to show; inputs are chosen elsewhere."""
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        prop = iterator.GetProperty()
        if not (prop.GetPanelVisibility() == "never" or prop.GetInformationOnly()
                or prop.IsA("vtkSMInputProperty") or prop.GetIsInternal()):
            yield iterator.GetKey()
        iterator.Next()


def check_panel(name, proxy):
    yield make_event(PANEL + "SearchBox/AdvancedButton", "set_boolean", "true")
    for prop in list_shown_properties(proxy):
        yield check_visibility(prop, prop not in HIDDEN[name])
    for owner, prop, text in ARRAYS:
        if owner == name:
            yield make_check(PROXY_PANEL + prop + "/ComboBox", "currentText", text)
    for owner, prop, choice, states in CHOICES:
        if owner == name:
            yield make_event(PROXY_PANEL + prop + "/ComboBox", "set_string", choice)
            for other, visible in states.items():
                yield check_visibility(other, visible)


simple.LoadPlugin(os.environ["LIGHT_TRANSPORT_PLUGIN"], remote=False, ns=globals())
kind = os.environ["LIGHT_TRANSPORT_FILTER"]
made = globals()[kind](registrationName=kind, Input=simple.Sphere())
simple.SetActiveSource(made)
events = check_panel(kind, made.SMProxy)
with open(os.environ["LIGHT_TRANSPORT_EVENTS"], "w", encoding="utf-8") as stream:
    stream.write("\n".join(["<?xml version=\"1.0\" ?>", "<pqevents>", *events, "</pqevents>", ""]))
