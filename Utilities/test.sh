#!/bin/bash
# SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Sets up (see setup.sh) and runs all tests, without a display. Arguments go to ctest: Utilities/test.sh -R Radiosity
set -euo pipefail
# shellcheck source=Utilities/setup.sh
. "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

setup -DBUILD_TESTING=ON
say "testing with $jobs jobs"
cd "$build_dir"
exec ctest --parallel "$jobs" --output-on-failure --no-tests=error --timeout 600 "$@"
