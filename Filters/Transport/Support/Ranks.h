// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The processes that share a scene, as far as private code needs them: how many there are, sums and
 * maxima over all of them, and that all of them agree on an outcome. All but the numbers are
 * collective; with one process (or no controller) they do nothing.
 *
 * A rank may fail anywhere, since memory may run out anywhere. So that no other waits for it for
 * ever, all meet before each exchange of numbers, where one that cannot go on says so (Attempt).
 */
#ifndef Ranks_h
#define Ranks_h

#include "Shared/Attempt.h"
#include "Shared/Outcome.h"
#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#include "vtkType.h"

#include <numeric>
#include <vector>

namespace LightTransport
{
class Ranks
{
public:
  Ranks() = default;
  /// `controller` may be nullptr; it must outlive this.
  explicit Ranks(vtkMultiProcessController* controller) : Controller(controller) {}

  vtkMultiProcessController* GetController() const { return this->Controller; }
  int GetNumber() const { return this->Controller ? this->Controller->GetNumberOfProcesses() : 1; }
  /// The number of this process.
  int GetMine() const { return this->Controller ? this->Controller->GetLocalProcessId() : 0; }
  bool AreSeveral() const { return this->GetNumber() > 1; }

  ///@{ Replace values by their sum, or the value by the largest. False when the ranks could not be
  /// reached.
  template <typename T>
  bool Sum(T* values, std::size_t count) const
  {
    return this->Reduce(values, count, vtkCommunicator::SUM_OP);
  }
  template <typename T>
  bool Sum(std::vector<T>& values) const
  {
    return this->Sum(values.data(), values.size());
  }
  template <typename T>
  T GetLargest(T value) const
  {
    this->Reduce(&value, 1, vtkCommunicator::MAX_OP);
    return value;
  }
  ///@}

  /// The values of all ranks, one rank after the other.
  template <typename T>
  std::vector<T> Gather(const std::vector<T>& mine) const;

  /// Done where all ranks are; else the failure of the lowest rank that has one, with its number
  /// where not all fail, or the abort.
  Outcome Agree(const Outcome& mine) const;

  /// Take a step, as LightTransport::Attempt does, on all ranks alike. Where it fails or throws on
  /// some ranks the others leave it at their next exchange, and all return the same failure.
  template <typename Step>
  Outcome Attempt(const Step& step, const Advice& advice) const;

private:
  /// Thrown on ranks that can go on, where they meet one that cannot.
  struct OtherFailed
  {
  };
  void Meet(bool canGoOn = true) const;
  Outcome Describe(int rank, bool isOfAll, const char* message) const;

  template <typename T>
  bool Reduce(T* values, std::size_t count, int operation) const;

  vtkMultiProcessController* Controller = nullptr;
};

//------------------------------------------------------------------------------
template <typename T>
bool Ranks::Reduce(T* values, std::size_t count, int operation) const
{
  if (!this->AreSeveral())
  {
    return true;
  }
  const std::vector<T> mine(values, values + count);
  this->Meet();
  return this->Controller->AllReduce(mine.data(), values, static_cast<vtkIdType>(count),
           operation) != 0;
}

//------------------------------------------------------------------------------
template <typename T>
std::vector<T> Ranks::Gather(const std::vector<T>& mine) const
{
  if (!this->AreSeveral())
  {
    return mine;
  }
  const int ranks = this->GetNumber();
  const auto length = static_cast<vtkIdType>(mine.size());
  std::vector<vtkIdType> lengths(ranks), offsets(ranks);
  this->Meet();
  this->Controller->AllGather(&length, lengths.data(), 1);
  std::partial_sum(lengths.begin(), lengths.end() - 1, offsets.begin() + 1);
  std::vector<T> all(offsets.back() + lengths.back());
  this->Meet();
  this->Controller->AllGatherV(mine.data(), all.data(), length, lengths.data(), offsets.data());
  return all;
}

//------------------------------------------------------------------------------
template <typename Step>
Outcome Ranks::Attempt(const Step& step, const Advice& advice) const
{
  Outcome mine = Outcome::Done();
  try
  {
    mine = LightTransport::Attempt(step, advice);
    this->Meet(static_cast<bool>(mine));
  }
  catch (const OtherFailed&)
  {
    return this->Agree(Outcome::Done());
  }
  // Moved: a copy of the message would need memory.
  if (mine || !this->AreSeveral())
  {
    return mine;
  }
  return this->Agree(mine);
}
} // namespace LightTransport

#endif
