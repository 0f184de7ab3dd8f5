// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkOpenGLShooter.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Device/DeviceSession.h"
#include "Device/DeviceWindow.h"
#include "Shooting/ProgressiveShooter.h"

#include "vtkObjectFactory.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <limits>

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
constexpr std::size_t AllEyes = std::numeric_limits<std::size_t>::max();
constexpr vtkIdType AllShots = VTK_ID_MAX;

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
void vtkOpenGLShooter::SetRenderWindow(vtkRenderWindow* window)
{
  if (!this->Window->IsUserWindow(window))
  {
    this->Progress.reset();
    this->Window->SetUserWindow(window);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkRenderWindow* vtkOpenGLShooter::GetRenderWindow()
{
  return this->Window->GetUserWindow();
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
// Chooses who shoots next, unless somebody does. False after an error, which has been reported.
bool vtkOpenGLShooter::AimAtNext(vtkIdType most)
{
  std::vector<ProgressiveShooter::Shooter> shooters;
  if (!Finish(this, this->Progress->FindShooters(shooters), "choosing a shooter"))
  {
    return false;
  }
  const auto left = static_cast<std::size_t>(most);
  shooters.erase(shooters.begin() + std::min(shooters.size(), left), shooters.end());
  this->Aimed = static_cast<vtkIdType>(shooters.size());
  if (!shooters.empty())
  {
    this->Progress->Aim(shooters, this->EyePointDensity);
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
    if (!this->Progress->IsShooting() && !this->AimAtNext(numberOfShots - shots))
    {
      return -1;
    }
    if (!this->Progress->IsShooting())
    {
      break;
    }
    if (!Finish(this, this->Progress->ShootNext(AllEyes), "shooting"))
    {
      return -1;
    }
    shots += this->Aimed;
  }
  return shots;
}

//------------------------------------------------------------------------------
// A single eye point at first; then as many as there is time for. Drawing is waited for: what has
// been begun would make the frame late.
vtkIdType vtkOpenGLShooter::ShootFor(double seconds, bool& isOver)
{
  isOver = false;
  if (!this->IsReady())
  {
    return -1;
  }
  const DeviceSession session(this->Window->Get());
  const double begin = vtkTimerLog::GetUniversalTime();
  double now = begin;
  if (!this->Progress->IsShooting())
  {
    if (!this->AimAtNext(AllShots))
    {
      return -1;
    }
    isOver = !this->Progress->IsShooting();
    glFinish();
    now = vtkTimerLog::GetUniversalTime();
  }
  bool isFirst = true;
  while (this->Progress->IsShooting() && (isFirst || now + this->SecondsPerEye <= begin + seconds))
  {
    const double left = begin + seconds - now;
    const double room = this->SecondsPerEye > 0.0 ? left / this->SecondsPerEye : 1.0;
    const auto eyes =
      static_cast<std::size_t>(std::min(std::max(room, 1.0), double(HemisphereItems::MostEyes)));
    if (!Finish(this, this->Progress->ShootNext(eyes), "shooting"))
    {
      return -1;
    }
    glFinish();
    const double before = now;
    now = vtkTimerLog::GetUniversalTime();
    this->SecondsPerEye = (now - before) / static_cast<double>(eyes);
    isFirst = false;
  }
  return isOver || this->Progress->IsShooting() ? 0 : this->Aimed;
}

//------------------------------------------------------------------------------
vtkTextureObject* vtkOpenGLShooter::ComputeRadiosity(bool ambient)
{
  if (!this->IsReady())
  {
    return nullptr;
  }
  const DeviceSession session(this->Window->Get());
  return Finish(this, this->Progress->ComputeRadiosity(ambient), "adding up the radiosity")
    ? this->Progress->GetRadiosity()[0].Get()
    : nullptr;
}

//------------------------------------------------------------------------------
double vtkOpenGLShooter::GetBandScale(int band)
{
  const bool isThere =
    this->Progress && band >= 0 && band < static_cast<int>(this->Progress->GetScales().size());
  return isThere ? this->Progress->GetScales()[band] : 0.0;
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
