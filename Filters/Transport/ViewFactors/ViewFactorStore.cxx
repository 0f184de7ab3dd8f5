// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorStore.h"

#include "Links/ExchangeRow.h"
#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/DenseViewFactors.h"
#include "ViewFactors/HierarchicalViewFactors.h"
#include "ViewFactors/RayHitsFile.h"
#include "ViewFactors/RaySamples.h"
#include "ViewFactors/SampledViewFactors.h"
#include "ViewFactors/ViewFactorsFile.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
ViewFactorStore::ViewFactorStore() : Samples(std::make_shared<RaySamples>()) {}

//------------------------------------------------------------------------------
Outcome ViewFactorStore::Update(const PatchScene& scene, const ViewFactorSettings& settings,
  const std::vector<bool>& senders, const Ranks& ranks, const Monitor& monitor)
{
  this->Faces = SceneFaces();
  if (settings.Method != LinkMethod::Hierarchical && scene.GetOrder() != PatchScene::Order::Spatial)
  {
    return Outcome::Failed("Links between patches need the spatial order of the scene: set "
                           "ClusterTree to Spatial or LinkMethod to Hierarchical.");
  }
  Outcome updated = this->LoadedFile.empty() ? this->Make(scene, settings, senders, ranks, monitor)
                                             : this->TakeLoaded(scene, ranks, monitor);
  if (updated)
  {
    this->Faces = scene.GetFaces();
    this->AreaUnit = scene.GetScale() * scene.GetScale();
  }
  return updated;
}

//------------------------------------------------------------------------------
Outcome ViewFactorStore::Make(const PatchScene& scene, const ViewFactorSettings& settings,
  const std::vector<bool>& senders, const Ranks& ranks, const Monitor& monitor)
{
  // Clusters hold who sends and who does not, and rays meet both.
  if (settings.Method == LinkMethod::Hierarchical)
  {
    return this->Cache.Update(scene, HierarchicalViewFactors(settings.LinkTolerance), ranks,
      monitor);
  }
  if (settings.Method == LinkMethod::Sampled)
  {
    SamplingPlan plan = settings.Plan;
    if (plan.Rays.Each == 0)
    {
      plan.Rays.Each = SampledViewFactors::GetRaysFor(settings.LinkTolerance);
    }
    const SampledViewFactors builder(plan, this->Samples);
    Outcome updated = this->Cache.Update(scene, builder, ranks, monitor);
    if (this->Cache.WereMade())
    {
      this->Plan = plan;
      this->PlanTolerance = settings.LinkTolerance;
    }
    return updated;
  }
  // A closure needs whole rows.
  const bool all = settings.EnforceClosure ||
    std::all_of(senders.begin(), senders.end(), [](bool sends) { return sends; });
  return this->Cache.Update(scene,
    DenseViewFactors(settings.Tolerance, settings.EnforceClosure,
      all ? std::vector<bool>() : senders),
    ranks, monitor);
}

//------------------------------------------------------------------------------
LinkMethod ViewFactorStore::GetMethod(const ViewFactorSettings& settings) const
{
  return this->LoadedFile.empty() ? settings.Method
    : this->LoadedRays > 0        ? LinkMethod::Sampled
                                  : LinkMethod::Dense;
}

//------------------------------------------------------------------------------
SamplingPlan ViewFactorStore::FindPlan(const PatchScene& scene, double linkTolerance,
  const SamplingPlan& first, const Ranks& ranks) const
{
  const bool serves = this->GetLinks().IsSampled() && this->PlanTolerance <= linkTolerance &&
    this->Samples->Hits.Have(this->Plan.Rays, scene, ranks);
  return serves ? this->Plan : first;
}

//------------------------------------------------------------------------------
// Of rays the links are to be made of what they have met, a matrix is there.
Outcome ViewFactorStore::TakeLoaded(const PatchScene& scene, const Ranks& ranks,
  const Monitor& monitor)
{
  const Links& links = this->GetLinks();
  const bool fits = this->LoadedRays > 0
    ? this->Samples->Hits.Have({ this->LoadedRays, {} }, scene, ranks)
    : links.Fingerprint == scene.GetFingerprint() &&
      links.Matrix->GetNumberOfPatches() == scene.GetNumberOfPatches();
  Outcome taken = ranks.Agree(fits
      ? Outcome::Done()
      : Outcome::Failed("The view factors in \"" + this->LoadedFile +
          "\" were computed for another geometry: give the mesh that they belong to, or compute "
          "them (Load(nullptr)) and save them again."));
  if (taken && this->LoadedRays > 0)
  {
    SamplingPlan plan;
    plan.Rays.Each = this->LoadedRays;
    taken = this->Cache.Update(scene, SampledViewFactors(plan, this->Samples), ranks, monitor);
  }
  return taken;
}

//------------------------------------------------------------------------------
const RayHits& ViewFactorStore::GetHits() const
{
  return this->Samples->Hits;
}

//------------------------------------------------------------------------------
std::shared_ptr<PatchRays> ViewFactorStore::ShareRays()
{
  auto rays = std::make_shared<PatchRays>();
  this->Samples->Rays = rays;
  return rays;
}

//------------------------------------------------------------------------------
double ViewFactorStore::GetViewFactor(vtkIdType i, vtkIdType j) const
{
  const vtkExchange* exchange = this->GetLinks().GetExchange();
  const vtkIdType faces = exchange ? this->Faces.GetNumberOfFaces() : 0;
  if (i < 0 || j < 0 || i >= faces || j >= faces)
  {
    return 0.0;
  }
  double factor = 0.0;
  for (const vtkIdType row : this->Faces.GetPatches(i))
  {
    double exchanged = 0.0;
    for (const vtkIdType column : this->Faces.GetPatches(j))
    {
      exchanged += exchange->GetValue(row, column);
    }
    factor += this->Faces.GetShare(row) * (exchanged / exchange->GetAreas()[row]);
  }
  return factor;
}

//------------------------------------------------------------------------------
void ViewFactorStore::CopyRow(vtkIdType i, double* factors) const
{
  const vtkIdType faces = this->GetNumberOfFaces();
  std::fill_n(factors, faces, 0.0);
  const vtkExchange* exchange = this->GetLinks().GetExchange();
  std::vector<double> values;
  for (const vtkIdType row : this->Faces.GetPatches(i))
  {
    ExchangeRow::Copy(exchange, row, values);
    for (vtkIdType j = 0; j < faces; ++j)
    {
      double exchanged = 0.0;
      for (const vtkIdType column : this->Faces.GetPatches(j))
      {
        exchanged += values[column];
      }
      factors[j] += this->Faces.GetShare(row) * (exchanged / exchange->GetAreas()[row]);
    }
  }
}

//------------------------------------------------------------------------------
Outcome ViewFactorStore::Save(const std::string& fileName, const Ranks& ranks) const
{
  if (fileName.empty())
  {
    return Outcome::Failed("The name of the file to save view factors in is empty.");
  }
  const Links& links = this->GetLinks();
  if (links.IsSampled())
  {
    return RayHitsFile::Write(fileName, this->Samples->Hits, links.Hierarchy->GetNumberOfPatches(),
      links.Rays.Each, ranks);
  }
  if (ranks.AreSeveral())
  {
    return Outcome::Failed(
      "A matrix of view factors can be saved on one process only: each of several holds a part. "
      "Use one process, or set LinkMethod to Sampled.");
  }
  if (links.Hierarchy)
  {
    return Outcome::Failed("Links between clusters cannot be saved: switch Hierarchical off and "
                           "update.");
  }
  if (!links.Matrix || !this->Cache.GetKey().Senders.empty())
  {
    return Outcome::Failed("There are no view factors to save: call Update first.");
  }
  return ViewFactorsFile::Write(fileName, links);
}

//------------------------------------------------------------------------------
Outcome ViewFactorStore::Load(const std::string& fileName, const Ranks& ranks)
{
  Links loaded;
  int rays = 0;
  Outcome read = Outcome::Done();
  if (ranks.GetLargest(RayHitsFile::Is(fileName) ? 1 : 0) > 0)
  {
    read = RayHitsFile::Read(fileName, ranks, this->Samples->Hits, rays);
  }
  else if (ranks.AreSeveral())
  {
    read = Outcome::Failed(
      "A matrix of view factors can be loaded on one process only: each of several holds a part. "
      "Use one process, or save those of LinkMethod Sampled.");
  }
  else
  {
    read = ViewFactorsFile::Read(fileName, loaded);
  }
  if (read)
  {
    this->Cache.Put(std::move(loaded));
    this->Faces = SceneFaces();
    this->LoadedFile = fileName;
    this->LoadedRays = rays;
  }
  return read;
}

//------------------------------------------------------------------------------
void ViewFactorStore::Forget()
{
  this->Cache.Put(Links());
  *this->Samples = RaySamples();
  this->Checked = CheckedRows();
  this->Faces = SceneFaces();
  this->LoadedFile.clear();
  this->LoadedRays = 0;
}
} // namespace LightTransport
