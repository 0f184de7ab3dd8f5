// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/LinkMethodChoice.h"

#include <cmath>
#include <sstream>

namespace LightTransport
{
namespace
{
// CPU seconds at an accuracy of 1e-2, of a matrix for each pair and of rays for each patch, and the
// powers of the accuracy with which they grow: of scenes with some furniture, of which single ones
// take from a third to twice as long (measured).
constexpr double UsualAccuracy = 1e-2;
constexpr double SecondsPerPair = 3e-7;
constexpr double PairPower = 0.3;
constexpr double SecondsPerPatch = 2e-4;
constexpr double PatchPower = 0.95;
// A matrix is more exact than asked for, by far, and the same for each light: so long one waits.
constexpr double LittleTime = 1.5;
// A matrix takes gigabytes before long.
constexpr double MostDensePatches = 8192.0;
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
void LinkMethodChoice::DecideByCost(vtkIdType patches, double accuracy)
{
  if (!this->Open)
  {
    return;
  }
  const auto count = static_cast<double>(patches);
  const double finer = UsualAccuracy / accuracy;
  const double dense = SecondsPerPair * count * count * std::pow(finer, PairPower);
  const double sampled = SecondsPerPatch * count * std::pow(finer, PatchPower);
  if (dense <= LittleTime)
  {
    this->Decide(LinkMethod::Dense, "all pairs take little time");
  }
  else if (count > MostDensePatches)
  {
    this->Decide(LinkMethod::Sampled, "all pairs would take much memory and time");
  }
  else
  {
    std::ostringstream why;
    why << "all pairs may take about " << std::ceil(dense) << " s, rays " << std::ceil(sampled)
        << " s";
    this->Decide(dense <= sampled ? LinkMethod::Dense : LinkMethod::Sampled, why.str());
  }
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
