// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A run of a filter that takes light from vtkLights and an environment, patch by patch.
#ifndef LightingRun_h
#define LightingRun_h

#include "Lighting/PunctualLight.h"
#include "Run/TransportRun.h"

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

private:
  vtkLightingAlgorithm* Lighting;
};
} // namespace LightTransport

#endif
