// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Links of subsurface scattering by photons that start evenly on all patches: G_ij is what entered
 * j and left i, or the other way round, which is the same on average (Helmholtz reciprocity; light
 * enters diffusely). New light on the same body costs one product, and no photon.
 */
#ifndef PhotonLinks_h
#define PhotonLinks_h

#include "Links/LinkBuilder.h"
#include "Photons/PhotonScattering.h"
#include "Scattering/ScatteringMedium.h"

#include <vector>

namespace LightTransport
{
class PhotonLinks : public LinkBuilder
{
public:
  /// `image` of a medium that varies, or nullptr.
  PhotonLinks(std::vector<ScatteringMedium> bands, double millimetersPerUnit,
    const PhotonScattering::Settings& settings, const MediumImage* image);

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

  /**
   * Standard errors of what the links give, `scattered`, from `squares`, what they give for the
   * square of the light (patches x components of one light or several, as `light` is): a pair that
   * k photons have linked is known to the root of k. Collective.
   */
  static std::vector<double> GetErrors(const Links& links, const std::vector<double>& light,
    const std::vector<double>& scattered, const std::vector<double>& squares, const Ranks& ranks);

private:
  std::vector<ScatteringMedium> Bands;
  double MillimetersPerUnit;
  PhotonScattering::Settings Settings;
  const MediumImage* Image;
};
} // namespace LightTransport

#endif
