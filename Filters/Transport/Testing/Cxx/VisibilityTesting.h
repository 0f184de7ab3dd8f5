// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of visibility share: polygons, the exact view of a point past occluders, and
/// scenes made of polygons.
#ifndef VisibilityTesting_h
#define VisibilityTesting_h

#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "RandomNumbers.h"
#include "Scene/PatchScene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

using namespace LightTransport;

namespace VisibilityTesting
{
using LightTransportTesting::Corners;
using LightTransportTesting::Random;
using LightTransportTesting::Vector;

//------------------------------------------------------------------------------
inline Vector GetNormal(const Corners& corners)
{
  Vector twiceArea = Vector::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
  {
    twiceArea += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
  }
  return twiceArea.normalized();
}

//------------------------------------------------------------------------------
/// What of a polygon is in front of a plane.
inline Corners Cut(const Corners& polygon, const Vector& on, const Vector& normal)
{
  Corners front;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vector& from = polygon[k];
    const Vector& to = polygon[(k + 1) % polygon.size()];
    const double heightFrom = (from - on).dot(normal);
    const double heightTo = (to - on).dot(normal);
    if (heightFrom >= 0.0)
    {
      front.push_back(from);
    }
    if (heightFrom * heightTo < 0.0)
    {
      front.push_back(from + heightFrom / (heightFrom - heightTo) * (to - from));
    }
  }
  return front.size() > 2 ? front : Corners();
}

//------------------------------------------------------------------------------
/// Lambert's formula: pi times the factor from a point to a polygon in front of its plane.
inline double GetFlux(const Corners& polygon, const Vector& point, const Vector& normal)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Vector a = polygon[k] - point;
    const Vector b = polygon[(k + 1) % polygon.size()] - point;
    const Vector cross = a.cross(b);
    const double sine = cross.norm();
    if (sine > 0.0)
    {
      sum += std::atan2(sine, a.dot(b)) / sine * cross.dot(normal);
    }
  }
  return std::abs(0.5 * sum);
}

//------------------------------------------------------------------------------
/// What of a polygon is left when all that lies in the cone from the point over the occluders (all
/// on this side of the polygon's plane) is taken away.
inline std::vector<Corners> GetVisibleParts(const Corners& target,
  const std::vector<Corners>& occluders, const Vector& point)
{
  std::vector<Corners> parts(1, target);
  for (const Corners& occluder : occluders)
  {
    const Vector facing = GetNormal(occluder);
    const double side = facing.dot(occluder[0] - point) > 0.0 ? 1.0 : -1.0;
    std::vector<Corners> left;
    for (Corners& part : parts)
    {
      for (std::size_t k = 0; k < occluder.size() && !part.empty(); ++k)
      {
        const Vector from = occluder[k] - point;
        const Vector inward = side * from.cross(occluder[(k + 1) % occluder.size()] - point);
        const Corners outside = Cut(part, point, -inward);
        if (!outside.empty())
        {
          left.push_back(outside);
        }
        part = Cut(part, point, inward);
      }
    }
    parts = left;
  }
  return parts;
}

//------------------------------------------------------------------------------
inline double GetVisibleFlux(const Corners& target, const std::vector<Corners>& occluders,
  const Vector& point, const Vector& normal)
{
  double sum = 0.0;
  for (const Corners& part : GetVisibleParts(target, occluders, point))
  {
    sum += GetFlux(part, point, normal);
  }
  return sum;
}

//------------------------------------------------------------------------------
/// A scene of polygons; its patches are in another order (PatchScene::GetPatch).
inline bool BuildScene(const std::vector<Corners>& polygons, PatchScene& scene)
{
  LightTransportTesting::Surface surface;
  for (const Corners& polygon : polygons)
  {
    std::vector<LightTransportTesting::Point> points;
    for (const Vector& corner : polygon)
    {
      points.push_back({ corner.x(), corner.y(), corner.z() });
    }
    surface.AddPolygon(points);
  }
  return LightTransportTesting::CheckDone(scene.Build(surface.Get(), Ranks()), "scene");
}

//------------------------------------------------------------------------------
inline Corners GetCorners(const PatchScene& scene, vtkIdType patch)
{
  Corners corners;
  for (int k = 0; k < scene.GetNumberOfCorners(patch); ++k)
  {
    corners.push_back(scene.GetCorner(patch, k));
  }
  return corners;
}
} // namespace VisibilityTesting

#endif
