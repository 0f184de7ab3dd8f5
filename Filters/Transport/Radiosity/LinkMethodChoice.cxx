// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/LinkMethodChoice.h"

namespace LightTransport
{
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
