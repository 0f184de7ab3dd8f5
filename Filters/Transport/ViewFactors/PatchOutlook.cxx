// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PatchOutlook.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"

#include <cmath>

namespace LightTransport
{
namespace
{
// The variance of a share by such points falls with the power 5/4 of their number, where it is an
// edge in four dimensions that they resolve: beside independent rays they gain the power 1/4.
constexpr double GainPower = 0.25;
} // namespace

//------------------------------------------------------------------------------
PatchOutlook::PatchOutlook(const PatchScene& scene, const SceneRayCaster& caster, vtkIdType patch,
  Hits& hits)
  : Caster(caster), Patch(patch), AllHits(hits)
{
  this->Shape.Set(scene, patch);
  for (int set = 0; set < NumberOfSets; ++set)
  {
    this->Sets.emplace_back(static_cast<std::uint64_t>(patch) * NumberOfSets + set);
  }
  this->Rays = FirstRays / NumberOfSets;
  for (Set& set : this->Sets)
  {
    for (int index = 0; index < this->Rays; ++index)
    {
      this->Cast(set, index);
    }
  }
}

//------------------------------------------------------------------------------
void PatchOutlook::CastMore()
{
  for (Set& set : this->Sets)
  {
    for (int index = this->Rays; index < 2 * this->Rays; ++index)
    {
      this->Cast(set, index);
    }
  }
  this->Rays *= 2;
}

//------------------------------------------------------------------------------
void PatchOutlook::Cast(Set& set, int index)
{
  bool front = false;
  const vtkIdType hit = this->Caster.FindHit(set.Sampler.GetPoint(this->Shape, index, 0),
    set.Sampler.GetDirection(this->Shape.Normal, index, 2), this->Patch, front);
  if (hit < 0)
  {
    ++set.Sky;
    return;
  }
  set.Back += front ? 0 : 1;
  std::atomic<vtkIdType>& count = front ? this->AllHits.Front[hit] : this->AllHits.Back[hit];
  count.fetch_add(1, std::memory_order_relaxed);
}

//------------------------------------------------------------------------------
int PatchOutlook::CountSky() const
{
  int count = 0;
  for (const Set& set : this->Sets)
  {
    count += set.Sky;
  }
  return count;
}

//------------------------------------------------------------------------------
int PatchOutlook::CountOpen() const
{
  int count = this->CountSky();
  for (const Set& set : this->Sets)
  {
    count += set.Back;
  }
  return count;
}

//------------------------------------------------------------------------------
// Of a mean over the sets, from the squares of what they differ from it, and the variance of one
// ray.
double PatchOutlook::GetDeviation(double squares, double variance) const
{
  constexpr double degrees = NumberOfSets - 1;
  const double usual = variance * std::pow(this->Rays, -1.0 - GainPower);
  return std::sqrt(0.5 * (squares / degrees + usual) / NumberOfSets);
}

//------------------------------------------------------------------------------
PatchOutlook::Estimate PatchOutlook::GetOpen() const
{
  const double rays = this->Rays;
  const double count = this->CountOpen();
  Estimate open;
  open.Value = count / (rays * NumberOfSets);
  double squares = 0.0;
  for (const Set& set : this->Sets)
  {
    squares += std::pow((set.Sky + set.Back) / rays - open.Value, 2);
  }
  // One ray more of either kind: what none has met may be there all the same.
  const double share = (count + 1.0) / (rays * NumberOfSets + 2.0);
  open.Deviation = this->GetDeviation(squares, share * (1.0 - share));
  return open;
}

//------------------------------------------------------------------------------
// By the differences from what each set would have met of the sky if it had the same part of its
// own openings.
PatchOutlook::Estimate PatchOutlook::GetSky() const
{
  const double open = this->CountOpen();
  Estimate sky;
  if (open == 0.0)
  {
    return sky;
  }
  sky.Value = this->CountSky() / open;
  double squares = 0.0;
  for (const Set& set : this->Sets)
  {
    squares += std::pow((set.Sky - sky.Value * (set.Sky + set.Back)) / this->Rays, 2);
  }
  const double share = open / this->GetNumberOfRays();
  sky.Deviation = this->GetDeviation(squares, share * sky.Value * (1.0 - sky.Value)) / share;
  return sky;
}
} // namespace LightTransport
