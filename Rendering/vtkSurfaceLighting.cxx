// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceLighting.h"

#include "Maps/EnvironmentLight.h"
#include "Shared/BitHash.h"

#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkRadianceTransfer.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace LightTransport;

vtkStandardNewMacro(vtkSurfaceLighting);

struct vtkSurfaceLighting::Parts
{
  vtkSmartPointer<vtkImageData> Environment;
  EnvironmentLight Light;
  std::uint64_t Stamp = 0; ///< of what Light was read from
};

//------------------------------------------------------------------------------
vtkSurfaceLighting::vtkSurfaceLighting() : Private(new Parts) {}

//------------------------------------------------------------------------------
vtkSurfaceLighting::~vtkSurfaceLighting() = default;

//------------------------------------------------------------------------------
void vtkSurfaceLighting::SetEnvironment(vtkImageData* environment)
{
  if (this->Private->Environment != environment)
  {
    this->Private->Environment = environment;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageData* vtkSurfaceLighting::GetEnvironment()
{
  return this->Private->Environment;
}

//------------------------------------------------------------------------------
void vtkSurfaceLighting::SetIrradianceArray(const std::string& name)
{
  if (this->IrradianceArray != name)
  {
    this->IrradianceArray = name;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
std::string vtkSurfaceLighting::GetIrradianceArray()
{
  return this->IrradianceArray;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkSurfaceLighting::GetMTime()
{
  vtkImageData* environment = this->Private->Environment;
  return std::max(this->Superclass::GetMTime(), environment ? environment->GetMTime() : 0);
}

//------------------------------------------------------------------------------
// Turned, it stays as it is.
Outcome vtkSurfaceLighting::ReadEnvironment(const EnvironmentLight*& light)
{
  Parts& parts = *this->Private;
  const bool hasDirections = this->EnvironmentMethod == ENVIRONMENT_METHOD_DIRECTIONS;
  const int directions = hasDirections ? this->NumberOfEnvironmentDirections : 0;
  BitHash stamp;
  stamp.AddObjects({ parts.Environment });
  stamp.Add(static_cast<std::uint64_t>(directions));
  light = &parts.Light;
  if (parts.Stamp == stamp.Get())
  {
    return Outcome::Done();
  }
  Outcome read =
    parts.Light.Read(parts.Environment, vtkRadianceTransfer::LargestDegree, directions);
  parts.Stamp = read ? stamp.Get() : 0;
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkSurfaceLighting::GetTurn(double turn[9]) const
{
  double up[3];
  double right[3];
  std::copy_n(this->EnvironmentUp, 3, up);
  std::copy_n(this->EnvironmentRight, 3, right);
  vtkMath::Normalize(up);
  const double along = vtkMath::Dot(up, right);
  for (int k = 0; k < 3; ++k)
  {
    right[k] -= along * up[k];
  }
  const double size = vtkMath::Normalize(right);
  if (!(vtkMath::Norm(up) > 0.0) || !std::isfinite(size) ||
    !(size > 1e-9 * vtkMath::Norm(this->EnvironmentRight)))
  {
    return Outcome::Failed("EnvironmentUp and EnvironmentRight are 0, not finite or parallel: set "
                           "two directions that differ.");
  }
  std::copy_n(right, 3, turn);
  vtkMath::Cross(up, right, turn + 3);
  std::copy_n(up, 3, turn + 6);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkSurfaceLighting::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RendererLights: " << this->RendererLights << "\n";
  os << indent << "Environment: " << this->Private->Environment.Get() << "\n";
  os << indent << "EnvironmentUp: " << this->EnvironmentUp[0] << " " << this->EnvironmentUp[1]
     << " " << this->EnvironmentUp[2] << "\n";
  os << indent << "EnvironmentRight: " << this->EnvironmentRight[0] << " "
     << this->EnvironmentRight[1] << " " << this->EnvironmentRight[2] << "\n";
  os << indent << "EnvironmentMethod: " << this->EnvironmentMethod << "\n";
  os << indent << "NumberOfEnvironmentDirections: " << this->NumberOfEnvironmentDirections << "\n";
  os << indent << "IrradianceArray: " << this->IrradianceArray << "\n";
  os << indent << "Incidence: " << this->Incidence << "\n";
  os << indent << "AtCorners: " << this->AtCorners << "\n";
  os << indent << "Bumps: " << this->Bumps << "\n";
}
