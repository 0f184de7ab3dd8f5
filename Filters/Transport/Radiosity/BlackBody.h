// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What a black body emits at its temperature, in kelvin and W/m2.
#ifndef BlackBody_h
#define BlackBody_h

#include <vector>

namespace LightTransport
{
namespace BlackBody
{
/// Its fourth power is still far from overflow.
constexpr double HighestTemperature = 1e30;

/// In a band of these limits (wavelengths in micrometres); without limits, at all wavelengths.
double GetFlux(double temperature, const std::vector<double>& bandLimits, int band);

/// The temperature at which it emits this at all wavelengths.
double GetTemperature(double flux);
} // namespace BlackBody
} // namespace LightTransport

#endif
