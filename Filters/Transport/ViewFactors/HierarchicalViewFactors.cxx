// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/HierarchicalViewFactors.h"

#include "Geometry/SceneRayCaster.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"
#include "ViewFactors/LinkRefinement.h"
#include "ViewFactors/Openings.h"
#include "ViewFactors/ViewFactorClosure.h"
#include "vtkTimerLog.h"

#include <utility>

namespace LightTransport
{
namespace
{
// The stages as fractions of the progress.
constexpr double RefineDone = 0.97;
// The part of the free memory that links may fill.
constexpr double MemoryForLinks = 0.8;
// And what is kept for other links, at most.
constexpr double MemoryToKeep = 0.1;

//------------------------------------------------------------------------------
Outcome Store(const PatchScene& scene, const LinkRefinement& refinement, const Ranks& ranks,
  Links& links)
{
  links.Hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  links.ClusterTree = scene.GetOrder() == PatchScene::Order::Atlas ? "Atlas" : "Spatial";
  const bool stored = links.Hierarchy->SetTree(scene.GetAreas(), refinement.GetNodes(),
                        ranks.GetMine(), ranks.GetNumber()) &&
    links.Hierarchy->SetLinks(refinement.GetLinks());
  return ranks.Agree(stored
      ? Outcome::Done()
      : Outcome::Failed(
          "The memory for the links is no longer there: raise LinkTolerance or free memory."));
}

//------------------------------------------------------------------------------
void Summarize(const PatchScene& scene, const LinkRefinement& refinement, Links& links)
{
  const LinkRefinement::Counters& count = refinement.GetCounters();
  links.Summaries = { { "PairsExamined", count.PairsExamined },
    { "PairsBackFacing", count.PairsBackFacing }, { "PairsUnobstructed", count.PairsUnobstructed },
    { "NumberOfLinks", count.Links }, { "NumberOfPatchLinks", count.PatchLinks },
    { "LinkRaysCast", count.Rays }, { "LinkError", refinement.GetErrorEstimate() },
    { "MatrixBytes", links.Hierarchy->GetNumberOfBytes() },
    { "DenseMatrixBytes", vtkExchangeMatrix::GetEstimatedBytes(scene.GetNumberOfPatches(), 1) } };
  links.RowErrors.assign(scene.GetNumberOfPatches(),
    refinement.GetErrorEstimate() + LinkRefinement::OpenTolerance +
      ViewFactorClosure::SinglePrecision);
}
} // namespace

//------------------------------------------------------------------------------
HierarchicalViewFactors::HierarchicalViewFactors(double tolerance, std::vector<double> brightness,
  std::shared_ptr<PairLooks> looks)
  : Tolerance(tolerance), Brightness(std::move(brightness)), Looks(std::move(looks))
{
}

//------------------------------------------------------------------------------
LinkKey HierarchicalViewFactors::GetKey() const
{
  LinkKey key{ "HierarchicalViewFactors", { this->Tolerance }, {} };
  key.Parameters.insert(key.Parameters.end(), this->Brightness.begin(), this->Brightness.end());
  return key;
}

//------------------------------------------------------------------------------
Outcome HierarchicalViewFactors::Build(const PatchScene& scene, const Ranks& ranks,
  const Monitor& monitor, Links& links) const
{
  const double begin = vtkTimerLog::GetUniversalTime();
  links.Tolerance = this->Tolerance;
  SceneRayCaster caster;
  if (Outcome ready = ranks.Agree(caster.Build(scene)); !ready)
  {
    return ready;
  }
  LinkRefinement refinement(scene, caster, *this->Looks);
  if (!this->Brightness.empty())
  {
    refinement.SetBrightness(this->Brightness);
  }
  const Openings openings(scene, caster);
  const bool hasOpenings = openings.Exist();
  refinement.SetHasOpenings(hasOpenings);
  const double available = MemoryForLinks * TransportMemory::GetAvailableBytes();
  Outcome outcome =
    refinement.Refine(this->Tolerance, available, ranks, monitor.GetStage(0.0, RefineDone));
  if (!outcome || this->Looks->GetNumberOfBytes() > MemoryToKeep * available)
  {
    this->Looks->Clear();
  }
  outcome = outcome ? Store(scene, refinement, ranks, links) : outcome;
  if (!outcome)
  {
    return outcome;
  }
  Summarize(scene, refinement, links);
  outcome = links.SumRows(ranks);
  if (!outcome)
  {
    return outcome;
  }
  if (hasOpenings)
  {
    openings.CompleteClusters(this->Tolerance, refinement.GetRowDeviation(), ranks, links);
  }
  else
  {
    Openings::Skip(std::vector<double>(links.RowSums.size(),
                     Openings::Confidence * refinement.GetRowDeviation()),
      links);
  }
  if (Outcome closed = ViewFactorClosure::ScaleHierarchy(links, {}, ranks); !closed)
  {
    return closed;
  }
  // No other weights than those of the closed rows are ever in use.
  links.RawRowSums = links.RowSums;
  links.Summaries.emplace_back("ViewFactorSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return monitor.Check(1.0);
}
} // namespace LightTransport
