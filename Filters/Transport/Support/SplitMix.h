// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The generator splitmix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom
/// number generators", OOPSLA 2014): well mixed bits from any seed, also from seeds that follow
/// each other.
#ifndef SplitMix_h
#define SplitMix_h

#include <cstdint>

namespace LightTransport
{
class SplitMix
{
public:
  explicit SplitMix(std::uint64_t seed) : State(seed) {}

  std::uint64_t GetNext()
  {
    const std::uint64_t bits = this->Step();
    return bits ^ (bits >> 31);
  }

  /// Half as many, without the last step, which is for the lower half.
  std::uint32_t GetNextHalf() { return static_cast<std::uint32_t>(this->Step() >> 32); }

private:
  std::uint64_t Step()
  {
    this->State += 0x9E3779B97F4A7C15ull;
    std::uint64_t bits = this->State;
    bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
    return (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
  }

  std::uint64_t State;
};
} // namespace LightTransport

#endif
