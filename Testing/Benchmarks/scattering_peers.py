#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Photon walks beside those of other programs, in the same bodies: what is absorbed, and speed.

    scattering_peers.py [--photons 200000] [TOOL ...]

Tools are ours, analog, pmcxcl (Monte Carlo eXtreme for OpenCL, on PoCL; boxes only, of voxels) and
mitsuba (its volpath integrator on LLVM), those that are installed, all unless named. They are
searched on Python's path and in the folder that LIGHT_TRANSPORT_PEERS names, such as the
site-packages of a virtual environment. mitsuba 3.9 needs LLVM 17 or later, of which
DRJIT_LIBLLVM_PATH names the library. pmcxcl's own copy of the C++ library breaks PoCL's compiler:
here the system's is loaded before.

Diffuse light enters everywhere alike, in one band. The share of what has entered that is absorbed
stands with one standard error; photons per millisecond of CPU time are from the difference of a
long and a short run, one thread. mitsuba's roulette is off, which is biased at its defaults (an
exitance of .858 for .885). `analog` is the witness where tools disagree: the plainest walk there
is, in a cube.
"""

import argparse
import ctypes.util
import importlib.util
import math
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

LONG_OVER_SHORT = 5
# What a row of the table begins with where a process of its own prints it among others.
ROW = "row: "
BATCHES = 8
PEERS = {"ours": "vtklighttransport", "analog": "numpy", "pmcxcl": "pmcxcl", "mitsuba": "mitsuba"}


def make_bodies():
    """Name, surface, medium, mean free paths across, and voxels of boxes."""
    from scattering_models import make_box, make_bunny, make_sphere
    return (
        ("sphere", make_sphere(3), "marble", 20.0, None),
        ("sphere", make_sphere(3), "skim milk", 100.0, None),
        ("plate 10:10:1", make_box(1, 1, 0.1, 2), "marble", 100.0, None),
        ("bunny", make_bunny(), "index 1", 60.0, None),
        ("cube", make_box(1, 1, 1, 0), "index 1", 60.3, 60),
        ("cube", make_box(1, 1, 1, 0), "index 1.37", 60.3, 60),
    )


def find_external_reflectance(index):
    """Of diffuse light from outside."""
    angles = (np.arange(20000) + 0.5) / 20000 * math.pi / 2.0
    return 1.0 - (find_transmission(angles, index) * np.sin(2.0 * angles)).mean() * math.pi / 2.0


def find_transmission(angles, index):
    """Of unpolarised light from outside, by Fresnel's equations."""
    inside = np.arcsin(np.sin(angles) / index)
    along, across = np.cos(angles), np.cos(inside)
    parallel = (index * along - across) / (index * along + across)
    perpendicular = (along - index * across) / (along + index * across)
    return 1.0 - 0.5 * (parallel ** 2 + perpendicular ** 2)


class Ours:
    def prepare(self, body):
        from scattering_models import Walks
        from vtkmodules.vtkCommonCore import vtkDoubleArray
        _name, self.surface, self.medium, self.across, _voxels = body
        light = vtkDoubleArray()
        light.SetName("Irradiance")
        light.SetNumberOfComponents(3)
        light.SetNumberOfTuples(self.surface.GetNumberOfCells())
        for band in range(3):
            light.FillComponent(band, 1.0 if band == 0 else 0.0)
        self.surface.GetCellData().AddArray(light)
        self.walks = Walks

    def run(self, photons, seed):
        walks = self.walks(self.surface, self.medium, self.across, photons, seed)
        leaving = walks.field("LeavingShare")[0] + walks.field("UnscatteredShare")[0]
        return 1.0 - leaving, walks.field("LeavingShareError")[0]


class Analog:
    """In a cube: photons are absorbed whole or not at all, leave or stay; all step together."""

    def prepare(self, body):
        from scattering_models import Medium
        _name, _surface, material, self.across, _voxels = body
        medium = Medium(material)
        self.index = medium.index
        self.absorption = medium.coefficients[1][0] / medium.get_extinction()

    def run(self, photons, seed):
        chance = np.random.default_rng(seed)
        outside = np.arcsin(np.sqrt(chance.random(photons)))
        outside = outside[chance.random(photons) < find_transmission(outside, self.index)]
        entered = len(outside)
        places = chance.random((entered, 3)) * (1.0, 1.0, 0.0)
        ways = turn(np.cos(np.arcsin(np.sin(outside) / self.index)), chance)
        lengths = self.draw_lengths(entered, chance)
        absorbed = 0
        while len(places):
            stays = np.ones(len(places), dtype=bool)
            with np.errstate(divide="ignore", invalid="ignore"):
                walls = np.where(ways > 0.0, 1.0 - places, -places) / ways
            axes = walls.argmin(axis=1)
            nearest = walls.min(axis=1)
            hits, free = np.flatnonzero(nearest < lengths), np.flatnonzero(nearest >= lengths)
            places[free] += ways[free] * lengths[free, None]
            stays[free] = chance.random(len(free)) >= self.absorption
            absorbed += len(free) - stays[free].sum()
            ways[free] = turn(2.0 * chance.random(len(free)) - 1.0, chance)
            lengths[free] = self.draw_lengths(len(free), chance)
            places[hits] += ways[hits] * nearest[hits, None]
            lengths[hits] -= nearest[hits]
            stays[hits] = chance.random(len(hits)) < find_internal_reflectance(
                abs(ways[hits, axes[hits]]), self.index)
            places[hits, axes[hits]] = ways[hits, axes[hits]] > 0.0
            ways[hits, axes[hits]] *= -1.0
            places, ways, lengths = places[stays], ways[stays], lengths[stays]
        share = absorbed / entered
        return share, math.sqrt(share * (1.0 - share) / entered)

    def draw_lengths(self, number, chance):
        return chance.exponential(size=number) / self.across


def turn(cosines, chance):
    """Directions of these cosines with the z axis."""
    angles = 2.0 * math.pi * chance.random(len(cosines))
    sines = np.sqrt(1.0 - cosines ** 2)
    return np.stack([sines * np.cos(angles), sines * np.sin(angles), cosines], axis=1)


def find_internal_reflectance(cosines, index):
    outside = index * np.sqrt(1.0 - cosines ** 2)
    transmission = find_transmission(np.arcsin(np.minimum(outside, 1.0)), index)
    return np.where(outside < 1.0, 1.0 - transmission, 1.0)


class Pmcxcl:
    """A face of the cube is lit: all are alike. Photons start in the body, refracted already."""

    def prepare(self, body):
        import pmcxcl
        from scattering_models import Medium
        _name, _surface, material, _across, voxels = body
        medium = Medium(material)
        scattering, absorption = (values[0] for values in medium.coefficients)
        self.module = pmcxcl
        self.settings = {
            "vol": np.ones((voxels,) * 3, dtype=np.uint8), "tstart": 0.0, "tend": 5e-7,
            "tstep": 5e-7, "prop": [[0, 0, 1, 1], [absorption, scattering, 0, medium.index]],
            "srcpos": [0, 0, 0], "srcdir": [0, 0, 1], "srctype": "planar",
            "srcparam1": [voxels, 0, 0, 0], "srcparam2": [0, voxels, 0, 0],
            "isreflect": int(medium.index > 1.0), "issavedet": 0, "outputtype": "energy",
            "autopilot": 1, "gpuid": 1, "angleinvcdf": self.find_angles(medium.index)}

    def find_angles(self, index):
        """Inverse of the cumulative distribution of refracted angles, in parts of pi."""
        angles = np.linspace(0.0, math.pi / 2.0, 20001)
        density = find_transmission(angles, index) * np.sin(2.0 * angles)
        sums = np.concatenate([[0.0], np.cumsum(density[1:] + density[:-1])])
        inside = np.arcsin(np.sin(angles) / index) / math.pi
        return np.interp(np.linspace(0.0, 1.0, 2001), sums / sums[-1], inside).astype(np.float32)

    def run(self, photons, seed):
        shares = []
        for batch in range(BATCHES):
            stat = self.module.run({**self.settings, "nphoton": photons // BATCHES,
                                    "seed": 1000 * seed + batch + 1})["stat"]
            shares.append(stat["energyabs"] / stat["energytot"])
        return np.mean(shares), np.std(shares, ddof=1) / math.sqrt(BATCHES)


class Mitsuba:
    """Rays begin on the surface, inwards: light goes both ways alike."""

    def prepare(self, body):
        import drjit
        import mitsuba
        mitsuba.set_variant("llvm_ad_mono")
        drjit.set_thread_count(1)
        from scattering_models import Medium, measure
        self.module = mitsuba
        _name, surface, material, across, _voxels = body
        medium = Medium(material)
        self.reflectance = find_external_reflectance(medium.index) if medium.index > 1.0 else 0.0
        scattering = medium.coefficients[0][0]
        self.normals, self.areas = measure(surface)
        self.corners = self.find_corners(surface)
        boundary = {"type": "null"} if medium.index == 1.0 else {
            "type": "dielectric", "int_ior": medium.index, "ext_ior": 1.0}
        shape = mitsuba.load_dict({"type": "obj", "filename": self.write(surface),
                                   "face_normals": True, "bsdf": boundary, "interior": {
                                       "type": "homogeneous", "sigma_t": across,
                                       "albedo": scattering / medium.get_extinction()}})
        self.scene = mitsuba.load_dict({
            "type": "scene", "light": {"type": "constant", "radiance": 1.0}, "body": shape,
            "integrator": {"type": "volpath", "max_depth": -1, "rr_depth": 1 << 30}})

    def find_corners(self, surface):
        from vtkmodules.util.numpy_support import vtk_to_numpy
        corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[corners]

    def write(self, surface):
        from vtkmodules.vtkIOGeometry import vtkOBJWriter
        file = tempfile.NamedTemporaryFile(suffix=".obj")
        writer = vtkOBJWriter()
        writer.SetFileName(file.name)
        writer.SetInputData(surface)
        writer.Write()
        self.file = file
        return file.name

    def run(self, photons, seed):
        mitsuba = self.module
        chance = np.random.default_rng(seed)
        cells = chance.choice(len(self.areas), photons, p=self.areas / self.areas.sum())
        weights = chance.dirichlet((1.0, 1.0, 1.0), photons)
        normals = self.normals[cells]
        # A cosine about the normal: a point of the sphere that touches the surface.
        points = chance.standard_normal((photons, 3))
        outwards = points / np.linalg.norm(points, axis=1)[:, None] + normals
        outwards /= np.linalg.norm(outwards, axis=1)[:, None]
        origins = (weights[:, :, None] * self.corners[cells]).sum(axis=1) + 1e-4 * outwards
        sampler = mitsuba.load_dict({"type": "independent"})
        sampler.seed(seed, photons)
        rays = mitsuba.Ray3f(mitsuba.Point3f(*make_columns(mitsuba, origins)),
                             mitsuba.Vector3f(*make_columns(mitsuba, -outwards)))
        light, _valid, _others = self.scene.integrator().sample(self.scene, sampler, rays)
        absorbed = (1.0 - np.array(light).ravel()) / (1.0 - self.reflectance)
        return absorbed.mean(), absorbed.std() / math.sqrt(photons)


def make_columns(mitsuba, rows):
    return [mitsuba.Float(np.ascontiguousarray(column, dtype=np.float32)) for column in rows.T]


def time_run(tool, photons, seed):
    begin = time.process_time()
    result = tool.run(photons, seed)
    return time.process_time() - begin, result


def can_take(name, body):
    return name in ("ours", "mitsuba") or body[4] is not None


def measure_tool(name, photons):
    """Rows of the table; in a process of its own."""
    for body in make_bodies():
        if not can_take(name, body):
            continue
        tool = {"ours": Ours, "analog": Analog, "pmcxcl": Pmcxcl, "mitsuba": Mitsuba}[name]()
        tool.prepare(body)
        short = photons // LONG_OVER_SHORT
        # What is compiled and loaded once is so in the first two runs.
        tool.run(short, 1)
        tool.run(photons, 2)
        little, _result = time_run(tool, short, 3)
        seconds, (share, error) = time_run(tool, photons, 4)
        speed = (photons - short) / max(seconds - little, 1e-9) / 1000.0
        print(f"{ROW}{body[0]:14} {body[2]:10} {body[3]:6g} {name:8} {share:8.5f} {error:8.5f} "
              f"{speed:10.0f}", flush=True)


def make_environment(name):
    environment = dict(os.environ, VTK_SMP_BACKEND_IN_USE="STDThread", VTK_SMP_MAX_THREADS="1",
                       POCL_MAX_PTHREAD_COUNT="1")
    if name == "pmcxcl":
        environment["LD_PRELOAD"] = ctypes.util.find_library("stdc++") or ""
    return environment


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tools", nargs="*", metavar="TOOL", help=", ".join(PEERS))
    parser.add_argument("--photons", type=int, default=200000)
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    sys.path.append(os.environ.get("LIGHT_TRANSPORT_PEERS", ""))
    for name in options.tools or PEERS:
        if name not in PEERS:
            parser.error(f"'{name}' is none of {', '.join(PEERS)}")
    if options.here:
        measure_tool(options.tools[0], options.photons)
        return
    print(f"{'body':14} {'medium':10} {'across':>6} {'tool':8} {'absorbed':>8} {'+-':>8} "
          f"{'photons/ms':>10}", flush=True)
    for name in options.tools or PEERS:
        if importlib.util.find_spec(PEERS[name]) is None:
            print(f"{name}: not installed")
            continue
        run_apart(name, options.photons)


def run_apart(name, photons):
    """In a process of its own: rows as they come, of all else that tools tell the end of errors."""
    command = [sys.executable, __file__, "--here", name, "--photons", str(photons)]
    with tempfile.TemporaryFile("w+") as errors, subprocess.Popen(
            command, env=make_environment(name), stdout=subprocess.PIPE, stderr=errors,
            text=True) as process:
        for line in process.stdout:
            if line.startswith(ROW):
                print(line[len(ROW):], end="", flush=True)
        if process.wait():
            errors.seek(0)
            print(f"{name}: " + " ".join(errors.read().split())[-400:], flush=True)


if __name__ == "__main__":
    main()
