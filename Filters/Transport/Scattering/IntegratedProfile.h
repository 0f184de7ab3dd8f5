// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A profile that is a formula for R_d(r) and no more: tail, moments and decay are computed from its
 * values, once. They are tabulated over the logarithm of the radius, as logarithms, in which powers
 * and the transitions between them are smooth, from far within the centre to where nothing is left:
 * relative errors are below 1e-7 at any radius.
 */
#ifndef IntegratedProfile_h
#define IntegratedProfile_h

#include "Scattering/ScatteringProfile.h"

#include <cstddef>
#include <vector>

namespace LightTransport
{
class IntegratedProfile : public ScatteringProfile
{
public:
  double GetTail(double radius) const override;
  void GetMoments(double radius, double moments[3]) const override;
  double GetSmallestScale() const override { return this->Scale; }
  double GetDecay() const override { return this->Decay; }

protected:
  /// To be called at the end of a constructor, when Evaluate works, and again when it has changed.
  /// `scale` is that of the profile.
  void Integrate(double scale);

private:
  /// The logarithm of a quantity and its slope over the logarithm of the radius.
  struct Knot
  {
    double Value = 0.0;
    double Slope = 0.0;
  };
  enum Quantity
  {
    FIRST_MOMENT, // three of them
    TAIL = 3,
    NUMBER_OF_QUANTITIES = 4
  };

  double GetRadius(double position) const;
  void AddInterval(std::size_t interval, double sums[3]) const;
  double EstimatePower(double radius) const;
  void IntegrateMoments();
  void IntegrateTail();
  void MeasureDecay();
  double Interpolate(int quantity, double position) const;

  double Scale = 1.0;
  double Decay = 0.0;
  double Total = 0.0;
  /// From here on the tail is the more exact one, before it the moment.
  double FirstFar = 0.0;
  std::vector<Knot> Table[NUMBER_OF_QUANTITIES];
};
} // namespace LightTransport

#endif
