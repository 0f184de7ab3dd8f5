#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh) and runs the demonstration (see demo.py), without a display; it ends by listing the files in demo/.
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

setup
say "running the demonstration; its files go to $source_dir/demo"
export PYTHONPATH=$build_dir/lib/python3/dist-packages
exec /usr/bin/python3 -B "$source_dir/Utilities/demo.py" "$source_dir/demo"
