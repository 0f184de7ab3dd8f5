// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/RayHits.h"

#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"

#include <algorithm>
#include <string>

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
double RayHits::GetEstimatedBytes(vtkIdType numberOfPatches, int raysPerPatch, const Ranks& ranks)
{
  const auto patches = static_cast<double>(numberOfPatches);
  const double met = std::min<double>(raysPerPatch, patches);
  return patches * (raysPerPatch * sizeof(Hit) + met * BytesPerMet) / ranks.GetNumber();
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
}

//------------------------------------------------------------------------------
std::vector<RayHits::Hit>& RayHits::Reset(std::uint64_t fingerprint, vtkIdType numberOfPatches,
  int raysPerPatch, const Ranks& ranks)
{
  this->Begin(fingerprint, numberOfPatches, ranks);
  this->Segments.push_back({ 0, raysPerPatch, {} });
  std::vector<Hit>& hits = this->Segments.back().Hits;
  hits.resize((this->Last - this->First) * raysPerPatch);
  this->Rays = raysPerPatch;
  return hits;
}

//------------------------------------------------------------------------------
Outcome RayHits::Allocate(int raysPerPatch, const PatchScene& scene, const Ranks& ranks)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  if (!this->AreOf(scene, ranks))
  {
    this->Begin(scene.GetFingerprint(), patches, ranks);
  }
  const int more = raysPerPatch - this->Rays;
  const double bytes = more > 0 ? GetEstimatedBytes(patches, raysPerPatch, ranks) : 0.0;
  const double available = TransportMemory::GetAvailableBytes();
  Outcome allocated = bytes <= available
    ? Outcome::Done()
    : Outcome::Failed(std::to_string(raysPerPatch) + " rays from each of " +
        std::to_string(patches) + " patches need " + TransportMemory::Format(bytes) +
        " of memory and " + TransportMemory::Format(available) +
        " are free: raise LinkTolerance or Accuracy, use fewer patches or processes on more "
        "machines (each casts a part).");
  allocated = ranks.Agree(allocated);
  if (allocated && more > 0)
  {
    this->Segments.push_back({ this->Rays, more, {} });
    this->Segments.back().Hits.resize((this->Last - this->First) * more);
  }
  return allocated;
}

//------------------------------------------------------------------------------
Outcome RayHits::CastTo(int raysPerPatch, const PatchScene& scene, const Ranks& ranks,
  const Monitor& monitor)
{
  Outcome ready = this->Allocate(raysPerPatch, scene, ranks);
  if (!ready || this->Rays >= raysPerPatch)
  {
    return ready;
  }
  PatchRays rays;
  ready = ranks.Agree(rays.Build(scene));
  Segment& segment = this->Segments.back();
  const RayPattern pattern(segment.First, segment.Count);
  const auto cast = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      rays.Cast(patch, pattern, segment.Hits.data() + (patch - this->First) * segment.Count);
    }
  };
  // All ranks count the batches of the one with the most patches: progress is a collective call.
  const vtkIdType most = ranks.GetLargest(this->Last - this->First);
  const auto batch =
    std::max<vtkIdType>(PatchesPerTurn, static_cast<vtkIdType>(RaysPerBatch / segment.Count));
  for (vtkIdType done = 0; ready && done < most; done += batch)
  {
    ready = monitor.Check(static_cast<double>(done) / static_cast<double>(most));
    const vtkIdType begin = std::min(this->First + done, this->Last);
    const vtkIdType end = std::min(begin + batch, this->Last);
    if (ready && begin < end)
    {
      Threads::For(begin, end, PatchesPerTurn, cast);
    }
  }
  if (!ready)
  {
    *this = RayHits();
    return ready;
  }
  this->Rays = raysPerPatch;
  return ready;
}
} // namespace LightTransport
