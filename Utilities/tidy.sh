#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up what compilers need (see setup.sh), configures, and runs clang-tidy (.clang-tidy) without a build.
#   Utilities/tidy.sh              on the C++ files that differ from where this branch left main, or from the commit before
#   Utilities/tidy.sh FILE...      on these sources
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# A change that touches more is checked in part: ten files take a minute or two.
most_files=10

# The commit that changes are counted from; nothing where git cannot tell (no repository, a single commit).
find_base()
{
  local base
  for base in origin/main main; do
    base=$(git merge-base HEAD "$base" 2>/dev/null) || continue
    if [ "$base" != "$(git rev-parse HEAD)" ]; then
      printf '%s\n' "$base"
      return
    fi
  done
  git rev-parse --verify --quiet HEAD~1 || true
}

# Sources that differ, and sources of headers that do.
list_changed()
{
  local base file
  base=$(find_base)
  if [ -z "$base" ]; then
    return
  fi
  git diff --name-only --diff-filter=d "$base" -- '*.cxx' '*.h' | while IFS= read -r file; do
    file=${file%.*}.cxx
    if [ -f "$file" ]; then
      printf '%s\n' "$file"
    fi
  done | sort -u
}

# clang-tidy can read what the build compiles, and nothing else.
is_compiled()
{
  grep -qF "\"file\": \"$source_dir/$1\"" "$build_dir/compile_commands.json"
}

use_system_tools
cd "$source_dir"
if [ $# -gt 0 ]; then
  candidates=("$@")
else
  mapfile -t candidates < <(list_changed)
fi
if [ ${#candidates[@]} -eq 0 ]; then
  say 'clang-tidy: no C++ source has changed, or git cannot tell which'
  exit
fi

prepare
if [ -z "$(find_version clang-tidy-14)" ]; then
  say 'clang-tidy: left out, its checks are those of clang-tidy 14 (Debian 12)'
  exit
fi
install_packages 700 clang-tidy-14
configure -DBUILD_TESTING=ON
files=()
for file in "${candidates[@]}"; do
  if is_compiled "$file"; then
    files+=("$file")
  fi
done
if [ $# -eq 0 ] && [ ${#files[@]} -gt "$most_files" ]; then
  say "clang-tidy: $most_files of ${#files[@]} changed sources; the others: Utilities/tidy.sh ${files[*]:most_files}"
  files=("${files[@]:0:most_files}")
fi

# Headers that shaders become.
cmake --build "$build_dir" --parallel "$jobs" --target LightTransportShaders >/dev/null || stop 'shaders could not be encoded.'
# clang cannot read what GCC precompiles; a source includes what it needs anyway.
mkdir -p "$build_dir/tidy"
sed -E 's/ -Winvalid-pch| -include [^ "]*cmake_pch\.hxx//g' "$build_dir/compile_commands.json" >"$build_dir/tidy/compile_commands.json"
say "clang-tidy: ${#files[@]} sources with $jobs jobs"
printf '%s\0' "${files[@]}" |
  xargs -0 -r -P "$jobs" -n 1 clang-tidy-14 -p "$build_dir/tidy" --quiet 2> >(grep -v ' warnings* generated\.$' >&2) ||
  stop 'clang-tidy found something: see above. Some of it can be mended by clang-tidy-14 -p build/tidy --fix FILE.'
say "clang-tidy: nothing found after $SECONDS s"
