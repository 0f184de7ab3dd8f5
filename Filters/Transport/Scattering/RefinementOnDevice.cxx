// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/RefinementOnDevice.h"

#include "Scattering/ScatteringClusters.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <tuple>

namespace LightTransport
{
namespace
{
///@{ Found at a time, about (100 MB), and receivers that this may be.
constexpr double PartsAtATime = 2e6;
constexpr double SmallestBatch = 64.0;
constexpr double LargestBatch = 65536.0;
///@}
} // namespace

//------------------------------------------------------------------------------
Outcome RefinementOnDevice::Fail(const std::string& reason)
{
  this->Failed = true;
  return Outcome::Failed(std::string("The links cannot be chosen on ") +
    this->Device->GetDeviceName() + ": " + reason + ". Set Device to CPU.");
}

//------------------------------------------------------------------------------
Outcome RefinementOnDevice::Initialize(double leaveOut, const std::vector<double>& limits)
{
  auto body = std::make_shared<vtkDeviceLinkRefiner::Body>();
  this->Clusters.Describe(*body);
  body->LeaveOut = leaveOut;
  for (std::size_t slot = 0; slot < limits.size(); ++slot)
  {
    body->Slots[slot].Limit = limits[slot];
  }
  std::string reason;
  return this->Device->Initialize(body, reason) ? Outcome::Done() : this->Fail(reason);
}

//------------------------------------------------------------------------------
Outcome RefinementOnDevice::Refine(vtkIdType first, vtkIdType last)
{
  std::vector<Part> parts;
  std::string reason;
  if (!this->Device->Refine(first, last, parts, reason))
  {
    return this->Fail(reason);
  }
  const double receivers = static_cast<double>(last - first);
  const double batch = PartsAtATime * receivers / static_cast<double>(parts.size() + 1);
  this->BatchSize = static_cast<vtkIdType>(std::min(std::max(batch, SmallestBatch), LargestBatch));
  this->First = first;
  this->SortByReceivers(parts, last);
  std::atomic<bool> areWhole{ true };
  const auto sort = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType k = begin; k < end; ++k)
    {
      Pulse::Beat(k);
      if (!this->SortWalk(this->Parts.data() + this->Offsets[k],
            this->Parts.data() + this->Offsets[k + 1]))
      {
        areWhole = false;
      }
    }
  };
  Threads::For(0, last - first, 1, sort);
  return areWhole ? Outcome::Done() : this->Fail("some of the links it was to find are missing");
}

//------------------------------------------------------------------------------
void RefinementOnDevice::SortByReceivers(const std::vector<Part>& parts, vtkIdType last)
{
  this->Offsets.assign(last - this->First + 1, 0);
  for (const Part& part : parts)
  {
    ++this->Offsets[part.Receiver - this->First + 1];
  }
  for (std::size_t k = 1; k < this->Offsets.size(); ++k)
  {
    this->Offsets[k] += this->Offsets[k - 1];
  }
  this->Parts.resize(parts.size());
  std::vector<std::size_t> next(this->Offsets.begin(), this->Offsets.end() - 1);
  for (const Part& part : parts)
  {
    this->Parts[next[part.Receiver - this->First]++] = part;
  }
}

//------------------------------------------------------------------------------
// Whether all patches are in some part, once.
bool RefinementOnDevice::SortWalk(Part* begin, Part* end) const
{
  const auto place = [this](const Part& part)
  {
    return std::make_tuple(this->Clusters.GetFirstPatch(part.Slot),
      part.What != vtkDeviceLinkRefiner::Kind::Divided);
  };
  std::sort(begin, end, [&](const Part& a, const Part& b) { return place(a) < place(b); });
  vtkIdType patch = 0;
  bool isWhole = true;
  for (const Part* part = begin; part != end; ++part)
  {
    if (part->What != vtkDeviceLinkRefiner::Kind::Divided)
    {
      isWhole = isWhole && this->Clusters.GetFirstPatch(part->Slot) == patch;
      patch = this->Clusters.GetLastPatch(part->Slot);
    }
  }
  return isWhole && patch == this->Clusters.GetLastPatch(0);
}

//------------------------------------------------------------------------------
RefinementOnDevice::Walk RefinementOnDevice::GetWalk(vtkIdType patch) const
{
  const vtkIdType k = patch - this->First;
  return { this->Parts.data() + this->Offsets[k], this->Parts.data() + this->Offsets[k + 1] };
}
} // namespace LightTransport
