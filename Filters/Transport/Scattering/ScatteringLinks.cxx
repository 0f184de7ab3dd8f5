// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringLinks.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Scattering/AirGaps.h"
#include "Scattering/ScatteringAssembly.h"
#include "Scattering/ScatteringModels.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace LightTransport
{
namespace
{
// An estimate of the links' error that exceeds their tolerance by more than this is warned of.
constexpr double MostExcess = 2.0;
// In millimetres: single precision holds no squares of more, or of less than its inverse.
constexpr double LargestSize = 1e15;

//------------------------------------------------------------------------------
// What came of all ranks' parts.
void Summarize(ScatteringAssembly::Summary& summary, const Ranks& ranks, double tolerance,
  Links& links)
{
  double counts[2] = { static_cast<double>(summary.Links), static_cast<double>(summary.LeftOut) };
  ranks.Sum(counts, 2);
  ranks.Sum(summary.Errors);
  ranks.Sum(summary.ThroughAir);
  ranks.Sum(summary.ThroughAirVariances);
  links.ThroughAir = std::move(summary.ThroughAir);
  links.ThroughAirVariances = std::move(summary.ThroughAirVariances);
  links.AirSamples = std::move(summary.AirSamples);
  const std::vector<double>& areas = links.Matrix->GetAreas();
  double bound = 0.0;
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    bound = std::max(bound, summary.Errors[patch] / areas[patch]);
  }
  if (bound > MostExcess * tolerance)
  {
    std::ostringstream text;
    text << "The links may be wrong by " << bound
         << " of the profile's total, more than twice LinkTolerance: the patches are many mean "
            "free paths wide. Use smaller patches, or check MillimetersPerUnit.";
    links.Warning = text.str();
  }
  links.Summaries = { { "NumberOfLinks", counts[0] }, { "LinksLeftOut", counts[1] },
    { "LinkErrorBound", bound } };
}

//------------------------------------------------------------------------------
Outcome FailForSize(double size)
{
  std::ostringstream text;
  text << "The surface is " << size << " mm from end to end, which must be between "
       << 1.0 / LargestSize << " and " << LargestSize << ": check MillimetersPerUnit.";
  return Outcome::Failed(text.str());
}
} // namespace

//------------------------------------------------------------------------------
ScatteringLinks::ScatteringLinks(int model, const ScatteringOptions& options,
  std::vector<ScatteringMedium> bands, double millimetersPerUnit, double tolerance,
  bool dropsThroughAir)
  : Model(model), Options(options), Bands(std::move(bands)), MillimetersPerUnit(millimetersPerUnit),
    Tolerance(tolerance), DropsThroughAir(dropsThroughAir)
{
}

//------------------------------------------------------------------------------
LinkKey ScatteringLinks::GetKey() const
{
  LinkKey key{ "ScatteringLinks",
    { static_cast<double>(this->Model), static_cast<double>(this->Options.BurleyFit),
      static_cast<double>(this->Options.NumberOfPhotons), static_cast<double>(this->Options.Seed),
      this->MillimetersPerUnit, this->Tolerance, this->DropsThroughAir ? 1.0 : 0.0 },
    {} };
  for (const ScatteringMedium& band : this->Bands)
  {
    key.Parameters.insert(key.Parameters.end(),
      { band.Scattering, band.Absorption, band.RefractiveIndex, band.Anisotropy });
  }
  return key;
}

//------------------------------------------------------------------------------
Outcome ScatteringLinks::Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
  Links& links) const
{
  const double begin = vtkTimerLog::GetUniversalTime();
  const double scale = scene.GetScale() * this->MillimetersPerUnit;
  if (!(scale >= 1.0 / LargestSize) || !(scale <= LargestSize))
  {
    return FailForSize(scale);
  }
  std::vector<double> areas = scene.GetAreas();
  for (double& area : areas)
  {
    area *= scale * scale;
  }
  links.Tolerance = this->Tolerance;
  links.AreThroughAirDropped = this->DropsThroughAir;
  ScatteringProfiles profiles;
  ScatteringAssembly::Summary summary;
  Outcome built =
    LinkOperators::AllocateMatrix(areas, static_cast<int>(this->Bands.size()), ranks, links.Matrix);
  built = built ? ScatteringModels::MakeProfiles(this->Model, this->Options, this->Bands, profiles)
                : built;
  AirGaps gaps;
  built = built ? ranks.Agree(gaps.Build(scene)) : built;
  built = built ? ScatteringAssembly::Fill(scene, scale, profiles, this->Tolerance,
                    { gaps, this->DropsThroughAir }, links.Matrix, monitor, summary)
                : built;
  if (!built)
  {
    return built;
  }
  for (const auto& profile : profiles)
  {
    links.ProfileTotals.push_back(profile->GetTotal());
    links.ProfileErrors.push_back(profile->GetError());
  }
  Summarize(summary, ranks, this->Tolerance, links);
  links.Summaries.emplace_back("LinkSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return built;
}
} // namespace LightTransport
