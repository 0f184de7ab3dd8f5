#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh) and runs the fuzz targets (Testing/Fuzz), one after another, each with another seed every time:
#   Utilities/fuzz.sh                    a minute of each
#   Utilities/fuzz.sh 3600 OpenEXR       an hour of one
#   Utilities/fuzz.sh sanitizers 600     ten minutes of each, with addresses and undefined behaviour watched as in sanitize.sh
# Inputs that are found (crashes, hangs, what must not come out) stay in Testing/Fuzz of the build; give one to its program to run it again.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

limits=()
if [ "${1:-}" = sanitizers ]; then
  use_preset sanitizers
  shift
  # The largest block is theirs to watch, and they take their time.
  export ASAN_OPTIONS=max_allocation_size_mb=1024
  export UBSAN_OPTIONS=print_stacktrace=1
  limits=(--patience 40)
fi
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
  "$build_dir/bin/Fuzz$target" "$source_dir/Testing/Fuzz/Corpus/$target" --seconds "$seconds" --seed "$seed" "${limits[@]}" ||
    wrong+=("$target, seed $seed: the files are in $PWD")
done
if [ ${#wrong[@]} -gt 0 ]; then
  stop 'something was found:' "${wrong[@]}"
fi
say "nothing was found after $SECONDS s"
