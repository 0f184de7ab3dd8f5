#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh) and runs the fuzz targets (Testing/Fuzz), one after another, each with another seed every time:
#   Utilities/fuzz.sh                    a minute of each
#   Utilities/fuzz.sh 3600 OpenEXR       an hour of one
# Inputs that are found (crashes, hangs, what must not come out) stay in build/Testing/Fuzz; give one to its program to run it again.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

seconds=${1:-60}
targets=("${@:2}")
if [ ${#targets[@]} -eq 0 ]; then
  targets=(OpenEXR ViewFactors Filters)
fi

prepare
configure -DBUILD_TESTING=ON
cmake --build "$build_dir" --parallel "$jobs" --target "${targets[@]/#/Fuzz}" || stop 'the build failed: see the first error above.'
cd "$build_dir/Testing/Fuzz"
seed=$(date +%s)
wrong=()
for target in "${targets[@]}"; do
  say "$target: $seconds s, seed $seed"
  "$build_dir/bin/Fuzz$target" "$source_dir/Testing/Fuzz/Corpus/$target" --seconds "$seconds" --seed "$seed" ||
    wrong+=("$target, seed $seed: the files are in $PWD")
done
if [ ${#wrong[@]} -gt 0 ]; then
  stop 'something was found:' "${wrong[@]}"
fi
say "nothing was found after $SECONDS s"
