// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkShaftCuller.h"

#include "vtkPatchTree.h"

#include <algorithm>
#include <limits>

namespace
{
// A plane has the scene in front of it when nothing is further behind than this (the scene's
// diagonal is 1): coordinates in single precision are not better than that.
constexpr double PlaneTolerance = 1e-7;
// Bounds are compared with this much to spare for rounding.
constexpr double Spare = 1e-12;
} // namespace

//------------------------------------------------------------------------------
vtkShaftCuller::Bounds::Bounds()
{
  this->Lower.fill(std::numeric_limits<double>::max());
  this->Upper.fill(-std::numeric_limits<double>::max());
}

//------------------------------------------------------------------------------
void vtkShaftCuller::Bounds::Add(const Vector& p)
{
  const std::array<double, Directions> heights = { p.x(), p.y(), p.z(), p.x() + p.y(),
    p.x() - p.y(), p.y() + p.z(), p.y() - p.z(), p.z() + p.x(), p.z() - p.x() };
  for (int k = 0; k < Directions; ++k)
  {
    this->Lower[k] = std::min(this->Lower[k], heights[k]);
    this->Upper[k] = std::max(this->Upper[k], heights[k]);
  }
}

//------------------------------------------------------------------------------
void vtkShaftCuller::Bounds::Add(const Bounds& other)
{
  for (int k = 0; k < Directions; ++k)
  {
    this->Lower[k] = std::min(this->Lower[k], other.Lower[k]);
    this->Upper[k] = std::max(this->Upper[k], other.Upper[k]);
  }
}

//------------------------------------------------------------------------------
vtkShaftCuller::vtkShaftCuller(const vtkPatchScene& scene) : Scene(scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->PatchBounds.resize(patches);
  this->Occluders.resize(patches);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      this->PatchBounds[patch].Add(scene.GetCorner(patch, corner));
    }
    this->Occluders[patch] = this->IsOccluder(patch);
    this->NumberOfOccluders += this->Occluders[patch] ? 1 : 0;
  }
  const auto& nodes = scene.GetTree().GetNodes();
  this->NodeBounds.resize(nodes.size());
  this->OccluderBounds.resize(nodes.size());
  // Children stand behind their parents.
  for (std::size_t k = nodes.size(); k-- > 0;)
  {
    const vtkPatchTree::Node& node = nodes[k];
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
bool vtkShaftCuller::IsOccluder(vtkIdType patch) const
{
  const Vector& normal = this->Scene.GetNormal(patch);
  const double least = normal.dot(this->Scene.GetCorner(patch, 0)) - PlaneTolerance;
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const vtkPatchTree::Node& node = this->Scene.GetTree().GetNode(open.back());
    open.pop_back();
    const Vector lowest =
      (normal.array() > 0.0).select(node.Lower.array(), node.Upper.array()).matrix();
    if (normal.dot(lowest) >= least)
    {
      continue;
    }
    if (!node.IsLeaf())
    {
      open.push_back(node.Left);
      open.push_back(node.Left + 1);
      continue;
    }
    for (vtkIdType other = node.First; other < node.Last; ++other)
    {
      for (int corner = 0; corner < this->Scene.GetNumberOfCorners(other); ++corner)
      {
        if (normal.dot(this->Scene.GetCorner(other, corner)) < least)
        {
          return true;
        }
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// Whether some cross-section (1 - t) begin + t end, 0 <= t <= 1, meets the other bounds in all
// directions at once: two linear inequalities in t for each.
bool vtkShaftCuller::Meets(const Bounds& begin, const Bounds& end, const Bounds& other)
{
  double first = 0.0;
  double last = 1.0;
  const auto limit = [&](double atBegin, double atEnd)
  {
    // atBegin + t (atEnd - atBegin) <= 0
    if (atBegin > 0.0 && atEnd > 0.0)
    {
      return false;
    }
    if (atBegin > 0.0)
    {
      first = std::max(first, atBegin / (atBegin - atEnd));
    }
    else if (atEnd > 0.0)
    {
      last = std::min(last, atBegin / (atBegin - atEnd));
    }
    return true;
  };
  for (int k = 0; k < Directions; ++k)
  {
    const double upper = other.Upper[k] + Spare;
    const double lower = other.Lower[k] - Spare;
    if (!limit(begin.Lower[k] - upper, end.Lower[k] - upper) ||
      !limit(lower - begin.Upper[k], lower - end.Upper[k]) || first > last + Spare)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkShaftCuller::Search(const Bounds& begin, const Bounds& end, Patches& found) const
{
  found.clear();
  std::vector<int> open(1, 0);
  while (!open.empty())
  {
    const int index = open.back();
    const vtkPatchTree::Node& node = this->Scene.GetTree().GetNode(index);
    open.pop_back();
    if (!Meets(begin, end, this->OccluderBounds[index]))
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
      if (this->Occluders[patch] && Meets(begin, end, this->PatchBounds[patch]))
      {
        found.push_back(patch);
      }
    }
  }
}

//------------------------------------------------------------------------------
void vtkShaftCuller::Find(int nodeI, int nodeJ, Patches& found) const
{
  this->Search(this->NodeBounds[nodeI], this->NodeBounds[nodeJ], found);
}

//------------------------------------------------------------------------------
void vtkShaftCuller::Narrow(int nodeI, int nodeJ, const Patches& candidates, Patches& found) const
{
  found.clear();
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(found),
    [&](vtkIdType patch)
    { return Meets(this->NodeBounds[nodeI], this->NodeBounds[nodeJ], this->PatchBounds[patch]); });
}

//------------------------------------------------------------------------------
void vtkShaftCuller::FindBetween(vtkIdType i, vtkIdType j, Patches& found) const
{
  this->Search(this->PatchBounds[i], this->PatchBounds[j], found);
  found.erase(std::remove_if(found.begin(), found.end(),
                [=](vtkIdType patch) { return patch == i || patch == j; }),
    found.end());
}

//------------------------------------------------------------------------------
void vtkShaftCuller::NarrowBetween(vtkIdType i, vtkIdType j, const Patches& candidates,
  Patches& found) const
{
  found.clear();
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(found),
    [&](vtkIdType patch)
    {
      return patch != i && patch != j &&
        Meets(this->PatchBounds[i], this->PatchBounds[j], this->PatchBounds[patch]);
    });
}
