// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/QuadratureRules.h"

#include <Eigen/Geometry>

#include <cmath>

namespace LightTransport
{
namespace QuadratureRules
{
namespace
{
//------------------------------------------------------------------------------
// Symmetric rules on a triangle (Dunavant, Int. J. Numer. Meth. Eng. 21, 1985; Strang and Fix
// 1973). An orbit is one point of barycentric coordinates (alpha, beta, gamma) and all its
// permutations: 1 point where all are equal, 3 where two are, else 6.
struct Orbit
{
  double Weight;
  double Alpha;
  double Beta;

  double GetGamma() const { return 1.0 - this->Alpha - this->Beta; }
  int GetNumberOfPoints() const
  {
    return this->Alpha == this->Beta ? 1 : (std::abs(this->GetGamma() - this->Beta) < 1e-9 ? 3 : 6);
  }
};
struct TriangleRule
{
  int Points;
  int Orbits;
  struct Orbit Orbit[5];
};
constexpr double Third = 1.0 / 3.0;
constexpr TriangleRule TriangleRules[NumberOfRules] = {
  { 1, 1, { { 1.0, Third, Third }, {}, {}, {}, {} } },
  { 3, 1, { { Third, 2.0 / 3.0, 1.0 / 6.0 }, {}, {}, {}, {} } },
  { 6, 2,
    { { 0.223381589678011, 0.108103018168070, 0.445948490915965 },
      { 0.109951743655322, 0.816847572980459, 0.0915762135097705 }, {}, {}, {} } },
  { 7, 3,
    { { 0.225, Third, Third }, { 0.132394152788506, 0.059715871789770, 0.470142064105115 },
      { 0.125939180544827, 0.797426985353087, 0.1012865073234565 }, {}, {} } },
  { 16, 5,
    { { 0.144315607677787, Third, Third },
      { 0.095091634267285, 0.081414823414554, 0.459292588292723 },
      { 0.103217370534718, 0.658861384496480, 0.170569307751760 },
      { 0.032458497623198, 0.898905543365938, 0.050547228317031 },
      { 0.027230314174435, 0.008394777409958, 0.263112829634638 } } },
};

// Gauss-Legendre points per side of a quadrilateral: the bilinear map takes polynomials of degree p
// and its Jacobian to degree p + 1 in each of its parameters.
constexpr int SidePoints[NumberOfRules] = { 1, 2, 3, 4, 5 };
constexpr double SideNodes[NumberOfRules][5] = { { 0.0 },
  { -0.577350269189625764509, 0.577350269189625764509 },
  { -0.774596669241483377036, 0.0, 0.774596669241483377036 },
  { -0.861136311594052575224, -0.339981043584856264803, 0.339981043584856264803,
    0.861136311594052575224 },
  { -0.906179845938663992798, -0.538469310105683091036, 0.0, 0.538469310105683091036,
    0.906179845938663992798 } };
constexpr double SideWeights[NumberOfRules][5] = { { 2.0 }, { 1.0, 1.0 },
  { 5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0 },
  { 0.347854845137453857373, 0.652145154862546142627, 0.652145154862546142627,
    0.347854845137453857373 },
  { 0.236926885056189087514, 0.478628670499366468041, 0.568888888888888888889,
    0.478628670499366468041, 0.236926885056189087514 } };
} // namespace

//------------------------------------------------------------------------------
int GetNumberOfPoints(int rule)
{
  return TriangleRules[rule].Points;
}

//------------------------------------------------------------------------------
void Make(const Polygon& polygon, int rule, Vector* points, double* weights)
{
  const TriangleRule& triangle = TriangleRules[rule];
  for (int corner = 1; corner + 1 < polygon.Count; ++corner)
  {
    const Vector& a = polygon.Corners[0];
    const Vector& b = polygon.Corners[corner];
    const Vector& c = polygon.Corners[corner + 1];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    const Vector* corners[6][3] = { { &a, &b, &c }, { &b, &c, &a }, { &c, &a, &b }, { &a, &c, &b },
      { &b, &a, &c }, { &c, &b, &a } };
    for (int index = 0; index < triangle.Orbits; ++index)
    {
      const Orbit& orbit = triangle.Orbit[index];
      for (int point = 0; point < orbit.GetNumberOfPoints(); ++point)
      {
        *points++ = orbit.Alpha * *corners[point][0] + orbit.Beta * *corners[point][1] +
          orbit.GetGamma() * *corners[point][2];
        *weights++ = area * orbit.Weight;
      }
    }
  }
}

//------------------------------------------------------------------------------
int GetNumberOfPoints(int rule, int corners)
{
  if (rule == 0)
  {
    return 1;
  }
  return corners == 4 ? SidePoints[rule] * SidePoints[rule]
                      : TriangleRules[rule].Points * (corners - 2);
}

//------------------------------------------------------------------------------
void MakeCompact(const Polygon& polygon, int rule, Vector* points, double* weights)
{
  if (polygon.Count != 4)
  {
    Make(polygon, rule, points, weights);
    return;
  }
  const Vector& a = polygon.Corners[0];
  const Vector u = polygon.Corners[1] - a;
  const Vector v = polygon.Corners[3] - a;
  const Vector twist = polygon.Corners[2] - polygon.Corners[1] - v;
  for (int i = 0; i < SidePoints[rule]; ++i)
  {
    const double s = 0.5 + 0.5 * SideNodes[rule][i];
    for (int j = 0; j < SidePoints[rule]; ++j)
    {
      const double t = 0.5 + 0.5 * SideNodes[rule][j];
      const double jacobian = (u + t * twist).cross(v + s * twist).norm();
      *points++ = a + s * u + t * (v + s * twist);
      *weights++ = 0.25 * SideWeights[rule][i] * SideWeights[rule][j] * jacobian;
    }
  }
}
} // namespace QuadratureRules
} // namespace LightTransport
