#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""Error of radiosity against CPU seconds, in one table: ours beside plain rays and other programs.

    radiosity_peers.py --program RadiosityPeersBenchmark [--scenes S,S,...] [--methods M,M,...]

Methods are auto, dense, hierarchical and sampled (LinkMethod; what a build lacks is left out), each
at the tolerances of its table, and rays (plain Embree, PlainRays.h), view3d and pyviewfactor,
which run where they are installed: View3D as a program on the path, pyviewfactor 1.1 in the Python
that --peer-python names (it wants another VTK than Debian's); both in small scenes.
Lights are "lamp" (a small one), "even" (all patches send alike), "sky" (all that comes in through
openings) and "sun" (what a low sun makes a crater reflect).

CPU seconds are those of all threads, without start-up and reading. The error is
sqrt(sum A dB^2 / sum A (B - E)^2): what is emitted is not counted. It is that from closed forms
where there is one (even light in a closed room of one reflectance), else from the dense method at
--reference, and for scenes that are too large for it from many plain rays; references are kept in
the folder. MB are those of the links. Each row is printed when it is known; what was printed
radiosity_peers_table.py makes tables and plots of.
"""

import argparse
import collections
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np
import vtklighttransport as lt
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SCENES = {"spheres-640": ("lamp", "even"), "spheres-2560": ("lamp", "even"),
          "spheres-10240": ("lamp", "even"), "cornell-2000": ("lamp", "even"),
          "room-3200": ("lamp", "even"), "room-8000": ("lamp", "even"),
          "white-room-2000": ("lamp", "even"), "crater-3200": ("sun", "sky"),
          "city-6000": ("lamp", "even", "sky"), "city-24000": ("lamp", "even", "sky"),
          "city-96000": ("lamp", "even", "sky"), "city-1000000": ("sky",)}
CLOSED = ("spheres", "room", "white-room")
ON_REQUEST = ("city-96000", "city-1000000")
SETTINGS = {"auto": ("1e-1", "5e-2", "3e-2", "1e-2", "3e-3", "1e-3"),
            "dense": ("1e-1", "1e-2", "1e-3"),
            "hierarchical": ("1e-1", "3e-2", "1e-2"),
            "sampled": ("1e-1", "5e-2", "3e-2", "1e-2", "3e-3", "1e-3"),
            "rays": ("16", "64", "256", "1024", "4096", "16384"),
            "view3d": ("1e-3",), "pyviewfactor": ("once",)}
# Which property of vtkRadiosity a setting is.
TOLERANCES = {"dense": "ViewFactorTolerance", "hierarchical": "LinkTolerance", "auto": "Accuracy",
              "sampled": "Accuracy"}
# Beyond these the dense matrix is not tried, nor other programs.
DENSE_PATCHES = 10500
PEER_PATCHES = 2800
REFERENCE_RAYS = 65536
SOLVER_TOLERANCE = 1e-6
# Seconds below which one run tells little.
LITTLE = 1.0

# In a process of its own, which may have another VTK. Compilation is start-up.
PYVIEWFACTOR = """
import sys, time, numpy, pyvista, pyviewfactor
mesh = pyvista.read(sys.argv[1])
compute = pyviewfactor.compute_viewfactor_matrix
compute(mesh.extract_cells(range(4)).extract_surface(), obstacles=[mesh.triangulate()])
begin = time.process_time()
factors = compute(mesh, obstacles=[mesh.triangulate()])
print(time.process_time() - begin)
numpy.save(sys.argv[2], factors.T)
"""

Row = collections.namedtuple("Row", "seconds megabytes radiosity said")


class Scene:
    def __init__(self, name, options):
        self.name = name
        self.path = options.folder / f"{name}.vtp"
        if not self.path.exists():
            subprocess.run([options.program, "scene", name, self.path], check=True)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(self.path))
        reader.Update()
        self.data = reader.GetOutput()
        self.areas = measure(self.data)
        self.reflectance = vtk_to_numpy(self.data.GetCellData().GetArray("Reflectance"))
        self.is_closed = name.rsplit("-", 1)[0] in CLOSED

    def get_emission(self, light):
        array = self.data.GetCellData().GetArray(light)
        return vtk_to_numpy(array) if array else np.zeros(len(self.areas))

    def find_error(self, light, radiosity, reference):
        emission = self.get_emission(light)
        difference = (self.areas * (radiosity - reference) ** 2).sum()
        return math.sqrt(difference / (self.areas * (reference - emission) ** 2).sum())


def measure(data):
    quality = vtkMeshQuality()
    quality.SetInputData(data)
    quality.SetTriangleQualityMeasureToArea()
    quality.SetQuadQualityMeasureToArea()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def run_ours(scene, light, method, setting):
    """None where this build does not know the method."""
    radiosity = lt.vtkRadiosity()
    choose = getattr(radiosity, f"SetLinkMethodTo{method.capitalize()}", None)
    tolerate = getattr(radiosity, f"Set{TOLERANCES[method]}", None)
    if not choose or not tolerate:
        return None
    choose()
    tolerate(float(setting))
    radiosity.SetTolerance(SOLVER_TOLERANCE)
    radiosity.SetDeviceToCPU()
    radiosity.SetInputData(scene.data)
    if light == "sky":
        radiosity.SetBackgroundRadiance(1.0 / math.pi)
    else:
        radiosity.SetInputArrayToProcess(0, 0, 0, 1, light)
    begin = time.process_time()
    radiosity.Update()
    seconds = time.process_time() - begin
    output = radiosity.GetOutputDataObject(0)
    field = output.GetFieldData()
    size = next((field.GetArray(name).GetValue(0) for name in ("MatrixBytes", "LinkBytes")
                 if field.GetArray(name)), math.nan)
    reached = field.GetArray("AccuracyReached")
    return Row(seconds, size / 1e6, vtk_to_numpy(output.GetCellData().GetArray("Radiosity")),
               f"{reached.GetValue(0):.1e}" if reached else "")


def run_rays(scene, light, rays, seed, options):
    with tempfile.NamedTemporaryFile() as file:
        done = subprocess.run([options.program, "rays", scene.path, light,
                               "1" if light == "sky" else "0", str(rays), str(seed), file.name],
                              check=True, capture_output=True, text=True)
        seconds, size = (float(word) for word in done.stdout.split())
        return Row(seconds, size / 1e6, np.fromfile(file.name, np.float32).astype(float), "")


def find_children_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def solve(scene, light, factors):
    """By a matrix of view factors."""
    emission = scene.get_emission(light)
    sky = 1.0 - factors.sum(axis=1) if light == "sky" else 0.0
    reflected = scene.reflectance[:, None] * factors
    return np.linalg.solve(np.eye(len(emission)) - reflected, emission + scene.reflectance * sky)


def run_view3d(scene, light, setting):
    program = shutil.which("View3D") or shutil.which("view3d")
    if not program or len(scene.areas) > PEER_PATCHES:
        return None
    with tempfile.TemporaryDirectory() as folder:
        given, found = os.path.join(folder, "in.vs3"), os.path.join(folder, "out.txt")
        with open(given, "w", encoding="ascii") as file:
            file.write(f"T {scene.name}\nC encl=0 eps={setting}\nF 3\n")
            for index in range(scene.data.GetNumberOfPoints()):
                file.write("V %d %.9g %.9g %.9g\n" % (index + 1, *scene.data.GetPoint(index)))
            for index in range(len(scene.areas)):
                cell = scene.data.GetCell(index)
                corners = [cell.GetPointId(k) + 1 for k in range(cell.GetNumberOfPoints())]
                corners += [0] * (4 - len(corners))
                file.write("S %d %d %d %d %d 0 0 1 s%d\n" % (index + 1, *corners, index + 1))
            file.write("End of data\n")
        begin = find_children_seconds()
        # It leaves a log where it runs.
        subprocess.run([os.path.abspath(program), given, found], check=True, cwd=folder,
                       capture_output=True)
        seconds = find_children_seconds() - begin
        size = len(scene.areas)
        with open(found, encoding="ascii") as file:
            file.readline()
            numbers = np.array(file.read().split(), float)
        factors = numbers[size:size + size * size].reshape(size, size)
    return Row(seconds, 4e-6 * size ** 2, solve(scene, light, factors), "")


def run_pyviewfactor(scene, light, options):
    if len(scene.areas) > PEER_PATCHES:
        return None
    with tempfile.TemporaryDirectory() as folder:
        found = os.path.join(folder, "factors.npy")
        done = subprocess.run([options.peer_python, "-c", PYVIEWFACTOR, scene.path, found],
                              check=False, capture_output=True, text=True)
        if done.returncode != 0:
            return None
        factors = np.load(found)
    return Row(float(done.stdout.split()[-1]), 8e-6 * factors.size,
               solve(scene, light, factors), "")


def run_once(scene, light, method, setting, options):
    """None where it cannot be."""
    if method in TOLERANCES:
        is_too_large = method == "dense" and len(scene.areas) > DENSE_PATCHES
        return None if is_too_large else run_ours(scene, light, method, setting)
    if method == "rays":
        return run_rays(scene, light, int(setting), options.seed, options)
    if method == "view3d":
        return run_view3d(scene, light, setting)
    return run_pyviewfactor(scene, light, options)


def run(scene, light, method, setting, options):
    """What takes little time is run three times: the one with the median of the seconds."""
    rows = [run_once(scene, light, method, setting, options)]
    if rows[0] and rows[0].seconds < LITTLE:
        rows += [run_once(scene, light, method, setting, options) for _ in range(2)]
        rows.sort(key=lambda row: row.seconds)
    return rows[len(rows) // 2]


def find_reference(scene, light, options):
    if light == "even" and scene.is_closed:
        return 1.0 / (1.0 - scene.reflectance), "closed form"
    large = len(scene.areas) > options.dense_limit
    kind = f"{REFERENCE_RAYS} rays" if large else f"dense {options.reference}"
    path = options.folder / f"{scene.name}-{light}-{kind.replace(' ', '-')}.npy"
    if not path.exists():
        row = (run_rays(scene, light, REFERENCE_RAYS, options.seed + 1000, options) if large
               else run_ours(scene, light, "dense", options.reference))
        np.save(path, row.radiosity)
    return np.load(path), kind


def parse():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("radiosity-peers"))
    parser.add_argument("--scenes", default=",".join(set(SCENES) - set(ON_REQUEST)))
    parser.add_argument("--lights", default="lamp,even,sky,sun")
    parser.add_argument("--methods", default=",".join(SETTINGS))
    parser.add_argument("--settings", help="in place of those of each method")
    parser.add_argument("--reference", default="1e-4", help="tolerance of the dense reference")
    parser.add_argument("--dense-limit", type=int, default=8500, help="patches of dense references")
    parser.add_argument("--peer-python", default=sys.executable, help="that has pyviewfactor")
    parser.add_argument("--seed", type=int, default=1, help="of plain rays")
    return parser.parse_args()


def main():
    options = parse()
    options.program = options.program.resolve()
    options.folder.mkdir(parents=True, exist_ok=True)
    names = options.scenes.split(",")
    print(f"{'scene':16}{'light':6}{'method':14}{'setting':>8}{'CPU s':>9}{'error':>10}"
          f"{'MB':>9}  said")
    for name in sorted(names, key=list(SCENES).index):
        scene = Scene(name, options)
        for light in SCENES[name]:
            if light not in options.lights.split(","):
                continue
            reference, kind = find_reference(scene, light, options)
            print(f"# {name}, {light}, {len(scene.areas)} patches: errors against {kind}")
            for method in options.methods.split(","):
                settings = options.settings.split(",") if options.settings else SETTINGS[method]
                for setting in settings:
                    row = run(scene, light, method, setting, options)
                    if row:
                        error = scene.find_error(light, row.radiosity, reference)
                        print(f"{name:16}{light:6}{method:14}{setting:>8}{row.seconds:9.3f}"
                              f"{error:10.2e}{row.megabytes:9.2f}  {row.said}", flush=True)


if __name__ == "__main__":
    main()
