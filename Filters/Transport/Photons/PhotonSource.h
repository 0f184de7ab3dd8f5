// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where photons start: on the patches that light enters, in proportion to how much does, evenly
 * over each. All bands share a photon's start: patches are chosen by the mean over the bands of
 * their shares of the flux, and what a photon stands for in a band is the share there over that
 * mean.
 */
#ifndef PhotonSource_h
#define PhotonSource_h

#include "Photons/PhotonRandom.h"
#include "Photons/PhotonWalk.h"
#include "Scene/PatchScene.h"

#include <vector>

namespace LightTransport
{
class PhotonSource
{
public:
  struct Photon
  {
    PhotonStart Start;
    double Scales[MostPhotonBands];
  };

  /// `flux` that enters, patches x bands: not negative, and in each band above 0 somewhere. The
  /// scene must outlive this.
  PhotonSource(const PatchScene& scene, const std::vector<double>& flux, int bands);

  /// All the flux of a band.
  double GetFlux(int band) const { return this->Flux[band]; }

  /// `place` from 0 to 1 runs through all that enters.
  Photon Start(double place, const PhotonWalk& walk, PhotonRandom& random) const;

private:
  using Vector = PatchScene::Vector;

  struct Triangle
  {
    vtkIdType Patch;
    int Corner; ///< the second one; the first is that of the patch
  };

  const PatchScene& Scene;
  double Flux[MostPhotonBands] = {};
  std::vector<Triangle> Triangles;
  std::vector<double> Ends;   ///< of each triangle, in place
  std::vector<double> Scales; ///< patches x bands
  int Bands;
};
} // namespace LightTransport

#endif
