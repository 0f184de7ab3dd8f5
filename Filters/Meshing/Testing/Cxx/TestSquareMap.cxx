// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Discs of many kinds are mapped onto the whole square, one-to-one by exact predicates, and flat
// ones with the stretch that is known for them.
#include "Atlas/SquareMap.h"
#include "MeshTestTools.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <set>

using namespace LightTransport;

namespace
{
using Disc = SquareMap::Disc;
using Coordinates = SquareMap::Coordinates;
using Edge = std::pair<std::size_t, std::size_t>;
using meshTest::Vector;

//------------------------------------------------------------------------------
Disc MakeDisc(const std::vector<Vector>& points, const std::vector<SquareMap::Triangle>& triangles)
{
  Disc disc;
  disc.Points = points;
  disc.Triangles = triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    disc.Sources.push_back(i);
  }
  return disc;
}

//------------------------------------------------------------------------------
// Columns times rows of squares, each of two triangles; `place` puts [0,1]^2 into space.
Disc MakeGrid(std::size_t columns, std::size_t rows,
  const std::function<Vector(double, double)>& place)
{
  std::vector<Vector> points;
  std::vector<SquareMap::Triangle> triangles;
  for (std::size_t j = 0; j <= rows; ++j)
  {
    for (std::size_t i = 0; i <= columns; ++i)
    {
      points.push_back(place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    }
  }
  for (std::size_t j = 0; j < rows; ++j)
  {
    for (std::size_t i = 0; i < columns; ++i)
    {
      const std::size_t a = j * (columns + 1) + i;
      const std::size_t b = a + columns + 1;
      triangles.push_back({ a, a + 1, b + 1 });
      triangles.push_back({ a, b + 1, b });
    }
  }
  return MakeDisc(points, triangles);
}

//------------------------------------------------------------------------------
std::map<Edge, std::size_t> GetEdgeOwners(const Disc& disc)
{
  std::map<Edge, std::size_t> owners;
  for (std::size_t i = 0; i < disc.Triangles.size(); ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      owners[Edge(disc.Triangles[i][j], disc.Triangles[i][(j + 1) % 3])] = i;
    }
  }
  return owners;
}

//------------------------------------------------------------------------------
double GetArea(const Disc& disc, std::size_t triangle)
{
  const auto& corners = disc.Triangles[triangle];
  Vector u;
  Vector v;
  Vector cross;
  vtkMath::Subtract(disc.Points[corners[1]].data(), disc.Points[corners[0]].data(), u.data());
  vtkMath::Subtract(disc.Points[corners[2]].data(), disc.Points[corners[0]].data(), v.data());
  vtkMath::Cross(u.data(), v.data(), cross.data());
  return 0.5 * vtkMath::Norm(cross.data());
}

struct Stretch
{
  double L2 = 0.0;
  double LInfinity = 0.0;
  double SquareArea = 0.0;
};

//------------------------------------------------------------------------------
// As Sander et al. write it, with the partial derivatives of the surface's point.
Stretch MeasureStretch(const Disc& disc, const std::vector<Coordinates>& uv)
{
  Stretch stretch;
  double surfaceArea = 0.0;
  for (std::size_t i = 0; i < disc.Triangles.size(); ++i)
  {
    const auto& corners = disc.Triangles[i];
    const Coordinates& p0 = uv[corners[0]];
    const Coordinates& p1 = uv[corners[1]];
    const Coordinates& p2 = uv[corners[2]];
    const double twice = (p1[0] - p0[0]) * (p2[1] - p0[1]) - (p2[0] - p0[0]) * (p1[1] - p0[1]);
    double a = 0.0;
    double b = 0.0;
    double c = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const double q0 = disc.Points[corners[0]][k];
      const double q1 = disc.Points[corners[1]][k];
      const double q2 = disc.Points[corners[2]][k];
      const double s = ((q1 - q0) * (p2[1] - p0[1]) - (q2 - q0) * (p1[1] - p0[1])) / twice;
      const double t = ((q2 - q0) * (p1[0] - p0[0]) - (q1 - q0) * (p2[0] - p0[0])) / twice;
      a += s * s;
      b += s * t;
      c += t * t;
    }
    const double area = GetArea(disc, i);
    surfaceArea += area;
    stretch.SquareArea += 0.5 * twice;
    stretch.L2 += area * 0.5 * (a + c);
    stretch.LInfinity = std::max(stretch.LInfinity,
      std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4.0 * b * b))));
  }
  stretch.L2 = std::sqrt(stretch.L2) / surfaceArea;
  stretch.LInfinity /= std::sqrt(surfaceArea);
  return stretch;
}

//------------------------------------------------------------------------------
// Every triangle counter-clockwise and the border once around the square: then the map is
// one-to-one onto the square.
void CheckBijection(meshTest::Checker& check, const Disc& disc, const std::vector<Coordinates>& uv,
  const std::string& name)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  int turned = 0;
  for (const auto& triangle : disc.Triangles)
  {
    const auto point = [&](int i)
    { return Kernel::Point_2(uv[triangle[i]][0], uv[triangle[i]][1]); };
    turned += CGAL::orientation(point(0), point(1), point(2)) != CGAL::LEFT_TURN;
  }
  check.Equal(turned, 0, 0, name + ": triangles that are not counter-clockwise");

  // The border, as steps along the square's border of length 4.
  const auto getPosition = [](const Coordinates& p) {
    return p[1] == 0.0 ? p[0] : p[0] == 1.0 ? 1.0 + p[1] : p[1] == 1.0 ? 3.0 - p[0] : 4.0 - p[1];
  };
  const std::map<Edge, std::size_t> owners = GetEdgeOwners(disc);
  std::set<std::size_t> borderPoints;
  double around = 0.0;
  int wrong = 0;
  int chords = 0;
  for (const auto& owner : owners)
  {
    const Coordinates& from = uv[owner.first.first];
    const Coordinates& to = uv[owner.first.second];
    const bool alongSide = (from[0] == to[0] && (to[0] == 0.0 || to[0] == 1.0)) ||
      (from[1] == to[1] && (to[1] == 0.0 || to[1] == 1.0));
    if (owners.count(Edge(owner.first.second, owner.first.first)) > 0)
    {
      chords += alongSide;
      continue;
    }
    borderPoints.insert(owner.first.first);
    const double step = getPosition(to) - getPosition(from);
    around += step < 0.0 ? step + 4.0 : step;
    wrong += !alongSide;
  }
  check.Equal(wrong, 0, 0, name + ": edges of the border that lie on no side");
  check.Equal(chords, 0, 0, name + ": inner edges that lie on a side");
  check.Equal(around, 4.0, 1e-12, name + ": way around the square");
  int outside = 0;
  int corners = 0;
  for (std::size_t i = 0; i < uv.size(); ++i)
  {
    const bool inside = uv[i][0] > 0.0 && uv[i][0] < 1.0 && uv[i][1] > 0.0 && uv[i][1] < 1.0;
    outside += inside == (borderPoints.count(i) > 0);
    corners += (uv[i][0] == 0.0 || uv[i][0] == 1.0) && (uv[i][1] == 0.0 || uv[i][1] == 1.0);
  }
  check.Equal(outside, 0, 0, name + ": points on the wrong side of the border");
  check.Equal(corners, 4, 0, name + ": corners of the square");
}

//------------------------------------------------------------------------------
// Only inner edges are halved, in the middle, and triangles know what they are a part of.
void CheckHalving(meshTest::Checker& check, const Disc& given, const Disc& halved,
  const std::string& name)
{
  const std::size_t size = given.Points.size();
  check.True(halved.Points.size() == size + halved.HalvedEdges.size() &&
      halved.Sources.size() == halved.Triangles.size() &&
      halved.Triangles.size() == given.Triangles.size() + 2 * halved.HalvedEdges.size() &&
      std::equal(given.Points.begin(), given.Points.end(), halved.Points.begin()),
    name + ": points or triangles are not those of halved edges");
  for (std::size_t i = 0; i < halved.HalvedEdges.size(); ++i)
  {
    const auto& edge = halved.HalvedEdges[i];
    for (int k = 0; k < 3; ++k)
    {
      check.Equal(halved.Points[size + i][k],
        0.5 * (halved.Points[edge[0]][k] + halved.Points[edge[1]][k]), 0.0, name + ": a middle");
    }
  }
  std::vector<double> areas(given.Triangles.size(), 0.0);
  for (std::size_t i = 0; i < halved.Triangles.size(); ++i)
  {
    areas[halved.Sources[i]] += GetArea(halved, i);
  }
  for (std::size_t i = 0; i < areas.size(); ++i)
  {
    const double area = GetArea(given, i);
    check.Equal(areas[i], area, 1e-9 * area, name + ": area of the parts of a triangle");
  }
  std::set<Edge> borders[2];
  for (int k = 0; k < 2; ++k)
  {
    const auto owners = GetEdgeOwners(k == 0 ? given : halved);
    for (const auto& owner : owners)
    {
      if (owners.count(Edge(owner.first.second, owner.first.first)) == 0)
      {
        borders[k].insert(owner.first);
      }
    }
  }
  check.True(borders[0] == borders[1], name + ": the border was touched");
}

//------------------------------------------------------------------------------
// Returns the map; `disc` becomes the mapped one.
SquareMap CheckMap(meshTest::Checker& check, Disc& disc, const std::string& name)
{
  SquareMap map;
  std::string problem;
  const Disc given = disc;
  if (!map.Map(disc, problem))
  {
    check.True(false, name + " is not mapped: " + problem);
    return map;
  }
  CheckBijection(check, disc, map.GetCoordinates(), name);
  CheckHalving(check, given, disc, name);
  const Stretch stretch = MeasureStretch(disc, map.GetCoordinates());
  check.Equal(stretch.SquareArea, 1.0, 1e-12, name + ": area in the square");
  check.Equal(map.GetL2Stretch(), stretch.L2, 1e-6 * stretch.L2, name + ": L2 stretch");
  check.Equal(map.GetLInfinityStretch(), stretch.LInfinity, 1e-6 * stretch.LInfinity,
    name + ": L-infinity stretch");
  check.True(stretch.L2 >= 1.0 - 1e-12, name + ": stretch below the possible");
  return map;
}

//------------------------------------------------------------------------------
// What is a parallelogram already is mapped by an affine map, whose stretch is known: for sides a
// and b at a right angle, (a/b + b/a)/2 is the square of the L2 stretch. A long strip does better
// when it is bent.
void TestFlat(meshTest::Checker& check)
{
  const auto jitter = [](double x, double y, double size)
  {
    const double inside = x * (1.0 - x) * y * (1.0 - y);
    return Vector{ x + size * inside * std::sin(9.0 * x + 7.0 * y),
      y + size * inside * std::cos(5.0 * x - 8.0 * y), 0.0 };
  };
  for (double width : { 1.0, 2.0, 10.0 })
  {
    for (double size : { 0.0, 1.0 })
    {
      Disc disc = MakeGrid(13, 9,
        [&](double x, double y)
        {
          const Vector p = jitter(x, y, size);
          return Vector{ 3.0 + width * p[0], 5.0, -p[1] };
        });
      const std::string name = "rectangle 1:" + std::to_string(width);
      const double stretch = CheckMap(check, disc, name).GetL2Stretch();
      const double affine = std::sqrt(0.5 * (width + 1.0 / width));
      if (width > 2.0)
      {
        check.True(stretch < affine + 1e-9, name + ": stretch above that of an affine map");
      }
      else
      {
        check.Equal(stretch, affine, size > 0.0 ? 1e-5 : 1e-9, name + ": stretch");
      }
    }
  }
}

//------------------------------------------------------------------------------
void TestCurved(meshTest::Checker& check)
{
  Disc hemisphere = MakeGrid(24, 24,
    [](double x, double y)
    {
      // The square's concentric squares become circles of latitude.
      const double u = 2.0 * x - 1.0;
      const double v = 2.0 * y - 1.0;
      const double radius = std::max(std::abs(u), std::abs(v));
      const double norm = std::hypot(u, v);
      const double angle = 0.5 * vtkMath::Pi() * radius;
      return norm > 0.0
        ? Vector{ std::sin(angle) * u / norm, std::sin(angle) * v / norm, std::cos(angle) }
        : Vector{ 0.0, 0.0, 1.0 };
    });
  check.True(CheckMap(check, hemisphere, "hemisphere").GetL2Stretch() < 1.2,
    "hemisphere: stretch is not low");

  // A tube that is open at one end: its length is eight times its circumference.
  Disc finger = MakeGrid(24, 24,
    [](double x, double y)
    {
      const double u = 2.0 * x - 1.0;
      const double v = 2.0 * y - 1.0;
      const double radius = std::max(std::abs(u), std::abs(v));
      const double norm = std::hypot(u, v);
      const double width = std::min(1.0, 4.0 * radius);
      return norm > 0.0
        ? Vector{ width * u / norm, width * v / norm, -16.0 * vtkMath::Pi() * radius }
        : Vector{ 0.0, 0.0, 0.0 };
    });
  check.True(CheckMap(check, finger, "finger").GetL2Stretch() < 4.0, "finger: stretch is not low");

  Disc saddle = MakeGrid(20, 20,
    [](double x, double y)
    {
      const double angle = 2.0 * vtkMath::Pi() * x;
      const double radius = 0.2 + y;
      return Vector{ radius * std::cos(angle), radius * std::sin(angle),
        radius * std::sin(3.0 * angle) + x };
    });
  CheckMap(check, saddle, "saddle");
}

//------------------------------------------------------------------------------
// Borders as scans have them: a slit that the border follows on both its sides, and teeth, whose
// inner edges join points of one side.
void TestBorders(meshTest::Checker& check)
{
  const std::size_t size = 16;
  Disc slit = MakeGrid(size, size, [](double x, double y) { return Vector{ x, y, 0.0 }; });
  const std::size_t row = size / 2;
  std::map<std::size_t, std::size_t> copies;
  for (std::size_t i = 0; i < size / 2; ++i)
  {
    const std::size_t point = row * (size + 1) + i;
    copies[point] = slit.Points.size();
    slit.Points.push_back(Vector(slit.Points[point]));
  }
  for (std::size_t i = 2 * size * row; i < slit.Triangles.size(); ++i)
  {
    for (std::size_t& point : slit.Triangles[i])
    {
      point = copies.count(point) ? copies[point] : point;
    }
  }
  CheckMap(check, slit, "slit");

  Disc teeth = MakeGrid(12, 12, [](double x, double y) { return Vector{ x, y, 0.3 * x * y }; });
  for (const auto& owner : GetEdgeOwners(MakeDisc(teeth.Points, teeth.Triangles)))
  {
    const auto& [from, to] = owner.first;
    if (GetEdgeOwners(teeth).count(Edge(to, from)) == 0)
    {
      Vector tip;
      for (int k = 0; k < 3; ++k)
      {
        tip[k] = 0.5 * (teeth.Points[from][k] + teeth.Points[to][k]);
      }
      tip[2] += 0.2;
      teeth.Sources.push_back(teeth.Triangles.size());
      teeth.Triangles.push_back({ to, from, teeth.Points.size() });
      teeth.Points.push_back(tip);
    }
  }
  CheckMap(check, teeth, "teeth");
  check.True(teeth.HalvedEdges.size() >= 44, "teeth: all but those at corners have edges to halve");
}

//------------------------------------------------------------------------------
void TestSmall(meshTest::Checker& check)
{
  const std::vector<Vector> square = { { 0, 0, 1 }, { 2, 0, 1 }, { 2, 2, 1 }, { 0, 2, 1 } };
  Disc pair = MakeDisc(square, { { 0, 1, 2 }, { 0, 2, 3 } });
  check.Equal(CheckMap(check, pair, "pair").GetL2Stretch(), 1.0, 1e-12, "pair: stretch");
  check.True(pair.HalvedEdges.empty(), "pair: nothing to halve");

  // A fan without inner points: all inner edges end at one point, so that those to points of its
  // two sides are halved.
  std::vector<Vector> fan;
  std::vector<SquareMap::Triangle> triangles;
  for (std::size_t i = 0; i < 12; ++i)
  {
    const double angle = vtkMath::Pi() * i / 6.0;
    fan.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    if (i > 1)
    {
      triangles.push_back({ 0, i - 1, i });
    }
  }
  Disc polygon = MakeDisc(fan, triangles);
  CheckMap(check, polygon, "polygon");
  check.True(!polygon.HalvedEdges.empty(), "polygon: something to halve");
}

//------------------------------------------------------------------------------
void TestNeedles(meshTest::Checker& check)
{
  for (double thin : { 1e-3, 1e-6, 1e-9 })
  {
    // Every other column is thin.
    Disc disc = MakeGrid(20, 20,
      [&](double x, double y)
      {
        const int column = static_cast<int>(std::lround(20.0 * x));
        return Vector{ column / 2 + (column % 2) * thin, 10.0 * y, std::sin(column / 2) };
      });
    CheckMap(check, disc, "needles " + std::to_string(thin));
  }
}

//------------------------------------------------------------------------------
// A part of a scan, grown triangle by triangle as long as it stays a disc: its border is jagged.
void TestScan(meshTest::Checker& check, vtkPolyData* scan)
{
  std::vector<SquareMap::Triangle> triangles;
  std::map<Edge, std::size_t> owners;
  for (vtkIdType cell = 0; cell < scan->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    scan->GetCellPoints(cell, size, ids);
    for (int j = 0; j < 3; ++j)
    {
      owners[Edge(ids[j], ids[(j + 1) % 3])] = cell;
    }
    triangles.push_back({ static_cast<std::size_t>(ids[0]), static_cast<std::size_t>(ids[1]),
      static_cast<std::size_t>(ids[2]) });
  }
  for (std::size_t first : { 0, 1000, 3000 })
  {
    Disc disc;
    std::map<std::size_t, std::size_t> numbers;
    std::set<Edge> edges;
    std::set<std::size_t> taken;
    std::deque<std::size_t> front = { first };
    while (!front.empty() && disc.Triangles.size() < 1500)
    {
      const std::size_t next = front.front();
      front.pop_front();
      const auto& corners = triangles[next];
      int shared = 0;
      int known = 0;
      for (int j = 0; j < 3; ++j)
      {
        shared += static_cast<int>(edges.count(Edge(corners[(j + 1) % 3], corners[j])));
        known += static_cast<int>(numbers.count(corners[j]));
      }
      const bool staysDisc = disc.Triangles.empty() || (shared == 1 && known == 2) || shared == 2;
      if (!staysDisc || !taken.insert(next).second)
      {
        continue;
      }
      SquareMap::Triangle triangle;
      for (int j = 0; j < 3; ++j)
      {
        const auto number = numbers.emplace(corners[j], disc.Points.size());
        if (number.second)
        {
          disc.Points.push_back(meshTest::GetPoint(scan, static_cast<vtkIdType>(corners[j])));
        }
        triangle[j] = number.first->second;
        const Edge edge(corners[j], corners[(j + 1) % 3]);
        edges.insert(edge);
        const auto neighbour = owners.find(Edge(edge.second, edge.first));
        if (neighbour != owners.end())
        {
          front.push_back(neighbour->second);
        }
      }
      disc.Sources.push_back(disc.Triangles.size());
      disc.Triangles.push_back(triangle);
    }
    const std::string name = "scan from " + std::to_string(first);
    check.True(disc.Triangles.size() == 1500, name + ": too small");
    check.True(CheckMap(check, disc, name).GetL2Stretch() < 1.6, name + ": stretch is not low");
  }
}

//------------------------------------------------------------------------------
void TestRefusal(meshTest::Checker& check)
{
  const std::vector<Vector> points = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 }, { 1, 1, 1 } };
  for (Disc disc : { MakeDisc({ points.begin(), points.begin() + 3 }, { { 0, 1, 2 } }),
         MakeDisc(points, { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 } }) })
  {
    SquareMap map;
    std::string problem;
    const std::size_t size = disc.Triangles.size();
    check.True(!map.Map(disc, problem), "three points of the border are not enough");
    check.True(problem.find("fewer than four points") != std::string::npos,
      "the reason is not named but: " + problem);
    check.True(disc.Triangles.size() == size, "a refused disc was changed");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSquareMap(int argc, char* argv[])
{
  meshTest::Checker check;
  TestFlat(check);
  TestCurved(check);
  TestBorders(check);
  TestSmall(check);
  TestNeedles(check);
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(meshTest::GetDataFile(argc, argv, "bunny.ply").c_str());
  reader->Update();
  TestScan(check, reader->GetOutput());
  TestRefusal(check);
  return check.GetExitCode();
}
