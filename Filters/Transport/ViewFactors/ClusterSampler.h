// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// A few points on a cluster or a patch: one of each of equal parts of the area, in the order of
/// the tree, in which neighbours are neighbours in space.
#ifndef ClusterSampler_h
#define ClusterSampler_h

#include "Links/LinkSlots.h"
#include "Scene/PatchScene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace LightTransport
{
class ClusterSampler
{
public:
  /// Points on each of two clusters.
  static constexpr int Points = 4;

  struct Sample
  {
    vtkIdType Patch;
    PatchScene::Vector Point;
  };
  using Samples = std::array<Sample, Points>;

  /// Random numbers from 0 to 1 from a key, equal for equal keys: splitmix64 (Steele, Lea and Flood
  /// 2014).
  class Randomness
  {
  public:
    Randomness(int i, int j)
      : State((static_cast<std::uint64_t>(i) << 32) ^ static_cast<std::uint64_t>(j))
    {
    }
    double Get()
    {
      this->State += 0x9E3779B97F4A7C15ull;
      std::uint64_t bits = this->State;
      bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ull;
      bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBull;
      return static_cast<double>((bits ^ (bits >> 31)) >> 11) * 0x1.0p-53;
    }

  private:
    std::uint64_t State;
  };

  /// Scene and slots must outlive this.
  ClusterSampler(const PatchScene& scene, const LinkSlots& slots);

  Samples Take(int slot, Randomness& random) const;

private:
  PatchScene::Vector GetPoint(vtkIdType patch, double u, double v) const;

  const PatchScene& Scene;
  const LinkSlots& Slots;
  std::vector<double> AreaBefore; ///< of the patches before each; the whole area last
};
} // namespace LightTransport

#endif
