// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Polygons of any shape in convex pieces: what is inside is in one piece, what is outside in none.
#include "LightTransportTesting.h"
#include "Scene/PolygonCutting.h"

#include <numeric>
#include <random>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
using Vector = PolygonCutting::Vector;
using Flat = std::vector<std::array<double, 2>>;

constexpr int MostCorners = 30;

//------------------------------------------------------------------------------
// By the crossings of a ray along x.
bool IsInside(const Flat& corners, const std::vector<int>& loop, double x, double y)
{
  bool inside = false;
  for (std::size_t k = 0; k < loop.size(); ++k)
  {
    const auto& a = corners[loop[k]];
    const auto& b = corners[loop[(k + 1) % loop.size()]];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
    {
      inside = !inside;
    }
  }
  return inside;
}

//------------------------------------------------------------------------------
double GetTurn(const std::array<double, 2>& a, const std::array<double, 2>& b,
  const std::array<double, 2>& c)
{
  return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

//------------------------------------------------------------------------------
double GetArea(const Flat& corners, const std::vector<int>& loop)
{
  double area = 0.0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k)
  {
    area += 0.5 * GetTurn(corners[loop[0]], corners[loop[k]], corners[loop[k + 1]]);
  }
  return area;
}

//------------------------------------------------------------------------------
std::vector<int> GetAll(const Flat& corners)
{
  std::vector<int> all(corners.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

//------------------------------------------------------------------------------
// In a plane that is not along the axes; in single precision or not.
std::vector<Vector> Place(const Flat& corners, bool isSingle)
{
  const Vector u = Vector(2.0, 1.0, -2.0) / 3.0;
  const Vector v = Vector(1.0, 2.0, 2.0) / 3.0;
  std::vector<Vector> places;
  for (const auto& corner : corners)
  {
    Vector place = 0.1 * (corner[0] * u + corner[1] * v) + Vector(0.1, 0.2, 0.3);
    if (isSingle)
    {
      place = place.cast<float>().cast<double>();
    }
    places.push_back(place);
  }
  return places;
}

//------------------------------------------------------------------------------
void CheckPieces(const Flat& corners, const PolygonCutting::Pieces& pieces, double tolerance,
  const std::string& what)
{
  double area = 0.0;
  for (const std::vector<int>& piece : pieces.Corners)
  {
    area += GetArea(corners, piece);
    const std::size_t size = piece.size();
    Check(size >= 3 && size <= MostCorners, what + ": corners of a piece");
    for (std::size_t k = 0; k < size; ++k)
    {
      Check(GetTurn(corners[piece[k]], corners[piece[(k + 1) % size]],
              corners[piece[(k + 2) % size]]) >= -tolerance,
        what + ": a piece is convex");
    }
  }
  CheckClose(area, GetArea(corners, GetAll(corners)), tolerance, what + ": area");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.1, 4.1);
  for (int k = 0; k < 2000; ++k)
  {
    const double x = uniform(random);
    const double y = uniform(random);
    const auto holders = std::count_if(pieces.Corners.begin(), pieces.Corners.end(),
      [&](const std::vector<int>& piece) { return IsInside(corners, piece, x, y); });
    if (holders != (IsInside(corners, GetAll(corners), x, y) ? 1 : 0))
    {
      Check(false, what + ": a point is in " + std::to_string(holders) + " pieces");
      return;
    }
  }
}

//------------------------------------------------------------------------------
void CheckShape(const Flat& corners, std::size_t mostPieces, const std::string& what)
{
  for (const bool isSingle : { false, true })
  {
    const std::string name = what + (isSingle ? ", single precision" : "");
    const PolygonCutting::Pieces pieces =
      PolygonCutting::Cut(Place(corners, isSingle), MostCorners, isSingle ? 1e-7 : 1e-16);
    Check(pieces.Is == PolygonCutting::Shape::Cut, name + " is cut");
    Check(pieces.Corners.size() <= mostPieces,
      name + ": " + std::to_string(pieces.Corners.size()) + " pieces");
    CheckPieces(corners, pieces, isSingle ? 1e-5 : 1e-12, name);
  }
}

//------------------------------------------------------------------------------
Flat MakeRing(int count, double radius, bool turnsLeft)
{
  Flat ring;
  for (int k = 0; k <= count; ++k)
  {
    const double angle = 2.0 * vtkMath::Pi() * (k % count) / count * (turnsLeft ? 1.0 : -1.0);
    ring.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  return ring;
}

//------------------------------------------------------------------------------
// Outer border, seam, hole, seam.
Flat Bridge(const Flat& outer, const Flat& hole)
{
  Flat bridged = outer;
  bridged.insert(bridged.end(), hole.begin(), hole.end());
  return bridged;
}

//------------------------------------------------------------------------------
void TestShapes()
{
  CheckShape({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }, 2, "an L");
  CheckShape({ { 0, 0 }, { 2, 0 }, { 0.5, 0.5 }, { 0, 2 } }, 2, "an arrow");
  CheckShape({ { 1, 0 }, { 2, 0 }, { 2, 1 }, { 3, 1 }, { 3, 2 }, { 2, 2 }, { 2, 3 }, { 1, 3 },
               { 1, 2 }, { 0, 2 }, { 0, 1 }, { 1, 1 } },
    5, "a cross");
  CheckShape({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 2, 0 }, { 4, 0 }, { 4, 1 }, { 4, 1 }, { 2, 1 },
               { 2, 1.5 }, { 2, 2 }, { 0, 2 }, { 0, 1 } },
    4, "collinear and repeated corners");
  CheckShape({ { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 }, { 0, 0 }, { 1, 1 }, { 1, 2 }, { 2, 2 },
               { 2, 1 }, { 1, 1 } },
    6, "a square with a hole");
  // The seam goes on along an edge.
  CheckShape({ { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 }, { 0, 1.5 }, { 1, 1.5 }, { 1, 2 }, { 2, 2 },
               { 2, 1 }, { 1, 1 }, { 1, 1.5 }, { 0, 1.5 } },
    6, "a hole at a straight corner");
  CheckShape({ { 0, 0 }, { 0.5, 1 }, { 0.5, 2 }, { 1, 1 }, { 0, 0 }, { 1, 0.5 }, { 2, 1 },
               { 2, 0.5 }, { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } },
    12, "two holes at a corner");
  // Corners on the lines between others, on a grid.
  const auto scale = [](Flat corners)
  {
    for (auto& corner : corners)
    {
      corner = { 0.25 * corner[0], 0.25 * corner[1] };
    }
    return corners;
  };
  CheckShape(scale({ { 10, 1 }, { 9, 2 }, { 10, 3 }, { 9, 5 }, { 8, 6 }, { 1, 11 }, { 0, 8 },
               { 1, 3 }, { 8, 4 }, { 1, 7 }, { 3, 8 }, { 9, 4 }, { 4, 3 } }),
    13, "lines through one corner");
  CheckShape(scale({ { 8, 11 }, { 1, 5 }, { 7, 9 }, { 7, 8 }, { 4, 6 }, { 6, 8 }, { 0, 4 },
               { 0, 3 }, { 0, 1 }, { 8, 2 }, { 10, 1 }, { 9, 4 }, { 5, 4 }, { 8, 8 }, { 9, 5 },
               { 11, 1 }, { 11, 8 }, { 10, 7 }, { 9, 7 } }),
    19, "lines through many corners");
  CheckShape({ { 0, 0 }, { 2, 0 }, { 1, 1 }, { 2, 2 }, { 0, 2 }, { 1, 1 } }, 4,
    "two pieces that meet at a corner");
  CheckShape(MakeRing(64, 1.0, true), 4, "a disc");
  CheckShape(MakeRing(1000, 1.0, true), 40, "a smooth disc");
  CheckShape(Bridge(MakeRing(32, 1.0, true), MakeRing(32, 0.5, false)), 34, "a ring");
  // In one dent of the other.
  CheckShape(Bridge(MakeRing(32, 1.0, true), MakeRing(32, 0.999, false)), 40, "a thin ring");
}

//------------------------------------------------------------------------------
void TestManyCorners()
{
  Flat comb{ { 4, 0 }, { 4, 3 } };
  for (int tooth = 0; tooth < 40; ++tooth)
  {
    comb.push_back({ 4 - 0.1 * tooth - 0.02, 3 });
    comb.push_back({ 4 - 0.1 * tooth - 0.05, 1 });
    comb.push_back({ 4 - 0.1 * tooth - 0.07, 1 });
    comb.push_back({ 4 - 0.1 * tooth - 0.1, 3 });
  }
  comb.push_back({ 0, 0 });
  CheckShape(comb, 125, "a comb");

  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0.2, 1.0);
  for (const int count : { 5, 12, 60, 300 })
  {
    Flat flower;
    for (int k = 0; k < count; ++k)
    {
      const double angle = 2.0 * vtkMath::Pi() * k / count;
      const double radius = uniform(random);
      flower.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
    }
    // A corner that pulls it out of the convex.
    flower[0] = { 0.05, 0.0 };
    CheckShape(flower, count, std::to_string(count) + " random corners");
  }
  Flat spiral;
  for (int k = 0; k <= 100; ++k)
  {
    const double angle = 0.15 * k;
    spiral.push_back({ (0.1 + 0.008 * k) * std::cos(angle), (0.1 + 0.008 * k) * std::sin(angle) });
  }
  for (int k = 100; k >= 0; --k)
  {
    const double angle = 0.15 * k;
    spiral.push_back(
      { (0.05 + 0.008 * k) * std::cos(angle), (0.05 + 0.008 * k) * std::sin(angle) });
  }
  CheckShape(spiral, 210, "a spiral");
}

//------------------------------------------------------------------------------
void TestOthers()
{
  using PolygonCutting::Shape;
  const auto cut = [](const std::vector<Vector>& corners)
  { return PolygonCutting::Cut(corners, MostCorners, 1e-16); };
  const PolygonCutting::Pieces square =
    cut(Place({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }, false));
  Check(square.Is == Shape::Whole && square.Corners[0] == std::vector<int>({ 0, 1, 2, 3 }),
    "a convex polygon stays as it is");
  const PolygonCutting::Pieces warped =
    cut({ { 0, 0, 0 }, { 0.5, 0, 0 }, { 0.4, 0.4, 0.1 }, { 0, 0.5, 0 } });
  Check(warped.Is == Shape::Warped && warped.Corners.size() == 2, "a warped quadrilateral");
  for (const std::vector<int>& triangle : warped.Corners)
  {
    Check(std::count(triangle.begin(), triangle.end(), 0) == 1 &&
        std::count(triangle.begin(), triangle.end(), 2) == 1,
      "is cut along its shorter diagonal");
  }
  Check(cut({ { 0, 0, 0 }, { 1, 0, 0 } }).Is == Shape::WithoutArea, "two corners");
  Check(cut({}).Is == Shape::WithoutArea, "no corners");
  Check(cut(Place({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 1, 0 } }, false)).Is == Shape::WithoutArea,
    "a line");
  Check(cut(Place({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }, false)).Is == Shape::WithoutArea,
    "a bow tie of two equal triangles");
  Check(cut(Place({ { 0, 0 }, { 3, 3 }, { 3, 0 }, { 0, 1 } }, false)).Is == Shape::Crossing,
    "a bow tie");
  Flat star;
  for (int k = 0; k < 5; ++k)
  {
    star.push_back({ std::cos(0.8 * vtkMath::Pi() * k), std::sin(0.8 * vtkMath::Pi() * k) });
  }
  Check(cut(Place(star, false)).Is == Shape::Crossing, "a star that crosses itself");
}
} // namespace

//------------------------------------------------------------------------------
int TestPolygonCutting(int, char*[])
{
  TestShapes();
  TestManyCorners();
  TestOthers();
  return Result();
}
