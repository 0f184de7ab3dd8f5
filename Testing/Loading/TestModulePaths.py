# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a command loads comes from nowhere near the current folder: neither libraries nor modules.

    TestModulePaths.py PROGRAM ARGUMENT...

The command ends by printing sys.path, an entry a line, after the line "sys.path:".
"""

import os
import subprocess
import sys
import tempfile

environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
with tempfile.TemporaryDirectory() as folder:
    log = os.path.join(folder, "log")
    # The loader adds the process's number to the name.
    result = subprocess.run(
        sys.argv[1:], env={**environment, "LD_DEBUG": "libs", "LD_DEBUG_OUTPUT": log}, cwd=folder,
        capture_output=True, text=True, timeout=240, check=False)
    look_ups = []
    for name in os.listdir(folder):
        with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as stream:
            look_ups += [line.split("trying file=")[1].strip() for line in stream
                         if "trying file=" in line]
    # The same place by another name.
    near = os.path.realpath(folder)

entries = result.stdout.partition("sys.path:\n")[2].splitlines()
problems = [f"library looked for as {name}" for name in sorted(set(look_ups))
            if not name.startswith("/") or os.path.realpath(name).startswith(near)]
problems += [f"module path has '{entry}'" for entry in entries
             if not entry.startswith("/") or os.path.realpath(entry) == near]
if result.returncode != 0 or not entries or not look_ups:
    problems.append(f"exit code {result.returncode}, {len(entries)} module paths, "
                    f"{len(look_ups)} libraries looked for\n{result.stdout}{result.stderr}")
for problem in problems:
    print("FAILED: " + problem, file=sys.stderr)
sys.exit(1 if problems else 0)
