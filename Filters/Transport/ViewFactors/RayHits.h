// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the rays of this rank's patches have met, the same number of each patch; more can be cast
 * later. The ranks share the patches in ranges.
 */
#ifndef RayHits_h
#define RayHits_h

#include "Geometry/PatchRays.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <algorithm>
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

  /// Rays of a patch at first: each doubling after that is of whole packets. And at most, since
  /// numbers of rays are kept in few digits.
  static constexpr int FewestRays = 64;
  static constexpr int MostRays = 65536;

  /// Bytes that one rank takes, and those of the links that are made of them.
  static double GetEstimatedBytes(vtkIdType numberOfPatches, int raysPerPatch, const Ranks& ranks);

  /// Cast rays until each patch has at least as many, FewestRays times a power of two; those of
  /// another scene are dropped first. Fails, on all ranks alike, where there is no memory.
  /// Collective.
  Outcome CastTo(int raysPerPatch, const PatchScene& scene, const Ranks& ranks,
    const Monitor& monitor);

  /// Whether CastTo would have nothing to do.
  bool Have(int raysPerPatch, const PatchScene& scene, const Ranks& ranks) const
  {
    return this->AreOf(scene, ranks) && this->Rays >= raysPerPatch;
  }

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
      const Hit* hits = segment.Hits.data() + (patch - this->First) * segment.Count;
      const int last = std::min(end, segment.First + segment.Count);
      for (int ray = std::max(begin, segment.First); ray < last; ++ray)
      {
        visitor(hits[ray - segment.First]);
      }
    }
  }

private:
  /// Some rays of each patch, one patch after the other.
  struct Segment
  {
    int First;
    int Count;
    std::vector<Hit> Hits;
  };

  bool AreOf(const PatchScene& scene, const Ranks& ranks) const;
  void Begin(std::uint64_t fingerprint, vtkIdType numberOfPatches, const Ranks& ranks);
  Outcome Allocate(int raysPerPatch, const PatchScene& scene, const Ranks& ranks);

  std::uint64_t Fingerprint = 0;
  int Rays = 0;
  vtkIdType First = 0;
  vtkIdType Last = 0;
  std::vector<Segment> Segments;
};
} // namespace LightTransport

#endif
