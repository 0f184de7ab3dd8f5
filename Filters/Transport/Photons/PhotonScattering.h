// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What leaves each face of a body when the light that enters it walks inside as photons, with its
 * standard error. Bands of equal anisotropy share their photons, unless the medium varies. The same
 * seed gives the same result on any number of threads and ranks.
 */
#ifndef PhotonScattering_h
#define PhotonScattering_h

#include "Photons/MediumImage.h"
#include "Photons/PhotonMedium.h"
#include "Photons/PhotonRecorder.h"
#include "Photons/PhotonTally.h"
#include "Photons/PhotonWalk.h"
#include "Photons/VaryingMedium.h"
#include "Scattering/ScatteringMedium.h"
#include "Scene/PatchScene.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "Support/Ranks.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace LightTransport
{
class PhotonScattering
{
public:
  struct Settings
  {
    /// Standard error of a band relative to it, root mean square over the surface; the worst band
    /// counts.
    double TargetError = 1e-2;
    /// 0: as many as TargetError needs.
    long long NumberOfPhotons = 0;
    std::uint64_t Seed = 1;
  };

  struct Result
  {
    ///@{ faces x bands, in the unit of the irradiance.
    std::vector<double> Scattered;
    std::vector<double> Errors;
    ///@}
    ///@{ Of each band.
    std::vector<double> RelativeErrors;
    std::vector<double> LeavingShares; ///< of what enters, what goes away for good after scattering
    std::vector<double> LeavingShareErrors;
    std::vector<double> UnscatteredShares;
    std::vector<double> LostShares;
    std::vector<double> PhotonsOfBands;
    std::vector<double> MeanWeights; ///< of photons that leave, each as often as it weighs
    ///@}
    long long Photons = 0;
    PhotonWalk::Counts Counts;
  };

  /// `media` in scene units, one for each band. Where the medium varies `image` has it, and `media`
  /// what is around it; else nullptr.
  PhotonScattering(const PatchScene& scene, std::vector<PhotonMedium> media, double refractiveIndex,
    const MediumImage* image)
    : Scene(scene), Media(std::move(media)), RefractiveIndex(refractiveIndex), Image(image)
  {
  }

  /// Media of coefficients per mm, of which the scene's unit has so many.
  static std::vector<PhotonMedium> GetMedia(const std::vector<ScatteringMedium>& bands,
    double millimeters);

  /// `entering` irradiance, patches x bands, not negative. `recorder` may be nullptr. Collective.
  Outcome Run(const std::vector<double>& entering, const Settings& settings, const Ranks& ranks,
    const Monitor& monitor, Result& result, PhotonRecorder* recorder = nullptr) const;

private:
  class Group;

  std::vector<std::vector<int>> GroupBands(const std::vector<double>& entering) const;
  std::vector<PhotonMedium> ChooseMedia(const std::vector<int>& bands) const;
  std::vector<double> GetFlux(const std::vector<int>& bands,
    const std::vector<double>& entering) const;
  double GetBallSize(const std::vector<VaryingMedium>& varying) const;
  Result MakeResult() const;

  const PatchScene& Scene;
  std::vector<PhotonMedium> Media;
  double RefractiveIndex;
  const MediumImage* Image;
};
} // namespace LightTransport

#endif
