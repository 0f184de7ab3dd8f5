// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of integrals over pairs of triangles share.
#ifndef ScatteringIntegralsTesting_h
#define ScatteringIntegralsTesting_h

#include "LightTransportTesting.h"
#include "Scattering/ScatteringIntegrals.h"

#include <functional>
#include <string>

namespace LightTransportTesting
{
/// The four quarters of a triangle: with themselves and with each other they make the whole.
/// `compare` gets what a band of it gives itself.
inline void CheckQuarters(const LightTransport::ScatteringProfiles& profiles, double size,
  double tolerance,
  const std::function<void(const LightTransport::ScatteringIntegrals::Triangle&, int band,
    double value)>& compare)
{
  using LightTransport::ScatteringIntegrals;
  using Vector = ScatteringIntegrals::Vector;
  using Triangle = ScatteringIntegrals::Triangle;
  const ScatteringIntegrals integrals(profiles, 20.0 * size, tolerance);
  const Vector a = size * Vector(0, 0, 0), b = size * Vector(1, 0, 0),
               c = size * Vector(0.8, 0.3, 0.4);
  const Triangle whole(a, b, c);
  const Vector ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  const Triangle quarters[4] = { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { bc, ca, ab } };
  ScatteringIntegrals::Result self, parts, pairs;
  integrals.AddSelf(whole, self);
  for (int i = 0; i < 4; ++i)
  {
    integrals.AddSelf(quarters[i], parts);
    for (int j = 0; j < i; ++j)
    {
      integrals.AddPair(quarters[i], quarters[j], 1e-6 * self.Value[0], pairs);
    }
  }
  for (int band = 0; band < 3; ++band)
  {
    const std::string what =
      "self, size " + std::to_string(size) + ", band " + std::to_string(band);
    CheckClose(parts.Value[band] + 2.0 * pairs.Value[band], self.Value[band], 1e-4, what);
    Check(self.Value[band] < whole.Area, what + " is below all that enters");
    compare(whole, band, self.Value[band]);
  }
}
} // namespace LightTransportTesting

#endif
