# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What demo.sh and test.sh share: installs the Debian packages that are missing, configures and builds in build/. Sourced, not
# run. It leaves `source_dir`, `build_dir` and `jobs` set. It removes nothing: no package, no file that it did not make.

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
build_dir=$source_dir/build

# ParaView's own VTK, Mesa's EGL and OSMesa, and the libraries that the modules use. paraview-dev does not name all that its CMake
# package asks for: libopenmpi-dev, libdouble-conversion-dev, libfreetype-dev, libglew-dev and libopengl-dev are for that. Tests
# take meshes from libcgal-demo.
packages=(
  g++ cmake ninja-build python3-dev
  paraview-dev python3-paraview libopenmpi-dev openmpi-bin
  libdouble-conversion-dev libfreetype-dev libglew-dev libegl-dev libopengl-dev libosmesa6-dev
  libcgal-dev libeigen3-dev libembree-dev libopenexr-dev
  python3-numpy
  libcgal-demo)

say()
{
  printf '\n== %s\n' "$*"
}

stop()
{
  printf '\n%s: stopped: %s\n' "$(basename "$0")" "$1" >&2
  shift
  if [ $# -gt 0 ]; then
    printf '  %s\n' "$@" >&2
  fi
  exit 1
}

# Debian's own compiler, CMake and Python, whatever the calling shell (conda, pyenv, a ParaView of its own) prefers.
use_system_tools()
{
  export PATH=/usr/sbin:/usr/bin:/sbin:/bin
  unset CC CXX CFLAGS CXXFLAGS CPPFLAGS LDFLAGS CMAKE_PREFIX_PATH CMAKE_GENERATOR
  unset PYTHONPATH PYTHONHOME LD_LIBRARY_PATH LD_PRELOAD
  # Nothing here needs a display: an X server that happens to be there must not change what is tested.
  unset DISPLAY WAYLAND_DISPLAY
}

check_system()
{
  local ID='' VERSION_ID='' PRETTY_NAME='an unknown system'
  if [ -r /etc/os-release ]; then
    . /etc/os-release
  fi
  if [ "$ID" != debian ] || [ "$VERSION_ID" != 12 ]; then
    stop "this script sets up Debian 12, and this is $PRETTY_NAME." \
      'The README says how to build by hand with CMake.'
  fi
  command -v apt-get >/dev/null || stop 'apt-get is not there, so no packages can be installed.'
}

free_megabytes()
{
  df -Pm "$1" | awk 'NR == 2 { print $4 }'
}

check_disk()
{
  local folder=$1 needed=$2 free
  free=$(free_megabytes "$folder")
  if [ "$free" -lt "$needed" ]; then
    stop "too little disk space: $folder has $free MB free, $needed MB are needed."
  fi
}

# A compiler with CGAL's and VTK's headers takes about 1 GB: fewer jobs on a machine with little memory.
choose_jobs()
{
  local memory=1000000
  jobs=$(nproc)
  if [ -r /proc/meminfo ]; then
    memory=$(awk '$1 == "MemAvailable:" { print int($2 / 1024) }' /proc/meminfo)
  fi
  if [ "$memory" -lt 1500 ]; then
    stop "too little memory: $memory MB are available, 1500 MB are needed to compile."
  fi
  if [ "$jobs" -gt $((memory / 1500)) ]; then
    jobs=$((memory / 1500))
  fi
}

is_installed()
{
  [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

install_packages()
{
  local package missing=() root=()
  for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "packages: all ${#packages[@]} are installed"
    return
  fi
  say "packages: installing ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop 'packages are missing, you are not root and sudo is not there.' \
      "As root: apt-get install --no-install-recommends ${missing[*]}"
    root=(sudo)
  fi
  # 544 packages on a bare system: 0.5 GB of archives and 2.7 GB unpacked.
  check_disk /usr 4000
  "${root[@]}" apt-get update -q || stop 'apt-get update failed: see its messages above.'
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends --no-remove "${missing[@]}" ||
    stop 'apt-get could not install the packages: see its messages above.' \
      'If it wanted to remove packages: python3-paraview and python3-vtk9 (or libvtk9-dev) exclude each other on Debian 12;' \
      'remove those yourself, or use another machine or chroot.'
}

check_build_directory()
{
  local home
  if [ ! -e "$build_dir" ] || [ -z "$(ls -A "$build_dir")" ]; then
    return
  fi
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build_dir/CMakeCache.txt" 2>/dev/null || true)
  if [ "$home" != "$source_dir" ] || ! grep -q '^CMAKE_GENERATOR:INTERNAL=Ninja$' "$build_dir/CMakeCache.txt"; then
    stop "$build_dir exists and was not made by this project's \"default\" CMake preset." \
      'Move it away or remove it, then run this again.'
  fi
  [ -w "$build_dir" ] || stop "$build_dir belongs to another user." 'Remove it as that user, or run this as that user.'
}

build()
{
  [ -w "$source_dir" ] || stop "$source_dir is not writable, and build/ is made there."
  check_build_directory
  check_disk "$source_dir" 1000
  choose_jobs
  say "configuring in $build_dir"
  cd "$source_dir" || stop "$source_dir cannot be entered."
  cmake --preset default || stop 'CMake could not configure: see its messages above.'
  say "building with $jobs jobs"
  cmake --build "$build_dir" --parallel "$jobs" || stop 'the build failed: see the first error above.'
}

setup()
{
  local begin=$SECONDS
  use_system_tools
  check_system
  install_packages
  say "packages: done after $((SECONDS - begin)) s"
  build
  say "set up after $((SECONDS - begin)) s; build/ takes $(du -sm "$build_dir" | cut -f1) MB"
}
