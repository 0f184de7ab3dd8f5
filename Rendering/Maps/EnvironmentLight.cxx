// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/EnvironmentLight.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
double GetBrightness(const EnvironmentPicture& picture, int column, int row)
{
  const double* value = picture.GetValue(column, row);
  return (std::abs(value[0]) + std::abs(value[1]) + std::abs(value[2])) * picture.GetPixelSize(row);
}

/// Pixels [First, Last) of a picture along its columns and rows.
struct Region
{
  int First[2];
  int Last[2];
  double Cost = 0.0; ///< brightness times the square of its size

  bool operator<(const Region& other) const { return this->Cost < other.Cost; }
  int GetLength(int axis) const { return this->Last[axis] - this->First[axis]; }

  /// Angle that it takes along columns or rows.
  double GetAngle(const EnvironmentPicture& picture, int axis) const
  {
    const double middle =
      0.5 * (this->First[1] + this->Last[1]) * vtkMath::Pi() / picture.Height; // from -z
    return axis == 0 ? 2.0 * vtkMath::Pi() * this->GetLength(0) / picture.Width * std::sin(middle)
                     : vtkMath::Pi() * this->GetLength(1) / picture.Height;
  }

  //----------------------------------------------------------------------------
  /// Sums of brightness over its lines along an axis.
  std::vector<double> GetSums(const EnvironmentPicture& picture, int axis) const
  {
    std::vector<double> sums(static_cast<std::size_t>(this->GetLength(axis)), 0.0);
    for (int row = this->First[1]; row < this->Last[1]; ++row)
    {
      for (int column = this->First[0]; column < this->Last[0]; ++column)
      {
        sums[axis == 0 ? column - this->First[0] : row - this->First[1]] +=
          GetBrightness(picture, column, row);
      }
    }
    return sums;
  }

  //----------------------------------------------------------------------------
  void FindCost(const EnvironmentPicture& picture)
  {
    double brightness = 0.0;
    for (const double sum : this->GetSums(picture, 1))
    {
      brightness += sum;
    }
    const double size = std::max(this->GetAngle(picture, 0), this->GetAngle(picture, 1));
    this->Cost = this->GetLength(0) * this->GetLength(1) > 1 ? brightness * size * size : 0.0;
  }

  //----------------------------------------------------------------------------
  /// Two halves of the same brightness, along the longer side.
  std::array<Region, 2> Divide(const EnvironmentPicture& picture) const
  {
    const bool isWide = this->GetAngle(picture, 0) >= this->GetAngle(picture, 1);
    const int axis = (isWide && this->GetLength(0) > 1) || this->GetLength(1) == 1 ? 0 : 1;
    const std::vector<double> sums = this->GetSums(picture, axis);
    double half = 0.0;
    for (const double sum : sums)
    {
      half += 0.5 * sum;
    }
    int cut = 0;
    for (double before = 0.0; cut < this->GetLength(axis) && before + 0.5 * sums[cut] < half;)
    {
      before += sums[cut++];
    }
    cut = std::min(std::max(cut, 1), this->GetLength(axis) - 1);
    std::array<Region, 2> halves = { *this, *this };
    halves[0].Last[axis] = this->First[axis] + cut;
    halves[1].First[axis] = this->First[axis] + cut;
    halves[0].FindCost(picture);
    halves[1].FindCost(picture);
    return halves;
  }

  //----------------------------------------------------------------------------
  /// All its light, from the middle of its brightness.
  SceneLight MakeLight(const EnvironmentPicture& picture) const
  {
    SceneLight light;
    light.Attenuation = { 1.0, 0.0, 0.0 };
    for (int row = this->First[1]; row < this->Last[1]; ++row)
    {
      for (int column = this->First[0]; column < this->Last[0]; ++column)
      {
        double direction[3];
        picture.GetDirection(column, row, direction);
        const double* value = picture.GetValue(column, row);
        const double size = picture.GetPixelSize(row);
        const double brightness = GetBrightness(picture, column, row);
        for (int k = 0; k < 3; ++k)
        {
          light.Color[k] += size * value[k];
          light.Axis[k] -= brightness * direction[k];
        }
      }
    }
    vtkMath::Normalize(light.Axis.data());
    return light;
  }
};

//------------------------------------------------------------------------------
/// P. Debevec, A median cut algorithm for light probe sampling, SIGGRAPH 2005 posters; what is
/// brightest and largest is divided next.
std::vector<SceneLight> FindDirections(const EnvironmentPicture& picture, int count)
{
  std::priority_queue<Region> regions;
  Region all{ { 0, 0 }, { picture.Width, picture.Height }, 0.0 };
  all.FindCost(picture);
  regions.push(all);
  while (static_cast<int>(regions.size()) < count && regions.top().Cost > 0.0)
  {
    Pulse::Beat();
    const Region largest = regions.top();
    regions.pop();
    for (const Region& half : largest.Divide(picture))
    {
      regions.push(half);
    }
  }
  std::vector<SceneLight> lights;
  for (; !regions.empty(); regions.pop())
  {
    const SceneLight light = regions.top().MakeLight(picture);
    if (vtkMath::Norm(light.Axis.data()) > 0.0)
    {
      lights.push_back(light);
    }
  }
  return lights;
}
} // namespace

//------------------------------------------------------------------------------
Outcome EnvironmentLight::Read(vtkImageData* picture, int degree, int directions)
{
  EnvironmentPicture source;
  Outcome read = source.Read(picture);
  if (read)
  {
    this->Harmonics = source.Project(degree);
    this->Directions =
      directions > 0 ? FindDirections(source, directions) : std::vector<SceneLight>();
  }
  return read;
}

//------------------------------------------------------------------------------
std::vector<double> EnvironmentLight::GetHarmonics(int degree,
  const SphericalHarmonics::Matrix& turn) const
{
  return SphericalHarmonics::Turn(degree, this->Harmonics, Bands, turn);
}

//------------------------------------------------------------------------------
std::vector<SceneLight> EnvironmentLight::GetDirections(
  const SphericalHarmonics::Matrix& turn) const
{
  std::vector<SceneLight> lights = this->Directions;
  for (SceneLight& light : lights)
  {
    const Vector3 axis = light.Axis;
    for (std::size_t k = 0; k < 3; ++k)
    {
      light.Axis[k] = turn[k] * axis[0] + turn[3 + k] * axis[1] + turn[6 + k] * axis[2];
    }
  }
  return lights;
}
} // namespace LightTransport
