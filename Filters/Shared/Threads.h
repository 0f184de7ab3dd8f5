// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Threads for all filters, in one place. Debian's ParaView leaves vtkSMPTools sequential
 * unless told otherwise; where nobody told it (no VTK_SMP_BACKEND_IN_USE), as many threads as its
 * STDThread backend has are used within a local scope, so that the host's choice for everything
 * else stays as it is.
 *
 * VTK's own threads end the process where work throws on one of them, and where the system refuses
 * one more. Here what work throws is thrown again on the thread that called, once all others are
 * done, and where threads are refused those that are there do the work.
 */
#ifndef TransportThreads_h
#define TransportThreads_h

#include "Shared/Pulse.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <string>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace Threads
{
/// The first exception of several threads.
class Failure
{
public:
  /// Call `work`, and keep what it throws.
  template <typename Work>
  void Catch(Work&& work)
  {
    try
    {
      work();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->First = this->First ? this->First : std::current_exception();
      this->Happened = true;
    }
  }
  bool HasHappened() const { return this->Happened; }
  void Rethrow() const
  {
    if (this->First)
    {
      std::rethrow_exception(this->First);
    }
  }

private:
  std::mutex Mutex;
  std::exception_ptr First;
  std::atomic<bool> Happened{ false };
};

/// Call `work` in a scope where vtkSMPTools runs on threads.
template <typename Work>
void Run(Work&& work)
{
  const char* name = vtkSMPTools::GetBackend();
  const std::string backend = name ? name : "";
  // VTK's storage for each thread tells only those apart that its backend made, if that is OpenMP.
  const bool needsOther = backend == "OpenMP" ||
    (backend == "Sequential" && std::getenv("VTK_SMP_BACKEND_IN_USE") == nullptr);
  if (!needsOther)
  {
    work();
    return;
  }
  // An exception that passed through it would leave the host with this backend.
  Failure failure;
  vtkSMPTools::LocalScope(vtkSMPTools::Config(std::string("STDThread")),
    [&]() { failure.Catch(work); });
  failure.Rethrow();
}

/// Call `work` on this thread and `help` on `others` more, or on fewer where the system refuses
/// some; then, until all of them are done, `wait` now and then. None of these may throw.
template <typename Work, typename Help, typename Wait>
void RunOn(int others, const Work& work, const Help& help, const Wait& wait)
{
  std::vector<std::thread> threads;
  std::mutex mutex;
  std::condition_variable ended;
  int running = 0;
  const auto run = [&]()
  {
    help();
    const std::lock_guard<std::mutex> lock(mutex);
    --running;
    ended.notify_one();
  };
  try
  {
    threads.reserve(std::max(others, 0));
    for (int k = 0; k < others; ++k)
    {
      threads.emplace_back(run);
      const std::lock_guard<std::mutex> lock(mutex);
      ++running;
    }
  }
  catch (const std::system_error&)
  {
  }
  catch (const std::bad_alloc&)
  {
  }
  work();
  std::unique_lock<std::mutex> lock(mutex);
  while (!ended.wait_for(lock, std::chrono::milliseconds(50), [&]() { return running == 0; }))
  {
    lock.unlock();
    wait();
    lock.lock();
  }
  lock.unlock();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

/// A value for each thread that asks for its own, begun as T(). It is not vtkSMPThreadLocal: that
/// of VTK's OpenMP, and from VTK 9.3 on of STDThread too, knows the threads of its backend alone,
/// and gives all others the same one.
template <typename T>
class Local
{
public:
  T& Get()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->Values[std::this_thread::get_id()];
  }
  /// Of all threads, once none of them works any more: visit(value).
  template <typename Visit>
  void ForEach(Visit&& visit)
  {
    for (auto& value : this->Values)
    {
      visit(value.second);
    }
  }

private:
  std::mutex Mutex;
  std::map<std::thread::id, T> Values;
};

/// Whether a functor has Initialize() and Reduce(), as vtkSMPTools::For knows them.
template <typename Functor, typename = void>
struct HasInitialize : std::false_type
{
};
template <typename Functor>
struct HasInitialize<Functor, std::void_t<decltype(std::declval<Functor&>().Initialize())>>
  : std::true_type
{
};

/// vtkSMPTools::For on threads: functor(from, to) for parts of [first, last) of `grain` numbers
/// each, any (0) as seems good. Initialize() of the functor is called once on each thread that
/// works, and Reduce() at the end, where it has them. Throws what the functor throws. Each part is
/// a beat of the calling thread's Pulse; on the others a beat ends the work where any has thrown.
template <typename Functor>
void For(vtkIdType first, vtkIdType last, vtkIdType grain, Functor& functor)
{
  Failure failure;
  const auto goesOn = [&failure]() { return !failure.HasHappened(); };
  std::atomic<vtkIdType> next{ first };
  const auto work = [&](vtkIdType part) // once on each thread
  {
    bool isReady = false;
    for (vtkIdType from = next.fetch_add(part); from < last && !failure.HasHappened();
         from = next.fetch_add(part))
    {
      if constexpr (HasInitialize<Functor>::value)
      {
        if (!isReady)
        {
          functor.Initialize();
          isReady = true;
        }
      }
      functor(from, std::min(from + part, last));
      Pulse::Beat();
    }
  };
  Run(
    [&]()
    {
      const int threads = std::max(vtkSMPTools::GetEstimatedNumberOfThreads(), 1);
      const vtkIdType part =
        grain > 0 ? grain : std::max<vtkIdType>((last - first) / (4 * threads), 1);
      const vtkIdType parts = (last - first + part - 1) / part;
      RunOn(
        static_cast<int>(std::min<vtkIdType>(threads, parts)) - 1,
        [&]() { failure.Catch([&]() { work(part); }); },
        [&]()
        {
          const Pulse pulse(goesOn, 0.0);
          failure.Catch([&]() { work(part); });
        },
        [&]() { failure.Catch([]() { Pulse::Beat(); }); });
      failure.Rethrow();
      if constexpr (HasInitialize<Functor>::value)
      {
        functor.Reduce();
      }
    });
}
} // namespace Threads
} // namespace LightTransport

#endif
