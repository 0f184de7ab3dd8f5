// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LightSource.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Fresnel.h"

#include <cstdint>

namespace LightTransport
{
//------------------------------------------------------------------------------
void LightSum::Add(const double* values, double weight, double transmittance)
{
  for (int band = 0; band < LightBands; ++band)
  {
    this->Incident[band] += weight * values[band];
    this->Transmitted[band] += weight * transmittance * values[band];
  }
}

//------------------------------------------------------------------------------
void LightSum::Add(const LightSum& other)
{
  for (int band = 0; band < LightBands; ++band)
  {
    this->Incident[band] += other.Incident[band];
    this->Transmitted[band] += other.Transmitted[band];
  }
}

//------------------------------------------------------------------------------
LitPatch::LitPatch(const PatchScene& scene, const SceneRayCaster* caster, double refractiveIndex,
  vtkIdType patch)
  : Scene(scene), Caster(caster), RefractiveIndex(refractiveIndex), Id(patch),
    Sampler(static_cast<std::uint64_t>(patch))
{
  this->Shape.Set(scene, patch);
}

//------------------------------------------------------------------------------
bool LitPatch::IsBlocked(const Vector& point, const Vector& target) const
{
  return this->Caster && this->Caster->IsOccluded(point, target, this->Id, -1);
}

//------------------------------------------------------------------------------
double LitPatch::GetTransmittance(double cosine) const
{
  return Fresnel::GetTransmittance(cosine, this->RefractiveIndex);
}
} // namespace LightTransport
