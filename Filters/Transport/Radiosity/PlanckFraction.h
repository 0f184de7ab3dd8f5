// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The share of black body radiation that lies in a band of wavelengths, to rounding.
 *
 * With z = C2 / (wavelength T) the share below a wavelength is 15 / pi^4 times the integral of
 * x^3 / (e^x - 1) from z to infinity: sum_n e^{-n z} / n (z^3 + 3 z^2 / n + 6 z / n^2 + 6 / n^3)
 * (Siegel and Howell, Thermal Radiation Heat Transfer), and where that converges slowly one minus
 * the integral of the Taylor series (Bernoulli numbers) from 0 to z.
 */
#ifndef PlanckFraction_h
#define PlanckFraction_h

namespace LightTransport
{
namespace PlanckFraction
{
///@{
/// The shares below and above a wavelength. `product` is wavelength times temperature in micrometre
/// kelvin, 0 to infinity. Small shares keep their digits.
double GetBelow(double product);
double GetAbove(double product);
///@}

/// The share between two wavelengths in micrometres (0 <= shorter <= longer <= infinity) at a
/// temperature in kelvin. At 0 K it is 0: nothing is emitted.
double GetBand(double shorter, double longer, double temperature);
} // namespace PlanckFraction
} // namespace LightTransport

#endif
