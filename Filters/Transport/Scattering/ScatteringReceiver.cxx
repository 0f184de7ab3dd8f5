// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringReceiver.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
void ScatteringReceiver::Look(vtkIdType patch)
{
  this->Patch = patch;
  this->Parts.clear();
  this->Add(0);
}

//------------------------------------------------------------------------------
void ScatteringReceiver::Look(vtkIdType patch, const int* begin, const int* end)
{
  this->Patch = patch;
  this->Parts.clear();
  this->AddKept(0, begin, end);
}

//------------------------------------------------------------------------------
bool ScatteringReceiver::IsNegligible(int slot) const
{
  return !this->Clusters->HoldsPatch(slot, this->Patch) &&
    this->Clusters->GetBound(this->Patch, slot) < this->LeaveOut;
}

//------------------------------------------------------------------------------
void ScatteringReceiver::SetSmooth(const ScatteringClusters::Estimate& estimate, Part& part) const
{
  const double area = this->Clusters->GetArea(part.Slot);
  part.Value = area * estimate.Value;
  part.Squares = area * estimate.Squares;
  part.IsFactor = this->Clusters->IsFactor(estimate);
}

//------------------------------------------------------------------------------
// Below what is smooth all is: a patch there is what it is at its centre, too.
ScatteringReceiver::Part ScatteringReceiver::MakeSmooth(int slot) const
{
  Part part;
  part.Slot = slot;
  part.IsLeftOut = this->IsNegligible(slot);
  if (!part.IsLeftOut && !this->Clusters->GetSlots().IsPatch(slot))
  {
    const ScatteringClusters::Estimate estimate = this->Clusters->Look(this->Patch, slot, false);
    this->SetSmooth(estimate, part);
  }
  return part;
}

//------------------------------------------------------------------------------
void ScatteringReceiver::Add(int slot)
{
  Part part;
  part.Slot = slot;
  part.IsLeftOut = this->IsNegligible(slot);
  if (part.IsLeftOut)
  {
    this->Parts.push_back(part);
    return;
  }
  this->AddLinked(slot);
}

//------------------------------------------------------------------------------
// What is not left out.
void ScatteringReceiver::AddLinked(int slot)
{
  Part part;
  part.Slot = slot;
  if (this->Clusters->GetSlots().IsPatch(slot))
  {
    this->AddPatch(slot);
    return;
  }
  if (!this->IsOwn(part))
  {
    const ScatteringClusters::Estimate estimate = this->Clusters->Look(this->Patch, slot, true);
    if (estimate.IsSmooth)
    {
      this->SetSmooth(estimate, part);
      this->Parts.push_back(part);
      return;
    }
  }
  this->AddNode(slot, [this](int child) { this->Add(child); });
}

//------------------------------------------------------------------------------
void ScatteringReceiver::AddPatch(int slot)
{
  Part part;
  part.Slot = slot;
  part.Value =
    this->Clusters->IntegratePatch(this->Patch, this->Clusters->GetSlots().GetPatch(slot));
  part.Squares = part.Value.square() / this->Clusters->GetArea(slot);
  part.IsExact = true;
  this->Parts.push_back(part);
}

//------------------------------------------------------------------------------
// The sum of what addChild(slot) adds for each child.
template <typename AddChild>
void ScatteringReceiver::AddNode(int slot, const AddChild& addChild)
{
  const std::size_t index = this->Parts.size();
  Part part;
  part.Slot = slot;
  part.IsExact = true;
  this->Parts.push_back(part);
  const LinkSlots::Node children = this->Clusters->GetSlots().GetChildren(slot);
  for (int child = children.First; child < children.Last; ++child)
  {
    const std::size_t below = this->Parts.size();
    addChild(child);
    part.Value += this->Parts[below].Value;
    part.Squares += this->Parts[below].Squares;
    part.IsExact = part.IsExact && this->Parts[below].IsExact;
  }
  part.NumberBelow = static_cast<int>(this->Parts.size() - index - 1);
  this->Parts[index] = part;
}

//------------------------------------------------------------------------------
void ScatteringReceiver::AddKept(int slot, const int* begin, const int* end)
{
  const std::size_t index = this->Parts.size();
  if (begin == end)
  {
    this->Add(slot);
    return;
  }
  if (*begin == slot)
  {
    this->AddLinked(slot);
    this->Parts[index].IsKept = true;
    return;
  }
  Part part;
  part.Slot = slot;
  part.IsDivided = true;
  this->Parts.push_back(part);
  const LinkSlots::Node children = this->Clusters->GetSlots().GetChildren(slot);
  for (int child = children.First; child < children.Last; ++child)
  {
    const int* const middle = std::find_if(begin, end,
      [&](int kept)
      { return !this->Clusters->HoldsPatch(child, this->Clusters->GetFirstPatch(kept)); });
    this->AddKept(child, begin, middle);
    begin = middle;
  }
  this->Parts[index].NumberBelow = static_cast<int>(this->Parts.size() - index - 1);
}

//------------------------------------------------------------------------------
void ScatteringReceiver::Adopt(vtkIdType patch, const RefinementOnDevice::Walk& walk)
{
  this->Patch = patch;
  this->Parts.clear();
  RefinementOnDevice::Walk left = walk;
  this->AddFound(0, left);
}

//------------------------------------------------------------------------------
// Nodes above what the device has found are near.
void ScatteringReceiver::AddFound(int slot, RefinementOnDevice::Walk& walk)
{
  if (walk.Begin->Slot != slot)
  {
    this->AddNode(slot, [&](int child) { this->AddFound(child, walk); });
    return;
  }
  const std::size_t index = this->Parts.size();
  const bool isDivided = walk.Begin->What == vtkDeviceLinkRefiner::Kind::Divided;
  this->AddPart(walk);
  if (isDivided)
  {
    while (walk.Begin != walk.End &&
      this->Clusters->HoldsPatch(slot, this->Clusters->GetFirstPatch(walk.Begin->Slot)))
    {
      this->AddPart(walk);
    }
    this->Parts[index].NumberBelow = static_cast<int>(this->Parts.size() - index - 1);
  }
}

//------------------------------------------------------------------------------
void ScatteringReceiver::AddPart(RefinementOnDevice::Walk& walk)
{
  const RefinementOnDevice::Part& found = *walk.Begin;
  ++walk.Begin;
  if (found.What == vtkDeviceLinkRefiner::Kind::Patch)
  {
    this->AddPatch(found.Slot);
    return;
  }
  Part part;
  part.Slot = found.Slot;
  part.IsLeftOut = found.What == vtkDeviceLinkRefiner::Kind::LeftOut;
  part.IsFactor = found.IsFactor;
  for (int band = 0; band < vtkDeviceLinkRefiner::NumberOfBands; ++band)
  {
    part.Value[band] = found.Value[band];
    part.Squares[band] = found.Deviation2[band];
  }
  part.Squares = (part.Squares + part.Value.square()) / this->Clusters->GetArea(part.Slot);
  this->Parts.push_back(part);
}

//------------------------------------------------------------------------------
ScatteringReceiver::Bands ScatteringReceiver::GetDeviation(const Part& part) const
{
  const double area = this->Clusters->GetArea(part.Slot);
  return (area * part.Squares - part.Value.square()).max(0.0).sqrt();
}

//------------------------------------------------------------------------------
bool ScatteringReceiver::IsOwn(const Part& part) const
{
  return this->Clusters->HoldsPatch(part.Slot, this->Patch);
}

//------------------------------------------------------------------------------
ScatteringReceiver::Part ScatteringReceiver::GetPart(int slot) const
{
  const vtkIdType first = this->Clusters->GetFirstPatch(slot);
  const Part* part = &this->Parts[0];
  while (part->Slot != slot)
  {
    if (part->NumberBelow == 0)
    {
      return this->MakeSmooth(slot);
    }
    const Part* below = part + 1;
    while (!this->Clusters->HoldsPatch(below->Slot, first))
    {
      below += 1 + below->NumberBelow;
    }
    part = below;
  }
  return *part;
}
} // namespace LightTransport
