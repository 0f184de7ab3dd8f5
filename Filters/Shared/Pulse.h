// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Keeps a filter within earshot of its user, however deep inside it works: loops say Pulse::Beat(),
 * and every so often the pulse that was set up at the top tells the user that work goes on, and
 * ends it by an exception where it is no longer wanted. Nothing is handed down.
 *
 * A pulse is that of the thread that made it, until it ends; on other threads, and where there is
 * none, a beat does nothing. All threads of Threads::For end with the one that called.
 */
#ifndef Pulse_h
#define Pulse_h

#include "Shared/Stopped.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <utility>

namespace LightTransport
{
class Pulse
{
public:
  /// Called by beats, at most every `interval` seconds; returns false when the work is to stop.
  using Function = std::function<bool()>;

  Pulse(Function goesOn, double interval)
    : GoesOn(std::move(goesOn)), Interval(interval), Last(Clock::now()), Outer(Current)
  {
    Current = this;
  }
  ~Pulse() { Current = this->Outer; }
  Pulse(const Pulse&) = delete;
  Pulse& operator=(const Pulse&) = delete;

  ///@{
  /// Throws Stopped when the work is to stop, from then on each time. A beat costs some 30 ns:
  /// where a step of a loop takes little more it gives its number, and every 1024th is a beat.
  static void Beat()
  {
    if (Current)
    {
      Current->Hear();
    }
  }
  template <typename Number>
  static void Beat(Number step)
  {
    if (static_cast<std::size_t>(step) % StepsPerBeat == 0)
    {
      Beat();
    }
  }
  ///@}

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t StepsPerBeat = 1024;

  // What the user's observers do is no part of the work.
  void Hear()
  {
    if (this->IsHearing || (!this->IsStopped && Clock::now() - this->Last < this->Interval))
    {
      return;
    }
    this->IsHearing = true;
    this->IsStopped = this->IsStopped || !this->GoesOn();
    this->IsHearing = false;
    this->Last = Clock::now();
    if (this->IsStopped)
    {
      throw Stopped();
    }
  }

  inline static thread_local Pulse* Current = nullptr;

  Function GoesOn;
  std::chrono::duration<double> Interval;
  Clock::time_point Last;
  Pulse* Outer;
  bool IsHearing = false;
  bool IsStopped = false;
};
} // namespace LightTransport

#endif
