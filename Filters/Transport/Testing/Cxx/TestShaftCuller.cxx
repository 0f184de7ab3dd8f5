// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Shaft culling never leaves out a patch that hides anything, leaves out most others, and knows
// scenes in which nothing can be in between; walls are what patches beside each other in one plane
// fill.

#include "Geometry/ShaftCuller.h"
#include "VisibilityTesting.h"

#include <set>

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace VisibilityTesting;

namespace
{
using Walls = std::vector<vtkIdType>;

//------------------------------------------------------------------------------
// Whether a segment crosses a patch, well inside both.
bool Crosses(const PatchScene& scene, vtkIdType patch, const Vector& from, const Vector& to)
{
  const Corners corners = GetCorners(scene, patch);
  const Vector& normal = scene.GetNormal(patch);
  const double heightFrom = (from - corners[0]).dot(normal);
  const double heightTo = (to - corners[0]).dot(normal);
  if (heightFrom * heightTo >= 0.0 || std::min(std::abs(heightFrom), std::abs(heightTo)) < 1e-6)
  {
    return false;
  }
  const Vector place = from + heightFrom / (heightFrom - heightTo) * (to - from);
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vector edge = corners[(k + 1) % corners.size()] - corners[k];
    if (normal.cross(edge).normalized().dot(place - corners[k]) < 1e-6)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
Vector GetPoint(const PatchScene& scene, vtkIdType patch, Random& random)
{
  const Corners corners = GetCorners(scene, patch);
  const auto last = static_cast<double>(corners.size() - 1);
  const auto k = 1 + static_cast<std::size_t>(random.Uniform(0.0, last - 1.0));
  const double s = std::sqrt(random.Uniform());
  return corners[0] + s * (corners[k] - corners[0]) +
    s * random.Uniform() * (corners[k + 1] - corners[k]);
}

//------------------------------------------------------------------------------
// The walls that some segments between two patches cross; of bodies that the first one is outside
// of those that face it.
std::set<vtkIdType> GetCrossed(const PatchScene& scene, const OccluderWalls& walls, vtkIdType i,
  vtkIdType j, int count, Random& random)
{
  std::set<vtkIdType> crossed;
  for (int k = 0; k < count; ++k)
  {
    const Vector from = GetPoint(scene, i, random);
    const Vector to = GetPoint(scene, j, random);
    // What is behind one of both is in between for no exchange.
    if ((to - from).dot(scene.GetNormal(i)) <= 0.0 || (from - to).dot(scene.GetNormal(j)) <= 0.0)
    {
      continue;
    }
    for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
    {
      const bool isBack = walls.GetBodies().IsOutside(i) &&
        walls.GetBodies().GetBody(walls.GetWall(patch)) >= 0 &&
        (from - scene.GetCentroid(patch)).dot(scene.GetNormal(patch)) < 0.0;
      if (patch != i && patch != j && !isBack && Crosses(scene, patch, from, to))
      {
        crossed.insert(walls.GetWall(patch));
      }
    }
  }
  return crossed;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> GetWalls(const std::vector<ShaftCuller::Occluder>& found)
{
  std::vector<vtkIdType> walls;
  for (const ShaftCuller::Occluder& occluder : found)
  {
    walls.push_back(occluder.Wall);
  }
  std::sort(walls.begin(), walls.end());
  return walls;
}

//------------------------------------------------------------------------------
bool Holds(const Walls& found, const std::set<vtkIdType>& wanted)
{
  return std::includes(found.begin(), found.end(), wanted.begin(), wanted.end());
}

//------------------------------------------------------------------------------
// Down the tree from the root to the leaves of two patches: lists only shrink, and at their end is
// what a search of the whole scene finds.
void CheckDescent(const PatchScene& scene, const ShaftCuller& culler, vtkIdType i, vtkIdType j,
  const std::set<vtkIdType>& crossed, const std::string& what)
{
  const auto getChild = [&](int node, vtkIdType patch)
  {
    const PatchTree& tree = scene.GetTree();
    const int left = tree.GetNode(node).Left;
    return tree.GetNode(node).IsLeaf() ? node : (patch < tree.GetNode(left).Last ? left : left + 1);
  };
  int nodeI = 0;
  int nodeJ = 0;
  ShaftCuller::Candidates list, direct, next;
  ShaftCuller::SideCache sides;
  culler.Find(nodeI, nodeJ, list);
  culler.KeepParting(nodeI, nodeJ, sides, list);
  while (!scene.GetTree().GetNode(nodeI).IsLeaf() || !scene.GetTree().GetNode(nodeJ).IsLeaf())
  {
    nodeI = getChild(nodeI, i);
    nodeJ = getChild(nodeJ, j);
    culler.Narrow(nodeI, nodeJ, list, next);
    culler.KeepParting(nodeI, nodeJ, sides, next);
    culler.Find(nodeI, nodeJ, direct);
    culler.KeepParting(nodeI, nodeJ, sides, direct);
    Walls narrowed = next.Walls;
    std::sort(narrowed.begin(), narrowed.end());
    std::sort(direct.Walls.begin(), direct.Walls.end());
    Check(narrowed == direct.Walls, what + ": narrowed list of two nodes");
    Check(Holds(narrowed, crossed), what + ": list of two nodes");
    std::swap(list, next);
  }
  std::vector<ShaftCuller::Occluder> occluders;
  culler.NarrowBetween(i, j, list, occluders);
  const Walls narrowed = GetWalls(occluders);
  culler.FindBetween(i, j, occluders);
  const Walls found = GetWalls(occluders);
  Check(narrowed == found, what + ": narrowed list of two patches");
  Check(Holds(found, crossed), what + ": list of two patches");
}

//------------------------------------------------------------------------------
// `most`: of all patches, what lists may hold on average for each patch that is crossed.
void CheckScene(const std::vector<Corners>& polygons, double most, const std::string& what)
{
  PatchScene scene;
  if (!BuildScene(polygons, scene))
  {
    return;
  }
  const ShaftCuller culler(scene);
  Check(culler.HasOccluders(), what + ": has occluders");
  Random random(11);
  const auto count = static_cast<double>(scene.GetNumberOfPatches());
  double listed = 0.0;
  double crossings = 0.0;
  constexpr int pairs = 150;
  for (int k = 0; k < pairs; ++k)
  {
    const auto i = static_cast<vtkIdType>(random.Uniform(0.0, count));
    const auto j = static_cast<vtkIdType>(random.Uniform(0.0, count));
    if (i == j)
    {
      continue;
    }
    const std::set<vtkIdType> crossed = GetCrossed(scene, culler.GetWalls(), i, j, 60, random);
    CheckDescent(scene, culler, i, j, crossed, what);
    std::vector<ShaftCuller::Occluder> found;
    culler.FindBetween(i, j, found);
    listed += static_cast<double>(found.size());
    crossings += static_cast<double>(crossed.size());
  }
  Check(crossings > 0.0, what + ": something is between");
  Check(listed < most * pairs * count,
    what + ": " + std::to_string(listed / pairs) + " of " + std::to_string(count));
}

//------------------------------------------------------------------------------
std::vector<Corners> GetPolygons(vtkPolyData* data)
{
  std::vector<Corners> polygons;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    Corners corners(ids->GetNumberOfIds());
    for (std::size_t k = 0; k < corners.size(); ++k)
    {
      data->GetPoint(ids->GetId(static_cast<vtkIdType>(k)), corners[k].data());
    }
    polygons.push_back(corners);
  }
  return polygons;
}

//------------------------------------------------------------------------------
std::vector<Corners> MakeSphere(double radius, int levels, bool inward)
{
  Surface surface;
  AddSphere(surface, radius, levels, inward);
  return GetPolygons(surface.Get());
}

//------------------------------------------------------------------------------
std::vector<Corners> Join(std::vector<Corners> a, const std::vector<Corners>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

//------------------------------------------------------------------------------
std::vector<Corners> Transform(std::vector<Corners> polygons, const Eigen::Matrix3d& matrix,
  const Vector& shift)
{
  for (Corners& corners : polygons)
  {
    for (Vector& corner : corners)
    {
      corner = matrix * corner + shift;
    }
  }
  return polygons;
}

//------------------------------------------------------------------------------
std::vector<Corners> Flip(std::vector<Corners> polygons)
{
  for (Corners& corners : polygons)
  {
    std::reverse(corners.begin(), corners.end());
  }
  return polygons;
}

//------------------------------------------------------------------------------
void TestScenes()
{
  Random random(12);
  std::vector<Corners> soup;
  for (int k = 0; k < 400; ++k)
  {
    soup.push_back(random.Triangle(random.Point(), 0.15));
  }
  CheckScene(soup, 0.05, "soup");
  const std::vector<Corners> cube = GetPolygons(MakeRoom(4));
  std::vector<Corners> room = cube;
  for (int k = 0; k < 4; ++k)
  {
    const Eigen::Matrix3d matrix = 0.15 * random.Rotation();
    room = Join(room, Flip(Transform(cube, matrix, Vector(0.3 + 0.15 * k, 0.6 - 0.1 * k, 0.4))));
  }
  CheckScene(room, 0.1, "room with boxes");
  // The same far from where it was, turned and larger.
  CheckScene(Transform(room, 1e3 * random.Rotation(), { 1e4, -2e4, 3e4 }), 0.1, "turned room");
  CheckScene(Join(MakeSphere(3.0, 2, true), MakeSphere(1.0, 2, false)), 0.1, "two spheres");
  // As large as single precision allows beside as small.
  CheckScene(Join(MakeSphere(3.0, 1, true), Transform(room, 1e-3 * random.Rotation(), { 0, 0, 0 })),
    0.3, "a small room in a sphere");
}

//------------------------------------------------------------------------------
bool HasOccluders(const std::vector<Corners>& polygons)
{
  PatchScene scene;
  BuildScene(polygons, scene);
  return ShaftCuller(scene).HasOccluders();
}

//------------------------------------------------------------------------------
// Inside a convex body all patches have all others in front; outside, and as soon as something
// stands in it, not.
void TestConvexScenes()
{
  Random random(13);
  const std::vector<Corners> room = GetPolygons(MakeRoom(5));
  const std::vector<Corners> body = MakeSphere(2.0, 2, true);
  const Eigen::Matrix3d turn = 20.0 * random.Rotation();
  const Vector shift(300.0, -100.0, 50.0);
  Check(!HasOccluders(room), "a room");
  Check(!HasOccluders(Transform(room, turn, shift)), "a turned room");
  Check(!HasOccluders(body), "a convex body from inside");
  Check(!HasOccluders(Transform(body, turn, shift)), "a turned convex body from inside");
  Check(HasOccluders(Flip(room)), "a cube from outside");
  Check(HasOccluders(Flip(body)), "a convex body from outside");
  Check(HasOccluders(Join(room, { random.Triangle({ 0.5, 0.5, 0.5 }, 0.1) })),
    "a triangle in a room");
  const Corners dent{ { 0.4, 0.4, 1e-4 }, { 0.6, 0.4, 1e-4 }, { 0.5, 0.6, 1e-4 } };
  Check(HasOccluders(Join(room, { dent })), "a triangle just over the floor");
  Check(!HasOccluders({ room[0] }), "one patch");
}

//------------------------------------------------------------------------------
// Numbers of walls; corners of each; what belongs to one that is not all there is in its plane.
void TestWalls()
{
  Random random(14);
  const std::vector<Corners> room = GetPolygons(MakeRoom(5));
  const auto count = [](const std::vector<Corners>& polygons)
  {
    PatchScene scene;
    BuildScene(polygons, scene);
    return OccluderWalls(scene).GetNumberOfPatches();
  };
  CheckClose(static_cast<double>(count(room)), 6.0, 0.0, "walls of a room");
  CheckClose(
    static_cast<double>(count(Transform(room, 20.0 * random.Rotation(), { 300.0, -100.0, 50.0 }))),
    6.0, 0.0, "walls of a turned room");
  const std::vector<Corners> body = MakeSphere(2.0, 2, false);
  CheckClose(static_cast<double>(count(body)), static_cast<double>(body.size()), 0.0,
    "walls of a sphere");
  // Without one of its squares a face is no convex polygon.
  std::vector<Corners> holed(room.begin(), room.begin() + 25);
  holed.erase(holed.begin() + 12);
  Check(count(holed) > 1 && count(holed) <= 5, "walls around a hole");
  // Half of its hull, but there twice: from both sides, or by others that lie on it in part.
  const std::vector<Corners> notched{ { { -1, 0, 0 }, { 0, 1, 0 }, { 0, 2, 0 } },
    { { 0, 2, 0 }, { 0, 1, 0 }, { 1, 0, 0 } } };
  CheckClose(static_cast<double>(count(Join(notched, Flip(notched)))), 4.0, 0.0,
    "walls of both sides of a notched sheet");
  const std::vector<Corners> overlapping{ { { -1, 0, 0 }, { -0.25, 0.5, 0 }, { 0, 2, 0 } },
    { { 0, 2, 0 }, { 0.25, 0.5, 0 }, { 1, 0, 0 } } };
  CheckClose(static_cast<double>(count(Join(notched, overlapping))), 4.0, 0.0,
    "walls of patches that overlap");
}

//------------------------------------------------------------------------------
// What one wall hides from all points.
void TestHiding()
{
  PatchScene scene;
  const Corners lower{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const Corners upper{ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } };
  const Corners screen{ { 0, 0, 0.5 }, { 1, 0, 0.5 }, { 1, 1, 0.5 }, { 0, 1, 0.5 } };
  BuildScene({ lower, upper, screen }, scene);
  const OccluderWalls walls(scene);
  const auto getCorners = [&](vtkIdType polygon)
  { return GetCorners(scene, scene.GetPatch(polygon)); };
  const auto getWall = [&](vtkIdType polygon) { return walls.GetWall(scene.GetPatch(polygon)); };
  const Corners a = getCorners(0), b = getCorners(1);
  const auto hides = [&](vtkIdType polygon, const Corners& from, const Corners& to, bool strictly)
  {
    OccluderWalls::End ends[2];
    ends[0].Set(from, true);
    ends[1].Set(to, true);
    return walls.HidesAll(getWall(polygon), ends[0], ends[1], strictly);
  };
  Check(hides(2, a, b, true), "a screen as large as the plates hides them");
  Corners beside = b;
  beside[0] -= 0.01 * (beside[2] - beside[0]);
  Check(!hides(2, a, beside, true), "a corner is seen past it");
  Check(!hides(0, a, b, false), "a plate does not hide itself");
  Check(!hides(2, a, a, false), "nothing is between what is on one side");
  Corners touching = getCorners(2);
  touching[1] += 0.5 * (b[0] - a[0]);
  Check(!hides(2, a, touching, true), "it is on the plane in part");
  Check(hides(2, a, touching, false), "but behind it all the same");
}

//------------------------------------------------------------------------------
// A cube from outside, without some of its faces (5 x 5 squares each, the floor first), shifted.
std::vector<Corners> MakeCube(const std::vector<int>& without, const Vector& shift = Vector::Zero())
{
  const std::vector<Corners> room = Flip(GetPolygons(MakeRoom(5)));
  std::vector<Corners> cube;
  for (std::size_t k = 0; k < room.size(); ++k)
  {
    if (std::count(without.begin(), without.end(), static_cast<int>(k / 25)) == 0)
    {
      cube.push_back(room[k]);
    }
  }
  return Transform(cube, Eigen::Matrix3d::Identity(), shift);
}

//------------------------------------------------------------------------------
// How many convex bodies there are, and how many of the patches are not outside.
void CheckBodies(const std::vector<Corners>& polygons, int bodies, int inside,
  const std::string& what)
{
  PatchScene scene;
  BuildScene(polygons, scene);
  const OccluderWalls walls(scene);
  CheckClose(walls.GetBodies().GetNumberOfBodies(), bodies, 0.0, what + ": bodies");
  int count = 0;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    count += walls.GetBodies().IsOutside(patch) ? 0 : 1;
  }
  CheckClose(count, inside, 0.0, what + ": patches that are not outside");
}

//------------------------------------------------------------------------------
void TestBodies()
{
  Random random(15);
  const std::vector<Corners> cube = MakeCube({});
  const std::vector<Corners> house = MakeCube({ 0 });
  const std::vector<Corners> ground = MakeCube({ 1, 2, 3, 4, 5 }, { 1, 0, 0 });
  CheckBodies(cube, 1, 0, "a cube");
  CheckBodies(Transform(cube, 20.0 * random.Rotation(), { 6e6, -1e6, 50 }), 1, 0,
    "a turned cube on a map");
  CheckBodies(MakeSphere(2.0, 2, false), 1, 0, "a sphere");
  CheckBodies(Flip(cube), 0, 0, "a room");
  CheckBodies(MakeCube({ 0, 1 }), 0, 0, "a cube without two faces");
  CheckBodies(house, 1, 0, "a house");
  CheckBodies(Join(house, Flip(ground)), 1, 0, "a house on the ground");
  const Corners under{ { 0, 0, -1 }, { 1, 0, -1 }, { 0, 1, -1 } };
  CheckBodies(Join(house, { under }), 0, 0, "something is under it");
  CheckBodies(Join(house, Flip(house)), 0, 0, "both sides of a house");
  CheckBodies({ under, Corners(under.rbegin(), under.rend()) }, 0, 0, "both sides of a sheet");
  CheckBodies(Join(cube, MakeCube({}, { 0.5, 0.3, 0.4 })), 2, 2 * (12 + 9 + 12),
    "two cubes that pass through each other");
  const Corners within{ { 0.4, 0.4, 0.5 }, { 0.6, 0.4, 0.5 }, { 0.4, 0.6, 0.5 } };
  CheckBodies(Join(cube, { within }), 1, 1, "something within");
}

//------------------------------------------------------------------------------
// Of what is beside an edge of a cube no wall of it hides all that is beside the edge across from
// it, but the whole cube does.
void TestHidingBodies()
{
  const Corners left{ { -1, 1.9, 0.45 }, { -0.95, 2.05, 0.5 }, { -1, 1.9, 0.55 } };
  const Corners right{ { 1.9, -1, 0.45 }, { 1.9, -1, 0.55 }, { 2.05, -0.95, 0.5 } };
  PatchScene scene;
  BuildScene(Join({ left, right }, MakeCube({})), scene);
  const OccluderWalls walls(scene);
  std::vector<vtkIdType> all(walls.GetNumberOfPatches());
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    all[k] = static_cast<vtkIdType>(k);
  }
  const auto hides = [&](const Corners& from, const Corners& to, bool isOutside)
  {
    OccluderWalls::End ends[2];
    ends[0].Set(from, isOutside);
    ends[1].Set(to, isOutside);
    return walls.FindHiding(
             all, [](vtkIdType wall) { return wall; }, ends[0], ends[1], false) >= 0;
  };
  const Corners a = GetCorners(scene, scene.GetPatch(0));
  const Corners b = GetCorners(scene, scene.GetPatch(1));
  Check(hides(a, b, true), "a cube hides what none of its walls hides");
  Check(!hides(a, b, false), "but nothing where both ends may be inside");
  Corners beside = b;
  beside[0] += Vector(0, 0, 10);
  Check(!hides(a, beside, true), "a corner is seen past it");
  const ShaftCuller culler(scene);
  std::vector<ShaftCuller::Occluder> found;
  culler.FindBetween(scene.GetPatch(0), scene.GetPatch(1), found);
  Check(!found.empty() &&
      std::all_of(found.begin(), found.end(),
        [&](const ShaftCuller::Occluder& occluder)
        { return walls.GetPlane(occluder.Wall).GetHeight(a[0]) > 0.0; }),
    "of a body the walls are enough that face the first patch");
}
} // namespace

//------------------------------------------------------------------------------
int TestShaftCuller(int, char*[])
{
  TestWalls();
  TestHiding();
  TestBodies();
  TestHidingBodies();
  TestScenes();
  TestConvexScenes();
  return Result();
}
