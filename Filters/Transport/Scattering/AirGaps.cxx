// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/AirGaps.h"

#include "Geometry/PlaneSides.h"
#include "Scene/PatchScene.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace LightTransport
{
namespace
{
// Cosine of normals that differ by more than a right angle, beyond what coordinates are worth.
constexpr double RightAngle = -1e-3;

//------------------------------------------------------------------------------
// A place where a segment leaves the body (Rise above 0) or enters it.
struct Passage
{
  double Fraction;
  double Rounding;
  double Rise; // along the normal
  vtkIdType Patch;
};
} // namespace

//------------------------------------------------------------------------------
Outcome AirGaps::Build(const PatchScene& scene)
{
  this->Scene = &scene;
  if (scene.IsOfTexels())
  {
    // They enclose no body: nobody knows what is air between them.
    return Outcome::Done();
  }
  const std::vector<bool> hollows = FindHollows(scene);
  this->HasHollows = std::find(hollows.begin(), hollows.end(), true) != hollows.end();
  return this->HasHollows ? this->Hollows.Build(scene, &hollows) : Outcome::Done();
}

//------------------------------------------------------------------------------
LinksThroughAir AirGaps::StartSums(const std::vector<double>& areas,
  const ScatteringProfiles& profiles, double sampleSize) const
{
  LinksThroughAir sums;
  sums.Carried.assign(areas.size() * profiles.size(), 0.0);
  sums.Variances = sums.Carried;
  const double largest = *std::max_element(areas.begin(), areas.end());
  const bool isSample = this->HasHollows && sampleSize != AllLinks;
  for (const auto& profile : profiles)
  {
    sums.Samples.push_back(isSample ? profile->GetTotal() * largest / sampleSize : 0.0);
  }
  return sums;
}

//------------------------------------------------------------------------------
bool AirGaps::AreBetween(vtkIdType i, vtkIdType j) const
{
  const PatchScene::Vector& from = this->Scene->GetCentroid(i);
  const PatchScene::Vector& to = this->Scene->GetCentroid(j);
  const auto areFacing = [this](vtkIdType a, vtkIdType b)
  { return this->Scene->GetNormal(a).dot(this->Scene->GetNormal(b)) < RightAngle; };
  const double first = this->Scene->GetPlane(i).GetCertainHeight(to);
  const double last = this->Scene->GetPlane(j).GetCertainHeight(from);
  thread_local std::vector<SceneRayCaster::Crossing> crossings;
  this->Hollows.FindCrossings(from, to, i, j, crossings);
  if (crossings.empty())
  {
    return first > 0.0 && last > 0.0 && areFacing(i, j);
  }
  thread_local std::vector<Passage> passages;
  passages.clear();
  for (const SceneRayCaster::Crossing& crossing : crossings)
  {
    const double rise = this->Scene->GetNormal(crossing.Patch).dot(to - from);
    passages.push_back({ crossing.Fraction, crossing.Rounding, rise, crossing.Patch });
  }
  // Of patches in front of each other.
  passages.push_back({ 0.0, 0.0, std::max(first, 0.0), i });
  passages.push_back({ 1.0, 0.0, -std::max(last, 0.0), j });
  // Of two in one place what enters is first: nothing is between them.
  std::sort(passages.begin(), passages.end(),
    [](const Passage& a, const Passage& b)
    { return std::tie(a.Fraction, a.Rise) < std::tie(b.Fraction, b.Rise); });
  const auto isGap = [&areFacing](const Passage& exit, const Passage& entry)
  {
    return exit.Rise > 0.0 && entry.Rise < 0.0 &&
      entry.Fraction - exit.Fraction > exit.Rounding + entry.Rounding &&
      areFacing(exit.Patch, entry.Patch);
  };
  return std::adjacent_find(passages.begin(), passages.end(), isGap) != passages.end();
}
} // namespace LightTransport
