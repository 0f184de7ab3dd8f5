// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Long work that is watched: it runs on a thread of its own while the one that started it tells the
 * monitor, ten times a second, how far the work is, and hears whether it is still wanted. Progress
 * has no gaps then, whatever libraries the work calls, and an abort takes as long as the work does
 * from one Check() to the next.
 *
 * The work must not change objects of VTK: their observers belong to the thread that started it.
 * Where that is needed, Heartbeat is the means.
 */
#ifndef Watch_h
#define Watch_h

#include "Common/Heartbeat.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <system_error>

namespace LightTransport
{
class Watch
{
public:
  /// Nobody watches.
  Watch() = default;

  /// From any thread of the work: throws Heartbeat::Stopped when it is to stop. As cheap as reading
  /// a number.
  void Check() const
  {
    if (this->IsStopped.load(std::memory_order_relaxed))
    {
      throw Heartbeat::Stopped();
    }
  }

  /// From the thread of the work itself: the monitor has heard of it, and answered, when this
  /// returns.
  void Report(double fraction)
  {
    this->Check();
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Fraction = fraction;
    if (this->HasWatcher)
    {
      this->IsWaiting = true;
      this->Changed.notify_all();
      this->Changed.wait(lock, [this]() { return !this->IsWaiting; });
    }
    this->Check();
  }

  /// For parts of the work that know a monitor alone: its reports are those of this, which throw.
  Monitor MakeMonitor()
  {
    return Monitor(
      [this](double fraction)
      {
        this->Report(fraction);
        return true;
      });
  }

  /// All further checks throw.
  void Stop() { this->IsStopped = true; }

  /// Do work(watch), which returns an Outcome. What it throws is thrown here.
  template <typename Work>
  static Outcome Run(const Monitor& monitor, const Work& work)
  {
    Watch watch;
    std::future<Outcome> result;
    try
    {
      watch.HasWatcher = true;
      result = std::async(std::launch::async,
        [&]()
        {
          const Ending ending{ watch };
          return work(watch);
        });
    }
    catch (const std::system_error&)
    {
      // No more threads are to be had: this one does the work, and cannot watch.
      watch.HasWatcher = false;
      return work(watch);
    }
    watch.Follow(monitor);
    return result.get();
  }

private:
  static constexpr std::chrono::milliseconds Interval{ 100 };

  // Says that the work is over, however it ended.
  struct Ending
  {
    Watch& Owner;
    ~Ending()
    {
      const std::lock_guard<std::mutex> lock(this->Owner.Mutex);
      this->Owner.HasEnded = true;
      this->Owner.Changed.notify_all();
    }
  };

  void Follow(const Monitor& monitor)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    while (!this->HasEnded)
    {
      this->Changed.wait_for(lock, Interval,
        [this]() { return this->IsWaiting || this->HasEnded; });
      const bool answers = this->IsWaiting;
      const double fraction = this->Fraction;
      if (!this->HasEnded && !this->IsStopped)
      {
        lock.unlock();
        const bool goesOn = monitor.Report(fraction);
        lock.lock();
        this->IsStopped = !goesOn;
      }
      if (answers)
      {
        this->IsWaiting = false;
        this->Changed.notify_all();
      }
    }
  }

  std::atomic<bool> IsStopped{ false };
  std::mutex Mutex;
  std::condition_variable Changed;
  double Fraction = 0.0;
  bool HasWatcher = false;
  /// For the answer to a report.
  bool IsWaiting = false;
  bool HasEnded = false;
};
} // namespace LightTransport

#endif
