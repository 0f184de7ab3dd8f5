// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkViewFactors.h"

#include "Geometry/PatchSampler.h"
#include "Geometry/SceneRayCaster.h"
#include "Links/LinkRefinement.h"
#include "Scene/PatchScene.h"
#include "Shared/Threads.h"
#include "Support/TransportMemory.h"
#include "ViewFactors/PolygonExchange.h"
#include "ViewFactors/ViewFactorAssembly.h"
#include "ViewFactors/ViewFactorClosure.h"
#include "ViewFactors/ViewFactorGroups.h"
#include "ViewFactors/ViewFactorsFile.h"
#include "ViewFactors/ViewFactorsResult.h"
#include "vtkCPULinkOperator.h"
#include "vtkCommunicator.h"
#include "vtkDataObject.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <numeric>

using namespace LightTransport;

vtkStandardNewMacro(vtkViewFactors);

namespace
{
// Rays per patch that tell sky from back faces; more where none of them finds either.
constexpr int OpeningRays = 128;
constexpr int MostOpeningRays = 4096;
// Rays per patch that sees an opening where nothing else tells how large it is.
constexpr int SamplingRays = 512;
// Patches that tell whether a scene has openings at all.
constexpr vtkIdType PatchesThatLook = 2000;
// Work between two looks at progress and abort: units of 64 x 64 pairs, and partly visible pairs.
constexpr vtkIdType UnitsPerBatch = 32;
constexpr vtkIdType PairsPerBatch = 1024;
// The stages as fractions of the progress.
constexpr double LookDone = 0.6;
constexpr double RefineDone = 0.97;
// The part of the free memory that links may fill.
constexpr double MemoryForLinks = 0.8;
// Relative error of an entry by storing it in single precision.
constexpr double SinglePrecision = 6e-8;
} // namespace

namespace
{
//------------------------------------------------------------------------------
// The rays of a patch that meet no front.
class Lookout
{
public:
  Lookout(const PatchScene& scene, const SceneRayCaster& caster, vtkIdType patch)
    : Caster(caster), Patch(patch), Sampler(static_cast<std::uint64_t>(patch))
  {
    PolygonExchange::MakePolygon(scene, patch, this->Polygon);
  }

  void Cast(int ray)
  {
    bool front = false;
    const vtkIdType hit = this->Caster.FindHit(this->Sampler.GetPoint(this->Polygon, ray, 0),
      this->Sampler.GetDirection(this->Polygon.Normal, ray, 2), this->Patch, front);
    this->Sky += hit < 0 ? 1 : 0;
    this->Back += hit >= 0 && !front ? 1 : 0;
  }

  int Sky = 0;
  int Back = 0;

private:
  const SceneRayCaster& Caster;
  vtkIdType Patch;
  PatchSampler Sampler;
  PolygonExchange::Polygon Polygon;
};

//------------------------------------------------------------------------------
// Whether any of many rays from all over the scene meets no front.
bool HasOpenings(const PatchScene& scene, const SceneRayCaster& caster)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  const vtkIdType step = std::max<vtkIdType>(patches / PatchesThatLook, 1);
  for (vtkIdType patch = 0; patch < patches; patch += step)
  {
    Lookout lookout(scene, caster, patch);
    for (int ray = 0; ray < OpeningRays; ++ray)
    {
      lookout.Cast(ray);
    }
    if (lookout.Sky + lookout.Back > 0)
    {
      return true;
    }
  }
  return false;
}
} // namespace

//------------------------------------------------------------------------------
vtkViewFactors::vtkViewFactors() : Result(new ViewFactorsResult)
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Group");
}

//------------------------------------------------------------------------------
vtkViewFactors::~vtkViewFactors() = default;

//------------------------------------------------------------------------------
bool vtkViewFactors::UpdateExchange(const PatchScene& scene, const ProgressFunction& progress,
  const std::vector<bool>* senders)
{
  this->Patches.clear();
  if (!this->Hierarchical && scene.GetOrder() != PatchScene::Order::Spatial)
  {
    vtkErrorMacro("A matrix needs the spatial order of the scene: set ClusterTree to Spatial or "
                  "switch Hierarchical on.");
    return false;
  }
  // A closure needs whole rows, and clusters hold who sends and who does not.
  const bool all = !senders || this->EnforceClosure || this->Hierarchical ||
    std::all_of(senders->begin(), senders->end(), [](bool sends) { return sends; });
  if (!this->Provide(scene, progress, all ? nullptr : senders))
  {
    return false;
  }
  this->Patches.resize(scene.GetNumberOfPatches());
  for (std::size_t polygon = 0; polygon < this->Patches.size(); ++polygon)
  {
    this->Patches[polygon] = scene.GetPatch(static_cast<vtkIdType>(polygon));
  }
  return true;
}

//------------------------------------------------------------------------------
// From a file, from the last update, or computed.
bool vtkViewFactors::Provide(const PatchScene& scene, const ProgressFunction& progress,
  const std::vector<bool>* senders)
{
  if (!this->LoadedFile.empty())
  {
    return this->CheckLoaded(scene);
  }
  if (this->IsUpToDate(scene, senders))
  {
    return true;
  }
  *this->Result = ViewFactorsResult();
  if (!this->Compute(scene, progress, senders))
  {
    *this->Result = ViewFactorsResult();
    return false;
  }
  this->Senders = senders ? *senders : std::vector<bool>();
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::IsUpToDate(const PatchScene& scene, const std::vector<bool>* senders) const
{
  // The groups and how points are written may change without new view factors.
  const vtkExchange* exchange = this->Result->GetExchange();
  if (!exchange || this->Result->Fingerprint != scene.GetFingerprint() ||
    (this->Result->Hierarchy != nullptr) != this->Hierarchical ||
    this->Result->Tolerance != (this->Hierarchical ? this->LinkTolerance : this->Tolerance) ||
    (!this->Hierarchical && this->HasClosedRows() != this->EnforceClosure) ||
    exchange->GetNumberOfParts() != this->GetNumberOfRanks())
  {
    return false;
  }
  // Enough when everyone who sends now was known to send.
  return this->Senders.empty() ||
    (senders &&
      std::equal(senders->begin(), senders->end(), this->Senders.begin(),
        [](bool now, bool then) { return then || !now; }));
}

//------------------------------------------------------------------------------
bool vtkViewFactors::CheckLoaded(const PatchScene& scene)
{
  const bool fits = this->Result->Fingerprint == scene.GetFingerprint() &&
    this->Result->Exchange->GetNumberOfPatches() == scene.GetNumberOfPatches();
  std::string error = "The view factors in \"" + this->LoadedFile +
    "\" were computed for another geometry: give the mesh that they belong to, or compute them "
    "(Load(nullptr)) and save them again.";
  if (!PatchScene::Agree(this->Controller, fits, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Compute(const PatchScene& scene, const ProgressFunction& progress,
  const std::vector<bool>* senders)
{
  const double begin = vtkTimerLog::GetUniversalTime();
  ViewFactorsResult& result = *this->Result;
  result.Fingerprint = scene.GetFingerprint();
  if (!(this->Hierarchical ? this->ComputeLinks(scene, progress)
                           : this->ComputeMatrix(scene, progress, senders)))
  {
    return false;
  }
  result.Summaries.emplace_back("ViewFactorSeconds", vtkTimerLog::GetUniversalTime() - begin);
  return progress(1.0);
}

//------------------------------------------------------------------------------
bool vtkViewFactors::ComputeMatrix(const PatchScene& scene, const ProgressFunction& progress,
  const std::vector<bool>* senders)
{
  ViewFactorsResult& result = *this->Result;
  result.Tolerance = this->Tolerance;
  ViewFactorAssembly assembly(scene, this->Tolerance, senders);
  if (!this->Assemble(scene, progress, assembly) || !this->SumRows())
  {
    return false;
  }
  result.RawRowSums = result.RowSums;
  this->Summarize(assembly);
  // Where pairs have been left out no row is whole: what it misses says nothing.
  return this->FindOpenings(scene, senders == nullptr) &&
    (!this->EnforceClosure || this->CloseRows(assembly.GetPairs()));
}

//------------------------------------------------------------------------------
bool vtkViewFactors::ComputeLinks(const PatchScene& scene, const ProgressFunction& progress)
{
  this->Result->Tolerance = this->LinkTolerance;
  SceneRayCaster caster;
  std::string error;
  if (!PatchScene::Agree(this->Controller, caster.Build(scene, error), error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  LinkRefinement refinement(scene, caster);
  if (this->Brightness.size() == scene.GetAreas().size())
  {
    refinement.SetBrightness(this->Brightness);
  }
  const bool hasOpenings = HasOpenings(scene, caster);
  refinement.SetClosesRows(!hasOpenings);
  const double available = MemoryForLinks * TransportMemory::GetAvailableBytes();
  const LinkRefinement::Outcome outcome = refinement.Refine(this->LinkTolerance, available,
    this->Controller, [&](double done) { return progress(RefineDone * done); });
  if (outcome == LinkRefinement::NO_MEMORY)
  {
    vtkErrorMacro("The links between clusters of "
      << scene.GetNumberOfPatches() << " patches need more than the "
      << TransportMemory::Format(available)
      << " of memory that are free for them: raise LinkTolerance, use fewer patches or processes "
         "on more machines (each holds a part).");
  }
  if (outcome != LinkRefinement::DONE || !this->StoreLinks(scene, refinement))
  {
    return false;
  }
  this->ClearOpenings();
  if (hasOpenings)
  {
    this->CastForOpenings(scene, caster);
  }
  return this->CloseRows({});
}

//------------------------------------------------------------------------------
bool vtkViewFactors::StoreLinks(const PatchScene& scene, const LinkRefinement& refinement)
{
  ViewFactorsResult& result = *this->Result;
  const int ranks = this->GetNumberOfRanks();
  const int rank = ranks > 1 ? this->Controller->GetLocalProcessId() : 0;
  result.Hierarchy = vtkSmartPointer<vtkExchangeHierarchy>::New();
  result.ClusterTree = scene.GetOrder() == PatchScene::Order::Atlas ? "Atlas" : "Spatial";
  const bool stored =
    result.Hierarchy->SetTree(scene.GetAreas(), refinement.GetNodes(), rank, ranks) &&
    result.Hierarchy->SetLinks(refinement.GetLinks());
  std::string error = "The memory for the links is no longer there: raise LinkTolerance or free "
                      "memory.";
  if (!PatchScene::Agree(this->Controller, stored, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  const LinkRefinement::Counters& count = refinement.GetCounters();
  result.Summaries = { { "PairsExamined", count.PairsExamined },
    { "PairsBackFacing", count.PairsBackFacing }, { "PairsUnobstructed", count.PairsUnobstructed },
    { "NumberOfLinks", count.Links }, { "NumberOfPatchLinks", count.PatchLinks },
    { "LinkRaysCast", count.Rays }, { "LinkError", refinement.GetErrorEstimate() },
    { "MatrixBytes", result.Hierarchy->GetNumberOfBytes() },
    { "DenseMatrixBytes", vtkExchangeMatrix::GetEstimatedBytes(scene.GetNumberOfPatches(), 1) } };
  result.RowErrors.assign(scene.GetNumberOfPatches(),
    refinement.GetErrorEstimate() + LinkRefinement::OpenTolerance + SinglePrecision);
  const bool summed = this->SumRows();
  result.RawRowSums = result.RowSums;
  return summed;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Assemble(const PatchScene& scene, const ProgressFunction& progress,
  ViewFactorAssembly& assembly)
{
  vtkNew<vtkExchangeMatrix> structure;
  const int rank = this->GetNumberOfRanks() > 1 ? this->Controller->GetLocalProcessId() : 0;
  structure->AllocateSparse(scene.GetAreas(), 1, rank, this->GetNumberOfRanks());
  this->Result->Exchange = this->MakeSparseExchange(scene.GetAreas(), assembly.Plan(*structure));
  return this->Result->Exchange && this->RunStages(progress, assembly);
}

//------------------------------------------------------------------------------
vtkIdType vtkViewFactors::GetMostOfAllRanks(vtkIdType count) const
{
  vtkIdType most = count;
  if (this->GetNumberOfRanks() > 1)
  {
    this->Controller->AllReduce(&count, &most, 1, vtkCommunicator::MAX_OP);
  }
  return most;
}

//------------------------------------------------------------------------------
// All ranks count the batches of the one with the most work: progress is a collective call.
bool vtkViewFactors::RunStages(const ProgressFunction& progress, ViewFactorAssembly& assembly)
{
  vtkExchangeMatrix* exchange = this->Result->Exchange;
  const auto run = [&](vtkIdType mine, vtkIdType batch, double from, double to, auto&& work)
  {
    const vtkIdType most = this->GetMostOfAllRanks(mine);
    for (vtkIdType first = 0; first < most; first += batch)
    {
      if (!progress(from + (to - from) * static_cast<double>(first) / static_cast<double>(most)))
      {
        return false;
      }
      if (first < mine)
      {
        work(first, std::min(first + batch, mine));
      }
    }
    return true;
  };
  bool ok = true;
  const auto look = [&](vtkIdType begin, vtkIdType end)
  { ok = ok && assembly.Look(exchange, begin, end); };
  if (!run(assembly.GetNumberOfUnits(), UnitsPerBatch, 0.0, LookDone, look))
  {
    return false;
  }
  std::string error = "The memory for the view factors is no longer there: use fewer patches or "
                      "free memory.";
  if (!PatchScene::Agree(this->Controller, ok, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  assembly.PrepareRefinement(this->Controller);
  const auto refine = [&](vtkIdType begin, vtkIdType end)
  { assembly.Refine(exchange, begin, end); };
  return run(assembly.GetNumberOfPairs(), PairsPerBatch, LookDone, RefineDone, refine);
}

//------------------------------------------------------------------------------
// Errors of rows and counters, over all ranks.
void vtkViewFactors::Summarize(const ViewFactorAssembly& assembly)
{
  ViewFactorsResult& result = *this->Result;
  const ViewFactorAssembly::Counters& count = assembly.GetCounters();
  const std::vector<std::pair<std::string, double>> summaries = { { "PairsExamined",
                                                                    count.Open.Examined },
    { "PairsBackFacing", count.Open.BackFacing }, { "PairsNotSending", count.NotSending },
    { "PairsFacing", count.Open.Facing }, { "PairsUnobstructed", count.Free },
    { "PairsHidden", count.Hidden }, { "PairsPartlyVisible", count.PartlyVisible },
    { "MatrixBytes", result.Exchange->GetNumberOfBytes() } };
  std::vector<double> totals = assembly.GetRowErrors();
  for (const auto& summary : summaries)
  {
    totals.push_back(summary.second);
  }
  if (this->GetNumberOfRanks() > 1)
  {
    const std::vector<double> mine = totals;
    this->Controller->AllReduce(mine.data(), totals.data(), static_cast<vtkIdType>(mine.size()),
      vtkCommunicator::SUM_OP);
  }
  const std::vector<double>& areas = result.Exchange->GetAreas();
  result.RowErrors.resize(areas.size());
  for (std::size_t row = 0; row < areas.size(); ++row)
  {
    result.RowErrors[row] = totals[row] / areas[row] + SinglePrecision * result.RowSums[row];
  }
  result.Summaries.clear();
  for (std::size_t k = 0; k < summaries.size(); ++k)
  {
    result.Summaries.emplace_back(summaries[k].first, totals[areas.size() + k]);
  }
  result.Summaries.emplace_back("DenseMatrixBytes",
    vtkExchangeMatrix::GetEstimatedBytes(result.Exchange->GetNumberOfPatches(), 1));
}

//------------------------------------------------------------------------------
bool vtkViewFactors::SumRows()
{
  ViewFactorsResult& result = *this->Result;
  const std::vector<double>& areas = result.GetExchange()->GetAreas();
  const std::vector<double> ones(areas.size(), 1.0);
  result.RowSums.resize(areas.size());
  auto links = this->MakeCPULinkOperator(result.GetExchange(), 1);
  if (!links || !links->SetVector(0, ones.data()) || !links->Multiply(1, 0) ||
    !links->GetVector(1, result.RowSums.data()))
  {
    return false;
  }
  std::transform(result.RowSums.begin(), result.RowSums.end(), areas.begin(),
    result.RowSums.begin(), std::divides<double>());
  return true;
}

namespace
{
//------------------------------------------------------------------------------
// Where the rays of a patch go that meet no front: into the sky or onto back faces. A row that
// misses no more than its error misses nothing.
struct Openings
{
  const PatchScene& Scene;
  const SceneRayCaster& Caster;
  ViewFactorsResult& Result;
  std::vector<int>& Rays; ///< of each patch

  void operator()(vtkIdType begin, vtkIdType end) const
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      const bool samples = this->Result.Hierarchy != nullptr;
      const double missing = 1.0 - this->Result.RowSums[patch];
      if (!samples && missing <= this->Result.RowErrors[patch])
      {
        continue;
      }
      Lookout lookout(this->Scene, this->Caster, patch);
      const int& sky = lookout.Sky;
      const int& back = lookout.Back;
      int ray = 0;
      for (; ray < OpeningRays ||
           (samples ? sky + back > 0 && ray < SamplingRays
                    : sky + back == 0 && ray < MostOpeningRays);
           ++ray)
      {
        lookout.Cast(ray);
      }
      this->Rays[patch] = ray;
      // How much is missing the row sum of a matrix knows better than rays, and that of links
      // between clusters worse.
      const double open = samples ? static_cast<double>(sky + back) / ray : missing;
      if (sky + back > 0)
      {
        this->Result.SkyFractions[patch] = open * sky / (sky + back);
        this->Result.BackFaceFractions[patch] = open * back / (sky + back);
      }
    }
  }
};
} // namespace

//------------------------------------------------------------------------------
void vtkViewFactors::ClearOpenings()
{
  ViewFactorsResult& result = *this->Result;
  result.SkyFractions.assign(result.RowSums.size(), 0.0);
  result.BackFaceFractions.assign(result.RowSums.size(), 0.0);
}

//------------------------------------------------------------------------------
bool vtkViewFactors::FindOpenings(const PatchScene& scene, bool areRowsWhole)
{
  const ViewFactorsResult& result = *this->Result;
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->ClearOpenings();
  if (!areRowsWhole)
  {
    return true;
  }
  bool isOpen = false;
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    isOpen = isOpen || 1.0 - result.RowSums[patch] > result.RowErrors[patch];
  }
  SceneRayCaster caster;
  std::string error;
  const bool ready = !isOpen || caster.Build(scene, error);
  if (!PatchScene::Agree(this->Controller, ready, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  this->CastForOpenings(scene, caster);
  return true;
}

//------------------------------------------------------------------------------
void vtkViewFactors::CastForOpenings(const PatchScene& scene, const SceneRayCaster& caster)
{
  ViewFactorsResult& result = *this->Result;
  std::vector<int> rays(scene.GetNumberOfPatches(), 0);
  Openings openings{ scene, caster, result, rays };
  Threads::For(0, scene.GetNumberOfPatches(), 64, openings);
  result.Summaries.emplace_back("RaysCast", std::accumulate(rays.begin(), rays.end(), 0.0));
}

//------------------------------------------------------------------------------
bool vtkViewFactors::CloseRows(const std::vector<PartlyVisiblePair>& pairs)
{
  ViewFactorsResult& result = *this->Result;
  std::vector<bool> closed(result.RowSums.size());
  for (std::size_t row = 0; row < closed.size(); ++row)
  {
    closed[row] = result.SkyFractions[row] + result.BackFaceFractions[row] == 0.0;
  }
  ViewFactorClosure::Report report;
  const bool done = result.Hierarchy
    ? ViewFactorClosure::Scale(result, closed, this->Controller, report)
    : ViewFactorClosure::Close(result, pairs, closed,
        ViewFactorAssembly::OpenShare * this->Tolerance + SinglePrecision, this->Controller,
        report);
  if (!done)
  {
    return false;
  }
  result.Summaries.emplace_back("ClosureChange", report.Change);
  result.Summaries.emplace_back("ClosureGap", report.Gap);
  return true;
}

//------------------------------------------------------------------------------
const std::vector<double>& vtkViewFactors::GetSkyFractions() const
{
  return this->Result->SkyFractions;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::HasClosedRows() const
{
  return std::any_of(this->Result->Summaries.begin(), this->Result->Summaries.end(),
    [](const auto& summary) { return summary.first == "ClosureChange"; });
}

//------------------------------------------------------------------------------
vtkExchange* vtkViewFactors::GetExchange()
{
  return this->Result->GetExchange();
}

//------------------------------------------------------------------------------
void vtkViewFactors::SetBrightness(const std::vector<double>& brightness)
{
  *this->Result = ViewFactorsResult();
  this->Brightness = brightness;
  this->Modified();
}

//------------------------------------------------------------------------------
const std::vector<double>& vtkViewFactors::GetRowSums() const
{
  return this->Result->RowSums;
}

//------------------------------------------------------------------------------
const std::vector<double>& vtkViewFactors::GetRowErrors() const
{
  return this->Result->RowErrors;
}

//------------------------------------------------------------------------------
double vtkViewFactors::GetViewFactor(vtkIdType i, vtkIdType j)
{
  const vtkExchange* exchange = this->Result->GetExchange();
  const vtkIdType patches = exchange ? static_cast<vtkIdType>(this->Patches.size()) : 0;
  if (i < 0 || j < 0 || i >= patches || j >= patches)
  {
    return 0.0;
  }
  const vtkIdType row = this->Patches[i];
  return exchange->GetValue(row, this->Patches[j]) / exchange->GetAreas()[row];
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Save(const char* fileName)
{
  std::string error;
  if (!fileName || !*fileName)
  {
    error = "The name of the file to save view factors in is empty.";
  }
  else if (this->GetNumberOfRanks() > 1)
  {
    error = "View factors can be saved on one process only: each of several holds a part.";
  }
  else if (this->Result->Hierarchy)
  {
    error = "Links between clusters cannot be saved: switch Hierarchical off and update.";
  }
  else if (!this->Result->Exchange || !this->Senders.empty())
  {
    error = "There are no view factors to save: call Update first.";
  }
  if (!error.empty() || !ViewFactorsFile::Write(fileName, *this->Result, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkViewFactors::Load(const char* fileName)
{
  ViewFactorsResult loaded;
  std::string error;
  const bool forget = !fileName || !*fileName;
  if (!forget && this->GetNumberOfRanks() > 1)
  {
    error = "View factors can be loaded on one process only: each of several holds a part.";
  }
  if (!error.empty() || (!forget && !ViewFactorsFile::Read(fileName, loaded, error)))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  *this->Result = std::move(loaded);
  this->Patches.clear();
  this->LoadedFile = forget ? "" : fileName;
  this->Senders.clear();
  this->Modified();
  return true;
}

//------------------------------------------------------------------------------
vtkTable* vtkViewFactors::GetGroupTable()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
void vtkViewFactors::AddSummaries(vtkFieldData* fields) const
{
  for (const auto& summary : this->Result->Summaries)
  {
    AddSummary(fields, summary.first.c_str(), summary.second);
  }
  if (this->Result->Hierarchy)
  {
    AddSummary(fields, "ClusterTreeUsed", this->Result->ClusterTree);
  }
}

//------------------------------------------------------------------------------
int vtkViewFactors::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  PatchScene scene;
  ViewFactorGroups::Groups groups;
  vtkInformation* choice = this->GetInputArrayInformation(0);
  const char* name = choice->Get(vtkDataObject::FIELD_NAME());
  std::string error;
  const auto order = this->LinksClusters() && this->UsesAtlas(input, this->ClusterTree)
    ? PatchScene::Order::Atlas
    : PatchScene::Order::Spatial;
  if (!scene.Build(input, this->Controller, error, order) ||
    !ViewFactorGroups::Gather(scene, input, name && *name ? name : "Group", groups, error))
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  this->SetProgressStage(0.0, 1.0);
  if (!this->UpdateExchange(scene, [this](double done) { return this->ReportProgress(done); }))
  {
    return 0;
  }
  if (!ViewFactorGroups::FillTable(*this->Result, groups, scene.GetScale(), this->Controller,
        vtkTable::GetData(outputs, 1)))
  {
    return 0;
  }
  output->ShallowCopy(input);
  scene.AddCellArray(output, "ViewFactorSum", this->Result->RawRowSums, 1);
  scene.AddCellArray(output, "ViewFactorError", this->Result->RowErrors, 1);
  scene.AddCellArray(output, "SkyFraction", this->Result->SkyFractions, 1);
  scene.AddCellArray(output, "BackFaceFraction", this->Result->BackFaceFractions, 1);
  this->AddSummaries(output->GetFieldData());
  return 1;
}

//------------------------------------------------------------------------------
void vtkViewFactors::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "EnforceClosure: " << this->EnforceClosure << "\n";
  os << indent << "Hierarchical: " << this->Hierarchical << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "ClusterTree: " << this->ClusterTree << "\n";
  os << indent << "LoadedFile: " << this->LoadedFile << "\n";
  for (const auto& summary : this->Result->Summaries)
  {
    os << indent << summary.first << ": " << summary.second << "\n";
  }
}
