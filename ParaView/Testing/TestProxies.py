# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's XML agrees with the classes.

Every command exists, defaults and enumerations are the same, no property of a class is left out.
"""

import PluginTools as tools

import vtklighttransport as lt
from paraview import servermanager
from vtkmodules import vtkRenderingCore

# What cannot be, or need not be, a property of a proxy.
WITHOUT_PROPERTY = {"Brightness", "Controller", "Hierarchical", "ViewFactors"}
INPUTS = {"Environment"}  # ports
FILTERS = ("vtkPatchMesher", "vtkSurfaceAtlas", "vtkSurfaceToAtlas", "vtkAtlasToSurface",
           "vtkViewFactors", "vtkDirectIrradiance", "vtkRadiosity", "vtkSubsurfaceScattering",
           "vtkSingleScattering", "vtkRadianceTransfer")
LIGHTS = ("NoLight", "DirectionalLight", "PointLight", "SpotLight")


def iterate_properties(proxy):
    iterator = proxy.NewPropertyIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        yield iterator.GetKey(), iterator.GetProperty()
        iterator.Next()


def get_value(vector):
    values = tuple(vector.GetElement(i) for i in range(vector.GetNumberOfElements()))
    return values[0] if len(values) == 1 else values


def get_domain(prop, kind):
    iterator = prop.NewDomainIterator()
    iterator.Begin()
    while not iterator.IsAtEnd():
        if iterator.GetDomain().IsA(kind):
            return iterator.GetDomain()
        iterator.Next()
    return None


def check_enumeration(label, domain, kind):
    """Entries count from 0 and are named as the class's constants are."""
    names = {domain.GetEntryValue(i): domain.GetEntryText(i)
             for i in range(domain.GetNumberOfEntries())}
    prefix = "".join("_" + c if c.isupper() else c for c in label).upper().lstrip("_") + "_"
    constants = {getattr(kind, key): key[len(prefix):]
                 for key in dir(kind) if key.startswith(prefix)}

    def squeeze(text):
        return "".join(c for c in text.upper() if c.isalnum())

    if {k: squeeze(v) for k, v in names.items()} != {k: squeeze(v) for k, v in constants.items()}:
        return [f"{kind.__name__} {label}: {names} in the XML, {constants} in the class"]
    return []


def check_proxy(proxy, model):
    problems = []
    kind = type(model)
    commands = set()
    for key, prop in iterate_properties(proxy):
        label = f"{proxy.GetXMLName()}.{key}"
        command = prop.GetCommand()
        if not command or not hasattr(model, command):
            problems.append(f"{label}: {kind.__name__} has no method {command}")
            continue
        commands.add(command[3:])
        if not prop.GetDocumentation() and key != "Input" and prop.GetPanelVisibility() != "never":
            problems.append(f"{label} has no documentation")
        getter = "Get" + command[3:]
        if prop.IsA("vtkSMVectorProperty") and command.startswith("Set") and hasattr(model, getter):
            default = getattr(model, getter)()
            value = get_value(prop)
            if value != default and not kind.__name__.endswith("Light"):
                problems.append(f"{label}: default {value} in the XML, {default} in the class")
        domain = get_domain(prop, "vtkSMEnumerationDomain")
        if domain:
            problems += check_enumeration(key, domain, kind)
    return problems, commands


def check_filter(name):
    proxy = servermanager.ProxyManager().NewProxy("filters", "LightTransport" + name[3:])
    if not proxy:
        return [f"there is no proxy for {name}"]
    problems, commands = check_proxy(proxy, getattr(lt, name)())
    if proxy.GetVTKClassName() != name:
        problems.append(f"{proxy.GetXMLName()} is made of {proxy.GetVTKClassName()}")
    own = set()
    for kind in type(getattr(lt, name)()).__mro__:
        if kind.__name__ in (
                "vtkImageAlgorithm", "vtkPassInputTypeAlgorithm", "vtkPolyDataAlgorithm"):
            break
        own |= {key[3:] for key in vars(kind) if key.startswith("Set") and "To" not in key[3:]}
    for missing in sorted(own - commands - WITHOUT_PROPERTY - INPUTS):
        problems.append(f"{name} has Set{missing}, and its proxy no such property")
    categories = proxy.GetHints().FindNestedElementByName("ShowInMenu")
    if not categories or categories.GetAttribute("category") != "Light Transport":
        problems.append(f"{name} is not in the menu Light Transport")
    return problems


def check_light(name):
    proxy = servermanager.ProxyManager().NewProxy("light_transport_lights", "LightTransport" + name)
    return check_proxy(proxy, vtkRenderingCore.vtkLight())[0] if proxy else [f"there is no {name}"]


def check_list(name, item):
    """A property with any number of values: they replace those of before."""
    proxy = servermanager.ProxyManager().NewProxy("filters", "LightTransportRadiosity")
    prop = proxy.GetProperty(name)
    for values in ([0.0, 8.0, 1e9], [5.0], []):
        prop.SetNumberOfElements(len(values))
        for index, value in enumerate(values):
            prop.SetElement(index, value)
        proxy.UpdateVTKObjects()
        model = proxy.GetClientSideObject()
        count = getattr(model, f"GetNumberOf{item}s")()
        found = [getattr(model, "Get" + item)(index) for index in range(count)]
        if found != values:
            return [f"{name}: {values} in the proxy, {found} in the class"]
    return []


all_problems = []
for filter_name in FILTERS:
    if hasattr(lt, filter_name):
        all_problems += check_filter(filter_name)
for light_name in LIGHTS:
    all_problems += check_light(light_name)
all_problems += check_list("BandLimits", "BandLimit")
all_problems += check_list("BackgroundRadiance", "BackgroundRadiance")
tools.finish(all_problems)
