// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The monitor of a filter: tells its observers how far it is, and hears when one of them aborts
/// it.
#ifndef FilterMonitor_h
#define FilterMonitor_h

#include "Shared/AbortCheck.h"
#include "Shared/Monitor.h"

namespace LightTransport
{
inline Monitor MakeFilterMonitor(vtkAlgorithm* filter)
{
  return Monitor(
    [filter](double fraction)
    {
      filter->UpdateProgress(fraction);
      return !AbortCheck::IsAborted(filter);
    });
}
} // namespace LightTransport

#endif
