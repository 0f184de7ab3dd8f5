// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Distances over thin faces against those in the plane, and what a crease adds; and that a piece is
// cut in two whatever its faces are.
#include "Atlas/PointDistances.h"
#include "Atlas/SurfaceBisection.h"
#include "MeshTestTools.h"

#include <algorithm>
#include <numeric>
#include <string>

using namespace LightTransport;

namespace
{
using meshTest::Checker;

//------------------------------------------------------------------------------
// A sheet of 1 x 1, cut into columns and rows; beyond x = 0.5 it stands upright.
TriangleSoup MakeSheet(std::size_t columns, std::size_t rows, bool folded)
{
  TriangleSoup soup;
  for (std::size_t row = 0; row <= rows; ++row)
  {
    for (std::size_t column = 0; column <= columns; ++column)
    {
      const double x = static_cast<double>(column) / static_cast<double>(columns);
      const double y = static_cast<double>(row) / static_cast<double>(rows);
      const double height = folded ? std::max(0.0, x - 0.5) : 0.0;
      soup.Points.push_back({ x - height, y, height });
    }
  }
  for (std::size_t row = 0; row < rows; ++row)
  {
    for (std::size_t column = 0; column < columns; ++column)
    {
      const std::size_t a = column + row * (columns + 1);
      const std::size_t c = a + columns + 2;
      soup.Triangles.push_back({ a, a + 1, c });
      soup.Triangles.push_back({ a, c, c - 1 });
      soup.CellIds.insert(soup.CellIds.end(), { 0, 0 });
    }
  }
  return soup;
}

//------------------------------------------------------------------------------
void TestSheet(bool folded, Checker& check)
{
  const double cost = 0.25;
  AtlasSurface surface;
  const Watch watch;
  check.True(!surface.Build(MakeSheet(600, 32, folded), watch).HasFailed(), "surface");
  const int size = surface.GetNumberOfFaces();
  std::vector<int> faces(size);
  std::iota(faces.begin(), faces.end(), 0);
  std::vector<std::array<double, 3>> costs(size, { 0.0, 0.0, 0.0 });
  for (int face = 0; face < size; ++face)
  {
    for (int edge = 0; edge < 3; ++edge)
    {
      const int other = surface.Neighbors[face][edge];
      const bool sharp = other >= 0 && surface.Normals[face].dot(surface.Normals[other]) < 0.5;
      costs[face][edge] = sharp ? cost : 0.0;
    }
  }
  PointDistances distances(surface, faces, surface.Neighbors, costs, watch);
  const int start = 0;
  distances.Reach(start, 0.0);
  const auto unfold = [](const AtlasSurface::Vector& p)
  { return Eigen::Vector2d(p[0] + p[2], p[1]); };
  double worst = 0.0;
  int thin = 0;
  for (int face = 0; face < size; ++face)
  {
    const Eigen::Vector2d center = unfold(surface.Centers[face]);
    const double distance = (center - unfold(surface.Centers[start])).norm();
    const double expected = distance + (folded && center[0] > 0.5 ? cost : 0.0);
    // Less than two faces away the corners' mean is not the distance of the centre.
    worst =
      distance > 0.1 ? std::max(worst, std::abs(distances.GetDistance(face) - expected)) : worst;
    thin += surface.IsThin(face);
  }
  check.True(thin == size, "all faces are thin");
  check.Equal(worst, 0.0, 0.03, folded ? "folded sheet" : "flat sheet");
}

//------------------------------------------------------------------------------
// Bundles are about as wide as long, and so are few.
void TestBundles(Checker& check)
{
  AtlasSurface surface;
  const Watch watch;
  check.True(!surface.Build(MakeSheet(600, 32, false), watch).HasFailed(), "surface");
  std::vector<int> sizes(surface.GetNumberOfFaces(), 0);
  for (int face = 0; face < surface.GetNumberOfFaces(); ++face)
  {
    const int bundle = surface.GetBundle(face);
    check.True(bundle >= 0, "a bundle for each face");
    sizes[std::max(bundle, 0)] += 1;
  }
  const auto number = surface.GetNumberOfFaces() - std::count(sizes.begin(), sizes.end(), 0);
  const int largest = *std::max_element(sizes.begin(), sizes.end());
  check.True(number >= 32 * 16 && number <= 32 * 32, std::to_string(number) + " bundles");
  check.True(largest <= 100, std::to_string(largest) + " faces in the largest bundle");
}

//------------------------------------------------------------------------------
// No cut is better than another where there is no area, or one face has all of it.
void TestWithoutArea(double areaOfFirst, Checker& check)
{
  AtlasSurface surface;
  const Watch watch;
  check.True(!surface.Build(MakeSheet(4, 4, false), watch).HasFailed(), "surface");
  std::fill(surface.Areas.begin(), surface.Areas.end(), 0.0);
  surface.Areas[0] = areaOfFirst;
  std::vector<int> faces(surface.GetNumberOfFaces());
  std::iota(faces.begin(), faces.end(), 0);
  const std::vector<int> owners(faces.size(), 0);
  std::vector<int> local(faces.size(), 0);
  SurfaceBisection bisection(surface, owners, local, watch);
  auto halves = bisection.Divide(faces, 0.0, 1.0);
  check.True(!halves[0].empty() && !halves[1].empty(), "two halves");
  halves[0].insert(halves[0].end(), halves[1].begin(), halves[1].end());
  std::sort(halves[0].begin(), halves[0].end());
  check.True(halves[0] == faces, "all faces are in one of the halves");
}
} // namespace

//------------------------------------------------------------------------------
int TestPointDistances(int, char*[])
{
  Checker check;
  TestSheet(false, check);
  TestSheet(true, check);
  TestBundles(check);
  TestWithoutArea(0.0, check);
  TestWithoutArea(1.0, check);
  return check.GetExitCode();
}
