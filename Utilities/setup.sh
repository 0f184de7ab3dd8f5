# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
#
# What the scripts beside it share: installs the Debian packages that are missing, configures and builds in build/. Sourced, not
# run. It leaves `source_dir`, `build_dir`, `debian` and `jobs` set. It removes nothing: no package, no file that it did not make.

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
preset=default
build_dir=$source_dir/build

# The libraries that the modules use, Mesa's EGL and OSMesa. Tests take meshes from libcgal-demo. Which VTK comes with them depends
# on the release: see choose_vtk.
packages=(
  g++ cmake ninja-build python3-dev python3-numpy openmpi-bin
  libegl-dev libopengl-dev libglew-dev libosmesa6-dev
  libcgal-dev libeigen3-dev libembree-dev libopenexr-dev
  libcgal-demo)
configure_options=()

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

# Another of CMake's presets than "default"; each has a folder of its own.
use_preset()
{
  preset=$1
  build_dir=$source_dir/build-$preset
}

check_system()
{
  local ID='' VERSION_ID='' PRETTY_NAME='an unknown system'
  if [ -r /etc/os-release ]; then
    # shellcheck source=/dev/null
    . /etc/os-release
  fi
  debian=$VERSION_ID
  if [ "$ID" != debian ] || { [ "$debian" != 12 ] && [ "$debian" != 13 ]; }; then
    stop "this script sets up Debian 12 and 13, and this is $PRETTY_NAME." \
      'The README says how to build by hand with CMake.'
  fi
  command -v apt-get >/dev/null || stop 'apt-get is not there, so no packages can be installed.'
}

# Debian 12: ParaView's own VTK. paraview-dev does not name all that its CMake package asks for: libopenmpi-dev,
# libdouble-conversion-dev, libfreetype-dev, libglew-dev and libopengl-dev are for that. Debian 13: plain VTK, because its ParaView
# package names library files that it does not have, so that CMake cannot find it.
choose_vtk()
{
  if [ "$debian" = 12 ]; then
    packages+=(paraview-dev python3-paraview libopenmpi-dev libdouble-conversion-dev libfreetype-dev)
    # A display for ParaView's window, whose panels are tested.
    packages+=(xvfb xauth)
  else
    packages+=(libvtk9-dev python3-vtk9)
    # CMake's warnings for developers are about the packages of VTK and CGAL.
    configure_options+=(-DVTKLIGHTTRANSPORT_BUILD_PARAVIEW_PLUGIN=OFF -Wno-dev)
    say 'Debian 13: plain VTK; the ParaView plugin and its tests are left out'
  fi
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

# The megabytes that they take at most, then the packages.
install_packages()
{
  local needed=$1 package missing=() root=()
  shift
  for package; do
    is_installed "$package" || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "packages: all $# are installed"
    return
  fi
  say "packages: installing ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop 'packages are missing, you are not root and sudo is not there.' \
      "As root: apt-get install --no-install-recommends ${missing[*]}"
    root=(sudo)
  fi
  check_disk /usr "$needed"
  "${root[@]}" apt-get update -q || stop 'apt-get update failed: see its messages above.'
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends --no-remove "${missing[@]}" ||
    stop 'apt-get could not install the packages: see its messages above.' \
      'If it wanted to remove packages: python3-paraview and python3-vtk9 (or libvtk9-dev) exclude each other;' \
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
    stop "$build_dir exists and was not made by this project's \"$preset\" CMake preset." \
      'Move it away or remove it, then run this again.'
  fi
  [ -w "$build_dir" ] || stop "$build_dir belongs to another user." 'Remove it as that user, or run this as that user.'
}

# Arguments go to CMake.
configure()
{
  [ -w "$source_dir" ] || stop "$source_dir is not writable, and $(basename "$build_dir")/ is made there."
  check_build_directory
  check_disk "$source_dir" 1000
  choose_jobs
  say "configuring in $build_dir"
  cd "$source_dir" || stop "$source_dir cannot be entered."
  cmake --preset "$preset" "${configure_options[@]}" "$@" || stop 'CMake could not configure: see its messages above.'
}

compile()
{
  say "building with $jobs jobs"
  cmake --build "$build_dir" --parallel "$jobs" || stop 'the build failed: see the first error above.'
}

prepare()
{
  use_system_tools
  check_system
  choose_vtk
  # About 550 packages on a bare system: 0.5 GB of archives and 2.7 GB unpacked.
  install_packages 4000 "${packages[@]}"
}

# Arguments go to CMake.
setup()
{
  local begin=$SECONDS
  prepare
  say "packages: done after $((SECONDS - begin)) s"
  configure "$@"
  compile
  say "set up after $((SECONDS - begin)) s; build/ takes $(du -sm "$build_dir" | cut -f1) MB"
}
