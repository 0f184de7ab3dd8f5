// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScatteringPass.h"

#include "vtkLightTransportPassesScatteringFS.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkSubsurfaceScatteringPass);

namespace
{
constexpr double LargestIndex = 10.0;

/// Reflectance for unpolarised light from outside (Fresnel).
double ComputeReflectance(double cosine, double index)
{
  if (index == 1.0)
  {
    return 0.0;
  }
  const double inside = std::sqrt(index * index - 1.0 + cosine * cosine);
  const double parallel = (index * index * cosine - inside) / (index * index * cosine + inside);
  const double perpendicular = (cosine - inside) / (cosine + inside);
  return 0.5 * (parallel * parallel + perpendicular * perpendicular);
}

/// 1 - 2 Int F(mu) mu dmu, by Simpson's rule in t with mu = t^2: the integrand bends most near
/// grazing angles.
double ComputeMeanTransmittance(double index)
{
  constexpr int Intervals = 2000;
  double sum = 0.0;
  for (int point = 0; point <= Intervals; ++point)
  {
    const double t = static_cast<double>(point) / Intervals;
    const double weight = point == 0 || point == Intervals ? 1.0 : (point % 2 == 1 ? 4.0 : 2.0);
    sum += weight * ComputeReflectance(t * t, index) * 4.0 * t * t * t;
  }
  return 1.0 - sum / (3.0 * Intervals);
}
} // namespace

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::vtkSubsurfaceScatteringPass() : vtkTransportPass("ScatteredIrradiance")
{
  this->SetRefractiveIndex(1.3);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::~vtkSubsurfaceScatteringPass() = default;

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::SetRefractiveIndex(double index)
{
  const double clamped = std::min(std::max(index, 1.0), LargestIndex);
  if (this->RefractiveIndex != clamped)
  {
    this->RefractiveIndex = clamped;
    this->MeanTransmittance = ComputeMeanTransmittance(clamped);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSubsurfaceScatteringPass::GetOutgoingWeight(double cosine, double refractiveIndex)
{
  const double index = std::min(std::max(refractiveIndex, 1.0), LargestIndex);
  const double clamped = std::min(std::max(cosine, 0.0), 1.0);
  return (1.0 - ComputeReflectance(clamped, index)) / ComputeMeanTransmittance(index);
}

//------------------------------------------------------------------------------
const char* vtkSubsurfaceScatteringPass::GetFragmentShader()
{
  return ::vtkLightTransportPassesScatteringFS;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScatteringPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
}
