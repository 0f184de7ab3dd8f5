// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/ShaftCuller.h"

#include "Geometry/PlaneSides.h"
#include "Scene/PatchTree.h"
#include "Shared/Pulse.h"
#include "Support/InstructionSets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  const std::size_t count = candidates.Walls.size();
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

//------------------------------------------------------------------------------
std::vector<ShaftCuller::Bounds> FindBounds(const PatchGeometry& geometry)
{
  std::vector<ShaftCuller::Bounds> bounds(geometry.GetNumberOfPatches());
  for (vtkIdType polygon = 0; polygon < geometry.GetNumberOfPatches(); ++polygon)
  {
    Pulse::Beat(polygon);
    for (int corner = 0; corner < geometry.GetNumberOfCorners(polygon); ++corner)
    {
      bounds[polygon].Add(geometry.GetCorner(polygon, corner));
    }
  }
  return bounds;
}

//------------------------------------------------------------------------------
// The bits of a node's patches.
unsigned int GetBits(const PatchTree::Node& node, vtkIdType first)
{
  return ((1u << node.GetSize()) - 1u) << (node.First - first);
}

//------------------------------------------------------------------------------
// Whether a wall may be between any of these patches: in front of one of each, with one of them
// over its plane and one of the others under it.
bool ArePartedBy(const SideMasks& i, unsigned int bitsI, const SideMasks& j, unsigned int bitsJ)
{
  return (i.Front & bitsI) != 0 && (j.Front & bitsJ) != 0 &&
    (((i.Above & bitsI) != 0 && (j.Below & bitsJ) != 0) ||
      ((i.Below & bitsI) != 0 && (j.Above & bitsJ) != 0));
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
  const std::size_t size = this->Walls.size();
  for (int k = 0; k < Directions; ++k)
  {
    this->Lower[k].resize(size);
    this->Upper[k].resize(size);
  }
  this->First.resize(size);
  this->Last.resize(size);
}

//------------------------------------------------------------------------------
ShaftCuller::ShaftCuller(const PatchScene& scene) : Scene(scene), Walls(scene)
{
  this->PatchBounds = FindBounds(scene);
  this->WallBounds = FindBounds(this->Walls);
  const auto& nodes = scene.GetTree().GetNodes();
  std::vector<std::vector<vtkIdType>> occluders(nodes.size());
  for (vtkIdType wall = 0; wall < this->Walls.GetNumberOfPatches(); ++wall)
  {
    Pulse::Beat(wall);
    if (IsAnyBehind(scene, this->Walls.GetPlane(wall)))
    {
      occluders[this->Walls.GetNode(wall)].push_back(wall);
    }
  }
  this->NodeBounds.resize(nodes.size());
  this->OccluderBounds.resize(nodes.size());
  this->NodesOutside.assign(nodes.size(), true);
  this->NodeBodies.resize(nodes.size());
  // Children stand behind their parents.
  for (std::size_t k = nodes.size(); k-- > 0;)
  {
    for (const vtkIdType wall : occluders[k])
    {
      this->OccluderBounds[k].Add(this->WallBounds[wall]);
    }
    nodes[k].IsLeaf() ? this->SetLeaf(static_cast<int>(k)) : this->SetNode(static_cast<int>(k));
  }
  this->OccluderBegins.assign(1, 0);
  for (const std::vector<vtkIdType>& own : occluders)
  {
    this->Occluders.insert(this->Occluders.end(), own.begin(), own.end());
    this->OccluderBegins.push_back(static_cast<vtkIdType>(this->Occluders.size()));
  }
  this->NumberOfOccluders = static_cast<vtkIdType>(this->Occluders.size());
}

//------------------------------------------------------------------------------
void ShaftCuller::SetLeaf(int node)
{
  const PatchTree::Node& leaf = this->Scene.GetTree().GetNode(node);
  const ConvexBodies& bodies = this->Walls.GetBodies();
  const auto getBody = [&](vtkIdType patch) { return bodies.GetBody(this->Walls.GetWall(patch)); };
  this->NodeBodies[node] = getBody(leaf.First);
  for (vtkIdType patch = leaf.First; patch < leaf.Last; ++patch)
  {
    this->NodeBounds[node].Add(this->PatchBounds[patch]);
    this->NodesOutside[node] = this->NodesOutside[node] && bodies.IsOutside(patch);
    this->NodeBodies[node] = getBody(patch) == this->NodeBodies[node] ? this->NodeBodies[node] : -1;
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::SetNode(int node)
{
  const int left = this->Scene.GetTree().GetNode(node).Left;
  for (const int child : { left, left + 1 })
  {
    this->NodeBounds[node].Add(this->NodeBounds[child]);
    this->OccluderBounds[node].Add(this->OccluderBounds[child]);
    this->NodesOutside[node] = this->NodesOutside[node] && this->NodesOutside[child];
  }
  this->NodeBodies[node] =
    this->NodeBodies[left] == this->NodeBodies[left + 1] ? this->NodeBodies[left] : -1;
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
    }
    for (vtkIdType k = this->OccluderBegins[index]; k < this->OccluderBegins[index + 1]; ++k)
    {
      const vtkIdType wall = this->Occluders[k];
      if (shaft.Meets(this->WallBounds[wall]) && !visit(wall))
      {
        return;
      }
    }
  }
}

//------------------------------------------------------------------------------
// Whether the boxes of two nodes are not certainly on the same side of a wall, or the second one on
// that which alone hides anything.
bool ShaftCuller::MayPart(vtkIdType wall, int nodeI, int nodeJ) const
{
  const int body = this->Walls.GetBodies().GetBody(wall);
  if (body >= 0 && (this->NodeBodies[nodeI] == body || this->NodeBodies[nodeJ] == body))
  {
    return false; // a convex body is behind its own patches
  }
  const PatchPlane plane = this->Walls.GetPlane(wall);
  const Vector size = plane.Normal.cwiseAbs();
  const auto getReach = [&](int index)
  {
    const PatchTree::Node& node = this->Scene.GetTree().GetNode(index);
    const double middle = plane.GetHeight(0.5 * (node.Lower + node.Upper));
    const double reach = 0.5 * size.dot(node.Upper - node.Lower);
    return std::array<double, 2>{ middle - reach, middle + reach };
  };
  const auto i = getReach(nodeI);
  const auto j = getReach(nodeJ);
  const bool isFrontAlone = this->NodesOutside[nodeI] && body >= 0;
  return (i[1] > plane.Rounding && j[0] < -plane.Rounding) ||
    (!isFrontAlone && i[0] < -plane.Rounding && j[1] > plane.Rounding);
}

//------------------------------------------------------------------------------
// What a body hides from patches outside it, the sides hide that face them.
SideMasks ShaftCuller::LeaveOutBacks(vtkIdType wall, unsigned int outside, SideMasks sides) const
{
  if (this->Walls.GetBodies().GetBody(wall) >= 0)
  {
    sides.Below = static_cast<std::uint16_t>(sides.Below & ~outside);
  }
  return sides;
}

//------------------------------------------------------------------------------
// The bits of those of a few patches that are outside all bodies.
unsigned int ShaftCuller::GetOutside(vtkIdType first, vtkIdType last) const
{
  unsigned int bits = 0;
  for (vtkIdType patch = first; patch < last; ++patch)
  {
    bits |= this->Walls.GetBodies().IsOutside(patch) ? 1u << (patch - first) : 0u;
  }
  return bits;
}

//------------------------------------------------------------------------------
bool ShaftCuller::MayBlock(int nodeI, int nodeJ) const
{
  bool blocks = false;
  this->Search(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]),
    [&](vtkIdType wall)
    {
      blocks = this->MayPart(wall, nodeI, nodeJ);
      return !blocks;
    });
  return blocks;
}

//------------------------------------------------------------------------------
void ShaftCuller::Find(int nodeI, int nodeJ, Candidates& found) const
{
  found.HasSides = false;
  found.Walls.clear();
  this->Search(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]),
    [&](vtkIdType wall)
    {
      if (this->MayPart(wall, nodeI, nodeJ))
      {
        found.Walls.push_back(wall);
      }
      return true;
    });
  this->SetBounds(found);
}

//------------------------------------------------------------------------------
void ShaftCuller::SetBounds(Candidates& found) const
{
  found.Resize();
  for (std::size_t c = 0; c < found.Walls.size(); ++c)
  {
    const Bounds& bounds = this->WallBounds[found.Walls[c]];
    for (int k = 0; k < Directions; ++k)
    {
      found.Lower[k][c] = bounds.Lower[k];
      found.Upper[k][c] = bounds.Upper[k];
    }
  }
}

//------------------------------------------------------------------------------
// By how far their edges are from the segment between two places, seen from the first: those with
// the segment well inside come first.
template <typename Item, typename GetWall>
void ShaftCuller::Order(const Vector& from, const Vector& to, std::vector<Item>& items,
  const GetWall& getWall) const
{
  const Vector axis = (to - from).normalized();
  std::vector<std::pair<double, Item>> ranks;
  ranks.reserve(items.size());
  for (const Item& item : items)
  {
    const vtkIdType wall = getWall(item);
    const Vector offset = this->Walls.GetCentroid(wall) - from;
    const double length = std::max(offset.norm(), std::numeric_limits<double>::min());
    const double radius = std::sqrt(
      this->Walls.GetAreas()[wall] * std::abs(offset.dot(this->Walls.GetNormal(wall))) / length);
    const double along = std::max(offset.dot(axis), 1e-3 * length);
    ranks.emplace_back((offset.cross(axis).norm() - radius) / along, item);
  }
  std::sort(ranks.begin(), ranks.end(),
    [&](const auto& a, const auto& b)
    { return a.first < b.first || (a.first == b.first && getWall(a.second) < getWall(b.second)); });
  std::transform(ranks.begin(), ranks.end(), items.begin(),
    [](const auto& rank) { return rank.second; });
}

//------------------------------------------------------------------------------
void ShaftCuller::KeepParting(int nodeI, int nodeJ, SideCache& sides, Candidates& found) const
{
  const PatchTree::Node& i = this->Scene.GetTree().GetNode(nodeI);
  const PatchTree::Node& j = this->Scene.GetTree().GetNode(nodeJ);
  if (found.HasSides || std::max(i.GetSize(), j.GetSize()) > SideFinder::MaximumPatches)
  {
    return;
  }
  this->Order(0.5 * (i.Lower + i.Upper), 0.5 * (j.Lower + j.Upper), found.Walls,
    [](vtkIdType wall) { return wall; });
  SideFinder finderI(this->Walls, this->Scene), finderJ(this->Walls, this->Scene);
  finderI.SetPatches(i.First, i.Last);
  finderJ.SetPatches(j.First, j.Last);
  const auto find = [&](int end, int node, const SideFinder& finder,
                      vtkIdType wall) -> const SideMasks&
  {
    return sides.Get(end, node, this->Scene.GetTree().GetNode(node).First, wall,
      this->Walls.GetNumberOfPatches(), [&](vtkIdType other) { return finder.Find(other); });
  };
  const unsigned int outside = this->GetOutside(i.First, i.Last);
  found.HasSides = true;
  found.FirstI = i.First;
  found.FirstJ = j.First;
  found.SidesI.clear();
  found.SidesJ.clear();
  std::size_t kept = 0;
  for (const vtkIdType wall : found.Walls)
  {
    const SideMasks sidesI = this->LeaveOutBacks(wall, outside, find(0, nodeI, finderI, wall));
    if (sidesI.Front == 0 || (sidesI.Above | sidesI.Below) == 0)
    {
      continue;
    }
    const SideMasks sidesJ = find(1, nodeJ, finderJ, wall);
    if (ArePartedBy(sidesI, GetBits(i, i.First), sidesJ, GetBits(j, j.First)))
    {
      found.Walls[kept++] = wall;
      found.SidesI.push_back(sidesI);
      found.SidesJ.push_back(sidesJ);
    }
  }
  found.Walls.resize(kept);
  this->SetBounds(found);
}

//------------------------------------------------------------------------------
void ShaftCuller::Narrow(int nodeI, int nodeJ, Candidates& candidates, Candidates& found) const
{
  const PatchTree& tree = this->Scene.GetTree();
  MarkAll(Shaft(this->NodeBounds[nodeI], this->NodeBounds[nodeJ]), candidates);
  found.Kept.clear();
  if (candidates.HasSides)
  {
    const unsigned int bitsI = GetBits(tree.GetNode(nodeI), candidates.FirstI);
    const unsigned int bitsJ = GetBits(tree.GetNode(nodeJ), candidates.FirstJ);
    for (std::size_t c = 0; c < candidates.Walls.size(); ++c)
    {
      if (candidates.First[c] <= candidates.Last[c] &&
        ArePartedBy(candidates.SidesI[c], bitsI, candidates.SidesJ[c], bitsJ))
      {
        found.Kept.push_back(c);
      }
    }
    Keep(candidates, found);
    return;
  }
  found.HasSides = false;
  found.Walls.clear();
  for (std::size_t c = 0; c < candidates.Walls.size(); ++c)
  {
    if (candidates.First[c] <= candidates.Last[c] &&
      this->MayPart(candidates.Walls[c], nodeI, nodeJ))
    {
      found.Walls.push_back(candidates.Walls[c]);
    }
  }
  this->SetBounds(found);
}

//------------------------------------------------------------------------------
// Those of the candidates that found.Kept names.
void ShaftCuller::Keep(const Candidates& candidates, Candidates& found)
{
  const std::size_t count = found.Kept.size();
  found.HasSides = true;
  found.FirstI = candidates.FirstI;
  found.FirstJ = candidates.FirstJ;
  found.Walls.resize(count);
  found.SidesI.resize(count);
  found.SidesJ.resize(count);
  found.Resize();
  for (std::size_t k = 0; k < count; ++k)
  {
    found.Walls[k] = candidates.Walls[found.Kept[k]];
    found.SidesI[k] = candidates.SidesI[found.Kept[k]];
    found.SidesJ[k] = candidates.SidesJ[found.Kept[k]];
  }
  for (int direction = 0; direction < Directions; ++direction)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      found.Lower[direction][k] = candidates.Lower[direction][found.Kept[k]];
      found.Upper[direction][k] = candidates.Upper[direction][found.Kept[k]];
    }
  }
}

//------------------------------------------------------------------------------
void ShaftCuller::FindBetween(vtkIdType i, vtkIdType j, std::vector<Occluder>& found) const
{
  found.clear();
  const unsigned int outside = this->GetOutside(i, i + 1);
  this->Search(Shaft(this->PatchBounds[i], this->PatchBounds[j]),
    [&](vtkIdType wall)
    {
      const SideMasks sidesI =
        this->LeaveOutBacks(wall, outside, FindSides(this->Walls, wall, this->Scene, i));
      const SideMasks sidesJ =
        sidesI.Front ? FindSides(this->Walls, wall, this->Scene, j) : SideMasks();
      if (ArePartedBy(sidesI, 1, sidesJ, 1) && !this->IsOf(wall, i, j))
      {
        found.push_back({ wall, (sidesI.Cut | sidesJ.Cut) != 0 });
      }
      return true;
    });
  this->Order(this->Scene.GetCentroid(i), this->Scene.GetCentroid(j), found,
    [](const Occluder& occluder) { return occluder.Wall; });
}

//------------------------------------------------------------------------------
void ShaftCuller::NarrowBetween(vtkIdType i, vtkIdType j, Candidates& candidates,
  std::vector<Occluder>& found) const
{
  MarkAll(Shaft(this->PatchBounds[i], this->PatchBounds[j]), candidates);
  const unsigned int bitI = 1u << (i - candidates.FirstI);
  const unsigned int bitJ = 1u << (j - candidates.FirstJ);
  found.clear();
  for (std::size_t k = 0; k < candidates.Walls.size(); ++k)
  {
    const SideMasks& sidesI = candidates.SidesI[k];
    const SideMasks& sidesJ = candidates.SidesJ[k];
    const vtkIdType wall = candidates.Walls[k];
    if (candidates.First[k] <= candidates.Last[k] && ArePartedBy(sidesI, bitI, sidesJ, bitJ) &&
      !this->IsOf(wall, i, j))
    {
      found.push_back({ wall, (sidesI.Cut & bitI) != 0 || (sidesJ.Cut & bitJ) != 0 });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<ShaftCuller::Vector> ShaftCuller::GetBox(int node) const
{
  const Vector& lower = this->Scene.GetTree().GetNode(node).Lower;
  const Vector& upper = this->Scene.GetTree().GetNode(node).Upper;
  std::vector<Vector> corners;
  for (int corner = 0; corner < 8; ++corner)
  {
    corners.emplace_back(corner & 1 ? upper.x() : lower.x(), corner & 2 ? upper.y() : lower.y(),
      corner & 4 ? upper.z() : lower.z());
  }
  return corners;
}

//------------------------------------------------------------------------------
vtkIdType ShaftCuller::FindHiding(int nodeI, int nodeJ, const Candidates& candidates,
  vtkIdType guess) const
{
  if (nodeI == nodeJ)
  {
    return -1;
  }
  OccluderWalls::End from, to;
  from.Set(this->GetBox(nodeI), this->NodesOutside[nodeI]);
  to.Set(this->GetBox(nodeJ), this->NodesOutside[nodeJ]);
  const auto find = [&](const std::vector<vtkIdType>& walls)
  {
    return this->Walls.FindHiding(
      walls, [](vtkIdType wall) { return wall; }, from, to, true);
  };
  const vtkIdType latest = guess >= 0 ? find({ guess }) : -1;
  return latest >= 0 ? latest : find(candidates.Walls);
}
} // namespace LightTransport
