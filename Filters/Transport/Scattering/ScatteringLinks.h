// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Links of subsurface scattering between all pairs of patches, by a model that is a profile of
/// distance (ScatteringModels), one kernel for each band.
#ifndef ScatteringLinks_h
#define ScatteringLinks_h

#include "Links/LinkBuilder.h"
#include "Scattering/ScatteringMedium.h"
#include "Scattering/ScatteringModels.h"

#include <vector>

namespace LightTransport
{
class ScatteringLinks : public LinkBuilder
{
public:
  /// `model` is one of vtkSubsurfaceScattering::ModelType, `tolerance` the error that the links of
  /// a patch may have together, relative to the profile's total. Links through air (AirGaps) are
  /// left out where they are to be dropped, and known by a sample where not.
  ScatteringLinks(int model, const ScatteringOptions& options, std::vector<ScatteringMedium> bands,
    double millimetersPerUnit, double tolerance, bool dropsThroughAir);

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

private:
  int Model;
  ScatteringOptions Options;
  std::vector<ScatteringMedium> Bands;
  double MillimetersPerUnit;
  double Tolerance;
  bool DropsThroughAir;
};
} // namespace LightTransport

#endif
