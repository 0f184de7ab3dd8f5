// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Shares of black body radiation against integrals with 30 digits, quadrature, and each other.
#include "LightTransportTesting.h"
#include "Radiosity/PlanckFraction.h"
#include "Shared/GaussLegendre.h"

#include <limits>

using namespace LightTransport;

using namespace LightTransportTesting;
using namespace PlanckFraction;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

//------------------------------------------------------------------------------
// From an arbitrary precision library: wavelength times temperature (micrometre kelvin), share.
void TestKnownShares()
{
  const double below[][2] = { { 100, 1.5320494436761839064e-57 }, { 500, 1.2987133217795937427e-9 },
    { 1000, 0.00032076978404488972166 }, { 2000, 0.066729940181385599418 },
    { 2897.771955, 0.25005454678069198748 }, { 4107, 0.49995645202439384081 },
    { 5000, 0.63372587191591024588 }, { 10000, 0.91415697092801560679 },
    { 14387, 0.96537751995632650309 }, { 14400, 0.96545838415259803075 },
    { 20000, 0.98555383866606544659 }, { 100000, 0.99985521024712409703 } };
  for (const auto& row : below)
  {
    CheckClose(GetBelow(row[0]), row[1], 3e-14, "share below " + std::to_string(row[0]));
    CheckClose(GetAbove(row[0]), 1.0 - row[1], 1e-12, "share above " + std::to_string(row[0]));
  }
  // Small shares at the other end.
  CheckClose(GetAbove(2e4), 0.014446161333934553407, 3e-14, "share above 2e4");
  CheckClose(GetAbove(1e5), 0.00014478975287590297422, 3e-14, "share above 1e5");
  CheckClose(GetAbove(1e6), 1.5205679759958959968e-7, 3e-14, "share above 1e6");
  CheckClose(GetBand(0.4, 0.7, 5772.0), 0.36638317138445865203, 1e-13, "visible sunlight");
  CheckClose(GetBand(8.0, 14.0, 300.0), 0.37574229364592431259, 1e-13, "atmospheric window");
}

//------------------------------------------------------------------------------
// Gauss-Legendre rules on intervals of x^3 / (e^x - 1).
double Integrate(double from, double to)
{
  constexpr int intervals = 30;
  const GaussLegendre rule(20);
  const double width = (to - from) / intervals;
  double sum = 0.0;
  for (int k = 0; k < intervals; ++k)
  {
    for (std::size_t n = 0; n < rule.Nodes.size(); ++n)
    {
      const double x = from + (k + rule.Nodes[n]) * width;
      sum += rule.Weights[n] * x * x * x / std::expm1(x);
    }
  }
  return 15.0 / std::pow(vtkMath::Pi(), 4) * sum * width;
}

//------------------------------------------------------------------------------
void TestQuadrature()
{
  constexpr double c2 = 14387.768775039338;
  for (double z = 0.01; z < 40.0; z *= 1.1)
  {
    CheckClose(GetBelow(c2 / z), Integrate(z, z + 60.0), 1e-12,
      "quadrature at z = " + std::to_string(z));
    Check(std::abs(GetBelow(c2 / z) + GetAbove(c2 / z) - 1.0) < 1e-15, "below and above are all");
  }
}

//------------------------------------------------------------------------------
void TestLimits()
{
  Check(GetBelow(0.0) == 0.0 && GetAbove(0.0) == 1.0, "nothing lies below 0");
  Check(GetBelow(Infinity) == 1.0 && GetAbove(Infinity) == 0.0, "nothing lies above infinity");
  Check(GetBelow(1.0) == 0.0 && GetBelow(1e-300) == 0.0, "shares too small for a number");
  Check(GetBand(0.0, Infinity, 300.0) == 1.0, "everything");
  Check(GetBand(0.0, Infinity, 0.0) == 0.0, "nothing at 0 K");
  Check(GetBand(5.0, 5.0, 1000.0) == 0.0, "an empty band");
  // Neighbours join, also where one formula takes over from another.
  for (const double temperature : { 3.0, 300.0, 2000.0, 1e5, 1e9 })
  {
    double sum = 0.0;
    double from = 0.0;
    for (const double to : { 0.1, 0.4, 0.7, 3.0, 5.0, 7.19, 8.0, 14.0, 48.0, 1000.0, Infinity })
    {
      const double share = GetBand(from, to, temperature);
      Check(share >= 0.0, "a share is not negative");
      sum += share;
      from = to;
    }
    CheckClose(sum, 1.0, 1e-14, "the shares of all bands at " + std::to_string(temperature));
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPlanckFraction(int, char*[])
{
  TestKnownShares();
  TestQuadrature();
  TestLimits();
  return Result();
}
