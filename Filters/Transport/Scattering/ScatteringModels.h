// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The models of scattering that are a profile of distance. A new one is a file with a class behind
 * ScatteringProfile, and a line in the table of ScatteringModels.cxx. (A model that is none, such
 * as photons that walk through the mesh, makes its links in another way and has no line here.)
 */
#ifndef ScatteringModels_h
#define ScatteringModels_h

#include "Scattering/ScatteringMedium.h"
#include "Scattering/ScatteringProfile.h"
#include "Shared/Outcome.h"
#include "Support/Ranks.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace LightTransport
{
/// What some models depend on beside the medium.
struct ScatteringOptions
{
  /// In vtkSubsurfaceScattering::BurleyFitType.
  int BurleyFit = 1;
  ///@{ Of the walk behind a tabulated profile; photons 0 for as many as is reasonable.
  long long NumberOfPhotons = 0;
  std::uint64_t Seed = 1;
  ///@}
  /// That share the work: each of them makes the same profiles.
  Ranks AllRanks;
};

struct ScatteringModel
{
  /// In vtkSubsurfaceScattering::ModelType.
  int Number;
  const char* Name;
  std::unique_ptr<const ScatteringProfile> (
    *MakeProfile)(const ScatteringMedium& medium, const ScatteringOptions& options);
};

namespace ScatteringModels
{
const std::vector<ScatteringModel>& GetAll();

/// nullptr for a number that no profile has.
const ScatteringModel* Find(int number);

/// One profile for each band. Fails for a number that no profile has, and where options do not fit
/// the medium.
Outcome MakeProfiles(int number, const ScatteringOptions& options,
  const std::vector<ScatteringMedium>& bands, ScatteringProfiles& profiles);
} // namespace ScatteringModels
} // namespace LightTransport

#endif
