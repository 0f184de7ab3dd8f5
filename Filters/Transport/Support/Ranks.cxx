// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Support/Ranks.h"

#include <array>
#include <new>
#include <string>

namespace LightTransport
{
namespace
{
constexpr std::size_t LongestMessage = 1023;
} // namespace

//------------------------------------------------------------------------------
void Ranks::Meet(bool canGoOn) const
{
  if (!this->AreSeveral())
  {
    return;
  }
  const int mine = canGoOn ? 0 : 1;
  int any = 0;
  this->Controller->AllReduce(&mine, &any, 1, vtkCommunicator::MAX_OP);
  if (canGoOn && any != 0)
  {
    throw OtherFailed();
  }
}

//------------------------------------------------------------------------------
// What has failed may be memory: until all ranks have said what they have to say none asks for any.
Outcome Ranks::Agree(const Outcome& mine) const
{
  if (!this->AreSeveral())
  {
    return mine;
  }
  this->Meet();
  const int mineNotDone[2] = { mine ? 0 : 1, mine.IsAborted() ? 1 : 0 };
  int notDone[2] = {};
  this->Controller->AllReduce(mineNotDone, notDone, 2, vtkCommunicator::SUM_OP);
  if (notDone[0] == 0 || notDone[1] > 0)
  {
    return notDone[0] == 0 ? Outcome::Done() : Outcome::Aborted();
  }
  const int mineIfFailed = mine ? this->GetNumber() : this->GetMine();
  int lowest = 0;
  this->Controller->AllReduce(&mineIfFailed, &lowest, 1, vtkCommunicator::MIN_OP);
  std::array<char, LongestMessage + 1> message{};
  if (lowest == this->GetMine())
  {
    mine.GetMessage().copy(message.data(), LongestMessage);
  }
  this->Controller->Broadcast(message.data(), static_cast<vtkIdType>(message.size()), lowest);
  return this->Describe(lowest, notDone[0] == this->GetNumber(), message.data());
}

//------------------------------------------------------------------------------
// A failure that not all have is told with its rank.
Outcome Ranks::Describe(int rank, bool isOfAll, const char* message) const
{
  const bool isReported = *message == '\0';
  if (isReported && (isOfAll || rank == this->GetMine()))
  {
    return Outcome::FailedAsReported();
  }
  try
  {
    const std::string place =
      "On rank " + std::to_string(rank) + " of " + std::to_string(this->GetNumber()) + ": ";
    return Outcome::Failed(
      (isOfAll ? "" : place) + (isReported ? "see the messages of that rank." : message));
  }
  catch (const std::bad_alloc&)
  {
    return Outcome::Failed("No memory left."); // short enough to need none
  }
}
} // namespace LightTransport
