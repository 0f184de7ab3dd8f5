// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLShooter.h"

#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "Device/DeviceWindow.h"
#include "Shooting/ProgressiveShooter.h"

#include "vtkObjectFactory.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkOpenGLShooter);

namespace
{
/// Numbers of patches are handed on in single precision.
constexpr vtkIdType MaximumNumberOfPatches = FloatTextures::MaximumTexels;
///@{ Of Resolution.
constexpr int LowestResolution = 16;
constexpr int HighestResolution = 2048;
///@}

bool Finish(vtkOpenGLShooter* shooter, const Outcome& work, const char* what)
{
  return DeviceErrors::Finish(shooter, work, what, shooter->GetDeviceName());
}
} // namespace

//------------------------------------------------------------------------------
vtkOpenGLShooter::vtkOpenGLShooter() : Window(new DeviceWindow) {}

//------------------------------------------------------------------------------
vtkOpenGLShooter::~vtkOpenGLShooter() = default;

//------------------------------------------------------------------------------
void vtkOpenGLShooter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DeviceName: " << this->GetDeviceName() << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Overshooting: " << this->Overshooting << "\n";
  os << indent << "EyePointDensity: " << this->EyePointDensity << "\n";
  os << indent << "NumberOfEyePoints: " << this->GetNumberOfEyePoints() << "\n";
  os << indent << "NumberOfBytesRead: " << this->GetNumberOfBytesRead() << "\n";
}

//------------------------------------------------------------------------------
void vtkOpenGLShooter::SetResolution(int resolution)
{
  const int clamped =
    resolution == 0 ? 0 : std::min(std::max(resolution, LowestResolution), HighestResolution);
  if (clamped != this->Resolution)
  {
    this->Resolution = clamped;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLShooter::GetNumberOfEyePoints()
{
  return this->Progress ? this->Progress->GetNumberOfEyePoints() : 0;
}

//------------------------------------------------------------------------------
vtkTypeInt64 vtkOpenGLShooter::GetNumberOfBytesRead()
{
  return this->Progress ? this->Progress->GetNumberOfBytesRead() : 0;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Open(std::string& reason)
{
  const Outcome open = this->Window->Open();
  reason = open ? reason : open.GetMessage();
  return static_cast<bool>(open);
}

//------------------------------------------------------------------------------
const char* vtkOpenGLShooter::GetDeviceName()
{
  return this->Window->GetDeviceName().c_str();
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::CheckSizes(vtkIdType numberOfPatches, int numberOfBands)
{
  if (numberOfPatches < 1 || numberOfPatches > MaximumNumberOfPatches || numberOfBands < 1 ||
    numberOfBands > MaximumNumberOfBands)
  {
    vtkErrorMacro(<< numberOfPatches << " patches with " << numberOfBands
                  << " bands: OpenGL takes 1 to " << MaximumNumberOfPatches << " patches and 1 to "
                  << int(MaximumNumberOfBands) << " bands. Set Device to CPU for more.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Initialize(const Patches& patches, int numberOfBands, const double* source,
  const double* reflectance)
{
  this->Progress.reset();
  const auto count = static_cast<vtkIdType>(patches.Areas.size());
  if (!this->CheckSizes(count, numberOfBands))
  {
    return false;
  }
  if (Outcome open = this->Window->Open(); !open)
  {
    vtkErrorMacro("No OpenGL context: " << open.GetMessage());
    return false;
  }
  this->Progress = std::make_unique<ProgressiveShooter>(this->Window->Get(), patches,
    std::vector<double>(reflectance, reflectance + count * numberOfBands), this->Overshooting);
  if (!this->Progress->IsAlive())
  {
    vtkErrorMacro("This OpenGL cannot make floating-point textures: set Device to CPU.");
    this->Progress.reset();
    return false;
  }
  if (!this->Begin(source))
  {
    this->Progress.reset();
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::Begin(const double* source)
{
  const DeviceSession session(this->Window->Get());
  if (Outcome allocated = this->Progress->AllocateVectors(); !allocated)
  {
    vtkErrorMacro(<< allocated.GetMessage() << ": set Device to CPU.");
    return false;
  }
  if (!this->Progress->Begin(source, this->Resolution))
  {
    vtkErrorMacro(<< this->Progress->GetNumberOfPatches()
                  << " patches do not fit into the memory of " << this->GetDeviceName()
                  << ": set Device to CPU.");
    return false;
  }
  return Finish(this, Outcome::Done(), "taking the scene");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::IsReady()
{
  if (!this->Progress || !this->Progress->IsAlive())
  {
    vtkErrorMacro("There is no scene, or its window has gone: call Initialize() first.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkIdType vtkOpenGLShooter::Shoot(vtkIdType numberOfShots)
{
  if (!this->IsReady())
  {
    return -1;
  }
  const DeviceSession session(this->Window->Get());
  vtkIdType shots = 0;
  while (shots < numberOfShots)
  {
    std::vector<ProgressiveShooter::Shooter> shooters;
    if (!Finish(this, this->Progress->FindShooters(shooters), "choosing a shooter"))
    {
      return -1;
    }
    if (shooters.empty())
    {
      break;
    }
    const auto left = static_cast<std::size_t>(numberOfShots - shots);
    shooters.erase(shooters.begin() + std::min(shooters.size(), left), shooters.end());
    if (!Finish(this, this->Progress->ShootFrom(shooters, this->EyePointDensity), "shooting"))
    {
      return -1;
    }
    shots += static_cast<vtkIdType>(shooters.size());
  }
  return shots;
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetLargestUnshot(double* perBand)
{
  if (!this->IsReady())
  {
    return false;
  }
  const DeviceSession session(this->Window->Get());
  return Finish(this, this->Progress->GetLargestUnshot(perBand),
    "looking for the largest unshot radiosity");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetIrradiance(double* values)
{
  if (!this->IsReady())
  {
    return false;
  }
  const DeviceSession session(this->Window->Get());
  this->Progress->GetIrradiance(values);
  return Finish(this, Outcome::Done(), "reading the irradiance");
}

//------------------------------------------------------------------------------
bool vtkOpenGLShooter::GetUnshot(double* values)
{
  if (!this->IsReady())
  {
    return false;
  }
  const DeviceSession session(this->Window->Get());
  this->Progress->GetUnshot(values);
  return Finish(this, Outcome::Done(), "reading the unshot radiosity");
}
