// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Which triangles cross, against CGAL's test for meshes, where coordinates are few, so that many
// triangles touch, lie in one plane or have no area.
#include "Common/Heartbeat.h"
#include "MeshTestTools.h"
#include "Mesher/NearPairs.h"
#include "Mesher/TriangleCrossings.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <numeric>
#include <random>
#include <stdexcept>

using namespace LightTransport;

namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

//------------------------------------------------------------------------------
// The triangles of a torus of rows x columns points.
TriangleCrossings::Triangles MakeTorus(std::size_t rows, std::size_t columns)
{
  TriangleCrossings::Triangles triangles;
  for (std::size_t i = 0; i < rows; ++i)
  {
    for (std::size_t j = 0; j < columns; ++j)
    {
      const auto get = [&](std::size_t row, std::size_t column)
      { return row % rows * columns + column % columns; };
      triangles.push_back({ get(i, j), get(i, j + 1), get(i + 1, j + 1) });
      triangles.push_back({ get(i, j), get(i + 1, j + 1), get(i + 1, j) });
    }
  }
  return triangles;
}

//------------------------------------------------------------------------------
// Two hubs, which are the first points, with a ring of points between them.
TriangleCrossings::Triangles MakeBicone(std::size_t ring)
{
  TriangleCrossings::Triangles triangles;
  for (std::size_t i = 0; i < ring; ++i)
  {
    const std::size_t next = (i + 1) % ring;
    triangles.push_back({ 0, i + 2, next + 2 });
    triangles.push_back({ 1, next + 2, i + 2 });
  }
  return triangles;
}

//------------------------------------------------------------------------------
TriangleCrossings::Points MakePoints(std::size_t number, int steps, std::mt19937& numbers)
{
  TriangleCrossings::Points points(number);
  for (TriangleSoup::Point& point : points)
  {
    for (double& value : point)
    {
      // The engine alone is the same everywhere.
      value = steps > 0 ? static_cast<double>(numbers() % steps) : 1e-9 * numbers();
    }
  }
  return points;
}

//------------------------------------------------------------------------------
Pairs FindByLibrary(const TriangleCrossings::Points& points,
  const TriangleCrossings::Triangles& triangles)
{
  Mesh mesh;
  for (const TriangleSoup::Point& point : points)
  {
    mesh.add_vertex(Kernel::Point_3(point[0], point[1], point[2]));
  }
  for (const TriangleSoup::Triangle& triangle : triangles)
  {
    mesh.add_face(Mesh::Vertex_index(triangle[0]), Mesh::Vertex_index(triangle[1]),
      Mesh::Vertex_index(triangle[2]));
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  Pairs pairs;
  for (const auto& pair : found)
  {
    if (pair.first != pair.second)
    {
      pairs.emplace_back(std::min(pair.first, pair.second), std::max(pair.first, pair.second));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

//------------------------------------------------------------------------------
void CompareWithLibrary(const TriangleCrossings::Triangles& triangles, std::size_t size,
  meshTest::Checker& check)
{
  std::mt19937 numbers(1);
  std::size_t all = 0;
  std::size_t touching = 0;
  for (int round = 0; round < 60; ++round)
  {
    const int steps[] = { 2, 3, 4, 8, 100, 0 };
    const TriangleCrossings::Points points = MakePoints(size, steps[round % 6], numbers);
    Pairs pairs;
    for (const auto& pair : TriangleCrossings::Find(points, triangles, Monitor()))
    {
      pairs.emplace_back(pair.First, pair.Second);
      touching += pair.OnlyTouches;
    }
    check.True(pairs == FindByLibrary(points, triangles),
      "other pairs than CGAL's in round " + std::to_string(round));
    all += pairs.size();
  }
  check.True(all > 10000, "no more than " + std::to_string(all) + " pairs were compared");
  check.True(touching > 100, "no more than " + std::to_string(touching) + " pairs touch");
}

//------------------------------------------------------------------------------
// Around a hub only neighbours are looked at, and where the hub is no corner nothing changes.
void CountLooks(meshTest::Checker& check)
{
  for (const std::size_t ring : { 50, 500, 5000 })
  {
    TriangleCrossings::Points points{ { 0, 0, 0 }, { 0, 0, 100 } };
    for (std::size_t i = 0; i < ring; ++i)
    {
      const double angle = 2.0 * vtkMath::Pi() * static_cast<double>(i) / static_cast<double>(ring);
      points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    }
    TriangleCrossings::Triangles triangles = MakeBicone(ring);
    for (std::size_t i = 0; 2 * i < triangles.size(); ++i)
    {
      triangles[i] = triangles[2 * i];
    }
    triangles.resize(ring);
    std::vector<std::size_t> used(ring);
    std::iota(used.begin(), used.end(), 0);
    std::size_t looks = 0;
    NearPairs::ForEach(points, triangles, used, [&](std::size_t, std::size_t) { ++looks; });
    const std::size_t all = ring * (ring - 1) / 2;
    check.True(ring < 64 ? looks == all : looks <= 3 * ring,
      std::to_string(looks) + " pairs of " + std::to_string(ring) + " triangles around a point");
  }
}

//------------------------------------------------------------------------------
void HearAbort(meshTest::Checker& check)
{
  std::mt19937 numbers(2);
  const TriangleCrossings::Triangles triangles = MakeTorus(20, 20);
  const TriangleCrossings::Points points = MakePoints(400, 100, numbers);
  int events = 0;
  const Monitor monitor([&events](double) { return ++events < 3; });
  bool isStopped = false;
  try
  {
    TriangleCrossings::Find(points, triangles, monitor);
  }
  catch (const Heartbeat::Stopped&)
  {
    isStopped = true;
  }
  check.True(isStopped && events == 3, "a wish was not heard");
}

//------------------------------------------------------------------------------
void BoundNumber(meshTest::Checker& check)
{
  std::mt19937 numbers(3);
  const TriangleCrossings::Triangles triangles = MakeTorus(6, 7);
  const TriangleCrossings::Points points = MakePoints(42, 0, numbers);
  const std::size_t number = TriangleCrossings::Find(points, triangles, Monitor()).size();
  check.Equal(TriangleCrossings::Find(points, triangles, Monitor(), number).size(), number, 0,
    "the number of pairs");
  std::string message;
  try
  {
    TriangleCrossings::Find(points, triangles, Monitor(), number - 1);
  }
  catch (const std::runtime_error& error)
  {
    message = error.what();
  }
  check.True(message ==
      "more than " + std::to_string(number - 1) + " pairs of triangles meet each other",
    "too many pairs are told as '" + message + "'");
}
} // namespace

//------------------------------------------------------------------------------
int TestTriangleCrossings(int, char*[])
{
  meshTest::Checker check;
  CompareWithLibrary(MakeTorus(6, 7), 42, check);
  CompareWithLibrary(MakeBicone(100), 102, check);
  CountLooks(check);
  HearAbort(check);
  BoundNumber(check);
  return check.GetExitCode();
}
