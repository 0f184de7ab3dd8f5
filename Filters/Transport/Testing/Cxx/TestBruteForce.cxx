// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The brute force that other tests compare view factors with: closed forms, surfaces in one place,
// and single rays on random scenes.
#include "BruteForce.h"
#include "RandomScenes.h"

using namespace LightTransportTesting;

namespace
{
const double Parallel = 0.19982489569838746;      // unit squares at distance 1
const double Perpendicular = 0.20004377607540316; // unit squares with a common edge

const Corners Floor = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
const Corners Wall = { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };

//------------------------------------------------------------------------------
Corners Reversed(const Corners& polygon)
{
  return Corners(polygon.rbegin(), polygon.rend());
}

//------------------------------------------------------------------------------
Corners Moved(Corners polygon, const Vector& by)
{
  for (Vector& corner : polygon)
  {
    corner += by;
  }
  return polygon;
}

//------------------------------------------------------------------------------
BruteForceRow Count(const std::vector<Corners>& polygons, std::size_t row, bool single = false)
{
  return BruteForce(polygons, BruteForce::GetWorth(polygons, single)).Count(row, 1e-5);
}

//------------------------------------------------------------------------------
void CheckShare(const BruteForceRow& row, std::size_t column, double right, const std::string& what)
{
  Check(row.Errors[column] < 2e-4, what + ": standard error " + std::to_string(row.Errors[column]));
  CheckClose(row.Shares[column] - right, 0.0, 4.0 * row.Errors[column] + 1e-12, what);
}

//------------------------------------------------------------------------------
void TestClosedForms()
{
  const Corners ceiling = Reversed(Moved(Floor, { 0, 0, 1 }));
  const auto parallel = Count({ Floor, ceiling }, 0);
  CheckShare(parallel, 1, Parallel, "parallel squares");
  CheckShare(parallel, 2, 1.0 - Parallel, "sky between parallel squares");
  CheckShare(Count({ Floor, Wall }, 1), 0, Perpendicular, "squares with a common edge");
  CheckShare(Count({ Floor, Moved(Floor, { 0, 0, 1 }) }, 0), 3, Parallel, "back of a square");
}

//------------------------------------------------------------------------------
// A sheet in between hides, its far side is not met, and where it lies nothing is met.
void TestSheets()
{
  const double gap = 1e-10;
  const Corners middle = Moved(Floor, { 0, 0, gap });
  const std::vector<Corners> plates = { Floor, Reversed(Moved(Floor, { 0, 0, 2 * gap })),
    Reversed(middle), middle };
  const auto row = Count(plates, 0);
  CheckShare(row, 2, 1.0, "a plate near another");
  CheckShare(row, 1, 0.0, "a plate behind it");
  // The sides of a sheet in single precision, differently meshed, are one place.
  RandomScene scene;
  scene.Polygons = { Floor, Reversed(Moved(Floor, { 0, 0, 1 })) };
  for (const auto& part :
    { Corners{ Floor[0], Floor[1], Floor[2] }, Corners{ Floor[0], Floor[2], Floor[3] } })
  {
    scene.Polygons.push_back(Reversed(part));
    scene.Polygons.push_back(Moved(part, { 0, 0, 1 }));
  }
  for (int turn = 0; turn < 5; ++turn)
  {
    Placement placement;
    placement.Turn = Random(turn).Rotation();
    placement.Offset = { 10, -5, 2 };
    placement.Single = true;
    const auto polygons = Place(scene.Polygons, placement);
    const auto sheet = Count(polygons, 0, true);
    Check(std::abs(sheet.Shares[1] - Parallel) < 4.0 * sheet.Errors[1] + 3e-6,
      "sheet in single precision: " + std::to_string(sheet.Shares[1]));
    Check(sheet.Shares[sheet.GetBack()] < 1e-12, "no back of a sheet is met");
  }
}

//------------------------------------------------------------------------------
// Of surfaces in one place that face the same way the first is met.
void TestTwice()
{
  const Corners ceiling = Reversed(Moved(Floor, { 0, 0, 1 }));
  const auto row = Count({ Floor, ceiling, ceiling }, 0);
  CheckShare(row, 1, Parallel, "the first of two");
  Check(row.Shares[2] < 1e-12, "the second of two is not met");
}

//------------------------------------------------------------------------------
/// The polygon that a ray meets first; one more than all: the sky, two more: a back face.
std::size_t Shoot(const std::vector<Corners>& polygons, std::size_t start, const Vector& origin,
  const Vector& way, double worth)
{
  struct Hit
  {
    double Distance, Facing;
    std::size_t Owner;
  };
  std::vector<Hit> hits;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t owner = 0; owner < polygons.size(); ++owner)
  {
    const Corners& polygon = polygons[owner];
    for (std::size_t k = 1; k + 1 < polygon.size() && owner != start; ++k)
    {
      const Vector u = polygon[k] - polygon[0], v = polygon[k + 1] - polygon[0];
      const Vector normal = u.cross(v).normalized();
      const double height = (polygon[0] - origin).dot(normal);
      const double distance = height / way.dot(normal);
      const Vector at = origin + distance * way - polygon[0];
      const double twice = u.cross(v).norm();
      const double a = at.cross(v).dot(normal) / twice, b = u.cross(at).dot(normal) / twice;
      if (std::abs(height) > worth && distance > 0.0 && a >= 0.0 && b >= 0.0 && a + b <= 1.0)
      {
        hits.push_back({ distance, way.dot(normal), owner });
        nearest = std::min(nearest, distance);
      }
    }
  }
  std::size_t met = hits.empty() ? polygons.size() : polygons.size() + 1;
  for (const Hit& hit : hits)
  {
    if (hit.Facing < 0.0 && (hit.Distance - nearest) * -hit.Facing <= worth)
    {
      met = std::min(met, hit.Owner);
    }
  }
  return met;
}

//------------------------------------------------------------------------------
// Single rays, with none of the half-planes.
void TestRays()
{
  constexpr int Rays = 20000;
  int rows = 0;
  double squares = 0.0;
  for (int number = 0; number < 14; ++number)
  {
    const std::string kind = SceneMaker::GetKinds()[number % SceneMaker::GetKinds().size()];
    const auto polygons = SceneMaker(number).Make(kind).Polygons;
    const double worth = BruteForce::GetWorth(polygons, false);
    const std::size_t start = number % polygons.size();
    const Corners& polygon = polygons[start];
    const auto row = BruteForce(polygons, worth).Count(start, 1e-4);
    // Parallelograms and triangles: points of the first triangle stand for all in a parallelogram
    // only together with those of the second.
    std::vector<double> counts(polygons.size() + 2, 0.0);
    Random numbers(number + 1);
    const Vector u = polygon[1] - polygon[0], v = polygon.back() - polygon[0];
    const Vector normal = u.cross(v).normalized();
    const Vector side = u.normalized(), other = normal.cross(side);
    for (int ray = 0; ray < Rays; ++ray)
    {
      double a = numbers.Uniform(), b = numbers.Uniform();
      if (polygon.size() == 3 && a + b > 1.0)
      {
        a = 1.0 - a;
        b = 1.0 - b;
      }
      const double sine = std::sqrt(numbers.Uniform());
      const double angle = numbers.Uniform(0.0, 2.0 * vtkMath::Pi());
      const Vector way = sine * (std::cos(angle) * side + std::sin(angle) * other) +
        std::sqrt(1.0 - sine * sine) * normal;
      counts[Shoot(polygons, start, polygon[0] + a * u + b * v, way, worth)] += 1.0 / Rays;
    }
    for (std::size_t column = 0; column < counts.size(); ++column)
    {
      const double share = row.Shares[column];
      const double sigma = std::sqrt(share * (1.0 - share) / Rays + 1e-8) + row.Errors[column];
      const double error = std::abs(counts[column] - share);
      Check(error < 4.5 * sigma,
        kind + ", column " + std::to_string(column) + ": " + std::to_string(counts[column]) +
          " of the rays, " + std::to_string(share) + " of the half-planes");
      squares += share > 1e-3 ? error * error / (sigma * sigma) : 0.0;
      rows += share > 1e-3 ? 1 : 0;
    }
  }
  Check(squares < 1.6 * rows,
    "deviations of rays in standard errors: mean square " + std::to_string(squares / rows));
}
} // namespace

//------------------------------------------------------------------------------
int TestBruteForce(int, char*[])
{
  TestClosedForms();
  TestSheets();
  TestTwice();
  TestRays();
  return Result();
}
