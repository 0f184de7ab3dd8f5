// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Asks, every so many steps, whether a job is still wanted, and ends it by an exception where not:
 * for loops deep inside of others, and for libraries that call ours back and know no other way
 * out. Attempt turns the exception into an outcome.
 */
#ifndef Heartbeat_h
#define Heartbeat_h

#include "Shared/Monitor.h"
#include "Shared/Stopped.h"

#include <cstddef>

namespace LightTransport
{
class Heartbeat
{
public:
  /// Thrown when the job is to stop.
  using Stopped = LightTransport::Stopped;

  /// The monitor, which must outlive this, hears its first fraction again and again.
  explicit Heartbeat(const Monitor& monitor, std::size_t interval = 4096)
    : Watcher(monitor), Interval(interval)
  {
  }

  void Beat()
  {
    if (++this->Count % this->Interval == 0 && !this->Watcher.Report(0.0))
    {
      throw Stopped();
    }
  }

private:
  const Monitor& Watcher;
  std::size_t Interval;
  std::size_t Count = 0;
};
} // namespace LightTransport

#endif
