// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/ProgressiveShooter.h"

#include "Context/OpenGLFunctions.h"

#include "vtkOpenGLState.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace LightTransport
{
namespace
{
enum Slot
{
  Unshot,
  Shot, ///< what a patch would shoot: Unshot and its share of the ambient radiosity
  OwnReflectance,
  ReflectancePerArea,
  Area,     ///< in every band
  Received, ///< power, by the shots under way
  Power,    ///< all power received
  Source,
  Radiosity, ///< so far
  Scratch
};

/// Candidates with less than this fraction of the best one's power wait.
constexpr float LeastPower = 0.5f;
///@{ Pixels along a side of a face, where nobody chooses.
constexpr int LowestResolution = 64;
constexpr int HighestResolution = 1024;
///@}
} // namespace

//------------------------------------------------------------------------------
ProgressiveShooter::ProgressiveShooter(vtkOpenGLRenderWindow* window,
  const vtkDeviceShooter::Patches& patches, const std::vector<double>& reflectance,
  bool overshooting)
  : Scene(patches), Reflectance(reflectance),
    Bands(static_cast<int>(reflectance.size() / patches.Areas.size())),
    Ambient(overshooting, this->Scene.GetAreas(), reflectance), Engine(window),
    Vectors(this->Engine), Items(&this->Engine), Brightest(this->Engine)
{
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::AllocateVectors()
{
  return this->Vectors.Initialize(this->Scene.GetNumberOfPatches(), this->Bands, 0);
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::Begin(const double* source, int resolution)
{
  if (Outcome allocated = this->Brightest.Allocate(this->Vectors.GetLayout()); !allocated)
  {
    return allocated;
  }
  const int automatic = static_cast<int>(std::sqrt(this->Scene.GetNumberOfPatches()));
  const int chosen = resolution > 0
    ? resolution
    : std::min(std::max(automatic, LowestResolution), HighestResolution);
  if (Outcome uploaded = this->Scene.Upload(this->Items, chosen / 2 * 2); !uploaded)
  {
    return uploaded;
  }
  this->ComputeScales(source);
  this->MeanReflectance = this->GetMeanReflectance();
  return this->SetMaterials(source);
}

//------------------------------------------------------------------------------
// Bands are scaled to a largest source of 1: single precision has too few exponents for some, and
// the brightest patch is the brightest of all bands alike.
void ProgressiveShooter::ComputeScales(const double* source)
{
  this->Scales.assign(static_cast<std::size_t>(this->Bands), 0.0);
  for (vtkIdType k = 0; k < this->GetSize(); ++k)
  {
    double& scale = this->Scales[k % this->Bands];
    scale = std::max(scale, std::abs(source[k]));
  }
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::SetMaterials(const double* source)
{
  const std::size_t size = this->Reflectance.size();
  std::vector<double> unshot(size, 0.0);
  std::vector<double> perArea(size);
  std::vector<double> areas(size);
  this->FirstPower = 0.0;
  for (std::size_t k = 0; k < size; ++k)
  {
    const double scale = this->Scales[k % this->Bands];
    const double area = this->Scene.GetAreas()[k / this->Bands];
    unshot[k] = scale > 0.0 ? source[k] / scale : 0.0;
    perArea[k] = this->Reflectance[k] / area;
    areas[k] = area;
    this->FirstPower += area * std::abs(unshot[k]);
  }
  const std::vector<double> nothing(size, 0.0);
  const std::pair<Slot, const double*> vectors[] = { { Unshot, unshot.data() },
    { Source, unshot.data() }, { OwnReflectance, this->Reflectance.data() },
    { ReflectancePerArea, perArea.data() }, { Area, areas.data() }, { Power, nothing.data() },
    { Received, nothing.data() } };
  for (const auto& vector : vectors)
  {
    if (Outcome set = this->Vectors.Set(vector.first, vector.second); !set)
    {
      return set;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::EndSweep()
{
  std::vector<double> squares(this->Scales.size());
  const Outcome drawn = this->Vectors.Dot(Unshot, Unshot, squares.data());
  if (drawn)
  {
    this->Ambient.EndSweep(std::accumulate(squares.begin(), squares.end(), 0.0));
  }
  return drawn;
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::ComputeShots()
{
  std::vector<double> power(this->Scales.size(), 0.0);
  if (this->Ambient.IsOn())
  {
    if (Outcome summed = this->Vectors.Dot(Unshot, Area, power.data()); !summed)
    {
      return summed;
    }
  }
  this->Ambient.SetUnshotPower(power);
  const std::vector<double> ones(this->Scales.size(), 1.0);
  return this->Vectors.Combine(Shot, ones.data(), Unshot,
    this->Ambient.GetAmbientRadiosity().data(), OwnReflectance);
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::FindShooters(std::vector<Shooter>& shooters)
{
  if (this->Ambient.IsSweepOver())
  {
    if (Outcome ended = this->EndSweep(); !ended)
    {
      return ended;
    }
  }
  if (Outcome computed = this->ComputeShots(); !computed)
  {
    return computed;
  }
  const Outcome found =
    this->Brightest.Find(shooters, this->Vectors.Get(Shot), { this->Vectors.Get(Area)[0] });
  if (found && !shooters.empty())
  {
    const float least = LeastPower * shooters[0].Power;
    shooters.erase(std::partition_point(shooters.begin(), shooters.end(),
                     [least](const Shooter& shooter) { return shooter.Power >= least; }),
      shooters.end());
  }
  return found;
}

//------------------------------------------------------------------------------
void ProgressiveShooter::Aim(const std::vector<Shooter>& shooters, double density)
{
  for (const Shooter& shooter : shooters)
  {
    const double wanted = density * shooter.Power / this->FirstPower;
    const double triangles = this->Scene.GetNumberOfTriangles(shooter.Index);
    const int divisions = static_cast<int>(std::ceil(std::sqrt(wanted / triangles)));
    const auto number = this->NumberOfEyePoints + static_cast<vtkTypeInt64>(this->Eyes.size());
    this->Scene.AddEyes(shooter.Index, std::max(divisions, 1), number, this->Eyes);
  }
  this->NumberOfEyePoints += static_cast<vtkTypeInt64>(this->Eyes.size());
  this->Ambient.AddShots(static_cast<vtkIdType>(shooters.size()));
  this->Aimed = shooters;
  this->NextEye = 0;
  this->Engine.Clear(this->Vectors.Get(Received));
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::ShootNext(std::size_t mostEyes)
{
  const std::size_t end = std::min(this->NextEye + mostEyes, this->Eyes.size());
  while (this->NextEye < end)
  {
    const std::size_t last = std::min(this->NextEye + HemisphereItems::MostEyes, end);
    if (Outcome drawn =
          this->Items.Shoot({ this->Eyes.data() + this->NextEye, this->Eyes.data() + last },
            this->Vectors.GetLayout(), this->Vectors.Get(Shot), this->Vectors.Get(Received));
        !drawn)
    {
      return drawn;
    }
    this->NextEye = last;
  }
  if (end < this->Eyes.size())
  {
    return Outcome::Done();
  }
  this->Eyes.clear();
  for (const Shooter& shooter : this->Aimed)
  {
    this->TakeAway(shooter.Index);
  }
  return this->Collect();
}

//------------------------------------------------------------------------------
// What a patch has shot is no longer unshot there: what it overshot is missing.
void ProgressiveShooter::TakeAway(int patch)
{
  vtkOpenGLState* state = this->Engine.GetWindow()->GetState();
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const FloatVectors::Layout& layout = this->Vectors.GetLayout();
  this->Engine.Bind(this->Vectors.Get(Unshot));
  state->vtkglScissor(patch % layout.Width, patch / layout.Width, 1, 1);
  state->vtkglEnable(GL_SCISSOR_TEST);
  for (int group = 0; group < layout.Groups; ++group)
  {
    float texel[4] = {};
    for (int lane = 0; lane < std::min(4, this->Bands - 4 * group); ++lane)
    {
      const int band = 4 * group + lane;
      const std::size_t k = static_cast<std::size_t>(patch) * this->Bands + band;
      texel[lane] =
        static_cast<float>(-this->Reflectance[k] * this->Ambient.GetAmbientRadiosity()[band]);
    }
    glClearBufferfv(GL_COLOR, group, texel);
  }
  state->vtkglDisable(GL_SCISSOR_TEST);
}

//------------------------------------------------------------------------------
// What is received adds to all power, and what is reflected of it can be shot.
Outcome ProgressiveShooter::Collect()
{
  const std::vector<double> ones(static_cast<std::size_t>(this->Bands), 1.0);
  if (Outcome added = this->Vectors.Combine(Power, ones.data(), Power, ones.data(), Received);
      !added)
  {
    return added;
  }
  if (Outcome reflected = this->Vectors.Scale(Scratch, ReflectancePerArea, Received); !reflected)
  {
    return reflected;
  }
  return this->Vectors.Combine(Unshot, ones.data(), Unshot, ones.data(), Scratch);
}

//------------------------------------------------------------------------------
std::vector<double> ProgressiveShooter::GetMeanReflectance() const
{
  std::vector<double> mean(static_cast<std::size_t>(this->Bands), 0.0);
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    mean[k % this->Bands] += this->Scene.GetAreas()[k / this->Bands] * this->Reflectance[k];
  }
  return mean;
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::ComputeRadiosity(bool ambient)
{
  std::vector<double> irradiance(static_cast<std::size_t>(this->Bands), 0.0);
  if (ambient)
  {
    if (Outcome summed = this->Vectors.Dot(Unshot, Area, irradiance.data()); !summed)
    {
      return summed;
    }
    std::transform(irradiance.begin(), irradiance.end(), this->MeanReflectance.begin(),
      irradiance.begin(),
      [](double power, double reflectance)
      { return reflectance < 1.0 ? std::max(power, 0.0) / (1.0 - reflectance) : 0.0; });
  }
  const std::vector<double> ones(static_cast<std::size_t>(this->Bands), 1.0);
  if (this->IsShooting())
  {
    // The part of the shots under way that has been handed out.
    const Outcome summed =
      this->Vectors.Combine(Radiosity, ones.data(), Power, ones.data(), Received);
    if (!summed)
    {
      return summed;
    }
  }
  if (Outcome reflected =
        this->Vectors.Scale(Scratch, ReflectancePerArea, this->IsShooting() ? Radiosity : Power);
      !reflected)
  {
    return reflected;
  }
  const Outcome added =
    this->Vectors.Combine(Scratch, ones.data(), Scratch, irradiance.data(), OwnReflectance);
  return added ? this->Vectors.Combine(Radiosity, ones.data(), Scratch, ones.data(), Source)
               : added;
}

//------------------------------------------------------------------------------
const FloatTextures::Group& ProgressiveShooter::GetRadiosity()
{
  return this->Vectors.Get(Radiosity);
}

//------------------------------------------------------------------------------
Outcome ProgressiveShooter::GetLargestUnshot(double* perBand)
{
  const Outcome drawn = this->Vectors.MaxNorm(Unshot, perBand);
  this->Unscale(perBand, this->Bands);
  return drawn;
}

//------------------------------------------------------------------------------
void ProgressiveShooter::GetIrradiance(double* values)
{
  this->Vectors.Read(Power, values);
  if (this->IsShooting())
  {
    std::vector<double> underWay(this->Reflectance.size());
    this->Vectors.Read(Received, underWay.data());
    std::transform(underWay.begin(), underWay.end(), values, values, std::plus<double>());
  }
  this->Unscale(values, this->GetSize());
  for (vtkIdType k = 0; k < this->GetSize(); ++k)
  {
    values[k] /= this->Scene.GetAreas()[k / this->Bands];
  }
}

//------------------------------------------------------------------------------
void ProgressiveShooter::GetUnshot(double* values)
{
  this->Vectors.Read(Unshot, values);
  this->Unscale(values, this->GetSize());
}

//------------------------------------------------------------------------------
// From patches x bands as they are on the device to the unit of the source.
void ProgressiveShooter::Unscale(double* values, vtkIdType size) const
{
  for (vtkIdType k = 0; k < size; ++k)
  {
    values[k] *= this->Scales[k % this->Bands];
  }
}
} // namespace LightTransport
