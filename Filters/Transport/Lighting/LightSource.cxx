// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LightSource.h"

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Fresnel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace LightTransport
{
//------------------------------------------------------------------------------
void LightSum::Add(const double* values, double weight, double transmittance, bool isBlocked)
{
  for (int band = 0; band < LightBands; ++band)
  {
    const double value = weight * values[band];
    this->Unshadowed[band] += value;
    this->Incident[band] += isBlocked ? 0.0 : value;
    this->Transmitted[band] += isBlocked ? 0.0 : transmittance * value;
  }
}

//------------------------------------------------------------------------------
void LightSum::AddScaled(const LightSum& other, double factor)
{
  for (int band = 0; band < LightBands; ++band)
  {
    this->Incident[band] += factor * other.Incident[band];
    this->Transmitted[band] += factor * other.Transmitted[band];
    this->Variance[band] += factor * factor * other.Variance[band];
    this->Unshadowed[band] += factor * other.Unshadowed[band];
  }
}

//------------------------------------------------------------------------------
void LightSum::RaiseUnshadowed(const double* values, double factor)
{
  for (int band = 0; band < LightBands; ++band)
  {
    this->Unshadowed[band] = std::max(this->Unshadowed[band], factor * values[band]);
  }
}

//------------------------------------------------------------------------------
double LightSum::GetLargestUnshadowed() const
{
  return *std::max_element(this->Unshadowed, this->Unshadowed + LightBands);
}

//------------------------------------------------------------------------------
double LightSum::GetLargestError() const
{
  return std::sqrt(*std::max_element(this->Variance, this->Variance + LightBands));
}

//------------------------------------------------------------------------------
LitPatch::LitPatch(const PatchScene& scene, const SceneRayCaster* caster, double refractiveIndex,
  vtkIdType patch)
  : Scene(scene), Caster(caster), RefractiveIndex(refractiveIndex), Id(patch),
    Plane(scene.GetPlane(patch)), Sampler(static_cast<std::uint64_t>(patch))
{
  this->Shape.Set(scene, patch);
}

//------------------------------------------------------------------------------
bool LitPatch::IsInFront(vtkIdType other) const
{
  for (int corner = 0; corner < this->Scene.GetNumberOfCorners(other); ++corner)
  {
    if (this->Plane.GetCertainHeight(this->Scene.GetCorner(other, corner)) > 0.0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool LitPatch::HasBlockers() const
{
  if (!this->Caster)
  {
    return false;
  }
  const Vector& normal = this->Plane.Normal;
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const PatchTree::Node& node = this->Scene.GetTree().GetNode(open.back());
    open.pop_back();
    const Vector highest =
      (normal.array() > 0.0).select(node.Upper.array(), node.Lower.array()).matrix();
    if (this->Plane.GetHeight(highest) <= this->Plane.Rounding)
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left);
      open.push_back(node.Left + 1);
      continue;
    }
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      if (patch != this->Id && this->IsInFront(patch))
      {
        return true;
      }
    }
  }
  return false;
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
