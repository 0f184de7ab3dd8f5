// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What an isotropic point source in an unbounded diffusive medium sends through a plane, times
 * 4 pi: z (1 + s d) exp(-s d) / d^3 at a distance r from the point next to the source, with z the
 * distance of the source from the plane, d^2 = r^2 + z^2 and s the effective transport coefficient.
 * Over the whole plane this is 2 pi exp(-s z). Profiles of diffusion theory are sums of such
 * sources. Lengths in millimetres.
 */
#ifndef PointSource_h
#define PointSource_h

#include <vector>

namespace LightTransport
{
class PointSource
{
public:
  /// `depth` is above 0, `transportCoefficient` not below.
  PointSource(double depth, double transportCoefficient);

  double GetDepth() const { return this->Depth; }

  double Evaluate(double radius) const;

  /// Integral over the plane beyond a radius, over 2 pi.
  double GetTail(double radius) const;

  /// Add the integrals from 0 to `radius` of the value times r^(k + 1) dr, k = 0, 1, 2.
  void AddMoments(double radius, double moments[3]) const;

private:
  void AddMomentsNearby(double radius, double moments[3]) const;
  double GetFirstMomentOfTail(double radius) const;
  void TabulateSecondMoment();
  double InterpolateSecondMoment(double radius) const;

  double Depth;
  double TransportCoefficient;

  /// Integral of exp(-s d) / d dr from 0 to r = z sinh(t), at equally spaced t.
  std::vector<double> Table;
};
} // namespace LightTransport

#endif
