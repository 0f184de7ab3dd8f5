#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Checks all that needs no build: the format of C and C++, shell and Python, spelling, links, licences. Installs the Debian packages
# that it needs; for what is wrong it says what to run.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

# All files that are the project's, one a line: those that git does not ignore or, without a repository, those of the same folders.
list_files()
{
  git ls-files --cached --others --exclude-standard 2>/dev/null ||
    find . -type f -not -path './.git/*' -not -path './build*' -not -path './demo/*' -not -path '*/__pycache__/*' -printf '%P\n'
}

# Those of `files` that have one of the endings.
with_ending()
{
  local ending pattern=''
  for ending; do
    pattern+="${pattern:+|}[.]$ending"
  done
  printf '%s\n' "${files[@]}" | grep -E "($pattern)\$"
}

# What is checked, what to run when it is wrong, the check.
check()
{
  local what=$1 mend=$2
  shift 2
  if "$@"; then
    say "$what: right"
  else
    say "$what: WRONG"
    wrong+=("$what: $mend")
  fi
}

use_system_tools
check_system
linters=(python3 python3-flake8 shellcheck codespell reuse)
install_packages 500 "${linters[@]}"
# Versions of clang-format differ in what they write: this one decides, and Debian 13 does not have it.
formatter=$(find_version clang-format-14)
if [ -n "$formatter" ]; then
  install_packages 500 clang-format-14
fi

cd "$source_dir"
files=()
while IFS= read -r file; do
  # git lists those that were just removed or renamed as well.
  if [ -f "$file" ]; then
    files+=("$file")
  fi
done < <(list_files)
mapfile -t sources < <(with_ending cxx h c)
mapfile -t scripts < <(with_ending sh)
mapfile -t modules < <(with_ending py)
mapfile -t texts < <(with_ending cxx h c glsl py in sh md txt cmake json xml module plugin)
scripts+=(.ci/run)
wrong=()

if [ -n "$formatter" ]; then
  check 'format of C++' "clang-format-14 -i \$(git ls-files '*.cxx' '*.h' '*.c')" clang-format-14 --dry-run -Werror "${sources[@]}"
else
  say 'format of C++: not checked, that needs clang-format 14 (Debian 12)'
fi
check 'shell' 'the messages above say what' shellcheck "${scripts[@]}"
check 'Python' 'the messages above say what (.flake8 has the settings)' /usr/bin/python3 -m flake8 "${modules[@]}"
check 'spelling' 'codespell -i 3 -w with the files above, or name a word that is meant in .codespellrc' codespell "${texts[@]}"
check 'messages' "Documentation/errors.md in the sources' words" /usr/bin/python3 Utilities/check_errors.py
check 'links' 'the messages above say what' /usr/bin/python3 Utilities/check_links.py
if git rev-parse --git-dir >/dev/null 2>&1; then
  check 'licences' 'SPDX lines at the top of the file as others have them, or a line in .reuse/dep5' reuse --root . lint
else
  say 'licences: not checked, only git can tell what is not the project'"'"'s'
fi

if [ ${#wrong[@]} -gt 0 ]; then
  stop 'some checks failed. What to run:' "${wrong[@]}"
fi
say "all checks passed after $SECONDS s"
