// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ViewFactorStore.h"

#include "Scene/PatchScene.h"
#include "Support/Ranks.h"
#include "ViewFactors/DenseViewFactors.h"
#include "ViewFactors/HierarchicalViewFactors.h"
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
                                             : this->CheckLoaded(scene, ranks);
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
    if (plan.RaysPerPatch == 0)
    {
      plan.RaysPerPatch = SampledViewFactors::GetRaysFor(settings.LinkTolerance);
    }
    const SampledViewFactors builder(plan, this->Samples);
    return this->Cache.Update(scene, builder, ranks, monitor);
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
Outcome ViewFactorStore::CheckLoaded(const PatchScene& scene, const Ranks& ranks) const
{
  const Links& links = this->GetLinks();
  const bool fits = links.Fingerprint == scene.GetFingerprint() &&
    links.Matrix->GetNumberOfPatches() == scene.GetNumberOfPatches();
  return ranks.Agree(fits
      ? Outcome::Done()
      : Outcome::Failed("The view factors in \"" + this->LoadedFile +
          "\" were computed for another geometry: give the mesh that they belong to, or compute "
          "them (Load(nullptr)) and save them again."));
}

//------------------------------------------------------------------------------
const RayHits& ViewFactorStore::GetHits() const
{
  return this->Samples->Hits;
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
Outcome ViewFactorStore::Save(const std::string& fileName, const Ranks& ranks) const
{
  if (fileName.empty())
  {
    return Outcome::Failed("The name of the file to save view factors in is empty.");
  }
  if (ranks.AreSeveral())
  {
    return Outcome::Failed(
      "View factors can be saved on one process only: each of several holds a part.");
  }
  if (this->GetLinks().Hierarchy)
  {
    return Outcome::Failed(this->GetLinks().IsSampled()
        ? "Links from rays cannot be saved: set LinkMethod to Dense and update."
        : "Links between clusters cannot be saved: switch Hierarchical off and update.");
  }
  if (!this->GetLinks().Matrix || !this->Cache.GetKey().Senders.empty())
  {
    return Outcome::Failed("There are no view factors to save: call Update first.");
  }
  return ViewFactorsFile::Write(fileName, this->GetLinks());
}

//------------------------------------------------------------------------------
Outcome ViewFactorStore::Load(const std::string& fileName, const Ranks& ranks)
{
  if (ranks.AreSeveral())
  {
    return Outcome::Failed(
      "View factors can be loaded on one process only: each of several holds a part.");
  }
  Links loaded;
  Outcome read = ViewFactorsFile::Read(fileName, loaded);
  if (read)
  {
    this->Cache.Put(std::move(loaded));
    this->Faces = SceneFaces();
    this->LoadedFile = fileName;
  }
  return read;
}

//------------------------------------------------------------------------------
void ViewFactorStore::Forget()
{
  this->Cache.Put(Links());
  this->Faces = SceneFaces();
  this->LoadedFile.clear();
}
} // namespace LightTransport
