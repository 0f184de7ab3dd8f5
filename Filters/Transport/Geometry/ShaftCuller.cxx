// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/ShaftCuller.h"

#include "Geometry/PlaneSides.h"
#include "Scene/PatchTree.h"
#include "Shared/Pulse.h"
#include "Support/InstructionSets.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// Bounds are in single precision: they are compared with this much to spare for rounding.
constexpr float Spare = 1e-6f;
// A bound that changes less than this along a shaft does not change: then it is met from one end to
// the other or not at all.
constexpr float Least = 1e-20f;
//------------------------------------------------------------------------------
// Where the cross-sections that meet the candidates begin and end: one side of the shaft after the
// other, in loops over all candidates that become vector instructions.
LT_CLONES void MarkAll(const ShaftCuller::Shaft& shaft, ShaftCuller::Candidates& candidates)
{
  const std::size_t count = candidates.Patches.size();
  float* const first = candidates.First.data();
  float* const last = candidates.Last.data();
  std::fill_n(first, count, 0.0f);
  std::fill_n(last, count, 1.0f);
  for (int k = 0; k < 2 * ShaftCuller::Directions; ++k)
  {
    const float origin = shaft.Sides[k].Begin;
    const float inverse = shaft.Sides[k].Inverse;
    const float* const bounds =
      k % 2 == 0 ? candidates.Upper[k / 2].data() : candidates.Lower[k / 2].data();
    float* const limits = shaft.Sides[k].IsLast ? last : first;
    const float sign = shaft.Sides[k].IsLast ? -1.0f : 1.0f;
    for (std::size_t c = 0; c < count; ++c)
    {
      const float t = sign * (bounds[c] - origin) * inverse;
      const float limit = sign * limits[c];
      limits[c] = sign * (t > limit ? t : limit);
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
ShaftCuller::Bounds::Bounds()
{
  this->Lower.fill(std::numeric_limits<float>::max());
  this->Upper.fill(-std::numeric_limits<float>::max());
}

//------------------------------------------------------------------------------
void ShaftCuller::Bounds::Add(const Vector& p)
{
  const std::array<double, Directions> heights = { p.x(), p.y(), p.z(), p.x() + p.y(),
    p.x() - p.y(), p.y() + p.z(), p.y() - p.z(), p.z() + p.x(), p.z() - p.x() };
  for (int k = 0; k < Directions; ++k)
  {
    const auto height = static_cast<float>(heights[k]);
    this->Lower[k] = std::min(this->Lower[k], height);
    this->Upper[k] = std::max(this->Upper[k], height);
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::Bounds::Add(const Bounds& other)
{
  for (int k = 0; k < Directions; ++k)
  {
    this->Lower[k] = std::min(this->Lower[k], other.Lower[k]);
    this->Upper[k] = std::max(this->Upper[k], other.Upper[k]);
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::Candidates::Resize()
{
  const std::size_t size = this->Patches.size();
  for (int k = 0; k < Directions; ++k)
  {
    this->Lower[k].resize(size);
    this->Upper[k].resize(size);
  }
  this->First.resize(size);
  this->Last.resize(size);
}

//------------------------------------------------------------------------------
ShaftCuller::ShaftCuller(const PatchScene& scene) : Scene(scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->PatchBounds.resize(patches);
  this->Occluders.resize(patches);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    Pulse::Beat(patch);
    for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      this->PatchBounds[patch].Add(scene.GetCorner(patch, corner));
    }
    this->Occluders[patch] = IsAnyBehind(scene, scene.GetPlane(patch));
    this->NumberOfOccluders += this->Occluders[patch] ? 1 : 0;
  }
  const auto& nodes = scene.GetTree().GetNodes();
  this->NodeBounds.resize(nodes.size());
  this->OccluderBounds.resize(nodes.size());
  // Children stand behind their parents.
  for (std::size_t k = nodes.size(); k-- > 0;)
  {
    const PatchTree::Node& node = nodes[k];
    for (vtkIdType patch = node.First; node.IsLeaf() && patch < node.Last; ++patch)
    {
      this->NodeBounds[k].Add(this->PatchBounds[patch]);
      if (this->Occluders[patch])
      {
        this->OccluderBounds[k].Add(this->PatchBounds[patch]);
      }
    }
    for (int child = 0; !node.IsLeaf() && child < 2; ++child)
    {
      this->NodeBounds[k].Add(this->NodeBounds[node.Left + child]);
      this->OccluderBounds[k].Add(this->OccluderBounds[node.Left + child]);
    }
  }
}

//------------------------------------------------------------------------------
// A lower bound that grows towards the end leaves what is above it at last, one that falls at
// first; an upper bound the other way round.
ShaftCuller::Shaft::Shaft(const Bounds& begin, const Bounds& end)
{
  const auto set = [](float from, float to, bool isLower)
  {
    const float change = std::max(std::abs(to - from), Least);
    const bool grows = to > from;
    return Side{ from, grows ? 1.0f / change : -1.0f / change, grows == isLower };
  };
  for (int k = 0; k < Directions; ++k)
  {
    this->Sides[2 * k] = set(begin.Lower[k] - Spare, end.Lower[k] - Spare, true);
    this->Sides[2 * k + 1] = set(begin.Upper[k] + Spare, end.Upper[k] + Spare, false);
  }
}

//------------------------------------------------------------------------------
// Whether some cross-section (1 - t) begin + t end, 0 <= t <= 1, meets the bounds in all directions
// at once.
bool ShaftCuller::Shaft::Meets(const Bounds& other) const
{
  float first = 0.0f;
  float last = 1.0f;
  for (int k = 0; k < 2 * Directions && first <= last; ++k)
  {
    const Side& side = this->Sides[k];
    const float bound = k % 2 == 0 ? other.Upper[k / 2] : other.Lower[k / 2];
    const float t = (bound - side.Begin) * side.Inverse;
    first = side.IsLast ? first : std::max(first, t);
    last = side.IsLast ? std::min(last, t) : last;
  }
  return first <= last;
}

//------------------------------------------------------------------------------
// Calls visit for the occluders that meet a shaft until it returns false.
template <typename Visit>
void ShaftCuller::Search(const Shaft& shaft, const Visit& visit) const
{
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const int index = open.back();
    const PatchTree::Node& node = this->Scene.GetTree().GetNode(index);
    open.pop_back();
    if (!shaft.Meets(this->OccluderBounds[index]))
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left + 1);
      open.push_back(node.Left);
      continue;
    }
    for (vtkIdType patch = node.First; patch < node.Last; ++patch)
    {
      if (this->Occluders[patch] && shaft.Meets(this->PatchBounds[patch]) && !visit(patch))
      {
        return;
      }
    }
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::Search(const Shaft& shaft, std::vector<vtkIdType>& found) const
{
  found.clear();
  this->Search(shaft,
    [&](vtkIdType patch)
    {
      found.push_back(patch);
      return true;
    });
}

//------------------------------------------------------------------------------
bool ShaftCuller::MayBlock(int nodeI, int nodeJ) const
{
  bool blocks = false;
  this->Search(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]),
    [&](vtkIdType)
    {
      blocks = true;
      return false;
    });
  return blocks;
}

//------------------------------------------------------------------------------
void ShaftCuller::Find(int nodeI, int nodeJ, Candidates& found) const
{
  this->Search(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]), found.Patches);
  found.Resize();
  for (std::size_t c = 0; c < found.Patches.size(); ++c)
  {
    const Bounds& bounds = this->PatchBounds[found.Patches[c]];
    for (int k = 0; k < Directions; ++k)
    {
      found.Lower[k][c] = bounds.Lower[k];
      found.Upper[k][c] = bounds.Upper[k];
    }
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::Narrow(int nodeI, int nodeJ, Candidates& candidates, Candidates& found) const
{
  MarkAll(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]), candidates);
  found.Patches.clear();
  for (std::size_t c = 0; c < candidates.Patches.size(); ++c)
  {
    if (candidates.IsBetween(c))
    {
      found.Patches.push_back(candidates.Patches[c]);
    }
  }
  found.Resize();
  for (int k = 0; k < Directions; ++k)
  {
    std::size_t next = 0;
    for (std::size_t c = 0; c < candidates.Patches.size(); ++c)
    {
      if (candidates.IsBetween(c))
      {
        found.Lower[k][next] = candidates.Lower[k][c];
        found.Upper[k][next++] = candidates.Upper[k][c];
      }
    }
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::FindBetween(vtkIdType i, vtkIdType j, std::vector<vtkIdType>& found) const
{
  this->Search(Shaft(this->PatchBounds[i], this->PatchBounds[j]), found);
  found.erase(std::remove_if(found.begin(), found.end(),
                [=](vtkIdType patch) { return patch == i || patch == j; }),
    found.end());
}

//------------------------------------------------------------------------------
void ShaftCuller::NarrowBetween(vtkIdType i, vtkIdType j, Candidates& candidates,
  std::vector<vtkIdType>& found) const
{
  MarkAll(Shaft(this->PatchBounds[i], this->PatchBounds[j]), candidates);
  found.clear();
  for (std::size_t k = 0; k < candidates.Patches.size(); ++k)
  {
    const vtkIdType patch = candidates.Patches[k];
    if (candidates.IsBetween(k) && patch != i && patch != j)
    {
      found.push_back(patch);
    }
  }
}
} // namespace LightTransport
