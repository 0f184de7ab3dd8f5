// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The visible part of the exchange between two polygons past occluders against exact values and
// against an independent integration: the exact view (clipped polygons) of many points.

#include "Geometry/ShaftCuller.h"
#include "ViewFactors/PairVisibility.h"
#include "VisibilityTesting.h"

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace VisibilityTesting;

namespace
{
using Share = PairVisibility::Share;

//------------------------------------------------------------------------------
// Patches a and b of a scene, each cut to the front of the other, and all others as occluders.
struct Case
{
  PatchScene Scene;
  Corners A, B;
  std::vector<Corners> Parts; ///< what of the occluders is in front of both

  explicit Case(const std::vector<Corners>& polygons)
  {
    BuildScene(polygons, this->Scene);
    const Corners a = GetCorners(this->Scene, this->Scene.GetPatch(0));
    const Corners b = GetCorners(this->Scene, this->Scene.GetPatch(1));
    this->A = Cut(a, b[0], GetNormal(b));
    this->B = Cut(b, a[0], GetNormal(a));
    for (std::size_t k = 2; k < polygons.size() && this->IsFacing(); ++k)
    {
      const vtkIdType occluder = this->Scene.GetPatch(static_cast<vtkIdType>(k));
      if (occluder < 0)
      {
        continue; // it lies on another
      }
      Corners part = GetCorners(this->Scene, occluder);
      part = Cut(part, a[0], GetNormal(a));
      part = part.empty() ? part : Cut(part, b[0], GetNormal(b));
      if (!part.empty())
      {
        this->Parts.push_back(part);
      }
    }
  }
  bool IsFacing() const { return !this->A.empty() && !this->B.empty(); }
};

//------------------------------------------------------------------------------
// The first look where `tolerance` is 0, otherwise the integral.
Share GetShare(const Case& scene, double tolerance, std::uint64_t key = 7, bool swapped = false)
{
  PairVisibility visibility;
  const vtkIdType a = scene.Scene.GetPatch(swapped ? 1 : 0);
  const vtkIdType b = scene.Scene.GetPatch(swapped ? 0 : 1);
  const ShaftCuller culler(scene.Scene);
  std::vector<ShaftCuller::Occluder> between;
  culler.FindBetween(a, b, between);
  if (!visibility.SetPair(scene.Scene, a, b, culler.GetWalls(), between, key))
  {
    return Share();
  }
  return tolerance > 0.0 ? visibility.Integrate(tolerance) : visibility.Look();
}

//------------------------------------------------------------------------------
// Integrals over the outer polygon of the exact view of the inner one: three points of each of n x
// n parts of the triangles of its fan.
double IntegrateViews(const Corners& outer, const Corners& inner,
  const std::vector<Corners>& occluders, int n)
{
  double visible = 0.0;
  double open = 0.0;
  const Vector normal = GetNormal(outer);
  for (std::size_t corner = 1; corner + 1 < outer.size(); ++corner)
  {
    const Vector u = (outer[corner] - outer[0]) / n;
    const Vector v = (outer[corner + 1] - outer[0]) / n;
    const double area = u.cross(v).norm();
    const auto add = [&](double i, double j)
    {
      const Vector point = outer[0] + i / 6.0 * u + j / 6.0 * v;
      visible += area * GetVisibleFlux(inner, occluders, point, normal);
      open += area * GetFlux(inner, point, normal);
    };
    for (int k = 0; k < n * n; ++k)
    {
      const int i = 6 * (k / n);
      const int j = 6 * (k % n);
      const int flip = i + j < 6 * n ? 0 : 1; // the other half of the parallelogram, mirrored
      const int x = flip ? 6 * n - i : i;
      const int y = flip ? 6 * n - j : j;
      const int sign = flip ? -1 : 1;
      add(x + sign, y + sign);
      add(x + 4 * sign, y + sign);
      add(x + sign, y + 4 * sign);
    }
  }
  return visible / open;
}

//------------------------------------------------------------------------------
// The polygon over which the integral has settled more is the outer one; how much is the error.
Share GetReference(const Case& scene, int n)
{
  Share best;
  best.Error = 1.0;
  for (const bool swapped : { false, true })
  {
    const Corners& outer = swapped ? scene.B : scene.A;
    const Corners& inner = swapped ? scene.A : scene.B;
    const double value = IntegrateViews(outer, inner, scene.Parts, n);
    const double error = std::abs(value - IntegrateViews(outer, inner, scene.Parts, 2 * n / 3));
    if (error < best.Error)
    {
      best.Value = value;
      best.Error = error;
    }
  }
  return best;
}

//------------------------------------------------------------------------------
Corners MakeSquare(const Vector& middle, const Vector& u, const Vector& v)
{
  return { middle - u - v, middle + u - v, middle + u + v, middle - u + v };
}

//------------------------------------------------------------------------------
// Two unit squares face to face, at z = 0 and 1, and a third thing.
std::vector<Corners> MakePlates(const std::vector<Corners>& between)
{
  std::vector<Corners> polygons{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } } };
  polygons.insert(polygons.end(), between.begin(), between.end());
  return polygons;
}

//------------------------------------------------------------------------------
// What the part x < c of a screen half way between the plates leaves visible: x + x' > 2 c. The
// integral over y and y' has a closed form; what is left depends on x - x' alone.
double GetExactScreen(double c)
{
  const auto kernel = [](double s)
  {
    const double q = 1.0 + s * s;
    const double angle = std::atan(1.0 / std::sqrt(q)) / std::sqrt(q);
    return (1.0 / (q + 1.0) + angle) / q - 1.0 / q + 1.0 / (q + 1.0);
  };
  double visible = 0.0;
  double open = 0.0;
  constexpr int n = 20000;
  for (int k = 0; k < n; ++k)
  {
    const double s = 2.0 * (k + 0.5) / n - 1.0;
    const double least = std::abs(s);
    const double most = 2.0 - least;
    visible += kernel(s) * std::max(0.0, most - std::max(least, 2.0 * c));
    open += kernel(s) * (most - least);
  }
  return visible / open;
}

//------------------------------------------------------------------------------
void CheckShare(const Case& scene, double exact, double tolerance, const std::string& what)
{
  const Share share = GetShare(scene, tolerance);
  CheckClose(share.Value - exact, 0.0, 2.0 * tolerance, what);
  Check(std::abs(share.Value - exact) <= share.Error + 1e-5,
    what + ": off by " + std::to_string(share.Value - exact) + ", estimated " +
      std::to_string(share.Error));
  const Share swapped = GetShare(scene, tolerance, 7, true);
  CheckClose(swapped.Value - share.Value, 0.0, share.Error + swapped.Error, what + ", swapped");
  const Share look = GetShare(scene, 0.0);
  Check(std::abs(look.Value - exact) <= look.Error + 2e-2,
    what + ": first look " + std::to_string(look.Value) + " instead of " + std::to_string(exact) +
      ", estimated " + std::to_string(look.Error));
}

//------------------------------------------------------------------------------
void TestScreens()
{
  for (const double c : { 0.1, 0.3, 0.5, 0.77 })
  {
    const Case scene(
      MakePlates({ { { -1, -1, 0.5 }, { c, -1, 0.5 }, { c, 2, 0.5 }, { -1, 2, 0.5 } } }));
    const double exact = GetExactScreen(c);
    CheckClose(GetReference(scene, 48).Value, exact, 2e-5, "reference for a screen");
    CheckShare(scene, exact, 1e-4, "screen up to " + std::to_string(c));
  }
  CheckClose(GetExactScreen(0.5), 0.5, 1e-9, "half a screen");
}

//------------------------------------------------------------------------------
// A triangle or a quadrilateral (a parallelogram) around a point, with `normal`.
Corners MakePatch(Random& random, const Vector& middle, const Vector& normal, double size,
  double aspect)
{
  const double angle = random.Uniform(0.0, 6.3);
  const Vector across = normal.unitOrthogonal();
  const Vector u = size * (std::cos(angle) * across + std::sin(angle) * normal.cross(across));
  const Vector v = normal.cross(u) / aspect + random.Uniform(-0.3, 0.3) * u;
  return random.Uniform() < 0.5 ? Corners{ middle - u - v, middle + u - v, middle + 2.0 * v }
                                : MakeSquare(middle, u, v);
}

//------------------------------------------------------------------------------
constexpr int NumberOfKinds = 7;
std::vector<Corners> MakeRandomPair(Random& random, int kind)
{
  const double size = random.Uniform(0.1, 0.5);
  const double ratio = random.Uniform(0.5, 2.0);
  const double aspect = kind == 3 ? random.Uniform(20.0, 200.0) : random.Uniform(1.0, 2.0);
  const double distance = random.Uniform(0.7, 2.0);
  const Vector tilt = Vector(random.Uniform(-0.7, 0.7), random.Uniform(-0.7, 0.7), 0.0);
  const Vector top(random.Uniform(-0.3, 0.3), random.Uniform(-0.3, 0.3), distance);
  std::vector<Corners> polygons;
  if (kind == 5) // along the axes
  {
    polygons = { MakeSquare(Vector::Zero(), Vector(size, 0, 0), Vector(0, size, 0)),
      MakeSquare(top, Vector(0, size * ratio, 0), Vector(size * ratio, 0, 0)) };
    const double x = random.Uniform(-0.5, 0.5) * size;
    const double height = random.Uniform(0.1, 0.9) * distance;
    polygons.push_back(MakeSquare({ x + 2.0, 0.0, height }, { 2, 0, 0 }, { 0, 3, 0 }));
    if (random.Uniform() < 0.5)
    {
      polygons.push_back(MakeSquare({ x, 0.0, 0.5 * distance }, { 0, 1, 0 }, { 0, 0, 0.1 }));
    }
    return polygons;
  }
  polygons = { MakePatch(random, Vector::Zero(), Vector::UnitZ(), size, aspect),
    MakePatch(random, top, (-Vector::UnitZ() + tilt).normalized(), size * ratio, aspect) };
  if (kind == 4) // a corner on a corner
  {
    const Vector& hinge = polygons[0][0];
    const Vector other = polygons[0][1];
    const Vector inward = Vector::UnitZ().cross(other - hinge).normalized();
    const Vector up = random.Uniform(-0.5, 0.5) * inward + Vector::UnitZ();
    polygons[1] = { hinge, hinge + random.Uniform(0.5, 2.0) * size * up, other };
  }
  const int count = kind == 0 ? 1 + static_cast<int>(random.Uniform(0.0, 6.0)) : 1;
  const auto choose = [&](std::size_t k)
  {
    const double s = random.Uniform(), t = random.Uniform();
    return Vector(polygons[k][0] + s * (1.0 - t) * (polygons[k][1] - polygons[k][0]) +
      s * t * (polygons[k][2] - polygons[k][0]));
  };
  for (int k = 0; k < count; ++k)
  {
    const Vector from = choose(0);
    const Vector middle = from + random.Uniform(0.1, 0.9) * (choose(1) - from);
    if (kind == 6) // one edge of something large, as at the rim of a body
    {
      const Vector edge = random.Point().normalized();
      const Vector away = edge.cross(random.Point()).normalized();
      polygons.push_back({ middle - 3.0 * edge, middle + 3.0 * edge, middle + 5.0 * away });
      continue;
    }
    Corners occluder = random.Triangle(Vector::Zero(), kind == 1 ? 0.15 * size : size);
    const Vector shift = (kind == 2 ? 0.8 * size : 0.0) * random.Point().normalized();
    for (Vector& corner : occluder)
    {
      corner += middle + shift;
    }
    polygons.push_back(occluder);
  }
  return polygons;
}

//------------------------------------------------------------------------------
// Estimates cover the errors of nearly all pairs, and in sum. Pairs that share an edge (kind 4) are
// known to converge more slowly than estimated: they are held to a bound of their own.
void TestEstimates(double tolerance)
{
  Random random(5);
  int count = 0;
  int covered = 0;
  double errors = 0.0;
  double estimates = 0.0;
  double adjacentErrors = 0.0;
  for (int k = 0; k < 300; ++k)
  {
    const int kind = k % NumberOfKinds;
    const Case scene(MakeRandomPair(random, kind));
    if (!scene.IsFacing())
    {
      continue;
    }
    const Share exact = GetReference(scene, 16);
    const Share share = GetShare(scene, tolerance, static_cast<std::uint64_t>(k));
    const double error = std::max(0.0, std::abs(share.Value - exact.Value) - exact.Error);
    Check(share.Value >= 0.0 && share.Value <= 1.0 && share.Error >= 0.0, "share out of range");
    if (kind == 4)
    {
      adjacentErrors += error;
      continue;
    }
    ++count;
    covered += error <= share.Error + 1e-6 ? 1 : 0;
    errors += error;
    estimates += share.Error;
  }
  const std::string what = "tolerance " + std::to_string(tolerance);
  // Measured: 89 % at 1e-2, where two grids are all that is compared, 93 to 95 % below.
  Check(covered >= (tolerance > 5e-3 ? 0.88 : 0.93) * count,
    what + ": " + std::to_string(covered) + " of " + std::to_string(count) + " pairs covered");
  Check(errors <= estimates,
    what + ": errors " + std::to_string(errors) + ", estimates " + std::to_string(estimates));
  CheckClose(adjacentErrors / 43.0, 0.0, 1e-3 + tolerance, what + ": mean error at shared edges");
}

//------------------------------------------------------------------------------
// Single things between two plates.
void TestThings()
{
  const auto check = [](const std::vector<Corners>& between, const std::string& what)
  {
    const Case scene(MakePlates(between));
    const Share exact = GetReference(scene, 30);
    const Share share = GetShare(scene, 1e-4);
    CheckClose(std::abs(share.Value - exact.Value), 0.0, share.Error + exact.Error + 1e-4, what);
    const Share swapped = GetShare(scene, 1e-4, 7, true);
    CheckClose(swapped.Value - share.Value, 0.0, share.Error + swapped.Error + 1e-5,
      what + ", swapped");
  };
  const Vector u(0.2, 0.1, 0.0), v(-0.1, 0.3, 0.0);
  check({ MakeSquare({ 0.4, 0.6, 0.05 }, u, v) }, "near the lower plate");
  check({ MakeSquare({ 0.4, 0.6, 0.5 }, u, v) }, "in the middle");
  check({ MakeSquare({ 0.4, 0.6, 0.97 }, u, v) }, "near the upper plate");
  check({ MakeSquare({ 0.4, 0.6, 0.1 }, u, { 0.0, 0.1, 0.3 }) }, "through the lower plane");
  check({ { { 0.2, 0.0, 0.0 }, { 0.8, 0.0, 0.0 }, { 0.5, 0.3, 0.4 } } }, "hinged on an edge");
  const double in = 0.45, out = 3.0;
  check({ { { -out, -out, 0.5 }, { in, -out, 0.5 }, { in, out, 0.5 }, { -out, out, 0.5 } },
          { { 0.6, -out, 0.5 }, { out, -out, 0.5 }, { out, out, 0.5 }, { 0.6, out, 0.5 } },
          { { in, -out, 0.5 }, { 0.6, -out, 0.5 }, { 0.6, 0.4, 0.5 }, { in, 0.4, 0.5 } },
          { { in, 0.6, 0.5 }, { 0.6, 0.6, 0.5 }, { 0.6, out, 0.5 }, { in, out, 0.5 } } },
    "a hole in a screen");
  const Case coplanar(
    MakePlates({ MakeSquare({ 0.4, 0.6, 0.0 }, u, v), MakeSquare({ 0.5, 0.5, 1.0 }, v, u) }));
  const Share share = GetShare(coplanar, 1e-4);
  CheckClose(share.Value, 1.0, 0.0, "what lies in the planes hides nothing");
  CheckClose(share.Error, 0.0, 0.0, "what lies in the planes hides nothing for certain");
}
} // namespace

//------------------------------------------------------------------------------
int TestPairVisibility(int, char*[])
{
  TestScreens();
  TestThings();
  for (const double tolerance : { 1e-2, 1e-3, 1e-4 })
  {
    TestEstimates(tolerance);
  }
  return Result();
}
