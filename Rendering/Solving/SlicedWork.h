// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Work that knows nothing of frames, done a while at a time: it has a thread of its own, which runs
 * only while the caller waits for it. So the two never meet, and need no locks for what they share;
 * what the work is at stays on its stack. The work says GoesOn now and then. Threads that help it
 * may end what they are at meanwhile: what they write must be the work's own.
 */
#ifndef SlicedWork_h
#define SlicedWork_h

#include "Shared/Outcome.h"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace LightTransport
{
class SlicedWork
{
public:
  using Work = std::function<Outcome()>;

  SlicedWork() = default;
  ~SlicedWork() { this->Stop(); }
  SlicedWork(const SlicedWork&) = delete;
  void operator=(const SlicedWork&) = delete;

  /// Takes work, in place of what is left of other work; RunFor does it.
  void Begin(Work work);

  /// Whether there is work that is not over.
  bool IsUnderWay() const { return static_cast<bool>(this->ToDo) && !this->Over; }

  /// Lets the work go on until it says GoesOn after this time. True when it is over.
  bool RunFor(double seconds);

  /// How work that is over ended.
  const Outcome& GetOutcome() const { return this->Ended; }

  /// To be called by the work: waits where the time is up. False where nobody wants it any more.
  bool GoesOn();

  /// Ends what is under way: GoesOn is false from now on.
  void Stop();

private:
  using Clock = std::chrono::steady_clock;

  void Run();
  void Hand(bool toWork, std::unique_lock<std::mutex>& lock);

  Work ToDo;
  Outcome Ended = Outcome::Done();
  std::thread Worker;
  std::mutex Mutex;
  std::condition_variable Turned;
  bool IsWorking = false; ///< whose turn it is
  bool Over = false;
  bool IsUnwanted = false;
  Clock::time_point End;
};
} // namespace LightTransport

#endif
