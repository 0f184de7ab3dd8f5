// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A run of vtkSubsurfaceScattering, as far as its models do the same: irradiance in, links made and
 * applied, exitance, thickness and sums out. Models that are a profile of distance are a
 * ProfileRun, photons in the body itself a MonteCarloRun.
 */
#ifndef ScatteringRun_h
#define ScatteringRun_h

#include "Run/TransportRun.h"
#include "Scattering/MediumProperties.h"
#include "Scattering/ScatteringMedium.h"

#include <memory>
#include <string>
#include <vector>

class vtkSubsurfaceScattering;

namespace LightTransport
{
class LinkBuilder;
class LinkCache;
class SceneOutput;

class ScatteringRun : public TransportRun
{
public:
  /// `links` are those that the filter keeps.
  ScatteringRun(vtkSubsurfaceScattering* owner, LinkCache& links, const RunPorts& ports)
    : TransportRun(ports), Owner(owner), Cache(links)
  {
    this->TakesTexels = true;
  }

protected:
  static constexpr int Bands = MediumProperties::Bands;
  /// The links, or photons in their place, as a fraction of the progress.
  static constexpr double LinksDone = 0.95;

  NumberProperties::List ListNumbers() const override;
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

  /// Whether the model looks at more than the reduced coefficient.
  virtual bool IsAnisotropic() const = 0;
  /// What looks into the body, which texels do not enclose; nullptr where nothing does.
  virtual const char* FindUseOfBody() const;
  virtual std::unique_ptr<LinkBuilder> MakeBuilder() const = 0;
  /// A failure where the input is texels, and something looks into the body.
  Outcome CheckTexels() const;
  /// From irradiance to exitance; by the links, unless a model does without.
  virtual Outcome Scatter();
  /// In the order of the scene.
  virtual Outcome ReadIrradiance();
  /// Adds what leaves to LeavingFlux.
  virtual void SumLeaving();
  /// Exitance, and what is to be told of how it came about.
  virtual void WriteScattered(const SceneOutput& output);

  /// What enters the patches, patches x components.
  std::vector<double> GetEntering() const;
  /// From what enters the patches of each of some lights, patches x components of all of them, to
  /// what leaves the patches, in place: lights share passes over the links.
  Outcome ApplyLinks(std::vector<double>& light, int numberOfLights);

  int GetNumberOfLights() const { return this->NumberOfLights; }
  /// The bands of each light, one after another.
  int GetNumberOfComponents() const { return Bands * this->NumberOfLights; }

  vtkSubsurfaceScattering* Owner;
  LinkCache& Cache;
  std::vector<ScatteringMedium> Media; ///< of each band
  ///@{ patches x components
  std::vector<double> Irradiance;
  std::vector<double> Scattered;
  ///@}
  ///@{ Known when written.
  std::vector<double> EnteringFlux; ///< of each component
  std::vector<double> LeavingFlux;  ///< likewise
  double ThinShares[Bands] = {};    ///< of the surface, below ThinBody; with ComputeThickness
  ///@}
  double ApplySeconds = 0.0;
  std::string DeviceUsed;
  std::string DeviceExplanation;

private:
  void CompareIndices() const;
  double GetEnteringShare() const;
  void WriteThickness(const SceneOutput& output);
  void WriteFluxes();

  int NumberOfLights = 1;
  std::vector<double> Thickness; ///< of each patch, in scene units
};
} // namespace LightTransport

#endif
