// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Shooting/ShootingScene.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
/// The golden ratio's fraction: multiples of it fill [0, 1) evenly however many there are.
constexpr double GoldenTurn = 0.6180339887498949;

//------------------------------------------------------------------------------
/// Three perpendicular axes whose sum points along a normal, turned around it by `angle`.
void MakeAxes(const double normal[3], double angle, float axes[3][3])
{
  double u[3];
  double v[3];
  vtkMath::Perpendiculars(normal, u, v, angle);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double turn = 2.0 * vtkMath::Pi() / 3.0 * axis;
    for (int k = 0; k < 3; ++k)
    {
      const double across = std::cos(turn) * u[k] + std::sin(turn) * v[k];
      axes[axis][k] =
        static_cast<float>(std::sqrt(1.0 / 3.0) * normal[k] + std::sqrt(2.0 / 3.0) * across);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
ShootingScene::ShootingScene(const vtkDeviceShooter::Patches& patches)
  : Offsets(patches.Offsets), Corners(patches.Corners), Normals(patches.Normals),
    Areas(patches.Areas), Roundings(patches.Roundings), Slopes(patches.Slopes)
{
  const double whole = std::accumulate(this->Areas.begin(), this->Areas.end(), 0.0);
  std::for_each(this->Areas.begin(), this->Areas.end(), [whole](double& area) { area /= whole; });
  this->Roundings.resize(this->Areas.size(), 0.0);
  this->Slopes.resize(this->Areas.size(), 0.0);
  this->SetPoints(patches.Points);
}

//------------------------------------------------------------------------------
void ShootingScene::SetPoints(const std::vector<double>& coordinates)
{
  Vector low;
  Vector high;
  low.fill(VTK_DOUBLE_MAX);
  high.fill(-VTK_DOUBLE_MAX);
  for (std::size_t k = 0; k < coordinates.size(); ++k)
  {
    low[k % 3] = std::min(low[k % 3], coordinates[k]);
    high[k % 3] = std::max(high[k % 3], coordinates[k]);
  }
  const double diagonal = std::sqrt(vtkMath::Distance2BetweenPoints(low.data(), high.data()));
  std::for_each(this->Roundings.begin(), this->Roundings.end(),
    [diagonal](double& rounding) { rounding /= diagonal; });
  this->Points.resize(coordinates.size() / 3);
  for (std::size_t k = 0; k < coordinates.size(); ++k)
  {
    this->Points[k / 3][k % 3] = (coordinates[k] - 0.5 * (low[k % 3] + high[k % 3])) / diagonal;
  }
}

//------------------------------------------------------------------------------
int ShootingScene::GetNumberOfTriangles(int patch) const
{
  return static_cast<int>(this->Offsets[patch + 1] - this->Offsets[patch] - 2);
}

//------------------------------------------------------------------------------
Outcome ShootingScene::Upload(HemisphereItems& items, int resolution) const
{
  std::vector<float> points;
  for (const Vector& point : this->Points)
  {
    points.insert(points.end(),
      { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) });
  }
  std::vector<unsigned int> triangles;
  std::vector<int> patches;
  for (int patch = 0; patch < this->GetNumberOfPatches(); ++patch)
  {
    const vtkIdType first = this->Offsets[patch];
    for (vtkIdType corner = first + 1; corner + 1 < this->Offsets[patch + 1]; ++corner)
    {
      for (vtkIdType at : { first, corner, corner + 1 })
      {
        triangles.push_back(static_cast<unsigned int>(this->Corners[at]));
      }
      patches.push_back(patch);
    }
  }
  const double rounding = *std::max_element(this->Roundings.begin(), this->Roundings.end());
  return items.Allocate(points, triangles, patches, resolution, rounding);
}

//------------------------------------------------------------------------------
// Of the patch's area, in the order of its corners.
std::vector<double> ShootingScene::GetTriangleShares(int patch) const
{
  const vtkIdType first = this->Offsets[patch];
  const Vector& a = this->Points[this->Corners[first]];
  std::vector<double> areas;
  for (vtkIdType corner = first + 1; corner + 1 < this->Offsets[patch + 1]; ++corner)
  {
    double u[3];
    double v[3];
    double cross[3];
    vtkMath::Subtract(this->Points[this->Corners[corner]].data(), a.data(), u);
    vtkMath::Subtract(this->Points[this->Corners[corner + 1]].data(), a.data(), v);
    vtkMath::Cross(u, v, cross);
    areas.push_back(vtkMath::Norm(cross));
  }
  const double whole = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::for_each(areas.begin(), areas.end(), [whole](double& area) { area /= whole; });
  return areas;
}

//------------------------------------------------------------------------------
void ShootingScene::AddEyes(int patch, int divisions, vtkTypeInt64 number,
  std::vector<HemisphereItems::Eye>& eyes) const
{
  const vtkIdType first = this->Offsets[patch];
  const double* normal = &this->Normals[3 * static_cast<std::size_t>(patch)];
  const Vector& a = this->Points[this->Corners[first]];
  const std::vector<double> shares = this->GetTriangleShares(patch);
  for (vtkIdType triangle = 0; triangle < this->GetNumberOfTriangles(patch); ++triangle)
  {
    const Vector& b = this->Points[this->Corners[first + triangle + 1]];
    const Vector& c = this->Points[this->Corners[first + triangle + 2]];
    const double share = shares[triangle] / (divisions * divisions);
    for (int i = 0; i < divisions; ++i)
    {
      for (int j = 0; j < 2 * (divisions - i) - 1; ++j)
      {
        // Upright triangles and those between them, alternating along a row.
        const double third = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const double s = (i + third) / divisions;
        const double t = (j / 2 + third) / divisions;
        HemisphereItems::Eye eye;
        for (int k = 0; k < 3; ++k)
        {
          eye.Position[k] = static_cast<float>((1.0 - s - t) * a[k] + s * b[k] + t * c[k]);
        }
        // Pixels fall differently each time, so that their errors average out.
        const double turns = GoldenTurn * static_cast<double>(number++);
        MakeAxes(normal, 2.0 * vtkMath::Pi() * (turns - std::floor(turns)), eye.Axes);
        eye.Rounding = static_cast<float>(this->Roundings[patch]);
        eye.Slope = static_cast<float>(this->Slopes[patch]);
        eye.Shooter = patch;
        eye.Power = share * this->Areas[patch];
        eyes.push_back(eye);
      }
    }
  }
}
} // namespace LightTransport
