// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Solving/SlicedWork.h"

#include "Shared/Attempt.h"

#include <system_error>
#include <utility>

namespace LightTransport
{
namespace
{
constexpr Advice WithoutMemory = { "use actors of fewer polygons", "A library gave up",
  "try another mesh, and report this if it remains" };
/// More than anyone waits, and less than clocks hold.
constexpr double LongestSlice = 1e6;
} // namespace

//------------------------------------------------------------------------------
void SlicedWork::Begin(Work work)
{
  this->Stop();
  this->ToDo = std::move(work);
  this->Ended = Outcome::Done();
  this->Over = false;
  this->IsUnwanted = false;
}

//------------------------------------------------------------------------------
// Where the system refuses a thread the work is done at once, however long it takes.
bool SlicedWork::RunFor(double seconds)
{
  if (!this->IsUnderWay())
  {
    return true;
  }
  this->End = Clock::now() +
    std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(seconds < LongestSlice ? seconds : LongestSlice));
  std::unique_lock<std::mutex> lock(this->Mutex);
  if (!this->Worker.joinable())
  {
    try
    {
      this->Worker = std::thread([this]() { this->Run(); });
    }
    catch (const std::system_error&)
    {
      this->Ended = Attempt(this->ToDo, WithoutMemory);
      this->Over = true;
      return true;
    }
  }
  this->Hand(true, lock);
  lock.unlock();
  if (this->Over)
  {
    this->Worker.join();
  }
  return this->Over;
}

//------------------------------------------------------------------------------
// Gives the turn to the other side and waits until it comes back.
void SlicedWork::Hand(bool toWork, std::unique_lock<std::mutex>& lock)
{
  this->IsWorking = toWork;
  this->Turned.notify_all();
  this->Turned.wait(lock, [&]() { return this->IsWorking != toWork; });
}

//------------------------------------------------------------------------------
void SlicedWork::Run()
{
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Turned.wait(lock, [this]() { return this->IsWorking; });
  }
  Outcome ended = this->IsUnwanted ? Outcome::Aborted() : Attempt(this->ToDo, WithoutMemory);
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Ended = std::move(ended);
  this->Over = true;
  this->IsWorking = false;
  this->Turned.notify_all();
}

//------------------------------------------------------------------------------
bool SlicedWork::GoesOn()
{
  if (std::this_thread::get_id() == this->Worker.get_id() && !this->IsUnwanted &&
    Clock::now() >= this->End)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Hand(false, lock);
  }
  return !this->IsUnwanted;
}

//------------------------------------------------------------------------------
void SlicedWork::Stop()
{
  this->IsUnwanted = true;
  if (this->Worker.joinable())
  {
    this->RunFor(LongestSlice);
  }
  this->ToDo = nullptr;
}
} // namespace LightTransport
