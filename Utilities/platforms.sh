#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Runs test.sh on bare systems, one after another, and prints a table of what came of it:
#   Utilities/platforms.sh                          all that are in Documentation/start/platforms.md
#   Utilities/platforms.sh trixie:vtk sid -- -L gl  some, and arguments for ctest
# A system is a release of Debian and the VTK that is built against, "paraview" (the default) or "vtk". Each is made by debootstrap in
# a folder of its own below TMPDIR, takes up to 8 GB, and is removed afterwards; logs go to build-platforms/. Needs root. Packages come
# from where apt of this machine has them; MIRROR names another archive.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

systems=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do
  systems+=("$1")
  shift
done
if [ ${#systems[@]} -eq 0 ]; then
  systems=(bookworm:paraview bookworm:vtk trixie:paraview trixie:vtk sid:paraview sid:vtk)
fi
logs=$source_dir/build-platforms
root=

# Where the archive of Debian is; nothing where apt does not know, and debootstrap takes its own.
find_mirror()
{
  # The format is apt's.
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(ORIGIN) $(LABEL) $(REPO_URI)' | awk '$1 == "Debian" && $2 == "Debian" { print $3; exit }'
}

remove_root()
{
  if [ -n "$root" ]; then
    umount "$root/proc" 2>/dev/null || true
    rm -rf --one-file-system "$root"
    root=
  fi
}

# A bare system in a new folder, with the files of the project that git knows.
make_root()
{
  root=$(mktemp -d "${TMPDIR:-/tmp}/platform.XXXXXX")
  chmod 755 "$root"
  debootstrap --variant=minbase "$1" "$root" ${mirror:+"$mirror"} || return
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  # Proxies, and whether the archive may be older than its date allows.
  apt-config dump Acquire >"$root/etc/apt/apt.conf.d/90host"
  mkdir -p "$root/src/project"
  git -C "$source_dir" ls-files -z --cached --others --exclude-standard --deduplicate |
    tar -C "$source_dir" --null -T - --ignore-failed-read -cf - | tar -C "$root/src/project" -xf -
  mount -t proc proc "$root/proc"
}

# Runs a line for the shell in the project of the bare system, with nothing of this machine's environment.
run_inside()
{
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb LC_ALL=C.UTF-8 \
    LIGHT_TRANSPORT_VTK="$vtk" http_proxy="${http_proxy:-}" https_proxy="${https_proxy:-}" \
    chroot "$root" /bin/bash -c 'cd /src/project && exec "$@"' bash "$@"
}

# What a log tells, in the order of the table's columns.
find_in_log()
{
  sed -nE "s/$1/\\1/p" "$log" | tail -n 1
}

use_system_tools
check_system
[ "$(id -u)" -eq 0 ] || stop 'only root may make systems and run programs in them.'
install_packages 50 debootstrap
mirror=${MIRROR:-$(find_mirror)}
mkdir -p "$logs"
trap remove_root EXIT
table=()
wrong=
for each in "${systems[@]}"; do
  suite=${each%%:*}
  vtk=${each#"$suite"}
  vtk=${vtk#:}
  vtk=${vtk:-paraview}
  log=$logs/$suite-$vtk.log
  check_disk "${TMPDIR:-/tmp}" 8000
  say "$suite with $vtk; the log is $log"
  begin=$SECONDS
  if { make_root "$suite" && run_inside Utilities/test.sh "${@:2}"; } >"$log" 2>&1; then
    result=right
  else
    result=WRONG
    wrong=yes
  fi
  table+=("| $suite | $(find_in_log '^== VTK: (.*[0-9.]+)[,;].*') | $(find_in_log '.*CXX compiler identification is (.*)') |\
 $(find_in_log '.*tests passed, (.*)') | $(grep -c 'warning:' "$log" || true) | $(((SECONDS - begin) / 60)) min,\
 $(du -smx "$root" | cut -f1) MB | $result |")
  printf '%s\n' "${table[-1]}"
  remove_root
done

printf '\n| system | VTK | compiler | tests | warnings | took | |\n|---|---|---|---|---|---|---|\n'
printf '%s\n' "${table[@]}"
[ -z "$wrong" ]
