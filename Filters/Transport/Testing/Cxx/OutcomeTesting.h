// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A check for tests that look at private classes.
#ifndef OutcomeTesting_h
#define OutcomeTesting_h

#include "LightTransportTesting.h"
#include "Shared/Outcome.h"

namespace LightTransportTesting
{
/// Whether a step is done; tells its message otherwise.
inline bool CheckDone(const LightTransport::Outcome& outcome, const std::string& what)
{
  return Check(static_cast<bool>(outcome), what + ": " + outcome.GetMessage());
}
} // namespace LightTransportTesting

#endif
