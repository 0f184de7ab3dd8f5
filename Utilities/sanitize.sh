#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh), builds C++ with an instrument in a folder of its own, and runs tests with it:
#   Utilities/sanitize.sh sanitizers                 addresses and undefined behaviour
#   Utilities/sanitize.sh tsan                       threads
#   Utilities/sanitize.sh tsan -R Radiosity          arguments go to ctest
# All C++ tests, but those that need OpenGL: Mesa is not built with the instruments. On two cores the build takes about 20 minutes
# and the tests 40; the tests of threads take longer.
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

case ${1:-} in
  sanitizers | tsan) use_preset "$1" ;;
  *) stop 'the first argument is the preset: sanitizers or tsan.' ;;
esac
shift

prepare
configure
compile
say "testing with $preset"
exec ctest --preset "$preset" --label-exclude gl --timeout 3600 "$@"
