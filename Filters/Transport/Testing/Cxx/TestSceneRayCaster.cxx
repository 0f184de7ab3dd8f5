// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Rays where single precision cannot tell: edges, vertices, gaps, tiny patches, patches in one
// plane. Every answer is known from the construction.
#include "Geometry/PatchSampler.h"
#include "Geometry/SceneRayCaster.h"
#include "LightTransportTesting.h"
#include "OutcomeTesting.h"
#include "Scene/PatchScene.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <memory>
#include <random>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = PatchScene::Vector;

//------------------------------------------------------------------------------
struct Scene
{
  PatchScene Patches;
  SceneRayCaster Caster;

  explicit Scene(vtkPolyData* data, const std::vector<bool>* subset = nullptr)
  {
    CheckDone(this->Patches.Build(data, Ranks()), "scene");
    CheckDone(this->Caster.Build(this->Patches, subset), "caster");
  }

  /// Input coordinates to scene coordinates.
  Vector Map(double x, double y, double z) const
  {
    return (Vector(x, y, z) - this->Patches.GetCenter()) / this->Patches.GetScale();
  }

  vtkIdType FindHit(const Vector& origin, const Vector& direction, vtkIdType from) const
  {
    bool front = false;
    return this->Caster.FindHit(origin, direction, from, front);
  }

  bool HasCorner(vtkIdType patch, vtkIdType point) const
  {
    const vtkIdType* corners = this->Patches.GetCorners(patch);
    const vtkIdType* end = corners + this->Patches.GetNumberOfCorners(patch);
    return std::find(corners, end, point) != end;
  }

  Vector Sample(vtkIdType patch, int index) const
  {
    Polygon polygon;
    polygon.Count = this->Patches.GetNumberOfCorners(patch);
    for (int corner = 0; corner < polygon.Count; ++corner)
    {
      polygon.Corners[corner] = this->Patches.GetCorner(patch, corner);
    }
    polygon.Normal = this->Patches.GetNormal(patch);
    return PatchSampler(static_cast<std::uint64_t>(patch)).GetPoint(polygon, index, 0);
  }
};

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Turn(vtkPolyData* data)
{
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(37.0, 0.3, 0.5, 0.8);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetInputData(data);
  filter->SetTransform(turn);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeSphere(int levels, bool inward)
{
  Surface sphere;
  AddSphere(sphere, 1.0, levels, inward);
  return sphere.Get();
}

//------------------------------------------------------------------------------
// A ray at an edge or a corner from inside meets a patch that has it, and does not get past it.
void TestLeaks(vtkPolyData* data, const std::string& name)
{
  const Scene scene(data);
  const PatchScene& patches = scene.Patches;
  std::mt19937 random(11);
  const auto draw = [&random]() { return static_cast<double>(random() >> 5) * 0x1p-27; };
  int rays = 0, missed = 0, passed = 0, wrong = 0;
  while (rays < 50000)
  {
    const vtkIdType from = random() % patches.GetNumberOfPatches();
    const vtkIdType at = random() % patches.GetNumberOfPatches();
    const int corner = static_cast<int>(random() % patches.GetNumberOfCorners(at));
    const vtkIdType* corners = patches.GetCorners(at);
    const vtkIdType a = corners[corner];
    const vtkIdType b = corners[(corner + 1) % patches.GetNumberOfCorners(at)];
    const double along = rays % 2 == 0 ? 0.0 : draw();
    const Vector target =
      patches.GetPoints()[a] + along * (patches.GetPoints()[b] - patches.GetPoints()[a]);
    const Vector origin = scene.Sample(from, rays);
    if ((target - origin).dot(patches.GetNormal(from)) < 1e-3)
    {
      continue; // the edge is one of the patch's own, or in its plane
    }
    ++rays;
    const vtkIdType hit = scene.FindHit(origin, target - origin, from);
    missed += hit < 0 ? 1 : 0;
    wrong += hit >= 0 && !(scene.HasCorner(hit, a) && (along == 0.0 || scene.HasCorner(hit, b)));
    const Vector beyond = origin + 1.25 * (target - origin);
    passed += scene.Caster.IsOccluded(origin, beyond, from, -1) ? 0 : 1;
  }
  Check(missed == 0, name + ": rays that meet nothing: " + std::to_string(missed));
  Check(passed == 0, name + ": rays that get out: " + std::to_string(passed));
  Check(wrong == 0, name + ": rays that meet another patch: " + std::to_string(wrong));
}

//------------------------------------------------------------------------------
// From a convex body or a flat wall no ray meets it again, however flat it leaves or however near
// to an edge. (Both at once pass the edge at less than rounding.)
void TestSelfHits(vtkPolyData* data, const std::string& name)
{
  const Scene scene(data);
  const PatchScene& patches = scene.Patches;
  int hits = 0;
  for (vtkIdType patch = 0; patch < patches.GetNumberOfPatches(); ++patch)
  {
    const Vector& normal = patches.GetNormal(patch);
    const PatchSampler sampler(static_cast<std::uint64_t>(patch));
    for (int ray = 0; ray < 64; ++ray)
    {
      Vector origin = scene.Sample(patch, ray);
      if (ray % 2 == 0)
      {
        const Vector& a = patches.GetCorner(patch, 0);
        const Vector edge = patches.GetCorner(patch, 1) - a;
        origin = a + 0.01 * ray * edge + 1e-9 * normal.cross(edge);
      }
      Vector direction = sampler.GetDirection(normal, ray, 2);
      if (ray % 4 == 1)
      {
        direction -= (1.0 - 1e-6) * direction.dot(normal) * normal;
      }
      hits += scene.FindHit(origin, direction, patch) < 0 ? 0 : 1;
    }
  }
  Check(hits == 0, name + ": rays that meet their own body: " + std::to_string(hits));
}

//------------------------------------------------------------------------------
void TestGap(double gap, bool screened)
{
  constexpr int n = 8;
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  plates.AddGrid({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  if (screened)
  {
    plates.AddGrid({ 0, 0, 0.5 * gap }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  }
  const Scene scene(plates.Get());
  const std::string name = "gap of " + std::to_string(gap * 1e9) + "e-9";
  for (int i = 0; i < n * n; ++i)
  {
    const vtkIdType below = scene.Patches.GetPatch(i);
    for (int j = 0; j < n * n; ++j)
    {
      const vtkIdType above = scene.Patches.GetPatch(n * n + j);
      Check(scene.Caster.IsOccluded(scene.Sample(below, i + j), scene.Sample(above, i * j), below,
              above) == screened,
        name + ": rays from plate to plate");
    }
    bool front = false;
    const Vector origin = scene.Patches.GetCentroid(below);
    const vtkIdType hit =
      scene.Caster.FindHit(origin, scene.Patches.GetNormal(below), below, front);
    const vtkIdType polygon = hit < 0 ? -1 : scene.Patches.GetPolygon(hit);
    Check(screened ? polygon >= 2 * n * n && !front : polygon == n * n + i % n * n + i / n && front,
      name + ": the first patch across it is " + std::to_string(polygon));
  }
}

//------------------------------------------------------------------------------
// The outline of an occluder of any size, between two plates of size 1.
void TestOutline(double size, double margin)
{
  Surface surface;
  surface.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  surface.AddPolygon({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } });
  const Vector center(0.317, 0.229, 0.371);
  const Vector sides[3] = { { 0.3, 0.1, 0.2 }, { -0.2, 0.3, -0.1 }, { -0.1, -0.4, -0.1 } };
  std::vector<Point> corners;
  for (const Vector& side : sides)
  {
    const Vector corner = center + size * side;
    corners.push_back({ corner.x(), corner.y(), corner.z() });
  }
  surface.AddPolygon(corners);
  const Scene scene(surface.Get());
  const PatchScene& patches = scene.Patches;
  const vtkIdType occluder = patches.GetPatch(2);
  int wrong = 0;
  for (int ray = 0; ray < 3000; ++ray)
  {
    const Vector origin = scene.Sample(patches.GetPatch(0), ray);
    const Vector& a = patches.GetCorner(occluder, ray % 3);
    const Vector& b = patches.GetCorner(occluder, (ray + 1) % 3);
    const Vector edge = a + (ray % 101) / 100.0 * (b - a);
    for (const double side : { -margin, margin })
    {
      const Vector through = edge + side * (edge - patches.GetCentroid(occluder));
      const Vector target =
        origin + (through - origin) * (0.4 / std::abs(through.z() - origin.z()));
      wrong +=
        scene.Caster.IsOccluded(origin, target, patches.GetPatch(0), -1) == (side < 0.0) ? 0 : 1;
    }
  }
  Check(wrong == 0,
    "outline of an occluder of " + std::to_string(size * 1e9) +
      "e-9: wrong rays: " + std::to_string(wrong));
}

//------------------------------------------------------------------------------
// Sheets that single precision cannot tell apart: the nearest one is found.
void TestNearest()
{
  Surface sheets;
  sheets.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  for (const int k : { 3, 1, 0, 2 })
  {
    const double z = 0.75 + k * 1e-9;
    sheets.AddPolygon({ { 0, 0, z }, { 0, 1, z }, { 1, 1, z }, { 1, 0, z } });
  }
  const Scene scene(sheets.Get());
  for (int i = 0; i < 4; ++i)
  {
    const vtkIdType from = scene.Patches.GetPatch(i);
    for (int ray = 0; ray < 100; ++ray)
    {
      const Vector origin = scene.Sample(from, ray);
      const Vector target = scene.Map(0.01 * ray, 0.5, 0.75);
      const vtkIdType hit = scene.FindHit(origin, target - origin, from);
      Check(hit == scene.Patches.GetPatch(6), "the nearest sheet");
    }
  }
}

//------------------------------------------------------------------------------
// A wall of two sheets in one place that are cut differently: each side sees its own sheet, and the
// other one does not stop its rays.
void TestThinWall()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 4, 4);
  surface.AddGrid({ 0, 0, 0.5 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  surface.AddGrid({ 0, 0, -0.5 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  const Scene scene(Turn(surface.Get()));
  const PatchScene& patches = scene.Patches;
  for (vtkIdType polygon = 0; polygon < patches.GetNumberOfPatches(); ++polygon)
  {
    const vtkIdType patch = patches.GetPatch(polygon);
    for (int ray = 0; ray < 50; ++ray)
    {
      bool front = false;
      const vtkIdType hit =
        scene.Caster.FindHit(scene.Sample(patch, ray), patches.GetNormal(patch), patch, front);
      Check(hit >= 0 && front, "straight on there is the front of a plate");
      Check(hit >= 0 && (patches.GetPolygon(hit) >= 25) == (polygon < 25),
        "the sheets of a wall do not see each other");
    }
  }
}

//------------------------------------------------------------------------------
// Two patches that meet at a tiny angle: in a groove each sees the other, on a ridge neither does.
void TestTinyAngle(double angle)
{
  for (const double height : { angle, -angle })
  {
    Surface surface;
    surface.AddPolygon({ { 0, 0, 0 }, { 1, 0, height }, { 1, 1, height }, { 0, 1, 0 } });
    surface.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { -1, 1, height }, { -1, 0, height } });
    const Scene scene(Turn(surface.Get()));
    const PatchScene& patches = scene.Patches;
    for (int i = 0; i < 2; ++i)
    {
      const vtkIdType from = patches.GetPatch(i);
      const vtkIdType to = patches.GetPatch(1 - i);
      for (int ray = 0; ray < 100; ++ray)
      {
        const Vector origin = scene.Sample(from, ray);
        const Vector along = scene.Sample(to, ray) - origin;
        // On the ridge just over the own plane, the lowest that a ray can be.
        const Vector& normal = patches.GetNormal(from);
        const double lift = 0.1 * angle * along.norm() - along.dot(normal);
        const Vector direction = along + (height > 0.0 ? 0.0 : lift) * normal;
        Check(scene.FindHit(origin, direction, from) == (height > 0.0 ? to : -1),
          "a ray over an angle of " + std::to_string(height * 1e9) + "e-9");
        Check(!scene.Caster.IsOccluded(origin, origin + along, from, to), "own patches");
      }
    }
  }
}

//------------------------------------------------------------------------------
void TestSubset()
{
  Surface surface;
  for (const double z : { 0.0, 1.0, 2.0 })
  {
    surface.AddPolygon({ { 0, 0, z }, { 1, 0, z }, { 1, 1, z }, { 0, 1, z } });
  }
  auto data = surface.Get();
  const Scene all(data);
  std::vector<bool> subset(3, true);
  subset[all.Patches.GetPatch(1)] = false;
  const Scene some(data, &subset);
  const vtkIdType low = all.Patches.GetPatch(0);
  const vtkIdType high = all.Patches.GetPatch(2);
  const Vector a = all.Patches.GetCentroid(low);
  const Vector b = all.Patches.GetCentroid(high);
  Check(all.Caster.IsOccluded(a, b, low, high), "the patch between");
  Check(!some.Caster.IsOccluded(a, b, low, high), "a patch that is left out");
  Check(some.FindHit(a, b - a, low) == high, "patches that are not");
}
} // namespace

//------------------------------------------------------------------------------
int TestSceneRayCaster(int, char*[])
{
  TestLeaks(MakeSphere(3, true), "sphere");
  TestLeaks(Turn(MakeRoom(6)), "room");
  TestSelfHits(MakeSphere(3, false), "sphere");
  Surface wall;
  wall.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 40, 40);
  TestSelfHits(wall.Get(), "wall");
  TestSelfHits(Turn(wall.Get()), "slanted wall");
  for (const double gap : { 1e-9, 1e-6, 1e-3 })
  {
    TestGap(gap, false);
    TestGap(gap, true);
  }
  TestOutline(0.1, 1e-9);
  TestOutline(1e-3, 1e-7);
  TestOutline(1e-6, 1e-4);
  TestOutline(1e-9, 0.01);
  TestNearest();
  TestThinWall();
  for (const double angle : { 1e-9, 1e-6, 1e-3 })
  {
    TestTinyAngle(angle);
  }
  TestSubset();
  return Result();
}
