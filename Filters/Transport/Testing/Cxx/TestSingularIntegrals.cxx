// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Profiles that go like 1/r at the centre, integrated over pairs of triangles that touch, coincide
// or almost do, from much smaller to much larger than the mean free path: against brute force that
// is exact around each point. One model for each band.
#include "LightTransportTesting.h"
#include "Scattering/ScatteringIntegrals.h"
#include "Scattering/ScatteringModels.h"
#include "ScatteringIntegralsTesting.h"
#include "Shared/GaussLegendre.h"
#include "vtkSubsurfaceScattering.h"

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
using Filter = vtkSubsurfaceScattering;
using Vector = ScatteringIntegrals::Vector;
using Triangle = ScatteringIntegrals::Triangle;
using Result3 = ScatteringIntegrals::Result;

constexpr double Tolerance = 4e-5;

//------------------------------------------------------------------------------
ScatteringProfiles MakeProfiles()
{
  const ScatteringMedium marble = { 2.19, 0.0021, 1.5 };
  const ScatteringMedium dark = { 1.0, 1.0, 1.3 };
  ScatteringProfiles profiles;
  profiles.push_back(
    ScatteringModels::Find(Filter::MODEL_PHOTON_BEAM_DIFFUSION)->MakeProfile(marble, {}));
  profiles.push_back(ScatteringModels::Find(Filter::MODEL_BETTER_DIPOLE)->MakeProfile(dark, {}));
  profiles.push_back(
    ScatteringModels::Find(Filter::MODEL_CHRISTENSEN_BURLEY)->MakeProfile(marble, {}));
  return profiles;
}

//------------------------------------------------------------------------------
/// The profile around a point integrated over a triangle: in polar coordinates around the foot of
/// the point the radius is exact, by tails, and the angle is one along each edge.
double IntegrateAround(const ScatteringProfile& profile, const Vector& point, const Triangle& other)
{
  static const GaussLegendre rule(10);
  const Vector normal =
    (other.Corners[1] - other.Corners[0]).cross(other.Corners[2] - other.Corners[0]).normalized();
  const double height = normal.dot(point - other.Corners[0]);
  const Vector foot = point - height * normal;
  const double nearest = profile.GetTail(std::abs(height));
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const Vector& begin = other.Corners[k];
    const Vector edge = other.Corners[(k + 1) % 3] - begin;
    const double length = edge.norm();
    const Vector axis = edge / length;
    const double distance = normal.dot(axis.cross(foot - begin));
    if (std::abs(distance) < 1e-12 * length)
    {
      continue;
    }
    // Places along the edge are distance sinh(t): the angle changes by dt / cosh(t).
    const double away = std::abs(distance);
    const double first = std::asinh(axis.dot(begin - foot) / away);
    const double last = std::asinh((axis.dot(begin - foot) + length) / away);
    const int parts = static_cast<int>(std::ceil(last - first));
    for (int i = 0; i < parts * 10; ++i)
    {
      const double t = first + (last - first) / parts * (i / 10 + rule.Nodes[i % 10]);
      const double angle = (last - first) / parts * rule.Weights[i % 10] / std::cosh(t);
      const double reach = std::hypot(height, away * std::cosh(t));
      sum += std::copysign(angle, distance) * (nearest - profile.GetTail(reach));
    }
  }
  return sum / (2.0 * vtkMath::Pi());
}

//------------------------------------------------------------------------------
/// Over points of the first triangle; over the profile's total.
double SumPoints(const ScatteringProfile& profile, const Triangle& a, const Triangle& b, int cuts)
{
  const Vector u = (a.Corners[1] - a.Corners[0]) / cuts;
  const Vector v = (a.Corners[2] - a.Corners[0]) / cuts;
  double sum = 0.0;
  for (int i = 0; i < cuts; ++i)
  {
    for (int j = 0; j < cuts - i; ++j)
    {
      const Vector corner = a.Corners[0] + i * u + j * v;
      sum += IntegrateAround(profile, corner + (u + v) / 3.0, b);
      if (j < cuts - i - 1)
      {
        sum += IntegrateAround(profile, corner + 2.0 * (u + v) / 3.0, b);
      }
    }
  }
  return sum * a.Area / (cuts * cuts) / profile.GetTotal();
}

//------------------------------------------------------------------------------
double BruteForce(const ScatteringProfile& profile, const Triangle& a, const Triangle& b, int cuts)
{
  const double coarse = SumPoints(profile, a, b, cuts / 2);
  const double fine = SumPoints(profile, a, b, cuts);
  return (4.0 * fine - coarse) / 3.0;
}

//------------------------------------------------------------------------------
struct Case
{
  const char* Name;
  Vector Corners[3];
};

const Vector Origin(0, 0, 0);
const Vector Side(1, 0, 0);
const Vector Apex(0.4, 0.9, 0.0);

const Case Cases[] = { { "coplanar edge", { Side, Origin, { 0.6, -0.8, 0.0 } } },
  { "part of an edge", { { 0.7, 0.0, 0.0 }, { 0.2, 0.0, 0.0 }, { 0.6, -0.8, 0.1 } } },
  { "tilted edge", { Side, Origin, { 0.6, -0.8, 0.3 } } },
  { "upright edge", { Side, Origin, { 0.5, 0.1, 0.7 } } },
  { "folded edge", { Side, Origin, { 0.5, 0.8, 0.2 } } },
  { "coplanar corner", { Side, { 1.8, 0.3, 0.0 }, { 0.9, 1.2, 0.0 } } },
  { "corner", { Side, { 1.8, 0.3, 0.2 }, { 0.9, 1.2, 0.6 } } },
  { "the same place", { Side, Origin, Apex } },
  { "overlapping", { { 0.2, 0.1, 0.0 }, { 1.3, 0.2, 0.0 }, { 0.5, 1.0, 0.0 } } },
  { "above", { { 0.2, 0.1, 0.1 }, { 1.3, 0.2, 0.1 }, { 0.5, 1.0, 0.1 } } },
  { "close above", { { 0.0, 0.0, 1e-3 }, { 1.0, 0.0, 1e-3 }, { 0.4, 0.9, 1e-3 } } },
  { "near", { { 1.05, 0.0, 0.0 }, { 2.0, 0.3, 0.2 }, { 1.5, 1.2, 0.2 } } },
  { "far", { { 8.0, 1.0, 3.0 }, { 9.0, 1.0, 3.0 }, { 8.4, 1.9, 3.5 } } } };

//------------------------------------------------------------------------------
void TestPairs()
{
  const ScatteringProfiles profiles = MakeProfiles();
  for (const double size : { 1e-6, 0.003, 0.1, 1.0 })
  {
    const ScatteringIntegrals integrals(profiles, 20.0 * size, Tolerance);
    const Triangle first(size * Origin, size * Side, size * Apex);
    for (const Case& other : Cases)
    {
      const Triangle second(size * other.Corners[0], size * other.Corners[1],
        size * other.Corners[2]);
      const double tolerance = 1e-10 * first.Area * integrals.GetLargestShare(first.Area);
      Result3 result;
      Result3 mirrored;
      integrals.AddPair(first, second, tolerance, result);
      integrals.AddPair(second, first, tolerance, mirrored);
      for (int band = 0; band < 3; ++band)
      {
        const std::string what = std::string(other.Name) + ", size " + std::to_string(size) +
          ", band " + std::to_string(band);
        const double expected = BruteForce(*profiles[band], first, second, size < 1.0 ? 40 : 80);
        Check(std::abs(result.Value[band] - expected) <= 3e-4 * expected + 10.0 * tolerance, what);
        Check(std::abs(mirrored.Value[band] - expected) <= 3e-4 * expected + 10.0 * tolerance,
          what + " mirrored");
      }
      Check(result.Error <= 2.0 * Tolerance * result.Value.maxCoeff() + 10.0 * tolerance,
        std::string(other.Name) + ", size " + std::to_string(size) +
          ": error estimate within the tolerance");
    }
  }
}

//------------------------------------------------------------------------------
void TestSelf()
{
  const ScatteringProfiles profiles = MakeProfiles();
  for (const double size : { 1e-9, 0.003, 0.05, 0.5, 3.0, 20.0, 300.0, 1e4, 1e6 })
  {
    CheckQuarters(profiles, size, Tolerance,
      [&](const Triangle& whole, int band, double value)
      {
        if (size < 1.0)
        {
          CheckClose(value, BruteForce(*profiles[band], whole, whole, 80), 3e-4,
            "self against brute force, size " + std::to_string(size) + ", band " +
              std::to_string(band));
        }
      });
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSingularIntegrals(int, char*[])
{
  TestPairs();
  TestSelf();
  return Result();
}
