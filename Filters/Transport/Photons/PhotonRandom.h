// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Random numbers of one photon: a stream of its own for each seed and photon, so that walks are the
 * same on any thread and in any order. The generator is xoroshiro128+ (D. Blackman, S. Vigna,
 * "Scrambled linear pseudorandom number generators", ACM TOMS 47, 2021).
 */
#ifndef PhotonRandom_h
#define PhotonRandom_h

#include "Support/SplitMix.h"

#include <Eigen/Core>

#include <cmath>
#include <cstdint>

namespace LightTransport
{
class PhotonRandom
{
public:
  PhotonRandom(std::uint64_t seed, std::uint64_t photon)
  {
    SplitMix key(seed);
    SplitMix bits(key.GetNext() ^ (photon * 0xD1342543DE82EF95ull));
    this->First = bits.GetNext();
    this->Second = bits.GetNext() | 1u;
  }

  /// Uniform in (0, 1).
  double Get()
  {
    const std::uint64_t sum = this->First + this->Second;
    const std::uint64_t mixed = this->Second ^ this->First;
    this->First = Rotate(this->First, 24) ^ mixed ^ (mixed << 16);
    this->Second = Rotate(mixed, 37);
    // The 53 bits of a double, the lowest of which is set: never 0.
    return static_cast<double>((sum >> 11) | 1u) * 0x1.0p-53;
  }

  /// Exponentially distributed, with mean 1.
  double GetExponential() { return -std::log(this->Get()); }

  /// Uniform within the unit circle; returns the square of its distance from the centre.
  double GetInCircle(double& x, double& y)
  {
    double square;
    do
    {
      x = 2.0 * this->Get() - 1.0;
      y = 2.0 * this->Get() - 1.0;
      square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    return square;
  }

  /// A direction, each as likely as any other (G. Marsaglia, Annals of Mathematical Statistics 43,
  /// 1972).
  Eigen::Vector3d GetDirection()
  {
    double x, y;
    const double square = this->GetInCircle(x, y);
    const double factor = 2.0 * std::sqrt(1.0 - square);
    return { factor * x, factor * y, 1.0 - 2.0 * square };
  }

private:
  static std::uint64_t Rotate(std::uint64_t bits, int by)
  {
    return (bits << by) | (bits >> (64 - by));
  }

  std::uint64_t First;
  std::uint64_t Second;
};
} // namespace LightTransport

#endif
