# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
#
# What the scripts beside it share: installs the Debian packages that are missing, configures and builds in build/. Sourced, not
# run. It leaves `source_dir`, `build_dir`, `system` and `jobs` set. It removes nothing: no package, no file that it did not make.
# LIGHT_TRANSPORT_VTK chooses between the VTK of ParaView, with the plugin ("paraview"), and the plain one ("vtk").

source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
preset=default
build_dir=$source_dir/build

# The libraries that the modules use, and Mesa's EGL. Tests take meshes from libcgal-demo. Which VTK comes with them: see choose_vtk.
packages=(
  g++ cmake ninja-build python3-dev python3-numpy openmpi-bin
  libegl-dev libopengl-dev libglew-dev
  libcgal-dev libeigen3-dev libembree-dev libopenexr-dev
  libcgal-demo)
configure_options=()
os_release=/etc/os-release
lists_updated=

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

# Debian and what is made of it, whatever its name. Which packages it has is asked of apt, not told by a list of releases.
check_system()
{
  local ID='' ID_LIKE='' PRETTY_NAME='an unknown system'
  if [ -r "$os_release" ]; then
    # shellcheck source=/dev/null
    . "$os_release"
  fi
  system=$PRETTY_NAME
  family=" $ID $ID_LIKE "
  case $family in
    *' debian '* | *' ubuntu '*) ;;
    *)
      stop "this script sets up Debian and its derivatives, and this is $system." \
        'The README says how to build by hand with CMake.'
      ;;
  esac
  command -v apt-get >/dev/null || stop 'apt-get is not there, so no packages can be installed.'
}

# The version that is installed or that apt would install, nothing where it has none.
find_version()
{
  LC_ALL=C apt-cache policy "$1" | awk '$1 == "Candidate:" && $2 != "(none)" { print $2 }'
}

# A bare system has no lists yet, and apt knows of nothing.
update_lists()
{
  if [ -z "$lists_updated" ]; then
    say 'packages: asking which there are'
    run_as_root apt-get update -q || stop 'apt-get update failed: see its messages above.'
    lists_updated=yes
  fi
}

# A package, and the oldest version that serves.
check_version()
{
  local version remedy='Debian 12, Ubuntu 24.04 and all later ones have it.'
  version=$(find_version "$1")
  if [ -z "$version" ]; then
    case $family in
      *' ubuntu '*) remedy='Is the component "universe" on? sudo add-apt-repository universe' ;;
    esac
    stop "$system has no package $1." "$remedy"
  fi
  dpkg --compare-versions "$version" ge "$2" || stop "$system has $1 $version, and $2 or later is needed." "$remedy"
}

# ParaView's VTK, with the plugin, or the plain one. Their Python packages exclude each other up to Debian 13, so that what is
# installed decides; else ParaView's. paraview-dev does not name all that its CMake package asks for: libopenmpi-dev,
# libpython3-dev, libdouble-conversion-dev, libfreetype-dev, libglew-dev and libopengl-dev are for that.
choose_vtk()
{
  local vtk=${LIGHT_TRANSPORT_VTK:-}
  if [ -z "$vtk" ]; then
    vtk=paraview
    if are_installed python3-vtk9 && ! are_installed python3-paraview; then
      vtk=vtk
    elif [ -z "$(find_version paraview-dev)" ]; then
      vtk=vtk
    fi
  fi
  case $vtk in
    paraview)
      check_version paraview-dev 5.11
      say "VTK: that of ParaView $(find_version paraview-dev), with the plugin"
      packages+=(paraview-dev python3-paraview libopenmpi-dev libpython3-dev libdouble-conversion-dev libfreetype-dev)
      # A display for ParaView's window, whose panels are tested.
      packages+=(xvfb xauth)
      # What draws its buttons: no package of it names that up to 5.11.
      if dpkg --compare-versions "$(find_version paraview-dev)" lt 5.12; then
        packages+=(libqt5svg5)
      fi
      if [ "$preset" = default ]; then
        configure_options+=(-DVTKLIGHTTRANSPORT_BUILD_PARAVIEW_PLUGIN=ON)
      fi
      ;;
    vtk)
      check_version libvtk9-dev 9.1
      say "VTK: the plain $(find_version libvtk9-dev); the ParaView plugin and its tests are left out"
      packages+=(libvtk9-dev python3-vtk9)
      configure_options+=(-DVTKLIGHTTRANSPORT_BUILD_PARAVIEW_PLUGIN=OFF)
      ;;
    *) stop "LIGHT_TRANSPORT_VTK is \"$vtk\": it must be \"paraview\" or \"vtk\"." ;;
  esac
  # CMake's warnings for developers are about the packages of VTK and CGAL.
  configure_options+=(-Wno-dev)
  # OpenGL without EGL, which a test compares: Mesa has given it up.
  if [ -n "$(find_version libosmesa6-dev)" ]; then
    packages+=(libosmesa6-dev)
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

are_installed()
{
  local package
  for package; do
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || return
  done
}

run_as_root()
{
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  else
    command -v sudo >/dev/null || stop 'packages are missing, you are not root and sudo is not there.' "As root: $*"
    sudo "$@"
  fi
}

# The megabytes that they take at most, then the packages.
install_packages()
{
  local needed=$1 package missing=()
  shift
  for package; do
    are_installed "$package" || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then
    say "packages: all $# are installed"
    return
  fi
  update_lists
  say "packages: installing ${missing[*]}"
  check_disk /usr "$needed"
  run_as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends --no-remove "${missing[@]}" ||
    stop 'apt-get could not install the packages: see its messages above.' \
      'If it wanted to remove packages: python3-paraview and python3-vtk9 (or libvtk9-dev) exclude each other;' \
      'LIGHT_TRANSPORT_VTK=vtk or =paraview chooses the one that is there.'
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
  are_installed "${packages[@]}" || update_lists
  check_version cmake 3.21
  check_version libcgal-dev 5.5
  check_version libembree-dev 3
  check_version libopenexr-dev 3
  choose_vtk
  # From 550 packages on a bare Debian 12 (0.5 GB of archives, 2.7 GB unpacked) to 750 on unstable (1.2 and 4.4 GB).
  install_packages 6000 "${packages[@]}"
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
