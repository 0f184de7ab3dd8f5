// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Weights of photons as whole numbers of a small unit: sums are the same in whichever order
/// photons come, on any number of threads and ranks.
#ifndef PhotonUnits_h
#define PhotonUnits_h

#include <cmath>
#include <cstdint>

namespace LightTransport
{
namespace PhotonUnits
{
/// Sums of 2^31 photons that weigh 3 fit.
constexpr std::int64_t PerPhoton = std::int64_t(1) << 30;

inline std::int64_t Count(double weight)
{
  return std::llround(weight * PerPhoton);
}
} // namespace PhotonUnits
} // namespace LightTransport

#endif
