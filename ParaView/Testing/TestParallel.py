# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""TestParallel.py CASE RANKS COMMAND...: radiosity over MPI gives the serial answer, patch by patch, or an error on every rank.

COMMAND runs a script with pvbatch on one rank; the words from `--` to `--` in it are left out for the serial run. CASE is
  split   each rank has a part of the room
  empty   the first rank has everything, the others nothing
  ghosts  as split, with ghost cells
  error   as split, with a coordinate on the last rank that is no number
"""

import os
import subprocess
import sys
import tempfile

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

ARRAYS = ("Radiosity", "Irradiance", "NetFlux")
# Sums over patches in another order, through a solution to 1e-10.
TOLERANCE = 1e-9


def run(command, case, output):
    result = subprocess.run(
        [*command, case, output], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(result.stdout)
    return result


def load(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def get_values(data, name):
    """By patch; ghosts left out."""
    arrays = data.GetCellData()
    ids, ghosts, values = (arrays.GetArray(key) for key in ("PatchId", "vtkGhostType", name))
    return {ids.GetValue(cell): values.GetTuple(cell) for cell in range(data.GetNumberOfCells())
            if not ghosts or ghosts.GetValue(cell) == 0}


def compare(serial, parallel):
    problems = []
    for name in ARRAYS:
        expected, found = get_values(serial, name), get_values(parallel, name)
        if sorted(expected) != sorted(found):
            problems.append(f"{name}: {len(expected)} patches expected, {len(found)} found")
            continue
        largest = max(abs(value[0]) for value in expected.values())
        differences = [abs(expected[patch][0] - found[patch][0]) for patch in expected]
        if not all(difference <= TOLERANCE * largest for difference in differences):
            problems.append(f"{name} differs by {max(differences)}; its largest value is {largest}")
    return problems


def test_answer(case, ranks, serial_command, command, folder):
    outputs = [os.path.join(folder, name) for name in ("serial.vtp", "parallel.vtp")]
    codes = [run(serial_command, "split", outputs[0]).returncode, run(command, case, outputs[1]).returncode]
    if codes != [0, 0]:
        return [f"exit codes {codes}"]
    serial, parallel = (load(output) for output in outputs)
    if serial.GetNumberOfCells() == 0 or not serial.GetCellData().GetArray("Radiosity"):
        return ["the serial run has no result"]
    problems = compare(serial, parallel)
    used = {int(value[0]) for value in get_values(parallel, "Rank").values()}
    if used != ({0} if case == "empty" else set(range(ranks))):
        problems.append(f"only ranks {sorted(used)} had patches")
    return problems


def test_error(ranks, command, folder):
    output = os.path.join(folder, "parallel.vtp")
    result = run(command, "error", output)
    problems = []
    reports = [line for line in result.stdout.splitlines() if "vtkRadiosity (" in line and "finite" in line]
    if len(reports) != ranks:
        problems.append(f"{len(reports)} of {ranks} ranks reported the error")
    if "the script came to its end" not in result.stdout:
        problems.append(f"the script did not come to its end; exit code {result.returncode}")
    elif load(output).GetCellData().GetArray("Radiosity"):
        problems.append("there is a result in spite of the error")
    return problems


def main(case, ranks, *command):
    begin = command.index("--")
    end = command.index("--", begin + 1)
    parallel_command = command[:begin] + command[begin + 1:end] + command[end + 1:]
    with tempfile.TemporaryDirectory() as folder:
        if case == "error":
            problems = test_error(int(ranks), parallel_command, folder)
        else:
            serial_command = command[:begin] + command[end + 1:]
            problems = test_answer(case, int(ranks), serial_command, parallel_command, folder)
    for problem in problems:
        print("FAILED: " + problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
