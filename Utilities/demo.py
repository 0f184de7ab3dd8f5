#!/usr/bin/python3
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration: a Cornell box, two bunnies and a dragon, from mesh to pictures and tables.

    demo.py FOLDER

writes into FOLDER (made when missing) and ends by listing its files. Exit status 1 when devices
disagree or energy is not kept.
"""

import sys
import time

import vtklighttransport as lt

from demo_atlas import show_atlas
from demo_bunny import show_bunny
from demo_cornell_box import RadiosityScene, show_cornell_box, show_error_against_time
from demo_tools import DemoError, Folder, Summary


def show_all(folder, summary):
    scenes = [RadiosityScene(patches) for patches in (250, 500, 1000, 2000)]
    show_cornell_box(folder, summary, scenes[-1])
    show_error_against_time(folder, summary, scenes, 8000)
    scattering = lt.vtkSubsurfaceScattering
    show_bunny(folder, summary, "marble", scattering.MATERIAL_MARBLE)
    show_bunny(folder, summary, "skim milk", scattering.MATERIAL_SKIMMILK)
    show_atlas(folder, summary)


def main(arguments):
    if len(arguments) != 1 or arguments[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 2
    begin = time.perf_counter()
    folder = Folder(arguments[0])
    summary = Summary()
    try:
        show_all(folder, summary)
    except (DemoError, OSError) as error:
        print(f"demo.py: {error}", file=sys.stderr)
        return 1
    summary.add("all", "time", time.perf_counter() - begin, "s")
    summary.show()
    folder.write_table("summary.csv", summary.rows)
    folder.show()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
