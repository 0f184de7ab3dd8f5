// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What was found of pairs of slots (LinkEstimator) when links were refined, kept: nothing of it
 * depends on what the links are for. A finer threshold, or another brightness, goes down the same
 * pairs from the top and looks at those alone that nobody has looked at; so its links are those
 * that it would find afresh.
 *
 * Each unit of work has pairs of its own, a tree in one list: the first is the unit's, and pairs
 * that another is divided into stand side by side.
 */
#ifndef PairLooks_h
#define PairLooks_h

#include "ViewFactors/LinkEstimator.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;

class PairLooks
{
public:
  struct Look
  {
    enum Kinds : std::uint8_t
    {
      UNKNOWN,
      DARK, ///< the two do not face each other
      CLUSTERS,
      PATCHES
    };
    /// Of the pairs that this was divided into by its first and by its second slot, the first; 0:
    /// it was not.
    std::uint32_t Children[2] = {};
    Kinds Kind = UNKNOWN;
    bool IsFree = false; ///< nothing can be between
    union
    {
      LinkEstimator::View Clusters = {};
      PatchPairs::View Patches;
    };
  };
  using Unit = std::vector<Look>;

  /// Keep what there is if it is of this scene, on as many ranks; else begin anew.
  void Prepare(const PatchScene& scene, const Ranks& ranks, std::size_t units);
  void Clear();

  Unit& GetUnit(std::size_t unit) { return this->Units[unit]; }
  /// The place in `unit` of what a pair there is divided into by its first slot (0) or second (1).
  static std::size_t Divide(Unit& unit, std::size_t place, int side, int children);

  double GetNumberOfBytes() const;

private:
  std::uint64_t Fingerprint = 0;
  int NumberOfRanks = 0;
  int Rank = 0;
  std::vector<Unit> Units;
};
} // namespace LightTransport

#endif
