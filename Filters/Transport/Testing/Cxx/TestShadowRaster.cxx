// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What a point sees of a target past polygons, from rasters of all shifts together, against the
// exact view; closed sheets let nothing through.

#include "ViewFactors/ShadowRaster.h"
#include "VisibilityTesting.h"

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace VisibilityTesting;

namespace
{
// A point that looks straight down on targets in the plane h = 0.
const double Down[3] = { 0.0, 0.0, -1.0 };

//------------------------------------------------------------------------------
// Counter-clockwise corners in the plane h = 0.
ShadowRaster::Target MakeTarget(const Corners& corners)
{
  ShadowRaster::Target target;
  target.Begin = target.End = corners[0].x();
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vector& from = corners[k];
    const Vector run = corners[(k + 1) % corners.size()] - from;
    target.Begin = std::min(target.Begin, from.x());
    target.End = std::max(target.End, from.x());
    if (std::abs(run.x()) > 1e-12 * run.norm())
    {
      const double slope = run.y() / run.x();
      target.Edges.push_back({ from.y() - slope * from.x(), slope, run.x() > 0.0 });
    }
  }
  return target;
}

//------------------------------------------------------------------------------
void SetShapes(const std::vector<Corners>& polygons, ShadowRaster::Occluders& shapes)
{
  shapes.Clear();
  for (const Corners& polygon : polygons)
  {
    std::vector<std::array<double, 3>> places;
    for (const Vector& corner : polygon)
    {
      places.push_back({ corner.x(), corner.y(), corner.z() });
    }
    shapes.Add(places);
  }
}

//------------------------------------------------------------------------------
ShadowRaster::Occluders MakeShapes(const std::vector<Corners>& polygons)
{
  ShadowRaster::Occluders shapes;
  SetShapes(polygons, shapes);
  return shapes;
}

//------------------------------------------------------------------------------
ShadowRaster::Flux See(const ShadowRaster::Target& target, const ShadowRaster::Occluders& occluders,
  const double* point, const double* normal, const double* shift,
  ShadowRaster::Weights weights = ShadowRaster::Weights::Fine)
{
  ShadowRaster::View view;
  ShadowRaster::Look(target, occluders, point, shift, view);
  return ShadowRaster::Weigh(view, normal, weights);
}

//------------------------------------------------------------------------------
// The visible part from rasters of size x size shifts.
double GetMeanShare(const ShadowRaster::Target& target, const ShadowRaster::Occluders& occluders,
  const Vector& point, const double* normal, int size)
{
  ShadowRaster::Flux sum;
  for (int i = 0; i < size; ++i)
  {
    for (int j = 0; j < size; ++j)
    {
      const double shift[2] = { (i + 0.5) / size, (j + 0.5) / size };
      const auto flux = See(target, occluders, point.data(), normal, shift);
      sum.Visible += flux.Visible;
      sum.Open += flux.Open;
    }
  }
  return sum.GetShare();
}

//------------------------------------------------------------------------------
Corners MakePolygon(int count, double angle)
{
  Corners corners;
  for (int k = 0; k < count; ++k)
  {
    const double phi = angle + 2.0 * vtkMath::Pi() * k / count;
    corners.push_back({ std::cos(phi), std::sin(phi), 0.0 });
  }
  return corners;
}

//------------------------------------------------------------------------------
Corners Scale(Corners corners, double u, double w, double h)
{
  for (Vector& corner : corners)
  {
    corner = corner.cwiseProduct(Vector(u, w, h));
  }
  return corners;
}

//------------------------------------------------------------------------------
std::vector<Corners> MakeOccluders(int kind, Random& random)
{
  std::vector<Corners> occluders;
  const Corners triangle{ { -0.31, -0.22, 0.4 }, { 0.27, -0.13, 0.5 }, { 0.02, 0.33, 0.6 } };
  if (kind == 0)
  {
    occluders = { triangle };
  }
  else if (kind == 1) // the larger of two
  {
    occluders = { Scale(triangle, 0.25, 0.25, 0.5), triangle };
  }
  for (int k = 0; kind == 2 && k < 11; ++k) // in columns that do not touch
  {
    const double u = -0.55 + 0.1 * k;
    occluders.push_back({ { u, random.Uniform(-0.6, 0.0), 0.5 }, { u + 0.08, 0.1, 0.5 },
      { u + 0.03, random.Uniform(0.2, 0.6), 0.5 } });
  }
  for (int k = 0; kind == 3 && k < 13; ++k) // one over the other
  {
    occluders.push_back(random.Triangle(random.Point(0.3) + Vector(0.0, 0.0, 0.5), 0.15));
  }
  if (kind == 4) // with many corners, one of them on an edge
  {
    Corners polygon = Scale(MakePolygon(7, 0.2), 0.25, 0.2, 1.0);
    polygon.insert(polygon.begin() + 1, 0.5 * (polygon[0] + polygon[1]));
    for (Vector& corner : polygon)
    {
      corner.z() = 0.5 + 0.2 * corner.x();
    }
    occluders = { polygon, Scale(MakePolygon(4, 0.2), 0.2, 0.35, 1.0) };
    for (Vector& corner : occluders[1])
    {
      corner.z() = 0.3;
    }
  }
  return occluders;
}

//------------------------------------------------------------------------------
void CheckShadow(const Corners& target, const std::vector<Corners>& occluders, const Vector& point,
  const Vector& normal, const std::string& what)
{
  const double exact =
    GetVisibleFlux(target, occluders, point, normal) / GetFlux(target, point, normal);
  const double share =
    GetMeanShare(MakeTarget(target), MakeShapes(occluders), point, normal.data(), 48);
  Check(std::abs(share - exact) < 1e-4,
    what + ": " + std::to_string(share) + " instead of " + std::to_string(exact));
}

//------------------------------------------------------------------------------
// From near and far, straight and aslant, for targets of many shapes, in any unit.
void TestShadows()
{
  Random random(1);
  const std::vector<Corners> targets{ MakePolygon(3, 0.3), MakePolygon(4, 0.25 * vtkMath::Pi()),
    MakePolygon(4, 1.1), MakePolygon(12, 0.1), Scale(MakePolygon(3, 0.5), 1e-4, 1.0, 1.0) };
  for (std::size_t k = 0; k < targets.size(); ++k)
  {
    for (int kind = 0; kind < 5; ++kind)
    {
      for (const double unit : { 1e-6, 1.0, 1e6 })
      {
        std::vector<Corners> occluders = MakeOccluders(kind, random);
        for (Corners& occluder : occluders)
        {
          occluder = Scale(occluder, unit, unit, unit);
        }
        const Vector point = unit * Vector(0.2, -0.1, kind == 0 ? 1000.0 : 1.3);
        const Vector normal = Vector(0.3, 0.2, -2.0).normalized();
        CheckShadow(Scale(targets[k], unit, unit, unit), occluders, point, normal,
          "target " + std::to_string(k) + ", occluders " + std::to_string(kind) + ", unit " +
            std::to_string(unit));
      }
    }
  }
}

//------------------------------------------------------------------------------
// 2 x 12 x 10 triangles on a grid of points around h = 0.5, moved by up to `jitter` of the spacing.
std::vector<Corners> MakeSheet(double jitter, Random& random)
{
  constexpr int n = 12;
  constexpr int m = 10;
  std::vector<Vector> points;
  for (int k = 0; k < (n + 1) * (m + 1); ++k)
  {
    const Vector offset = 0.25 * jitter * random.Point();
    points.push_back(Vector(0.25 * (k / (m + 1)) - 1.5, 0.25 * (k % (m + 1)) - 1.25, 0.5) + offset);
  }
  std::vector<Corners> sheet;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      const Vector* const p = &points[i * (m + 1) + j];
      sheet.push_back({ p[0], p[m + 1], p[m + 2] });
      sheet.push_back({ p[0], p[1], p[m + 2] });
    }
  }
  return sheet;
}

//------------------------------------------------------------------------------
void TestClosedSheets()
{
  Random random(2);
  const ShadowRaster::Target square =
    MakeTarget({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } });
  double visible = 0.0;
  for (int k = 0; k < 3000; ++k)
  {
    std::vector<Corners> sheet = MakeSheet(k % 3 == 0 ? 0.0 : 0.4, random);
    for (Corners& triangle : sheet)
    {
      std::rotate(triangle.begin(), triangle.begin() + k % 3, triangle.end());
      if (random.Uniform() < 0.5)
      {
        std::reverse(triangle.begin(), triangle.end());
      }
    }
    const bool even = k % 2 == 0;
    const Vector point = even ? Vector(0.0, 0.0, 1.0)
                              : Vector(random.Uniform(-0.3, 0.3), random.Uniform(-0.2, 0.2), 1.0);
    // Points and shifts with few digits put edges and corners on lines and samples.
    const double shift[2] = { even ? 0.125 * (k / 2 % 8) : random.Uniform(),
      even ? 0.125 * (k / 16 % 8) : random.Uniform() };
    visible += See(square, MakeShapes(sheet), point.data(), Down, shift).Visible;
  }
  CheckClose(visible, 0.0, 0.0, "what a closed sheet lets through");
}

//------------------------------------------------------------------------------
// A triangle in a plane through the point hides nothing, in whatever direction.
void TestEdgeOn()
{
  Random random(3);
  const Corners corners{ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
  const ShadowRaster::Target square = MakeTarget(corners);
  double largest = 0.0;
  for (int k = 0; k < 20000; ++k)
  {
    const Vector point(random.Uniform(-0.5, 0.5), random.Uniform(-0.5, 0.5), 1.0);
    const Vector a = k % 2 == 0 ? random.Point() : Vector(k % 4 == 1 ? 0.0 : 1.0, 1.0, 0.5);
    const Vector b = k % 2 == 0 ? random.Point() : Vector(-a.y(), a.x(), 0.25);
    Corners triangle;
    for (int corner = 0; corner < 3; ++corner)
    {
      const Vector direction = random.Uniform(-0.5, 0.5) * a + random.Uniform(-0.5, 0.5) * b;
      triangle.push_back(point - direction * (random.Uniform(0.1, 0.9) / direction.z()));
    }
    const double shift[2] = { random.Uniform(), random.Uniform() };
    const auto flux = See(square, MakeShapes({ triangle }), point.data(), Down, shift);
    largest = std::max(largest, 1.0 - flux.GetShare());
  }
  CheckClose(largest, 0.0, 0.0, "shadow of a triangle seen from its plane");
}

//------------------------------------------------------------------------------
// What is left over in the arrays of shapes counts for nothing.
void TestCounts()
{
  Random random(4);
  const Corners target = MakePolygon(4, 0.7);
  ShadowRaster::Occluders shapes;
  for (int count = 40; count >= 0; --count)
  {
    std::vector<Corners> occluders;
    for (int k = 0; k < count; ++k)
    {
      occluders.push_back(random.Triangle(random.Point(0.4) + Vector(0.0, 0.0, 0.6), 0.1));
    }
    SetShapes(occluders, shapes);
    const Vector point(0.1, 0.2, 2.0);
    const double exact = GetVisibleFlux(target, occluders, point, -Vector::UnitZ()) /
      GetFlux(target, point, Vector::UnitZ());
    const double share = GetMeanShare(MakeTarget(target), shapes, point, Down, 16);
    Check(std::abs(share - exact) < 5e-4, std::to_string(count) + " triangles");
  }
}

//------------------------------------------------------------------------------
// A corner that is there twice, but for rounding, leads nowhere.
void TestTwins()
{
  const ShadowRaster::Target target = MakeTarget(MakePolygon(4, 0.7));
  Corners polygon = Scale(MakePolygon(5, 0.3), 0.4, 0.3, 0.0);
  for (Vector& corner : polygon)
  {
    corner.z() = 0.5;
  }
  const Vector point(0.1, 0.2, 2.0);
  const double once = GetMeanShare(target, MakeShapes({ polygon }), point, Down, 16);
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    Corners twins = polygon;
    twins.insert(twins.begin() + static_cast<std::ptrdiff_t>(k),
      polygon[k] + Vector(1e-15, 1e-15 * static_cast<double>(k), 0.0));
    CheckClose(GetMeanShare(target, MakeShapes({ twins }), point, Down, 16), once, 1e-6,
      "a corner that is there twice");
  }
}

//------------------------------------------------------------------------------
// Many samples share a weight where the target is far away: that is off by less and less.
void TestCoarseWeights()
{
  Random random(5);
  const ShadowRaster::Target square =
    MakeTarget({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } });
  const double shift[2] = { 0.5, 0.5 };
  for (const double distance : { 3.0, 10.0, 30.0 })
  {
    double largest = 0.0;
    for (int k = 0; k < 1000; ++k)
    {
      const auto triangles =
        MakeShapes({ random.Triangle(random.Point(0.8) + Vector(0.0, 0.0, 1.0), 0.6) });
      const Vector point(random.Uniform(), random.Uniform(), distance);
      const auto fine = See(square, triangles, point.data(), Down, shift);
      const auto coarse =
        See(square, triangles, point.data(), Down, shift, ShadowRaster::Weights::Coarse);
      largest = std::max(largest, std::abs(fine.GetShare() - coarse.GetShare()));
    }
    std::cout << "coarse weights at " << distance << ": " << largest << "\n";
    Check(largest < 0.02 / (distance * distance) + 1e-6, "weights of many samples");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestShadowRaster(int, char*[])
{
  TestShadows();
  TestClosedSheets();
  TestEdgeOn();
  TestCounts();
  TestTwins();
  TestCoarseWeights();
  return Result();
}
