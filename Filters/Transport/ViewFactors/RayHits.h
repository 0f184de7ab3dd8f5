// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the rays of this rank's patches have met; more can be cast later. The ranks share the
 * patches in ranges.
 */
#ifndef RayHits_h
#define RayHits_h

#include "Geometry/PatchRays.h"
#include "Links/RayNumbers.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;

class RayHits
{
public:
  using Hit = PatchRays::Hit;

  /// Rays of a patch at least: a packet, so that each doubling after that is of whole ones. And at
  /// most, since numbers of rays are kept in few digits.
  static constexpr int FewestRays = 16;
  static constexpr int MostRays = 65536;

  /// Bytes that one rank takes, and those of the links that are made of them.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, const RayNumbers& numbers,
    const Ranks& ranks);

  /// Cast rays until each patch has at least as many, FewestRays times a power of two; those of
  /// another scene are dropped first. `rays` are those of the scene, or are built. Fails, on all
  /// ranks alike, where there is no memory. Collective.
  Outcome CastTo(const RayNumbers& numbers, const PatchScene& scene, PatchRays& rays,
    const Ranks& ranks, const Monitor& monitor);

  /// Whether CastTo would have nothing to do.
  bool Have(const RayNumbers& numbers, const PatchScene& scene, const Ranks& ranks) const;

  /// Begin anew with hits from elsewhere, `raysPerPatch` of each patch of a scene: those of this
  /// rank, one patch after the other, for the caller to fill.
  std::vector<Hit>& Reset(std::uint64_t fingerprint, vtkIdType numberOfPatches, int raysPerPatch,
    const Ranks& ranks);

  /// Of the scene.
  std::uint64_t GetFingerprint() const { return this->Fingerprint; }

  ///@{ The patches of this rank.
  vtkIdType GetFirst() const { return this->First; }
  vtkIdType GetLast() const { return this->Last; }
  ///@}

  /// visitor(hit) for the rays `begin` to `end` of a patch of this rank.
  template <typename Visitor>
  void Visit(vtkIdType patch, int begin, int end, Visitor&& visitor) const
  {
    for (const Segment& segment : this->Segments)
    {
      const int last = std::min(end, segment.First + segment.Count);
      int ray = std::max(begin, segment.First);
      const Hit* hits = ray < last ? this->Find(segment, patch) : nullptr;
      for (; hits && ray < last; ++ray)
      {
        visitor(hits[ray - segment.First]);
      }
    }
  }

private:
  /// Some rays of some patches, one patch after the other. Of a patch what comes first is in the
  /// segment that comes first.
  struct Segment
  {
    int First;
    int Count;
    std::vector<vtkIdType> Patches; ///< ascending
    std::vector<Hit> Hits;
  };

  bool AreOf(const PatchScene& scene, const Ranks& ranks) const;
  void Begin(std::uint64_t fingerprint, vtkIdType numberOfPatches, const Ranks& ranks);
  const Hit* Find(const Segment& segment, vtkIdType patch) const
  {
    std::size_t place = patch - this->First;
    if (segment.Patches.size() < this->Rays.size())
    {
      const auto found = std::lower_bound(segment.Patches.begin(), segment.Patches.end(), patch);
      if (found == segment.Patches.end() || *found != patch)
      {
        return nullptr;
      }
      place = found - segment.Patches.begin();
    }
    return segment.Hits.data() + place * segment.Count;
  }
  std::vector<Segment> FindMissing(const RayNumbers& numbers) const;
  Outcome Allocate(const RayNumbers& numbers, const PatchScene& scene, const Ranks& ranks);
  Outcome Cast(std::size_t firstSegment, const PatchRays& rays, const Ranks& ranks,
    const Monitor& monitor);

  std::uint64_t Fingerprint = 0;
  vtkIdType First = 0;
  vtkIdType Last = 0;
  std::vector<int> Rays; ///< of each patch of this rank
  std::vector<Segment> Segments;
};
} // namespace LightTransport

#endif
