// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A run with photons in the body itself: followed with the light as it is, or counted as links.
#ifndef MonteCarloRun_h
#define MonteCarloRun_h

#include "Photons/MediumImage.h"
#include "Photons/PhotonScattering.h"
#include "Scattering/ScatteringRun.h"

namespace LightTransport
{
class MonteCarloRun : public ScatteringRun
{
public:
  using ScatteringRun::ScatteringRun;

protected:
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  bool IsAnisotropic() const override { return true; }
  const char* FindUseOfBody() const override { return "Model MonteCarlo"; }
  std::unique_ptr<LinkBuilder> MakeBuilder() const override;
  Outcome Scatter() override;
  void SumLeaving() override;
  void WriteScattered(const SceneOutput& output) override;

private:
  /// Without links.
  bool FollowsPhotons() const;
  PhotonScattering::Settings GetSettings() const;
  Outcome ReadMedium();
  Outcome FollowPhotons();
  Outcome ApplyWithErrors();
  std::vector<PhotonMedium> GetMedia() const;
  void CheckSize() const;
  Outcome CheckLost(double share, double photons) const;
  void WritePhotons(const SceneOutput& output) const;

  /// Where the medium varies; else nullptr.
  std::unique_ptr<MediumImage> Image;
  PhotonScattering::Result Photons;
  std::vector<double> Errors; ///< patches x components, of links
};
} // namespace LightTransport

#endif
