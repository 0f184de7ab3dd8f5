// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/LinkMethodChoice.h"

#include "Radiosity/SceneLook.h"
#include "Scene/PatchScene.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
// CPU seconds at an accuracy of 1e-2, and the powers of the accuracy with which they grow: of
// pairs, of those that face each other where something is between many of them or hardly any, and
// of the rays of a patch (all measured; scenes take from a third to three times as long).
constexpr double UsualAccuracy = 1e-2;
constexpr double SecondsPerPair = 4e-8;
constexpr double SecondsPerFacingPair = 1e-6;
constexpr double SecondsPerFreePair = 1e-7;
constexpr double FreeShare = 0.02;
constexpr double PairPower = 0.3;
constexpr double SecondsPerPatch = 1e-4;
constexpr double PatchPower = 0.95;
// A matrix is more exact than asked for, by far, and the same for each light: so long one waits.
constexpr double LittleTime = 0.5;
// So few patches take little time whatever they are, and the matrix of so many is too large.
constexpr vtkIdType FewPatches = 1000;
constexpr vtkIdType ManyPatches = 8192;

//------------------------------------------------------------------------------
double PredictDense(const SceneLook& look, double finer)
{
  const double each = look.HiddenShare < FreeShare ? SecondsPerFreePair : SecondsPerFacingPair;
  // The first look at a pair costs the same for every accuracy.
  const double growth = std::pow(std::max(finer, 1.0), PairPower);
  return SecondsPerPair * look.Pairs + each * look.FacingPairs * growth;
}
} // namespace

//------------------------------------------------------------------------------
LinkMethodChoice::LinkMethodChoice(const Wishes& wishes) : Asked(wishes)
{
  if (wishes.AreGiven)
  {
    this->Decide(wishes.Given, "given by SetViewFactors");
  }
  else if (wishes.Method != 0)
  {
    this->Decide(static_cast<LinkMethod>(wishes.Method), "asked for");
  }
  else if (wishes.PairSolver)
  {
    this->Decide(LinkMethod::Dense, std::string(wishes.PairSolver) + " needs each pair of patches");
  }
  else if (wishes.ViewFactorTolerance > 0.0)
  {
    this->Decide(LinkMethod::Dense, "ViewFactorTolerance asks for it");
  }
  else if (wishes.RefinesByBrightness || wishes.UsesAtlas)
  {
    this->Decide(LinkMethod::Hierarchical,
      std::string(wishes.RefinesByBrightness ? "RefineByBrightness" : "ClusterTree") +
        " asks for it");
  }
  else if (wishes.LinkTolerance > 0.0)
  {
    this->Decide(LinkMethod::Sampled, "LinkTolerance asks for links that it decides on");
  }
  else
  {
    this->Open = true;
  }
}

//------------------------------------------------------------------------------
void LinkMethodChoice::Decide(LinkMethod method, const std::string& why)
{
  this->Method = method;
  this->Why = why;
  this->Open = false;
}

//------------------------------------------------------------------------------
Outcome LinkMethodChoice::DecideByCost(const PatchScene& scene, double accuracy)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  if (!this->Open)
  {
    return Outcome::Done();
  }
  if (patches <= FewPatches || patches > ManyPatches)
  {
    const bool areFew = patches <= FewPatches;
    this->Decide(areFew ? LinkMethod::Dense : LinkMethod::Sampled,
      areFew ? "all pairs of few patches" : "all pairs would take much memory and time");
    return Outcome::Done();
  }
  SceneLook look;
  Outcome looked = look.Take(scene);
  const double finer = UsualAccuracy / accuracy;
  const double dense = PredictDense(look, finer);
  const double sampled = SecondsPerPatch * look.Patches * std::pow(finer, PatchPower);
  std::ostringstream why;
  why << "all pairs may take about " << std::ceil(dense) << " s, rays " << std::ceil(sampled)
      << " s";
  this->Decide(dense <= std::max(sampled, LittleTime) ? LinkMethod::Dense : LinkMethod::Sampled,
    why.str());
  return looked;
}

//------------------------------------------------------------------------------
std::string LinkMethodChoice::Explain() const
{
  return std::string(GetName(this->Method)) + ": " + this->Why;
}

//------------------------------------------------------------------------------
std::vector<std::string> LinkMethodChoice::ListUnheeded() const
{
  std::vector<std::string> warnings;
  const auto warn = [&](const char* what, const char* remedy)
  {
    warnings.push_back(std::string(what) + " has no effect on " +
      (this->Asked.AreGiven ? "view factors that are given" : "the links") + " (" +
      this->Explain() + "): " + (this->Asked.AreGiven ? "set it in their vtkViewFactors" : remedy) +
      ", or " + what + " to 0.");
  };
  if (this->Asked.ViewFactorTolerance > 0.0 &&
    (this->Asked.AreGiven || this->Method != LinkMethod::Dense))
  {
    warn("ViewFactorTolerance", "set LinkMethod to Dense");
  }
  if (this->Asked.LinkTolerance > 0.0 &&
    (this->Asked.AreGiven || this->Method == LinkMethod::Dense))
  {
    warn("LinkTolerance", "set LinkMethod to Sampled or Hierarchical");
  }
  return warnings;
}

//------------------------------------------------------------------------------
const char* LinkMethodChoice::GetName(LinkMethod method)
{
  return method == LinkMethod::Dense ? "Dense"
    : method == LinkMethod::Sampled  ? "Sampled"
                                     : "Hierarchical";
}
} // namespace LightTransport
