# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""TestParallel.py CASE RANKS COMMAND...: over MPI the serial answer, or an error on every rank.

COMMAND runs ParallelFilters.py, or for a medium ParallelMedium.py; what stands between `--` and
`--` in it is left out for the serial run. CASE is
  split   each rank has a part of the room
  empty   the first rank has everything, the others nothing
  ghosts  as split, with ghost cells
  error   as split, with a coordinate on the last rank that is no number
  array   as split, with an array on the last rank that has one value too many
  memory  as split, with too little memory on the last rank
  medium  each rank has a part of a block, and all of the image of its medium
  pieces  as medium, with a part of the image
"""

import os
import subprocess
import sys
import tempfile

from TestingTools import read_surface

ROOM_ARRAYS = {
    "radiosity": ("Radiosity", "Irradiance", "NetFlux"),
    "scattering": ("DirectIrradiance", "TransmittedIrradiance", "ScatteredIrradiance",
                   "ViewFactorSum", "SkyFraction", "BackFaceFraction")}
SAMPLED_ARRAYS = {**ROOM_ARRAYS, "sampled": ("Radiosity", "Irradiance", "RadiosityError")}
PHOTON_ARRAYS = {"photons": ("ScatteredIrradiance", "ScatteredIrradianceError")}
BLOCK_ARRAYS = {**PHOTON_ARRAYS, "table": ("ScatteredIrradiance",)}
# What all ranks say where the last one fails, or all do.
ON_LAST = "On rank {last} of {ranks}: "
ERRORS = {"error": ON_LAST + "The input has point coordinates that are not finite",
          "array": ON_LAST + "In the input the cell array \"Wrong\"", "memory": ON_LAST,
          "pieces": "The medium is not the same on all ranks"}
# Room for sums over patches in another order, in a solution to 1e-10; links that are sums of
# several ranks are rounded to single precision on each.
TOLERANCE = 1e-9
TOLERANCES = {"sampled": 1e-6}


def get_arrays(case):
    return {"medium": BLOCK_ARRAYS, "pieces": PHOTON_ARRAYS, "split": SAMPLED_ARRAYS,
            "empty": SAMPLED_ARRAYS, "ghosts": SAMPLED_ARRAYS}.get(case, ROOM_ARRAYS)


def run(command, case, folder):
    os.mkdir(folder)
    result = subprocess.run(
        [*command, case, folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        check=False)
    print(result.stdout)
    return result


def load(folder, name):
    return read_surface(os.path.join(folder, name + ".vtp"))


def get_values(data, name):
    """By patch; ghosts left out."""
    arrays = data.GetCellData()
    ids, ghosts, values = (arrays.GetArray(key) for key in ("PatchId", "vtkGhostType", name))
    return {ids.GetValue(cell): values.GetTuple(cell) for cell in range(data.GetNumberOfCells())
            if not ghosts or ghosts.GetValue(cell) == 0}


def compare(name, serial, parallel, tolerance):
    expected, found = get_values(serial, name), get_values(parallel, name)
    if sorted(expected) != sorted(found):
        return [f"{name}: {len(expected)} patches expected, {len(found)} found"]
    pairs = [pair for patch in expected for pair in zip(expected[patch], found[patch])]
    largest = max(abs(value) for value, _ in pairs)
    if not all(abs(a - b) <= tolerance * largest for a, b in pairs):
        worst = max(abs(a - b) for a, b in pairs)
        return [f"{name} differs by {worst}; its largest value is {largest}"]
    return []


def test_answer(case, ranks, serial_command, command, folder):
    folders = [os.path.join(folder, name) for name in ("serial", "parallel")]
    codes = [run(serial_command, "split", folders[0]).returncode,
             run(command, case, folders[1]).returncode]
    if codes != [0, 0]:
        return [f"exit codes {codes}"]
    problems = []
    for name, arrays in get_arrays(case).items():
        serial, parallel = (load(place, name) for place in folders)
        if serial.GetNumberOfCells() == 0:
            return ["the serial run has no result"]
        for array in arrays:
            problems += compare(array, serial, parallel, TOLERANCES.get(name, TOLERANCE))
        used = {int(value[0]) for value in get_values(parallel, "Rank").values()}
        if used != ({0} if case == "empty" else set(range(ranks))):
            problems.append(f"{name}: only ranks {sorted(used)} had patches")
    return problems


def test_error(case, ranks, command, folder):
    place = os.path.join(folder, "parallel")
    result = run(command, case, place)
    problems = []
    words = ERRORS[case].format(last=ranks - 1, ranks=ranks)
    for reporter in (("vtkSubsurfaceScattering",) if case == "pieces" else
                     ("vtkRadiosity", "vtkDirectIrradiance")):
        reports = [line for line in result.stdout.splitlines()
                   if reporter + " (" in line and words in line]
        if len(reports) != ranks:
            problems.append(f"{len(reports)} of {ranks} ranks reported the error of {reporter}")
    if "the script came to its end" not in result.stdout:
        problems.append(f"the script did not come to its end; exit code {result.returncode}")
    else:
        for name, arrays in get_arrays(case).items():
            if load(place, name).GetCellData().GetArray(arrays[0]):
                problems.append(f"{name}: there is a result in spite of the error")
    return problems


def main(case, ranks, *command):
    begin = command.index("--")
    end = command.index("--", begin + 1)
    parallel_command = command[:begin] + command[begin + 1:end] + command[end + 1:]
    with tempfile.TemporaryDirectory() as folder:
        if case in ERRORS:
            problems = test_error(case, int(ranks), parallel_command, folder)
        else:
            serial_command = command[:begin] + command[end + 1:]
            problems = test_answer(case, int(ranks), serial_command, parallel_command, folder)
    for problem in problems:
        print("FAILED: " + problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
