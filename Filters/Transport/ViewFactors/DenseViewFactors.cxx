// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/DenseViewFactors.h"

#include "Geometry/SceneRayCaster.h"
#include "Links/LinkOperators.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/Openings.h"
#include "ViewFactors/ViewFactorAssembly.h"
#include "ViewFactors/ViewFactorClosure.h"
#include "vtkNew.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
namespace
{
// Work between two looks at progress and abort: units of 64 x 64 pairs, and partly visible pairs.
constexpr vtkIdType UnitsPerBatch = 32;
constexpr vtkIdType PairsPerBatch = 1024;
// The stages as fractions of the progress.
constexpr double LookDone = 0.6;
constexpr double RefineDone = 0.97;

//------------------------------------------------------------------------------
// Does the work [0, mine) in batches. All ranks count the batches of the one with the most work:
// progress is a collective call.
template <typename Work>
Outcome RunBatches(vtkIdType mine, vtkIdType batch, const Ranks& ranks, const Monitor& monitor,
  Work&& work)
{
  const vtkIdType most = ranks.GetLargest(mine);
  for (vtkIdType first = 0; first < most; first += batch)
  {
    if (!monitor.Report(static_cast<double>(first) / static_cast<double>(most)))
    {
      return Outcome::Aborted();
    }
    if (first < mine)
    {
      work(first, std::min(first + batch, mine));
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome RunStages(vtkExchangeMatrix* matrix, const Ranks& ranks, const Monitor& monitor,
  ViewFactorAssembly& assembly)
{
  bool hasMemory = true;
  Outcome looked =
    RunBatches(assembly.GetNumberOfUnits(), UnitsPerBatch, ranks, monitor.GetStage(0.0, LookDone),
      [&](vtkIdType begin, vtkIdType end)
      { hasMemory = hasMemory && assembly.Look(matrix, begin, end); });
  if (!looked)
  {
    return looked;
  }
  const Outcome stored = hasMemory
    ? Outcome::Done()
    : Outcome::Failed("The memory for the view factors is no longer there: use fewer patches or "
                      "free memory.");
  if (Outcome agreed = ranks.Agree(stored); !agreed)
  {
    return agreed;
  }
  assembly.PrepareRefinement(ranks);
  return RunBatches(assembly.GetNumberOfPairs(), PairsPerBatch, ranks,
    monitor.GetStage(LookDone, RefineDone),
    [&](vtkIdType begin, vtkIdType end) { assembly.Refine(matrix, begin, end); });
}

//------------------------------------------------------------------------------
Outcome Assemble(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
  ViewFactorAssembly& assembly, vtkSmartPointer<vtkExchangeMatrix>& matrix)
{
  vtkNew<vtkExchangeMatrix> structure;
  structure->AllocateSparse(scene.GetAreas(), 1, ranks.GetMine(), ranks.GetNumber());
  Outcome allocated =
    LinkOperators::AllocateSparseMatrix(scene.GetAreas(), assembly.Plan(*structure), ranks, matrix);
  return allocated ? RunStages(matrix, ranks, monitor, assembly) : allocated;
}

//------------------------------------------------------------------------------
// Errors of rows and counters, over all ranks.
void Summarize(const ViewFactorAssembly& assembly, const Ranks& ranks, Links& links)
{
  const ViewFactorAssembly::Counters& count = assembly.GetCounters();
  links.Summaries = { { "PairsExamined", count.Open.Examined },
    { "PairsBackFacing", count.Open.BackFacing }, { "PairsNotSending", count.NotSending },
    { "PairsFacing", count.Open.Facing }, { "PairsUnobstructed", count.Free },
    { "PairsHidden", count.Hidden }, { "PairsPartlyVisible", count.PartlyVisible },
    { "PairsLookedAt", count.Rastered }, { "MatrixBytes", links.Matrix->GetNumberOfBytes() } };
  std::vector<double> totals;
  for (const auto& summary : links.Summaries)
  {
    totals.push_back(summary.second);
  }
  ranks.Sum(totals);
  for (std::size_t k = 0; k < totals.size(); ++k)
  {
    links.Summaries[k].second = totals[k];
  }
  links.RowErrors = assembly.GetRowErrors(ranks);
  const std::vector<double>& areas = links.Matrix->GetAreas();
  for (std::size_t row = 0; row < areas.size(); ++row)
  {
    links.RowErrors[row] =
      links.RowErrors[row] / areas[row] + ViewFactorClosure::SinglePrecision * links.RowSums[row];
  }
  links.Summaries.emplace_back("DenseMatrixBytes",
    vtkExchangeMatrix::GetEstimatedBytes(links.Matrix->GetNumberOfPatches(), 1));
}

//------------------------------------------------------------------------------
// `errors` are those of what is open in each row.
Outcome FindOpenings(const PatchScene& scene, const Ranks& ranks, Links& links,
  std::vector<double>& errors)
{
  bool isOpen = !links.AreRowsWhole;
  for (std::size_t row = 0; row < links.RowSums.size(); ++row)
  {
    isOpen = isOpen || 1.0 - links.RowSums[row] > links.RowErrors[row];
  }
  if (!isOpen)
  {
    Openings::Skip(links.RowErrors, links);
    return Outcome::Done();
  }
  SceneRayCaster caster;
  Outcome ready = ranks.Agree(caster.Build(scene));
  if (ready && links.AreRowsWhole)
  {
    errors = Openings(scene, caster).Complete(links.Tolerance, ranks, links);
  }
  else if (ready)
  {
    Openings(scene, caster).Survey(ranks, links);
  }
  return ready;
}
} // namespace

//------------------------------------------------------------------------------
DenseViewFactors::DenseViewFactors(double tolerance, bool enforceClosure, std::vector<bool> senders)
  : Tolerance(tolerance), EnforceClosure(enforceClosure), Senders(std::move(senders))
{
}

//------------------------------------------------------------------------------
Outcome DenseViewFactors::FillRows(const PatchScene& scene, double tolerance,
  const std::vector<bool>& patches, const Ranks& ranks, const Monitor& monitor,
  vtkSmartPointer<vtkExchangeMatrix>& matrix)
{
  ViewFactorAssembly assembly(scene, tolerance, &patches);
  return Assemble(scene, ranks, monitor, assembly, matrix);
}

//------------------------------------------------------------------------------
LinkKey DenseViewFactors::GetKey() const
{
  return { "DenseViewFactors", { this->Tolerance, this->EnforceClosure ? 1.0 : 0.0 },
    this->Senders };
}

//------------------------------------------------------------------------------
Outcome DenseViewFactors::Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
  Links& links) const
{
  const double begin = vtkTimerLog::GetUniversalTime();
  links.Tolerance = this->Tolerance;
  ViewFactorAssembly assembly(scene, this->Tolerance,
    this->Senders.empty() ? nullptr : &this->Senders);
  Outcome outcome = Assemble(scene, ranks, monitor, assembly, links.Matrix);
  outcome = outcome ? links.SumRows(ranks) : outcome;
  if (!outcome)
  {
    return outcome;
  }
  links.RawRowSums = links.RowSums;
  Summarize(assembly, ranks, links);
  std::vector<double> openingErrors(links.RowSums.size(), 0.0);
  // Where pairs have been left out no row is whole: what it misses says nothing.
  links.AreRowsWhole = this->Senders.empty();
  outcome = FindOpenings(scene, ranks, links, openingErrors);
  outcome = outcome && this->EnforceClosure
    ? ViewFactorClosure::CloseMatrix(links, assembly.GetPairs(), openingErrors, this->Tolerance,
        ranks)
    : outcome;
  if (!outcome)
  {
    return outcome;
  }
  links.Summaries.emplace_back("ViewFactorSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return monitor.Check(1.0);
}
} // namespace LightTransport
