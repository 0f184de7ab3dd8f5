// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Links of subsurface scattering by a model that is a profile of distance (ScatteringModels), one
/// kernel for each band: between all pairs of patches (ScatteringAssembly), or from clusters of
/// patches (ScatteringRefinement).
#ifndef ScatteringLinks_h
#define ScatteringLinks_h

#include "Links/LinkBuilder.h"
#include "Links/LinkOperators.h"
#include "Scattering/ScatteringMedium.h"
#include "Scattering/ScatteringModels.h"
#include "Scattering/ScatteringRows.h"

#include <vector>

namespace LightTransport
{
class ScatteringClusters;
class ScatteringRefinement;

/// Which links there are.
struct ScatteringLinkChoice
{
  int Method = 0;               ///< of vtkSubsurfaceScattering::LinkMethodType
  int Number = 0;               ///< of each receiver: of Uniform, and at most of Adaptive
  double Tolerance = 0.0;       ///< relative error of what a patch receives; 0 for the method's own
  bool DropsThroughAir = false; ///< of all pairs
  bool AreCompressed = false;   ///< those from clusters
  double CompressionTolerance = 0.0;
  bool IsKept = false;                 ///< when patches move
  LinkDevice Device = LinkDevice::CPU; ///< where those from clusters are chosen
  std::vector<double> Light; ///< that they are chosen for, patches x components; empty for any
};

class ScatteringLinks : public LinkBuilder
{
public:
  /// `model` is one of vtkSubsurfaceScattering::ModelType. Links through air (AirGaps) are
  /// left out where they are to be dropped, and of all pairs known by a sample where not.
  ScatteringLinks(int model, const ScatteringOptions& options, std::vector<ScatteringMedium> bands,
    double millimetersPerUnit, const ScatteringLinkChoice& choice);

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

private:
  struct Task;

  bool IsOfAllPairs() const;
  bool IsDense(const Task& task, const ScatteringRefinement& refinement) const;
  Outcome LinkPatches(Task& task) const;
  Outcome LinkClusters(Task& task) const;
  Outcome FillRows(Task& task, const ScatteringClusters& clusters,
    const ScatteringRefinement& refinement) const;
  Outcome ChooseRows(Task& task, const ScatteringClusters& clusters,
    const ScatteringRefinement& refinement, ScatteringRows::Summary& summary) const;
  void Summarize(Task& task, const ScatteringRefinement& refinement,
    const ScatteringRows::Summary& summary) const;
  double GetTolerance(bool isDense) const;

  int Model;
  ScatteringOptions Options;
  std::vector<ScatteringMedium> Bands;
  double MillimetersPerUnit;
  ScatteringLinkChoice Choice;
};
} // namespace LightTransport

#endif
