// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A run of a filter that takes light from vtkLights and an environment, patch by patch.
#ifndef LightingRun_h
#define LightingRun_h

#include "Lighting/PunctualLight.h"
#include "Run/TransportRun.h"

#include <functional>
#include <vector>

class vtkLightingAlgorithm;

namespace LightTransport
{
class LightingRun : public TransportRun
{
public:
  LightingRun(vtkLightingAlgorithm* owner, const RunPorts& ports)
    : TransportRun(ports), Lighting(owner)
  {
  }

protected:
  NumberProperties::List ListNumbers() const override;

  /// Take over the lights that are on. A warning tells where there is no light at all.
  Outcome ReadLights(std::vector<PunctualLight>& lights) const;

  /// Do something with each patch of this rank that costs about as much as `rays` rays, with
  /// progress up to a fraction. `finish`: then to be done with each, one after another.
  Outcome ForLocalPatches(double rays, double done,
    const std::function<void(vtkIdType patch)>& compute,
    const std::function<void(vtkIdType patch)>& finish = {});

private:
  vtkLightingAlgorithm* Lighting;
};
} // namespace LightTransport

#endif
