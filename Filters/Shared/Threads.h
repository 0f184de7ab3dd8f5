// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Threads for all filters, in one place. Debian's ParaView leaves vtkSMPTools sequential
 * unless told otherwise; where nobody told it (no VTK_SMP_BACKEND_IN_USE), the STDThread backend is
 * used within a local scope, so that the host's choice for everything else stays as it is.
 */
#ifndef TransportThreads_h
#define TransportThreads_h

#include "vtkSMPTools.h"

#include <cstdlib>
#include <string>

namespace LightTransport
{
namespace Threads
{
/// Call `work` in a scope where vtkSMPTools runs on threads.
template <typename Work>
void Run(Work&& work)
{
  const char* backend = vtkSMPTools::GetBackend();
  const bool sequentialByDefault = backend && std::string(backend) == "Sequential" &&
    std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr;
  if (sequentialByDefault)
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(std::string("STDThread")), work);
  }
  else
  {
    work();
  }
}

/// vtkSMPTools::For on threads.
template <typename Functor>
void For(vtkIdType first, vtkIdType last, vtkIdType grain, Functor& functor)
{
  Run([&]() { vtkSMPTools::For(first, last, grain, functor); });
}
} // namespace Threads
} // namespace LightTransport

#endif
