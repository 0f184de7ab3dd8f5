# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Lights from directions and points; needs no numpy."""

from vtklighttransport.filters import make_filter
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkDataObject


def make_light(position, intensity=1.0, positional=False):
    """From a direction, infinitely far, or from a point."""
    from vtkmodules.vtkRenderingCore import vtkLight
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(position)
    light.SetFocalPoint(0.0, 0.0, 0.0)
    light.SetIntensity(intensity)
    if positional:
        light.PositionalOn()
        # Beyond 90 degrees the light has no cone.
        light.SetConeAngle(180.0)
        light.SetAttenuationValues(0.0, 0.0, 1.0)
    return light


def find_material(scattering):
    """Reduced scattering, absorption and refractive index: of the material, or of the properties
    where there is none."""
    reduced = list(scattering.GetScatteringCoefficient())
    absorption = list(scattering.GetAbsorptionCoefficient())
    index = reference(scattering.GetRefractiveIndex())
    scattering.GetMaterialProperties(scattering.GetMaterial(), reduced, absorption, index)
    return reduced, absorption, index.get()


def take_light_of(scattering):
    """The filter takes what vtkDirectIrradiance writes; returns the index that this must have."""
    index = find_material(scattering)[2]
    if index > 1.0:
        scattering.SetIncidenceToTransmitted()
    else:
        scattering.SetInputArrayToProcess(
            0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "DirectIrradiance")
    return index


def make_irradiance(lights, **properties):
    """A vtkDirectIrradiance. A light is a vtkLight, or (x, y, z), or (x, y, z, intensity)."""
    irradiance = make_filter("vtkDirectIrradiance", **properties)
    for light in lights:
        irradiance.AddLight(light if hasattr(light, "IsA") else make_light(*to_light(light)))
    return irradiance


def to_light(values):
    """Position and, where it is given, intensity."""
    try:
        numbers = [float(value) for value in values]
    except (TypeError, ValueError):
        numbers = []
    if len(numbers) not in (3, 4):
        raise ValueError("lights is a list of lights, each a vtkLight, (x, y, z) or (x, y, z, "
                         f"intensity), such as lights=[(1, 1, 1)]; {values!r:.60} is none")
    return numbers[:3], *numbers[3:]
