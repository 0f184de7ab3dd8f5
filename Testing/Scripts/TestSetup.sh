#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What Utilities/setup.sh makes of systems that are not at hand: their os-release files, and what their apt would say. Nothing is
# installed: apt and dpkg are functions here.
# Functions are called by setup.sh and by what is expected.
# shellcheck disable=SC2317
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../Utilities/setup.sh"

os_release=$(mktemp)
trap 'rm -f "$os_release"' EXIT
failed=0

# Packages that the pretended system has, NAME=VERSION, and those that are installed.
offered=() installed=()

apt-get()
{
  false
}

apt-cache()
{
  local package
  printf '%s:\n  Installed: (none)\n' "$2"
  for package in "${offered[@]}"; do
    if [ "${package%%=*}" = "$2" ]; then
      printf '  Candidate: %s\n' "${package#*=}"
      return
    fi
  done
  printf '  Candidate: (none)\n'
}

dpkg-query()
{
  local package
  for package in "${installed[@]}"; do
    if [ "$package" = "${*: -1}" ]; then
      printf 'installed'
    fi
  done
}

# What is tried, a part of what must be said, then the command. It may stop.
expect()
{
  local what=$1 words=$2 said
  shift 2
  said=$("$@" 2>&1) || true
  if [[ $said != *"$words"* ]]; then
    printf 'FAILED: %s: "%s" is not in:\n%s\n' "$what" "$words" "$said"
    failed=1
  fi
}

# The lines of an os-release file, then whether it is taken.
expect_system()
{
  local answer=$1
  shift
  printf '%s\n' "$@" >"$os_release"
  expect "$*" "$answer" recognise
}

recognise()
{
  check_system
  printf 'taken: %s' "$system"
}

pretend()
{
  os_release=/dev/null
  system=$1
  family=" $2 "
  packages=(libcgal-dev)
  configure_options=()
  choose_vtk
  printf '%s ' "${packages[@]}" "${configure_options[@]}"
}

expect_system 'taken: Debian GNU/Linux 12' ID=debian 'VERSION_ID="12"' 'PRETTY_NAME="Debian GNU/Linux 12 (bookworm)"'
expect_system 'taken: Debian GNU/Linux forky/sid' ID=debian 'PRETTY_NAME="Debian GNU/Linux forky/sid"'
expect_system 'taken: Ubuntu 24.04' ID=ubuntu ID_LIKE=debian 'VERSION_ID="24.04"' 'PRETTY_NAME="Ubuntu 24.04.1 LTS"'
expect_system 'taken: Linux Mint 22' ID=linuxmint 'ID_LIKE="ubuntu debian"' 'PRETTY_NAME="Linux Mint 22"' UBUNTU_CODENAME=noble
expect_system 'taken: Made of Ubuntu' ID=made ID_LIKE=ubuntu 'PRETTY_NAME="Made of Ubuntu"'
expect_system 'this is Fedora Linux 40' ID=fedora 'PRETTY_NAME="Fedora Linux 40"'
expect_system 'this is openSUSE' ID=opensuse-leap 'ID_LIKE="suse opensuse"' 'PRETTY_NAME="openSUSE Leap 15.6"'
expect_system 'this is an unknown system'

offered=(libvtk9-dev=9.3.0+dfsg1-4 paraview-dev=5.13.2+dfsg-3 libosmesa6-dev=25.0.7-2)
expect 'ParaView where nothing is installed' 'that of ParaView 5.13.2+dfsg-3, with the plugin' pretend 'Debian 13' debian
expect 'its package' paraview-dev pretend 'Debian 13' debian
expect 'OSMesa where it is' libosmesa6-dev pretend 'Debian 13' debian
installed=(python3-vtk9)
expect 'the VTK that is installed' 'the plain 9.3.0+dfsg1-4' pretend 'Debian 13' debian
expect 'no plugin then' BUILD_PARAVIEW_PLUGIN=OFF pretend 'Debian 13' debian
LIGHT_TRANSPORT_VTK=paraview expect 'the VTK that is asked for' 'that of ParaView 5.13' pretend 'Debian 13' debian
LIGHT_TRANSPORT_VTK=none expect 'no such VTK' 'must be "paraview" or "vtk"' pretend 'Debian 13' debian
installed=()
offered=(libvtk9-dev=9.6.2-1)
expect 'no ParaView' 'the plain 9.6.2-1' pretend 'Debian sid' debian
offered=(libvtk9-dev=9.1.0 paraview-dev=5.10.0)
expect 'an old ParaView' 'Ubuntu 22.04 has paraview-dev 5.10.0, and 5.11 or later is needed' pretend 'Ubuntu 22.04' 'ubuntu debian'
offered=(paraview-dev=5.11.2+dfsg-6)
expect 'what draws the buttons of ParaView 5.11' libqt5svg5 pretend 'Ubuntu 24.04' 'ubuntu debian'
offered=()
expect 'nothing' 'Is the component "universe" on?' pretend 'Ubuntu 24.04' 'ubuntu debian'

exit "$failed"
