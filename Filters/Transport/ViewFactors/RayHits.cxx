// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/RayHits.h"

#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace LightTransport
{
namespace
{
// Rays of all patches of a rank between two looks at progress and abort.
constexpr double RaysPerBatch = 4e6;
// Patches that a thread takes at a time.
constexpr vtkIdType PatchesPerTurn = 16;
// What a patch that is met takes while rows are made: counted, turned round and merged (measured).
constexpr double BytesPerMet = 40.0;

//------------------------------------------------------------------------------
vtkIdType GetShare(vtkIdType numberOfPatches, int rank, const Ranks& ranks)
{
  return numberOfPatches * rank / ranks.GetNumber();
}
} // namespace

//------------------------------------------------------------------------------
double RayHits::GetEstimatedBytes(vtkIdType numberOfPatches, const RayNumbers& numbers,
  const Ranks& ranks)
{
  const auto patches = static_cast<double>(numberOfPatches);
  const double rays = numbers.Sum(numberOfPatches);
  return (rays * sizeof(Hit) + std::min(rays, patches * patches) * BytesPerMet) / ranks.GetNumber();
}

//------------------------------------------------------------------------------
bool RayHits::AreOf(const PatchScene& scene, const Ranks& ranks) const
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  return this->Fingerprint == scene.GetFingerprint() &&
    this->First == GetShare(patches, ranks.GetMine(), ranks) &&
    this->Last == GetShare(patches, ranks.GetMine() + 1, ranks);
}

//------------------------------------------------------------------------------
void RayHits::Begin(std::uint64_t fingerprint, vtkIdType numberOfPatches, const Ranks& ranks)
{
  *this = RayHits();
  this->Fingerprint = fingerprint;
  this->First = GetShare(numberOfPatches, ranks.GetMine(), ranks);
  this->Last = GetShare(numberOfPatches, ranks.GetMine() + 1, ranks);
  this->Rays.assign(this->Last - this->First, 0);
}

//------------------------------------------------------------------------------
// What patches have, and what they are to have, of each kind in one piece.
std::vector<RayHits::Segment> RayHits::FindMissing(const RayNumbers& numbers) const
{
  std::map<std::pair<int, int>, std::vector<vtkIdType>> missing;
  for (vtkIdType patch = this->First; patch < this->Last; ++patch)
  {
    const int has = this->Rays[patch - this->First];
    if (has < numbers.Get(patch))
    {
      missing[{ has, numbers.Get(patch) }].push_back(patch);
    }
  }
  std::vector<Segment> segments;
  for (auto& [range, patches] : missing)
  {
    segments.push_back({ range.first, range.second - range.first, std::move(patches), {} });
  }
  return segments;
}

//------------------------------------------------------------------------------
bool RayHits::Have(const RayNumbers& numbers, const PatchScene& scene, const Ranks& ranks) const
{
  return this->AreOf(scene, ranks) && this->FindMissing(numbers).empty();
}

//------------------------------------------------------------------------------
std::vector<RayHits::Hit>& RayHits::Reset(std::uint64_t fingerprint, vtkIdType numberOfPatches,
  int raysPerPatch, const Ranks& ranks)
{
  this->Begin(fingerprint, numberOfPatches, ranks);
  this->Segments = this->FindMissing({ raysPerPatch, {} });
  this->Segments.resize(1);
  std::vector<Hit>& hits = this->Segments.back().Hits;
  hits.resize((this->Last - this->First) * raysPerPatch);
  this->Rays.assign(this->Rays.size(), raysPerPatch);
  return hits;
}

//------------------------------------------------------------------------------
Outcome RayHits::Allocate(const RayNumbers& numbers, const PatchScene& scene, const Ranks& ranks)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  if (!this->AreOf(scene, ranks))
  {
    this->Begin(scene.GetFingerprint(), patches, ranks);
  }
  std::vector<Segment> missing = this->FindMissing(numbers);
  const double bytes = missing.empty() ? 0.0 : GetEstimatedBytes(patches, numbers, ranks);
  const double available = TransportMemory::GetAvailableBytes();
  Outcome allocated = bytes <= available
    ? Outcome::Done()
    : Outcome::Failed(std::to_string(numbers.Each) + " rays from each of " +
        std::to_string(patches) + " patches need " + TransportMemory::Format(bytes) +
        " of memory and " + TransportMemory::Format(available) +
        " are free: raise LinkTolerance or Accuracy, use fewer patches or processes on more "
        "machines (each casts a part).");
  allocated = ranks.Agree(allocated);
  for (Segment& segment : missing)
  {
    if (allocated)
    {
      segment.Hits.resize(segment.Patches.size() * segment.Count);
      this->Segments.push_back(std::move(segment));
    }
  }
  return allocated;
}

//------------------------------------------------------------------------------
Outcome RayHits::CastTo(const RayNumbers& numbers, const PatchScene& scene, PatchRays& rays,
  const Ranks& ranks, const Monitor& monitor)
{
  const std::size_t before = this->AreOf(scene, ranks) ? this->Segments.size() : 0;
  Outcome ready = this->Allocate(numbers, scene, ranks);
  const vtkIdType missing = static_cast<vtkIdType>(this->Segments.size() - before);
  if (!ready || ranks.GetLargest(missing) == 0)
  {
    return ready;
  }
  ready = ranks.Agree(rays.IsBuilt() ? Outcome::Done() : rays.Build(scene));
  ready = ready ? this->Cast(before, rays, ranks, monitor) : ready;
  if (!ready)
  {
    *this = RayHits();
    return ready;
  }
  for (vtkIdType patch = this->First; patch < this->Last; ++patch)
  {
    int& has = this->Rays[patch - this->First];
    has = std::max(has, numbers.Get(patch));
  }
  return ready;
}

//------------------------------------------------------------------------------
// Batch by batch, all ranks as many as the one with the most rays: progress is a collective call.
Outcome RayHits::Cast(std::size_t firstSegment, const PatchRays& rays, const Ranks& ranks,
  const Monitor& monitor)
{
  struct Batch
  {
    Segment* Rays;
    vtkIdType Begin, End;
  };
  std::vector<Batch> batches;
  for (std::size_t index = firstSegment; index < this->Segments.size(); ++index)
  {
    Segment& segment = this->Segments[index];
    const auto patches = static_cast<vtkIdType>(segment.Patches.size());
    const auto step =
      std::max<vtkIdType>(PatchesPerTurn, static_cast<vtkIdType>(RaysPerBatch / segment.Count));
    for (vtkIdType begin = 0; begin < patches; begin += step)
    {
      batches.push_back({ &segment, begin, std::min(begin + step, patches) });
    }
  }
  const vtkIdType most = ranks.GetLargest(static_cast<vtkIdType>(batches.size()));
  Outcome cast = Outcome::Done();
  for (vtkIdType done = 0; cast && done < most; ++done)
  {
    cast = monitor.Check(static_cast<double>(done) / static_cast<double>(most));
    if (!cast || done >= static_cast<vtkIdType>(batches.size()))
    {
      continue;
    }
    const Batch& batch = batches[done];
    const RayPattern pattern(batch.Rays->First, batch.Rays->Count);
    const auto castSome = [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType place = begin; place < end; ++place)
      {
        rays.Cast(batch.Rays->Patches[place], pattern,
          batch.Rays->Hits.data() + place * batch.Rays->Count);
      }
    };
    const vtkIdType raysPerTurn = PatchesPerTurn * FewestRays;
    Threads::For(batch.Begin, batch.End,
      std::clamp<vtkIdType>(raysPerTurn / batch.Rays->Count, 1, PatchesPerTurn), castSome);
  }
  return cast;
}
} // namespace LightTransport
