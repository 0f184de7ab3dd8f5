// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// View factors of scenes, made when they are asked for and kept for as long as they serve, or
/// taken from a file: what stands behind a vtkViewFactors, and behind a vtkRadiosity that was given
/// none.
#ifndef ViewFactorStore_h
#define ViewFactorStore_h

#include "Links/LinkCache.h"
#include "Scene/SceneFaces.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "ViewFactors/CheckedRows.h"
#include "ViewFactors/SamplingPlan.h"
#include "vtkType.h"

#include <memory>
#include <string>
#include <vector>

namespace LightTransport
{
class PatchRays;
class PatchScene;
class Ranks;
class PairLooks;
class RayHits;
struct RaySamples;

/// Values of vtkRadiosity::LinkMethodType.
enum class LinkMethod
{
  Dense = 1,
  Hierarchical = 2,
  Sampled = 3
};

/// Properties of vtkViewFactors.
struct ViewFactorSettings
{
  double Tolerance = 0.0;
  bool EnforceClosure = false;
  LinkMethod Method = LinkMethod::Dense;
  double LinkTolerance = 0.0;
  /// Of sampled links; without rays as many as LinkTolerance asks for.
  SamplingPlan Plan = {};
};

class ViewFactorStore
{
public:
  ViewFactorStore();

  /**
   * Bring the view factors up to date for a scene. `senders` (one per patch; empty for all) tells
   * which patches send anything: pairs of which neither does may be left out. Those of a file serve
   * the scene that they were computed for and no other. Collective.
   */
  Outcome Update(const PatchScene& scene, const ViewFactorSettings& settings,
    const std::vector<bool>& senders, const Ranks& ranks, const Monitor& monitor);

  /// The plan to begin with: that of the links that are kept, if they are of this scene and were
  /// made for this tolerance or a smaller one, so that they need not be made again for other light;
  /// else `first`.
  SamplingPlan FindPlan(const PatchScene& scene, double linkTolerance, const SamplingPlan& first,
    const Ranks& ranks) const;

  /// What the last update left, or nothing after a failure.
  const Links& GetLinks() const { return this->Cache.Get(); }
  /// What links are between: as the settings have it, or a file.
  LinkMethod GetMethod(const ViewFactorSettings& settings) const;
  /// Whether it made them, and did not find them kept.
  bool WereMade() const { return this->LoadedFile.empty() && this->Cache.WereMade(); }

  /// What the rays of sampled links have met.
  const RayHits& GetHits() const;
  /// For as long as this is kept, and a scene is there, its trees for rays are built once.
  std::shared_ptr<PatchRays> ShareRays();
  /// What other links are compared with.
  CheckedRows& GetCheckedRows() { return this->Checked; }
  /// What links between clusters have found, for others of the same scene.
  const std::shared_ptr<PairLooks>& GetLooks() const { return this->Looks; }

  /// F_ij of faces of the scene of the last update. 0 where out of range and, on several ranks,
  /// what other ranks hold is left out.
  double GetViewFactor(vtkIdType i, vtkIdType j) const;
  /// Those of a face with all others: the same, and where rows are stored much faster.
  void CopyRow(vtkIdType i, double* factors) const;
  /// Their number, 0 after a failure.
  vtkIdType GetNumberOfFaces() const { return this->Faces.GetNumberOfFaces(); }
  /// In the input's unit squared.
  double GetArea(vtkIdType face) const { return this->AreaUnit * this->Faces.GetArea(face); }

  ///@{ Save what the last update computed; take it from a file until Forget or another file. On
  /// one process, or collective where it comes from rays.
  Outcome Save(const std::string& fileName, const Ranks& ranks) const;
  Outcome Load(const std::string& fileName, const Ranks& ranks);
  void Forget();
  ///@}
  /// Empty where the view factors are no file's.
  const std::string& GetLoadedFile() const { return this->LoadedFile; }

private:
  Outcome TakeLoaded(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor);
  Outcome Make(const PatchScene& scene, const ViewFactorSettings& settings,
    const std::vector<bool>& senders, const Ranks& ranks, const Monitor& monitor);

  LinkCache Cache;
  std::shared_ptr<RaySamples> Samples; ///< of sampled links, which may want more of them
  CheckedRows Checked;
  std::shared_ptr<PairLooks> Looks; ///< likewise of links between clusters
  ///@{ How they were made.
  SamplingPlan Plan;
  double PlanTolerance = 0.0;
  ///@}
  SceneFaces Faces;      ///< of the scene of the last update
  double AreaUnit = 1.0; ///< and its unit
  std::string LoadedFile;
  int LoadedRays = 0; ///< of each patch, where the file has any
};
} // namespace LightTransport

#endif
