#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What radiosity_peers.py printed, as CPU seconds to reach an error of B.

    radiosity_peers_table.py FILE ... [--plot PNG --of SCENE,LIGHT]

Between two measured points the seconds are interpolated in the logarithms; "<" stands before those
of a method whose first point is better than what is asked, and "-" where none is as good. The last
rows of a scene are the seconds of the best of ours, and of Auto, less what starting may take, over
those of plain rays. The plot draws all methods in one scene.
"""

import argparse
import collections
import fileinput
import math

ERRORS = (5e-2, 1e-2, 3e-3, 1e-3, 3e-4)
START = 0.1
OURS = ("auto", "dense", "hierarchical", "sampled")
LABELS = {"auto": "Auto", "dense": "dense", "hierarchical": "hierarchical", "sampled": "sampled",
          "rays": "plain rays", "view3d": "View3D", "pyviewfactor": "pyviewfactor"}


def read(files):
    """{(scene, light): {method: [(seconds, error)]}}; what is slower is better."""
    found = collections.defaultdict(lambda: collections.defaultdict(list))
    for line in fileinput.input(files):
        words = line.split()
        # What has no error is the reference itself.
        if len(words) >= 7 and words[2] in LABELS and float(words[5]) > 0.0:
            found[words[0], words[1]][words[2]].append((float(words[4]), float(words[5])))
    for methods in found.values():
        for method, points in methods.items():
            best = []
            for seconds, error in sorted(points):
                if not best or error < best[-1][1]:
                    best.append((seconds, error))
            methods[method] = best
    return found


def find_seconds(points, error):
    """And whether fewer might do; None where it is not reached."""
    for k, (seconds, reached) in enumerate(points):
        if reached <= error:
            if k == 0:
                return seconds, reached < error
            before, more = points[k - 1]
            share = math.log(more / error) / math.log(more / reached)
            return before * (seconds / before) ** share, False
    return None


def show(found):
    if not found:
        return "-"
    digits = f"{found[0]:.2g}" if found[0] < 100 else f"{found[0]:.0f}"
    return ("< " if found[1] else "") + digits


def compare(methods, names, error):
    """How many times the seconds of plain rays the best of these methods takes, once started."""
    rays = find_seconds(methods.get("rays", []), error)
    ours = [found for found in (find_seconds(methods.get(name, []), error) for name in names)
            if found]
    return max(min(ours)[0] - START, 0.0) / rays[0] if rays and ours else math.nan


def print_table(found):
    print("| scene | light | method | " + " | ".join(f"{100 * error:g} %" for error in ERRORS)
          + " |")
    print("|---" * (3 + len(ERRORS)) + "|")
    for (scene, light), methods in found.items():
        for method, points in methods.items():
            cells = [show(find_seconds(points, error)) for error in ERRORS]
            print(f"| {scene} | {light} | {LABELS[method]} | " + " | ".join(cells) + " |")
        for label, names in (("best of ours", OURS), ("Auto", ("auto",))):
            cells = [f"{compare(methods, names, error):.2g}" for error in ERRORS]
            print(f"| {scene} | {light} | ({label} - {START} s) / plain rays | "
                  + " | ".join("-" if cell == "nan" else cell for cell in cells) + " |")


def plot(found, scene, light, file):
    from vtklighttransport.plots import Line, plot_lines
    lines = [Line(LABELS[method], *zip(*found[scene, light][method]), family)
             for family, method in enumerate(LABELS) if method in found[scene, light]]
    plot_lines(file, lines, "CPU time in s", "error of the radiosity (without what is emitted)")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("files", nargs="+")
    parser.add_argument("--plot", help="PNG to write")
    parser.add_argument("--of", default="room-3200,lamp", help="scene and light of the plot")
    options = parser.parse_args()
    found = read(options.files)
    print_table(found)
    if options.plot:
        plot(found, *options.of.split(","), options.plot)


if __name__ == "__main__":
    main()
