// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Support/Ranks.h"

#include <string>

namespace LightTransport
{
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
Outcome Ranks::Agree(const Outcome& mine) const
{
  if (!this->AreSeveral())
  {
    return mine;
  }
  // Texts end with a zero each; the first one is that of the lowest rank. An abort has an empty
  // one.
  std::vector<char> text;
  if (!mine)
  {
    const std::string& message = mine.GetMessage();
    text.assign(message.c_str(), message.c_str() + message.size() + 1);
  }
  const bool aborted = this->GetLargest(mine.IsAborted() ? 1 : 0) != 0;
  const std::vector<char> all = this->Gather(text);
  if (all.empty())
  {
    return Outcome::Done();
  }
  return aborted ? Outcome::Aborted() : Outcome::Failed(all.data());
}
} // namespace LightTransport
