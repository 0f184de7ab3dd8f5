#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh) and runs the demonstration (see demo.py), without a display; it ends by listing the files in demo/.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# A demonstration needs no tests; where test.sh has built them, they stay.
if [ -e "$build_dir/CMakeCache.txt" ]; then
  setup
else
  setup -DBUILD_TESTING=OFF
fi
say "running the demonstration; its files go to $source_dir/demo"
export PYTHONPATH=$build_dir/lib/python3/dist-packages
exec /usr/bin/python3 -B "$source_dir/Utilities/demo.py" "$source_dir/demo"
