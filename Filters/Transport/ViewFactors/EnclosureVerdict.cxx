// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/EnclosureVerdict.h"

#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/FieldValues.h"
#include "Shared/Pulse.h"
#include "ViewFactors/ViewFactorClosure.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace LightTransport
{
namespace
{
// Less than this share of what leaves the patches is no opening: rays that slip between neighbors
// whose corners do not meet.
constexpr double ClosedShare = 1e-6;
// An enclosure that loses no more than this was meant to be closed.
constexpr double LeakingShare = 0.01;
// Back faces that get more than this are told of, and more than that make a scene inside out.
constexpr double NoticedBackShare = 0.002;
constexpr double InsideOutShare = 0.05;
// A patch sees mostly back faces, or is met from behind, from this share on; rays that tell.
constexpr double Mostly = 0.5;
constexpr double FewestHits = 32.0;
// Patches that see a leak at least this much, relative to the one that sees most of it, are beside
// it.
constexpr double BesideLeak = 0.8;

//------------------------------------------------------------------------------
std::string FormatPercent(double share)
{
  std::ostringstream text;
  text.precision(2);
  text << 100.0 * share << " %";
  return text.str();
}
} // namespace

//------------------------------------------------------------------------------
EnclosureVerdict::EnclosureVerdict(const PatchScene& scene, const Links& links)
  : Scene(scene), AllLinks(links), Problems(scene.GetProblems())
{
  this->SumOpenings();
  this->Judge();
  this->JudgeBackFaces();
  this->JudgeErrors();
}

//------------------------------------------------------------------------------
void EnclosureVerdict::SumOpenings()
{
  const std::vector<double>& areas = this->Scene.GetAreas();
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    this->Area += areas[patch];
    this->SkyShare += areas[patch] * this->AllLinks.SkyFractions[patch];
    this->BackShare += areas[patch] * this->AllLinks.BackFaceFractions[patch];
  }
  this->SkyShare /= this->Area;
  this->BackShare /= this->Area;
}

//------------------------------------------------------------------------------
void EnclosureVerdict::Judge()
{
  if (this->BackShare > InsideOutShare || this->IsTurnedOutwards())
  {
    this->Name = "InsideOut";
  }
  else if (this->SkyShare > LeakingShare || this->BackShare > ClosedShare)
  {
    this->Name = "Open";
  }
  else if (this->SkyShare > ClosedShare)
  {
    this->Name = "Leaking";
    this->JudgeLeak();
  }
}

//------------------------------------------------------------------------------
// No patch sees any other, and each edge of the surface belongs to two of them: all would see each
// other if they were turned.
bool EnclosureVerdict::IsTurnedOutwards() const
{
  const std::vector<double>& sums = this->AllLinks.RawRowSums;
  if (sums.size() < 4 || !this->AllLinks.AreRowsWhole ||
    std::any_of(sums.begin(), sums.end(), [](double sum) { return sum > 0.0; }))
  {
    return false;
  }
  std::map<std::pair<vtkIdType, vtkIdType>, int> edges;
  for (vtkIdType patch = 0; patch < this->Scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    const vtkIdType* corners = this->Scene.GetCorners(patch);
    const int count = this->Scene.GetNumberOfCorners(patch);
    for (int corner = 0; corner < count; ++corner)
    {
      const vtkIdType from = corners[corner];
      const vtkIdType to = corners[(corner + 1) % count];
      edges[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) { return edge.second == 0; });
}

//------------------------------------------------------------------------------
void EnclosureVerdict::JudgeLeak()
{
  const std::vector<double>& sky = this->AllLinks.SkyFractions;
  const auto most = std::max_element(sky.begin(), sky.end());
  for (std::size_t patch = 0; patch < sky.size(); ++patch)
  {
    if (sky[patch] >= BesideLeak * *most)
    {
      this->Flag(static_cast<vtkIdType>(patch), LEAK);
    }
  }
  std::ostringstream text;
  text << "The enclosure has a leak: " << FormatPercent(this->SkyShare)
       << " of what leaves its surfaces gets out, most (" << FormatPercent(*most) << ") from "
       << this->Describe(most - sky.begin())
       << ": close the gap, or set a background if it is meant to be there (LeakArea tells how "
          "large it is, \"SceneProblems\" where).";
  this->Warnings.push_back(text.str());
}

//------------------------------------------------------------------------------
void EnclosureVerdict::JudgeBackFaces()
{
  const Links& links = this->AllLinks;
  const auto patches = static_cast<vtkIdType>(links.BackFaceFractions.size());
  vtkIdType worst = 0;
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    const double behind = links.BackHits[patch];
    const double hits = behind + links.FrontHits[patch];
    const bool isBehind = hits >= FewestHits && behind > Mostly * hits;
    if (isBehind || links.BackFaceFractions[patch] > Mostly)
    {
      this->Flag(patch, MOSTLY_BACK_FACES);
    }
    worst = behind > links.BackHits[worst] ? patch : worst;
  }
  if (this->BackShare > NoticedBackShare)
  {
    this->Warnings.push_back(FormatPercent(this->BackShare) +
      " of what leaves the surfaces meets back faces, which absorb it, most of them of " +
      this->Describe(worst) +
      ": if normals point the wrong way there, turn them (vtkReverseSense, or FlipNormals of "
      "vtkPatchMesher); if both sides count, switch TwoSided on. \"SceneProblems\" tells which.");
  }
  else if (this->Name == "InsideOut")
  {
    this->Warnings.emplace_back(
      "No polygon sees any other, but their backs enclose a space. That is right for a body that "
      "is seen from outside; to see each other in there, they need their normals turned "
      "(vtkReverseSense, or FlipNormals of vtkPatchMesher).");
  }
}

//------------------------------------------------------------------------------
// Links between clusters know one error for all rows.
void EnclosureVerdict::JudgeErrors()
{
  const Links& links = this->AllLinks;
  if (!links.Matrix)
  {
    const double error = links.GetSummary("LinkError");
    if (error > links.Tolerance)
    {
      std::ostringstream text;
      text << "Links between clusters reached an error of " << error << " where LinkTolerance is "
           << links.Tolerance << ": raise it, or link pairs of patches (Dense).";
      this->Warnings.push_back(text.str());
    }
    return;
  }
  const std::vector<double> errors = links.GetErrors();
  vtkIdType count = 0;
  for (std::size_t patch = 0; patch < errors.size(); ++patch)
  {
    if (errors[patch] > links.Tolerance + ViewFactorClosure::SinglePrecision)
    {
      ++count;
      this->Flag(static_cast<vtkIdType>(patch), TOLERANCE_NOT_REACHED);
    }
  }
  if (count > 0)
  {
    const auto worst = std::max_element(errors.begin(), errors.end());
    std::ostringstream text;
    text << "The view factors of " << count << " of " << errors.size()
         << " patches do not reach the tolerance of " << links.Tolerance
         << ": their error is estimated at up to " << *worst << " ("
         << this->Describe(worst - errors.begin())
         << "). Divide large polygons that are partly hidden, or raise the tolerance.";
    this->Warnings.push_back(text.str());
  }
}

//------------------------------------------------------------------------------
void EnclosureVerdict::Flag(vtkIdType patch, Problem problem)
{
  this->Problems[this->Scene.GetFaces().GetFace(patch)] |= problem;
}

//------------------------------------------------------------------------------
std::string EnclosureVerdict::Describe(vtkIdType patch) const
{
  const SceneFaces& faces = this->Scene.GetFaces();
  return faces.Describe(faces.GetFace(patch));
}

//------------------------------------------------------------------------------
void EnclosureVerdict::AddTo(vtkFieldData* fields) const
{
  FieldValues::Add(fields, "EnclosureVerdict", this->Name);
  FieldValues::Add(fields, "IsClosed", this->IsOpen() ? 0.0 : 1.0);
  FieldValues::Add(fields, "LeakArea",
    this->SkyShare * this->Area * this->Scene.GetScale() * this->Scene.GetScale());
}
} // namespace LightTransport
