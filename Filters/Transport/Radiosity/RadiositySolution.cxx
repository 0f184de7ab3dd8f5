// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiositySolution.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
const char* GetName(SolverStatus status)
{
  const char* const names[] = { "Converged", "IterationsUsedUp", "Stagnated", "Diverged",
    "Aborted" };
  return names[static_cast<int>(status)];
}
} // namespace LightTransport
