// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScatteringPass.h"

#include "Shared/ArrayNames.h"
#include "Shared/Fresnel.h"
#include "vtkLightTransportPassesScatteringFS.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScatteringPass);

namespace
{
constexpr double LargestIndex = 10.0;

double GetMeanTransmittanceAt(double index)
{
  return 1.0 - Fresnel::GetMeanExternalReflectance(index);
}
} // namespace

//------------------------------------------------------------------------------
vtkSubsurfaceScatteringPass::vtkSubsurfaceScatteringPass()
  : vtkTransportPass(ArrayNames::ScatteredIrradiance)
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
    this->MeanTransmittance = GetMeanTransmittanceAt(clamped);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSubsurfaceScatteringPass::GetOutgoingWeight(double cosine, double refractiveIndex)
{
  const double index = std::min(std::max(refractiveIndex, 1.0), LargestIndex);
  const double clamped = std::min(std::max(cosine, 0.0), 1.0);
  // Without a boundary nothing is reflected, along the surface either.
  return index > 1.0 ? Fresnel::GetTransmittance(clamped, index) / GetMeanTransmittanceAt(index)
                     : 1.0;
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
