// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The profile integrated over pairs of triangles and over one triangle twice, against brute force,
// for triangles from much smaller to much larger than the mean free path.
#include "LightTransportTesting.h"
#include "Scattering/DipoleProfile.h"
#include "Scattering/PhotonBeamProfile.h"
#include "Scattering/ScatteringIntegrals.h"
#include "ScatteringIntegralsTesting.h"
#include "vtkMath.h"

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Vector = ScatteringIntegrals::Vector;
using Triangle = ScatteringIntegrals::Triangle;
using Result3 = ScatteringIntegrals::Result;

constexpr double Tolerance = 4e-5;

//------------------------------------------------------------------------------
ScatteringProfiles MakeProfiles()
{
  const ScatteringMedium media[] = { { 2.19, 0.0021, 1.5 }, { 2.62, 0.0041, 1.5 },
    { 1.0, 1.0, 1.3 } };
  ScatteringProfiles profiles;
  for (const ScatteringMedium& medium : media)
  {
    profiles.push_back(std::make_unique<DipoleProfile>(medium));
  }
  return profiles;
}

//------------------------------------------------------------------------------
std::vector<Vector> GetCentroids(const Triangle& triangle, int cuts)
{
  std::vector<Vector> centroids;
  const Vector u = (triangle.Corners[1] - triangle.Corners[0]) / cuts;
  const Vector v = (triangle.Corners[2] - triangle.Corners[0]) / cuts;
  for (int i = 0; i < cuts; ++i)
  {
    for (int j = 0; j < cuts - i; ++j)
    {
      const Vector corner = triangle.Corners[0] + i * u + j * v;
      centroids.push_back(corner + (u + v) / 3.0);
      if (j < cuts - i - 1)
      {
        centroids.push_back(corner + 2.0 * (u + v) / 3.0);
      }
    }
  }
  return centroids;
}

//------------------------------------------------------------------------------
/// All pairs of small triangles by their centroids.
double SumCentroids(const ScatteringProfile& profile, const Triangle& a, const Triangle& b,
  int cuts)
{
  const std::vector<Vector> from = GetCentroids(a, cuts);
  const std::vector<Vector> to = GetCentroids(b, cuts);
  double sum = 0.0;
  for (const Vector& x : from)
  {
    for (const Vector& y : to)
    {
      sum += profile.Evaluate((x - y).norm());
    }
  }
  return sum / (from.size() * to.size());
}

//------------------------------------------------------------------------------
/// Mean of the profile over both triangles, over its total; the error falls with the square of the
/// number of cuts, which extrapolation removes.
double BruteForce(const ScatteringProfile& profile, const Triangle& a, const Triangle& b, int cuts)
{
  const double coarse = SumCentroids(profile, a, b, cuts / 2);
  const double fine = SumCentroids(profile, a, b, cuts);
  return a.Area * b.Area * (4.0 * fine - coarse) / 3.0 / profile.GetTotal();
}

//------------------------------------------------------------------------------
struct Case
{
  const char* Name;
  Vector Corners[3];
};

const Vector Origin(0, 0, 0);
const Vector Side(1, 0, 0);

const Case Cases[] = { { "coplanar edge", { Side, Origin, { 0.6, -0.8, 0.0 } } },
  { "tilted edge", { Side, Origin, { 0.6, -0.8, 0.3 } } },
  { "folded edge", { Side, Origin, { 0.5, 0.1, 0.7 } } },
  { "corner", { Side, { 1.8, 0.3, 0.2 }, { 0.9, 1.2, 0.6 } } },
  { "near", { { 1.8, 0.3, 0.2 }, { 2.8, 0.3, 0.2 }, { 2.2, 1.2, 0.2 } } },
  { "far", { { 8.0, 1.0, 3.0 }, { 9.0, 1.0, 3.0 }, { 8.4, 1.9, 3.5 } } } };

//------------------------------------------------------------------------------
void TestPairs()
{
  const ScatteringProfiles profiles = MakeProfiles();
  for (const double size : { 0.003, 0.05, 0.5, 3.0 })
  {
    const ScatteringIntegrals integrals(profiles, 20.0 * size, Tolerance);
    const Triangle first(size * Origin, size * Side, size * Vector(0.4, 0.9, 0.0));
    for (const Case& other : Cases)
    {
      const Triangle second(size * other.Corners[0], size * other.Corners[1],
        size * other.Corners[2]);
      const double tolerance = 1e-12 * first.Area;
      Result3 result;
      Result3 mirrored;
      integrals.AddPair(first, second, tolerance, result);
      integrals.AddPair(second, first, tolerance, mirrored);
      for (int band = 0; band < 3; ++band)
      {
        const std::string what = std::string(other.Name) + ", size " + std::to_string(size) +
          ", band " + std::to_string(band);
        const double expected = BruteForce(*profiles[band], first, second, size > 1.0 ? 48 : 16);
        Check(std::abs(result.Value[band] - expected) <= 2e-4 * expected + 10.0 * tolerance, what);
        Check(std::abs(mirrored.Value[band] - expected) <= 2e-4 * expected + 10.0 * tolerance,
          what + " mirrored");
      }
      Check(result.Error <= 2.0 * Tolerance * result.Value.maxCoeff() + 10.0 * tolerance,
        std::string(other.Name) + ": error estimate within the tolerance");
    }
  }
}

//------------------------------------------------------------------------------
void TestSelf()
{
  const ScatteringProfiles profiles = MakeProfiles();
  for (const double size : { 0.003, 0.05, 0.5, 3.0, 20.0, 300.0, 1e4, 1e6 })
  {
    CheckQuarters(profiles, size, Tolerance,
      [&](const Triangle& whole, int band, double value)
      {
        if (size < 1.0 && band == 0)
        {
          CheckClose(value, BruteForce(*profiles[0], whole, whole, 16), 1e-3,
            "self against brute force, size " + std::to_string(size));
        }
      });
  }
}

//------------------------------------------------------------------------------
/// A patch far wider than the mean free path keeps all but what crosses its edges: per length of
/// edge, 2 int R r^2 dr.
void TestWidePatch()
{
  const ScatteringProfiles profiles = MakeProfiles();
  const double size = 3000.0;
  const ScatteringIntegrals integrals(profiles, 2.0 * size, Tolerance);
  const Triangle patch(size * Origin, size * Side, size * Vector(0.4, 0.9, 0.0));
  double perimeter = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    perimeter += (patch.Corners[k] - patch.Corners[(k + 1) % 3]).norm();
  }
  Result3 self;
  integrals.AddSelf(patch, self);
  for (int band = 0; band < 3; ++band)
  {
    double moments[3];
    profiles[band]->GetMoments(1e4, moments);
    // A convex body and its copy displaced by r overlap in A - r P / pi on average over directions.
    const double crossing = 2.0 * perimeter * moments[1] / profiles[band]->GetTotal();
    CheckClose(patch.Area - self.Value[band], crossing, 2e-2,
      "crossing the edges, band " + std::to_string(band));
  }
}

//------------------------------------------------------------------------------
/// Across an edge on which two wide patches lie: coplanar ones exchange 2 int R r^2 dr per length.
/// Where one of them is cut through its far corner, each part has a piece of the edge: together
/// they exchange the same, at any angle and width.
void TestWideNeighbours()
{
  const ScatteringProfiles profiles = MakeProfiles();
  for (const double size : { 10.0, 100.0, 1e3, 1e5 })
  {
    const ScatteringIntegrals integrals(profiles, 3.0 * size, Tolerance);
    const Triangle first(size * Origin, size * Side, size * Vector(0.4, 0.9, 0.0));
    for (const double tilt : { 0.0, 0.3, 2.0, -1.2 })
    {
      const Vector apex = size * Vector(0.6, -0.8 * std::cos(tilt), -0.8 * std::sin(tilt));
      const Vector middle = size * Vector(0.35, 0.0, 0.0);
      const double tolerance = 1e-9 * size;
      Result3 whole;
      Result3 parts;
      integrals.AddPair(first, { size * Side, size * Origin, apex }, tolerance, whole);
      integrals.AddPair(first, { size * Side, middle, apex }, tolerance, parts);
      integrals.AddPair({ middle, size * Origin, apex }, first, tolerance, parts);
      for (int band = 0; band < 3; ++band)
      {
        const std::string what = "size " + std::to_string(size) + ", tilt " + std::to_string(tilt) +
          ", band " + std::to_string(band);
        CheckClose(parts.Value[band], whole.Value[band], 4.0 * Tolerance, "parts, " + what);
        double moments[3];
        profiles[band]->GetMoments(1e5, moments);
        const double crossing = 2.0 * size * moments[1] / profiles[band]->GetTotal();
        if (tilt == 0.0)
        {
          CheckClose(whole.Value[band], crossing, 20.0 / size + 1e-3, "crossing, " + what);
        }
      }
      Check(whole.Error <= 2.0 * Tolerance * whole.Value.maxCoeff(),
        "error estimate within the tolerance, size " + std::to_string(size));
    }
  }
}

//------------------------------------------------------------------------------
/// Both sides of a sheet: against brute force where that can tell, and its parts make up the whole.
/// A patch far wider than the distance gives what lies opposite all but what passes beside it.
void TestSheets()
{
  const ScatteringProfiles profiles = MakeProfiles();
  const double distance = 2.0;
  const Vector across(0.0, 0.0, distance);
  for (const double size : { 10.0, 1e3, 1e5 })
  {
    const ScatteringIntegrals integrals(profiles, 3.0 * size, Tolerance);
    const Triangle first(size * Origin, size * Side, size * Vector(0.4, 0.9, 0.0));
    for (const double turn : { 0.0, 0.5, vtkMath::Pi() })
    {
      const auto place = [&](double x, double y)
      {
        const double u = x - 0.5, v = y - 0.3;
        return Vector(size *
            Vector(0.5 + u * std::cos(turn) - v * std::sin(turn),
              0.3 + u * std::sin(turn) + v * std::cos(turn), 0.0) +
          across);
      };
      const Vector p = place(0.0, 0.0), q = place(0.4, 0.9), r = place(1.0, 0.0);
      const Vector middle = 0.3 * p + 0.7 * r;
      const double tolerance = 1e-9 * size * size;
      Result3 whole;
      Result3 parts;
      integrals.AddPair(first, { p, q, r }, tolerance, whole);
      integrals.AddPair(first, { p, q, middle }, tolerance, parts);
      integrals.AddPair({ middle, q, r }, first, tolerance, parts);
      for (int band = 0; band < 3; ++band)
      {
        const std::string what = "sheet, size " + std::to_string(size) + ", turn " +
          std::to_string(turn) + ", band " + std::to_string(band);
        CheckClose(parts.Value[band], whole.Value[band], 4.0 * Tolerance, "parts, " + what);
        if (size < 20.0)
        {
          const double expected = BruteForce(*profiles[band], first, Triangle(p, q, r), 60);
          CheckClose(whole.Value[band], expected, 1e-3, "brute force, " + what);
        }
        else if (turn == 0.0)
        {
          CheckClose(whole.Value[band],
            first.Area * profiles[band]->GetTail(distance) / profiles[band]->GetTotal(),
            60.0 / size, "opposite, " + what);
        }
      }
      Check(whole.Error <= 2.0 * Tolerance * whole.Value.maxCoeff(),
        "error estimate within the tolerance, size " + std::to_string(size));
    }
  }
}

//------------------------------------------------------------------------------
/// In one plane two may overlap: a copy gives what the triangle gives itself, seen from either
/// side, and the parts of what overlaps by a little or by much, or not at all, give the whole.
void TestOnePlane()
{
  ScatteringProfiles dipoles = MakeProfiles();
  ScatteringProfiles beams;
  for (const double scattering : { 2.19, 2.62, 1.0 })
  {
    beams.push_back(std::make_unique<PhotonBeamProfile>(ScatteringMedium{ scattering, 0.01, 1.5 }));
  }
  for (const double size : { 0.01, 0.5, 10.0 })
  {
    for (const ScatteringProfiles* profiles : { &dipoles, &beams })
    {
      const std::string name =
        std::string(profiles == &beams ? "1/r" : "finite") + ", size " + std::to_string(size);
      const ScatteringIntegrals integrals(*profiles, 10.0 * size, Tolerance);
      const auto place = [&](double x, double y) { return Vector(size * Vector(x, y, 0.0)); };
      const Triangle first(place(0.0, 0.0), place(1.0, 0.0), place(0.4, 0.9));
      const double tolerance = 1e-9 * first.Area;
      const Vector* const c = first.Corners;
      Result3 self;
      Result3 front;
      Result3 back;
      integrals.AddSelf(first, self);
      integrals.AddPair(first, { c[1], c[2], c[0] }, tolerance, front);
      integrals.AddPair(first, { c[1], c[0], c[2] }, tolerance, back);
      for (const double gap : { -0.5, -0.01, -1e-6, 1e-6, 0.1 })
      {
        const Vector p = place(-0.1, -gap), q = place(0.9, -gap), r = place(0.6, -gap - 0.7);
        const Vector middle = 0.3 * p + 0.7 * q;
        Result3 whole;
        Result3 parts;
        integrals.AddPair(first, { q, p, r }, tolerance, whole);
        integrals.AddPair(first, { middle, p, r }, tolerance, parts);
        integrals.AddPair({ q, middle, r }, first, tolerance, parts);
        for (int band = 0; band < 3; ++band)
        {
          CheckClose(parts.Value[band], whole.Value[band], 4.0 * Tolerance,
            "parts, gap " + std::to_string(gap) + ", " + name);
        }
        Check(whole.Error <= 2.0 * Tolerance * whole.Value.maxCoeff() + 2.0 * tolerance,
          "error estimate within the tolerance, gap " + std::to_string(gap) + ", " + name);
      }
      for (int band = 0; band < 3; ++band)
      {
        CheckClose(front.Value[band], self.Value[band], 4.0 * Tolerance, "copy, " + name);
        CheckClose(back.Value[band], self.Value[band], 4.0 * Tolerance, "copy's back, " + name);
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestScatteringIntegrals(int, char*[])
{
  TestPairs();
  TestSelf();
  TestWidePatch();
  TestWideNeighbours();
  TestSheets();
  TestOnePlane();
  return Result();
}
