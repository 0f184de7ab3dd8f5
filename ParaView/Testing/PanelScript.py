# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by ParaView's window at its start, before it plays events (see CMakeLists.txt).

Makes a filter or a reader, so that its panel is shown, and writes the events: every property has a
widget, which is seen if the property applies, and the choice of an array shows the default, once.
"""

import os
from xml.sax.saxutils import quoteattr

from paraview import simple
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

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
    "Radiosity": {"ComputeErrors"},
    "SingleScattering": set(),
    "RadianceTransfer": set(),
    "SubsurfaceScattering": {"TransmittedIrradianceArray", "BurleyFit", "NumberOfLinks",
                             "TargetError", "NumberOfPhotons", "Anisotropy", "Seed",
                             "CompressionTolerance"},
    "OpenEXRReader": set(),
}
# What is chosen in a panel, and who is seen then.
CHOICES = (
    ("PatchMesher", "SizeField", "Array", {"EdgeLengthArray": True, "TargetEdgeLength": False}),
    ("PatchMesher", "SizeField", "Curvature",
     {"ApproximationError": True, "MinimumEdgeLength": True, "EdgeLengthArray": False}),
    ("Radiosity", "LinkMethod", "Dense", {"LinkTolerance": False, "ViewFactorTolerance": True}),
    ("Radiosity", "LinkMethod", "Hierarchical",
     {"LinkTolerance": True, "ViewFactorTolerance": False, "EnforceClosure": False}),
    ("Radiosity", "LinkMethod", "Sampled", {"ComputeErrors": True, "ViewFactorTolerance": False}),
    ("SubsurfaceScattering", "Material", "Marble", {"ScatteringCoefficient": False}),
    ("SingleScattering", "Material", "Marble", {"ScatteringCoefficient": False}),
    ("SubsurfaceScattering", "Model", "Christensen Burley", {"BurleyFit": True}),
    ("SubsurfaceScattering", "Model", "Monte Carlo",
     {"BurleyFit": False, "TargetError": True, "NumberOfPhotons": True, "Anisotropy": True,
      "LinkTolerance": False}),
    ("SubsurfaceScattering", "Incidence", "Transmitted",
     {"IrradianceArray": False, "TransmittedIrradianceArray": True}),
    ("SubsurfaceScattering", "Model", "Tabulated",
     {"BurleyFit": False, "TargetError": False, "Anisotropy": True, "LinkTolerance": True}),
)
POINTS, CELLS = 0, 1  # associations of arrays
# Filters that take texels, too, whose arrays are those of points.
TEXEL_FILTERS = ("SubsurfaceScattering",)


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


def list_array_choices(proxy):
    """Property, association and default of each."""
    for key in list_shown_properties(proxy):
        prop = proxy.GetProperty(key)
        if prop.IsA("vtkSMStringVectorProperty") and prop.GetNumberOfElements() == 5:
            yield key, int(prop.GetDefaultValue(3)), prop.GetDefaultValue(4)


def make_surface(choices):
    """With all arrays that are chosen from, and another one."""
    sphere = vtkSphereSource()
    sphere.Update()
    surface = vtkPolyData()
    surface.ShallowCopy(sphere.GetOutput())
    surface.GetPointData().Initialize()
    for association, data in ((POINTS, surface.GetPointData()), (CELLS, surface.GetCellData())):
        for name in ["Another"] + [default for _, kind, default in choices if kind == association]:
            array = vtkDoubleArray()
            array.SetName(name)
            array.SetNumberOfTuples(surface.GetNumberOfElements(association))
            array.Fill(0.5)
            data.AddArray(array)
    return surface


def make_source(data):
    source = simple.PVTrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    source.UpdatePipeline()
    return source


def check_panel(name, proxy, surface):
    yield make_event(PANEL + "SearchBox/AdvancedButton", "set_boolean", "true")
    for prop in list_shown_properties(proxy):
        yield check_visibility(prop, prop not in HIDDEN[name])
    for prop, association, default in list_array_choices(proxy):
        box = PROXY_PANEL + prop + "/ComboBox"
        kinds = (POINTS, CELLS) if name in TEXEL_FILTERS else (association,)
        count = sum(surface.GetAttributes(kind).GetNumberOfArrays() for kind in kinds)
        yield make_check(box, "currentText", default)
        yield make_check(box, "count", str(count))
    for owner, prop, choice, states in CHOICES:
        if owner == name:
            yield make_event(PROXY_PANEL + prop + "/ComboBox", "set_string", choice)
            for other, visible in states.items():
                yield check_visibility(other, visible)


def make_proxy(kind):
    """With its surface, where it has one."""
    if kind == "OpenEXRReader":
        return globals()[kind](FileName=os.environ["LIGHT_TRANSPORT_IMAGE"]), None
    pattern = simple.servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy(
        "filters", "LightTransport" + kind)
    surface = make_surface(list(list_array_choices(pattern)))
    return globals()[kind](registrationName=kind, Input=make_source(surface)), surface


simple.LoadPlugin(os.environ["LIGHT_TRANSPORT_PLUGIN"], remote=False, ns=globals())
shown = os.environ["LIGHT_TRANSPORT_FILTER"]
made, with_arrays = make_proxy(shown)
simple.SetActiveSource(made)
events = check_panel(shown, made.SMProxy, with_arrays)
with open(os.environ["LIGHT_TRANSPORT_EVENTS"], "w", encoding="utf-8") as stream:
    stream.write("\n".join(["<?xml version=\"1.0\" ?>", "<pqevents>", *events, "</pqevents>", ""]))
