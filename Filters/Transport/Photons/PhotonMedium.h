// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef PhotonMedium_h
#define PhotonMedium_h

namespace LightTransport
{
/// Bands that may share their photons.
constexpr int MostPhotonBands = 3;
/// Of photons that weigh less only some go on (Russian roulette), of those that start with 1.
constexpr double SmallPhotonWeight = 0.1;

/// What photons of one band walk in. Lengths in the unit of the walk.
struct PhotonMedium
{
  double Scattering; ///< coefficient as it is, not the reduced one
  double Absorption;
  double Anisotropy; ///< mean cosine of the angle of scattering (Henyey-Greenstein)

  double GetExtinction() const { return this->Scattering + this->Absorption; }
};

/// What happens to a photon at the end of a step that does not meet the surface.
enum class PhotonEvent
{
  SCATTERED,
  PASSED, ///< it walks on as before
  ENDED
};
} // namespace LightTransport

#endif
