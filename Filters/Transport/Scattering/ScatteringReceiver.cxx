// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringReceiver.h"

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
  const std::size_t index = this->Parts.size();
  Part part;
  part.Slot = slot;
  part.IsLeftOut = this->IsNegligible(slot);
  this->Parts.push_back(part);
  if (part.IsLeftOut)
  {
    return;
  }
  if (this->Clusters->GetSlots().IsPatch(slot))
  {
    part.Value =
      this->Clusters->IntegratePatch(this->Patch, this->Clusters->GetSlots().GetPatch(slot));
    part.Squares = part.Value.square() / this->Clusters->GetArea(slot);
    part.IsExact = true;
    this->Parts[index] = part;
    return;
  }
  if (!this->IsOwn(part))
  {
    const ScatteringClusters::Estimate estimate = this->Clusters->Look(this->Patch, slot, true);
    if (estimate.IsSmooth)
    {
      this->SetSmooth(estimate, this->Parts[index]);
      return;
    }
  }
  part.IsExact = true;
  const LinkSlots::Node children = this->Clusters->GetSlots().GetChildren(slot);
  for (int child = children.First; child < children.Last; ++child)
  {
    const std::size_t below = this->Parts.size();
    this->Add(child);
    part.Value += this->Parts[below].Value;
    part.Squares += this->Parts[below].Squares;
    part.IsExact = part.IsExact && this->Parts[below].IsExact;
  }
  part.NumberBelow = static_cast<int>(this->Parts.size() - index - 1);
  this->Parts[index] = part;
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
