# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Subsurface scattering in the bunny, by two devices, and its energy: a part of demo.py."""

import os

import numpy

import vtklighttransport as lt
from vtklighttransport.arrays import get_areas, get_cell_array, get_summary
from vtklighttransport.lights import make_light
from vtkmodules.vtkCommonCore import reference

import demo_pictures
from demo_tools import DATA, DemoError, demand_agreement, read_surface, snapshot, update

FROM_FRONT = (-0.4, 0.8, 1.0)
FROM_BEHIND = (0.3, 0.5, -1.0)

# The bunny is curved over many mean free paths: it gives back nearly what a flat surface does, a
# little more in its folds.
CURVATURE_ALLOWANCE = 0.1


def read_bunny():
    return read_surface(os.path.join(DATA, "bunny.ply"))


class Translucent:
    """An object of one material; its links are computed once and serve all lights and devices."""

    def __init__(self, material):
        self.filter = lt.vtkSubsurfaceScattering()
        self.filter.SetMaterial(material)
        # What a flat surface gives back by it is known in closed form.
        self.filter.SetModelToDipole()
        self.filter.SetMillimetersPerUnit(10.0)
        self.filter.SetIncidenceToTransmitted()
        self.scattering, self.absorption, index = [0.0] * 3, [0.0] * 3, reference(0.0)
        self.filter.GetMaterialProperties(material, self.scattering, self.absorption, index)
        self.refractive_index = index.get()

    def light(self, surface, direction):
        """The surface with what enters of a white light of unit irradiance, and the seconds."""
        direct = lt.vtkDirectIrradiance()
        direct.SetInputData(surface)
        direct.AddLight(make_light(direction))
        direct.SetRefractiveIndex(self.refractive_index)
        seconds = update(direct)
        return snapshot(direct), seconds

    def scatter(self, surface, device):
        self.filter.SetInputData(surface)
        self.filter.SetDevice(device)
        seconds = update(self.filter)
        return snapshot(self.filter), seconds

    def find_flat_reflectance(self):
        """What a flat, endless surface gives back of the light that enters, per band.

        Jensen et al. 2001.
        """
        n = self.refractive_index
        internal = -1.4399 / n**2 + 0.7099 / n + 0.6681 + 0.0636 * n
        mismatch = (1.0 + internal) / (1.0 - internal)
        scattering, absorption = numpy.array(self.scattering), numpy.array(self.absorption)
        albedo = scattering / (scattering + absorption)
        root = numpy.sqrt(3.0 * (1.0 - albedo))
        return albedo / 2.0 * (1.0 + numpy.exp(-4.0 / 3.0 * mismatch * root)) * numpy.exp(-root)


def demand_energy(what, surface, expected):
    """Per band, what leaves of what enters: near the fraction of a flat surface, and below 1."""
    areas = get_areas(surface)[:, None]
    entering = (areas * get_cell_array(surface, "TransmittedIrradiance")).sum(axis=0)
    leaving = (areas * get_cell_array(surface, "ScatteredIrradiance")).sum(axis=0)
    ratio = leaving / entering
    numbers = ", ".join(f"{r:.3f} ({e:.3f})" for r, e in zip(ratio, expected))
    print(
        f"  {what}: flux entering {entering[0]:.2f};"
        f" leaving / entering, in brackets of a flat surface: {numbers}"
    )
    if not numpy.all(ratio < 1.0) or not numpy.allclose(ratio, expected, rtol=CURVATURE_ALLOWANCE):
        raise DemoError(f"{what}: the energy that leaves is not what the material gives back")
    return ratio


def show_bunny(folder, summary, name, material):
    print(f"Bunny, {name}")
    bunny = read_bunny()
    translucent = Translucent(material)
    lit, direct_seconds = translucent.light(bunny, FROM_FRONT)
    surface, cpu_seconds = translucent.scatter(lit, translucent.filter.DEVICE_CPU)
    on_device, device_seconds = translucent.scatter(lit, translucent.filter.DEVICE_OPENGL)
    found = demand_agreement(
        f"CPU and {get_summary(on_device, 'DeviceUsed')}",
        get_cell_array(on_device, "ScatteredIrradiance"),
        get_cell_array(surface, "ScatteredIrradiance"),
    )
    expected = translucent.find_flat_reflectance()
    ratio = demand_energy("light from the front", surface, expected)
    behind, _ = translucent.light(bunny, FROM_BEHIND)
    behind, _ = translucent.scatter(behind, translucent.filter.DEVICE_CPU)
    ratio_behind = demand_energy("light from behind", behind, expected)

    file = "bunny_" + name.replace(" ", "")
    folder.write_data(file + ".vtp", surface)
    demo_pictures.render_bunny(
        folder.name(file + ".png"), surface, translucent.refractive_index, make_light(FROM_FRONT)
    )
    scene = "bunny, " + name
    summary.add(scene, "patches", surface.GetNumberOfCells(), "")
    summary.add(scene, "direct irradiance", direct_seconds, "s")
    summary.add(scene, "links", get_summary(surface, "LinkSeconds"), "s")
    summary.add(scene, "links of a patch", get_summary(surface, "LinksPerReceiver"), "")
    summary.add(scene, "links and scattering, CPU", cpu_seconds, "s")
    summary.add(scene, "scattering again with OpenGL", device_seconds, "s")
    summary.add(scene, "relative error of the links", get_summary(surface, "LinkError"), "")
    summary.add(scene, "largest difference of CPU and OpenGL", found, "of the largest value")
    for band, color in enumerate(("red", "green", "blue")):
        summary.add(scene, f"leaving / entering, front, {color}", ratio[band], "")
        summary.add(scene, f"leaving / entering, behind, {color}", ratio_behind[band], "")
