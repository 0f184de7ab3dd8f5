#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Makes the documentation's web site in build-docs/html: the pages by Sphinx with MyST, the classes by Doxygen. Installs
# the Debian packages that are missing (see setup.sh). Every warning is an error: a broken link, a page that no other
# leads to, a comment that Doxygen does not understand.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

packages=(doxygen python3-sphinx python3-myst-parser furo)
site_dir=$source_dir/build-docs

use_system_tools
check_system
install_packages 500 "${packages[@]}"

cd "$source_dir"
/usr/bin/python3 Utilities/check_links.py || stop 'some links are broken: see above.'
rm -rf "$site_dir"
mkdir -p "$site_dir/html"
/usr/bin/python3 -m sphinx -q -n -W --keep-going -b html -d "$site_dir/doctrees" -c Documentation/site . "$site_dir/html" ||
  stop 'Sphinx warned: see above.'
{
  cat Documentation/site/Doxyfile
  printf 'OUTPUT_DIRECTORY = %s\nHTML_OUTPUT = html/api\nPROJECT_NUMBER = %s\n' "$site_dir" \
    "$(sed -n 's/^project(vtkLightTransport VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
} | doxygen - || stop 'Doxygen warned: see above.'
say "the site is there after $SECONDS s: $site_dir/html/index.html"
