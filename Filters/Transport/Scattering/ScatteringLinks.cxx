// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringLinks.h"

#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Scattering/AirGaps.h"
#include "Scattering/RefinementOnDevice.h"
#include "Scattering/ScatteringAssembly.h"
#include "Scattering/ScatteringClusters.h"
#include "Scattering/ScatteringIntegrals.h"
#include "Scattering/ScatteringModels.h"
#include "Scattering/ScatteringPatches.h"
#include "Scattering/ScatteringRefinement.h"
#include "Scattering/ScatteringRows.h"
#include "Scene/PatchScene.h"
#include "Shared/BitHash.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"
#include "vtkSubsurfaceScattering.h"
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
// Where no tolerance is given, for links between all patches and for others.
constexpr double DenseTolerance = 1e-4;
constexpr double ClusterTolerance = 1e-2;
/// Above the longest distance in the scene, whose bounding box has diagonal 1.
constexpr double RoundingMargin = 1.01;
///@{ Of the tolerance of links between clusters, what their values may be wrong by: in proportion
/// to themselves, to areas, and to neighbours (in a triangle mesh there are about 40).
constexpr double ShareOfValues = 0.3;
constexpr double ShareOfAreas = 0.1;
constexpr double ShareOfNeighbours = 0.3 / 40.0;
///@}
/// Of these, where clusters are chosen for one light: errors of links are then near the tolerance
/// themselves, and those of values come on top.
constexpr double ShareWhereLit = 1.0 / 3.0;
/// Pairs of patches that take as long as a link from a cluster, about.
constexpr double PairsPerLink = 20.0;

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
/// What ways to links have in common.
struct ScatteringLinks::Task
{
  const PatchScene& Scene;
  double Scale; ///< of the scene's unit in millimetres
  const Ranks& AllRanks;
  const Monitor& Watch;
  Links& Result;
  std::vector<double> Areas; ///< in mm^2
  ScatteringProfiles Profiles;
};

//------------------------------------------------------------------------------
ScatteringLinks::ScatteringLinks(int model, const ScatteringOptions& options,
  std::vector<ScatteringMedium> bands, double millimetersPerUnit,
  const ScatteringLinkChoice& choice)
  : Model(model), Options(options), Bands(std::move(bands)), MillimetersPerUnit(millimetersPerUnit),
    Choice(choice)
{
}

//------------------------------------------------------------------------------
// What does not matter to links of this method is 0.
LinkKey ScatteringLinks::GetKey() const
{
  const bool isDense = this->IsOfAllPairs();
  const bool isCounted =
    !isDense && this->Choice.Method != vtkSubsurfaceScattering::LINK_METHOD_AUTO;
  const bool isCoded = !isDense && this->Choice.AreCompressed;
  BitHash light;
  for (const double value : this->Choice.Light)
  {
    light.AddNumber(value);
  }
  LinkKey key{ "ScatteringLinks",
    { static_cast<double>(this->Model), static_cast<double>(this->Options.BurleyFit),
      static_cast<double>(this->Options.NumberOfPhotons), static_cast<double>(this->Options.Seed),
      this->MillimetersPerUnit, static_cast<double>(this->Choice.Method),
      isCounted ? static_cast<double>(this->Choice.Number) : 0.0, this->Choice.Tolerance,
      this->Choice.DropsThroughAir ? 1.0 : 0.0, isCoded ? 1.0 : 0.0,
      isCoded ? this->Choice.CompressionTolerance : 0.0,
      this->Choice.IsKept && !isDense ? 1.0 : 0.0, static_cast<double>(this->Choice.Light.size()),
      static_cast<double>(light.Get() >> 32), static_cast<double>(light.Get() & 0xffffffffu) },
    {} };
  for (const ScatteringMedium& band : this->Bands)
  {
    key.Parameters.insert(key.Parameters.end(),
      { band.Scattering, band.Absorption, band.RefractiveIndex, band.Anisotropy });
  }
  return key;
}

//------------------------------------------------------------------------------
// What goes through the air is dropped pair by pair.
bool ScatteringLinks::IsOfAllPairs() const
{
  return this->Choice.Method == vtkSubsurfaceScattering::LINK_METHOD_DENSE ||
    this->Choice.DropsThroughAir;
}

//------------------------------------------------------------------------------
double ScatteringLinks::GetTolerance(bool isDense) const
{
  const double own = isDense ? DenseTolerance : ClusterTolerance;
  return this->Choice.Tolerance > 0.0 ? this->Choice.Tolerance : own;
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
  Task task{ scene, scale, ranks, monitor, links, scene.GetAreas(), {} };
  for (double& area : task.Areas)
  {
    area *= scale * scale;
  }
  ScatteringOptions options = this->Options;
  options.AllRanks = ranks;
  Outcome built = ScatteringModels::MakeProfiles(this->Model, options, this->Bands, task.Profiles);
  if (built)
  {
    built = this->IsOfAllPairs() ? this->LinkPatches(task) : this->LinkClusters(task);
  }
  if (!built || !links.GetExchange())
  {
    return built;
  }
  for (const auto& profile : task.Profiles)
  {
    links.ProfileTotals.push_back(profile->GetTotal());
    links.ProfileErrors.push_back(profile->GetError());
  }
  links.Summaries.emplace_back("LinkBytes", links.GetExchange()->GetNumberOfBytes());
  links.Summaries.emplace_back("LinkSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return built;
}

//------------------------------------------------------------------------------
Outcome ScatteringLinks::LinkPatches(Task& task) const
{
  Links& links = task.Result;
  links.Tolerance = this->GetTolerance(true);
  links.AreThroughAirDropped = this->Choice.DropsThroughAir;
  ScatteringAssembly::Summary summary;
  Outcome built = LinkOperators::AllocateMatrix(task.Areas, static_cast<int>(this->Bands.size()),
    "set LinkMethod to Adaptive, or ", task.AllRanks, links.Matrix);
  AirGaps gaps;
  built = built ? task.AllRanks.Agree(gaps.Build(task.Scene)) : built;
  built = built ? ScatteringAssembly::Fill(task.Scene, task.Scale, task.Profiles, links.Tolerance,
                    { gaps, this->Choice.DropsThroughAir }, links.Matrix, task.Watch, summary)
                : built;
  if (!built)
  {
    return built;
  }
  double counts[2] = { static_cast<double>(summary.Links), static_cast<double>(summary.LeftOut) };
  task.AllRanks.Sum(counts, 2);
  task.AllRanks.Sum(summary.Errors);
  summary.ThroughAir.SumUp(task.AllRanks);
  links.ThroughAir = std::move(summary.ThroughAir);
  double bound = 0.0;
  for (std::size_t patch = 0; patch < task.Areas.size(); ++patch)
  {
    bound = std::max(bound, summary.Errors[patch] / task.Areas[patch]);
  }
  if (bound > MostExcess * links.Tolerance)
  {
    std::ostringstream text;
    text << "The links may be wrong by " << bound
         << " of the profile's total, more than twice LinkTolerance: the patches are many mean "
            "free paths wide. Use smaller patches, or check MillimetersPerUnit.";
    links.Warning = text.str();
  }
  links.Summaries = { { "NumberOfLinks", counts[0] }, { "LinksLeftOut", counts[1] },
    { "LinkErrorBound", bound },
    { "LinksPerReceiver", 2.0 * counts[0] / static_cast<double>(task.Areas.size()) + 1.0 } };
  links.Remarks.emplace_back("LinkMethodUsed", "Dense");
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome ScatteringLinks::LinkClusters(Task& task) const
{
  const bool isUniform = this->Choice.Method == vtkSubsurfaceScattering::LINK_METHOD_UNIFORM;
  const bool isAuto = this->Choice.Method == vtkSubsurfaceScattering::LINK_METHOD_AUTO;
  Links& links = task.Result;
  links.Tolerance = this->GetTolerance(false);
  const ScatteringPatches patches(task.Scene, task.Scale);
  const double ofValues = links.Tolerance * (this->Choice.Light.empty() ? 1.0 : ShareWhereLit);
  const ScatteringIntegrals integrals(task.Profiles, RoundingMargin * task.Scale,
    ShareOfValues * ofValues);
  const double reference = integrals.GetLargestShare(patches.TotalArea);
  const double allowed = ofValues * reference;
  const ScatteringClusters::Tolerances factors{ ShareOfValues * ofValues,
    ShareOfAreas * allowed / patches.TotalArea, ShareOfNeighbours * allowed };
  const ScatteringClusters clusters(task.Scene, patches, integrals, factors);
  ScatteringRefinement refinement(clusters, task.Areas, this->Choice.Light, reference,
    factors.PerArea);
  const double most = isAuto ? 0.0 : this->Choice.Number;
  if (links.Choice)
  {
    const bool holds = isUniform
      ? refinement.KeepUniform(this->Choice.Number, *links.Choice, task.AllRanks)
      : refinement.KeepAdaptive(most, *links.Choice, task.AllRanks);
    return holds ? this->FillRows(task, clusters, refinement) : Outcome::Done();
  }
  if (isUniform)
  {
    refinement.ChooseUniform(this->Choice.Number, links.Tolerance);
  }
  else
  {
    refinement.ChooseAdaptive(links.Tolerance, most);
  }
  if (isAuto && !this->Choice.AreCompressed && this->IsDense(task, refinement))
  {
    return this->LinkPatches(task);
  }
  if (this->Choice.IsKept)
  {
    links.Choice = std::make_shared<LinkChoice>(refinement.GetChoice());
    links.Choice->Arrangement = task.Scene.GetArrangement();
  }
  return this->FillRows(task, clusters, refinement);
}

//------------------------------------------------------------------------------
Outcome ScatteringLinks::FillRows(Task& task, const ScatteringClusters& clusters,
  const ScatteringRefinement& refinement) const
{
  Links& links = task.Result;
  const int kernels = static_cast<int>(this->Bands.size());
  Outcome built = LinkOperators::CheckRows(static_cast<double>(task.Areas.size()) *
      refinement.GetProspect().Links,
    kernels, task.AllRanks);
  if (!built)
  {
    return built;
  }
  links.Hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  links.ClusterTree = task.Scene.GetOrder() == PatchScene::Order::Atlas ? "Atlas" : "Surface";
  links.Hierarchy->SetTree(task.Areas, clusters.GetSlots().GetNodes(), task.AllRanks.GetMine(),
    task.AllRanks.GetNumber(), kernels);
  ScatteringRows::Summary summary;
  built = this->ChooseRows(task, clusters, refinement, summary);
  if (!built)
  {
    return built;
  }
  summary.ThroughAir.SumUp(task.AllRanks);
  links.ThroughAir = std::move(summary.ThroughAir);
  this->Summarize(task, refinement, summary);
  if (this->Choice.AreCompressed)
  {
    links.Summaries.emplace_back("CompressionError",
      links.Hierarchy->CompressRows(this->Choice.CompressionTolerance,
        task.AllRanks.GetController()));
  }
  return built;
}

//------------------------------------------------------------------------------
// Auto comes back to the CPU where the device cannot. It knows no light.
Outcome ScatteringLinks::ChooseRows(Task& task, const ScatteringClusters& clusters,
  const ScatteringRefinement& refinement, ScatteringRows::Summary& summary) const
{
  AirGaps gaps;
  vtkSmartPointer<vtkDeviceLinkRefiner> refiner;
  Outcome chosen = task.AllRanks.Agree(gaps.Build(task.Scene));
  // Those that are kept have been chosen.
  const bool isLit = !this->Choice.Light.empty();
  if (chosen && !refinement.IsKept() && !isLit)
  {
    chosen = LinkOperators::FindRefiner(this->Choice.Device, task.AllRanks, refiner);
  }
  const auto fill = [&](RefinementOnDevice* device)
  {
    const ScatteringRows rows(refinement, task.Profiles, gaps);
    return task.AllRanks.Agree(
      rows.Fill(task.AllRanks, task.Watch, device, task.Result.Hierarchy, summary));
  };
  std::string where = "CPU";
  where += refinement.IsKept() ? ": links of an earlier position are kept" : "";
  where += isLit ? ": for the light that is given" : "";
  if (chosen && refiner)
  {
    RefinementOnDevice device(refiner, clusters);
    chosen = fill(&device);
    if (!device.HasFailed() || this->Choice.Device == LinkDevice::OpenGL)
    {
      task.Result.Remarks.emplace_back("LinksChosenOn", refiner->GetDeviceName());
      return chosen;
    }
    where = "CPU: " + chosen.GetMessage();
    chosen = Outcome::Done();
  }
  task.Result.Remarks.emplace_back("LinksChosenOn", where);
  return chosen ? fill(nullptr) : chosen;
}

//------------------------------------------------------------------------------
void ScatteringLinks::Summarize(Task& task, const ScatteringRefinement& refinement,
  const ScatteringRows::Summary& summary) const
{
  task.Result.Summaries = { { "NumberOfLinks", summary.Links }, { "LinksLeftOut", summary.LeftOut },
    { "LinkError", refinement.GetProspect().Error },
    { "LinksPerReceiver", summary.Links / static_cast<double>(task.Areas.size()) } };
  task.Result.ReusedShare = summary.Links > 0.0 ? summary.Reused / summary.Links : 0.0;
  const bool isUniform = this->Choice.Method == vtkSubsurfaceScattering::LINK_METHOD_UNIFORM;
  task.Result.Remarks.emplace_back("LinkMethodUsed", isUniform ? "Uniform" : "Adaptive");
  task.Result.Remarks.emplace_back("LinksLimitedBy",
    refinement.IsLimited() ? "NumberOfLinks" : "LinkTolerance");
}

//------------------------------------------------------------------------------
// The same on all ranks, whatever memory each has.
bool ScatteringLinks::IsDense(const Task& task, const ScatteringRefinement& refinement) const
{
  const auto patches = static_cast<double>(task.Areas.size());
  const double bytes =
    vtkExchangeMatrix::GetEstimatedBytes(static_cast<vtkIdType>(task.Areas.size()),
      static_cast<int>(this->Bands.size()), task.AllRanks.GetNumber());
  const bool isCheaper = patches <= PairsPerLink * refinement.GetProspect().Links &&
    bytes < TransportMemory::GetAvailableBytes();
  return task.AllRanks.GetLargest(isCheaper ? 0 : 1) == 0;
}
} // namespace LightTransport
