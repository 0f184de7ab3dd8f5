// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tracing/TriangleTree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace LightTransport
{
namespace
{
/// Fewer boxes to walk through, or fewer triangles to look at.
constexpr std::ptrdiff_t MostTriangles = 4;
/// Places that a box may be divided at, and one.
constexpr int NumberOfBins = 16;
/// Of the scene, for rounded distances to the sides of boxes.
constexpr float Margin = 1e-6f;
constexpr std::size_t FloatsOfBox = 8;
constexpr std::size_t PlaceOfSkip = 3;
} // namespace

//------------------------------------------------------------------------------
// An empty one changes nothing.
void TriangleTree::Box::Add(const Box& box)
{
  for (std::size_t axis = 0; axis < this->Lower.size(); ++axis)
  {
    this->Lower[axis] = std::min(this->Lower[axis], box.Lower[axis]);
    this->Upper[axis] = std::max(this->Upper[axis], box.Upper[axis]);
  }
}

//------------------------------------------------------------------------------
void TriangleTree::Box::Add(const Corner& corner)
{
  this->Add(Box{ corner, corner });
}

//------------------------------------------------------------------------------
void TriangleTree::Box::Add(const Triangle& triangle)
{
  std::for_each(triangle.Corners.begin(), triangle.Corners.end(),
    [this](const Corner& at) { this->Add(at); });
}

//------------------------------------------------------------------------------
// Half of it; 0 for an empty one.
float TriangleTree::Box::GetSurface() const
{
  Corner size;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    size[axis] = std::max(this->Upper[axis] - this->Lower[axis], 0.0f);
  }
  return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

//------------------------------------------------------------------------------
int TriangleTree::Box::GetLongestAxis() const
{
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    const float size = this->Upper[axis] - this->Lower[axis];
    longest = size > this->Upper[longest] - this->Lower[longest] ? axis : longest;
  }
  return longest;
}

//------------------------------------------------------------------------------
TriangleTree::Box TriangleTree::MakeEmptyBox()
{
  constexpr float Far = std::numeric_limits<float>::max();
  return { { Far, Far, Far }, { -Far, -Far, -Far } };
}

//------------------------------------------------------------------------------
TriangleTree::Corner TriangleTree::GetMiddle(const Triangle& triangle)
{
  Corner middle;
  for (std::size_t axis = 0; axis < middle.size(); ++axis)
  {
    middle[axis] =
      (triangle.Corners[0][axis] + triangle.Corners[1][axis] + triangle.Corners[2][axis]) / 3.0f;
  }
  return middle;
}

//------------------------------------------------------------------------------
TriangleTree::Box TriangleTree::GetBox(Place first, Place last)
{
  Box box = MakeEmptyBox();
  std::for_each(first, last, [&box](const Triangle& triangle) { box.Add(triangle); });
  return box;
}

//------------------------------------------------------------------------------
TriangleTree::TriangleTree(std::vector<Triangle> triangles) : Triangles(std::move(triangles))
{
  if (this->Triangles.empty())
  {
    return;
  }
  for (const Triangle& triangle : this->Triangles)
  {
    for (const Corner& corner : triangle.Corners)
    {
      for (const float coordinate : corner)
      {
        this->Spare = std::max(this->Spare, Margin * std::abs(coordinate));
      }
    }
  }
  this->AddBoxes(this->Triangles.begin(), this->Triangles.end());
  this->NumberOfBoxes = static_cast<int>(this->Texels.size() / FloatsOfBox);
  const std::size_t begin = this->Texels.size();
  for (const Triangle& triangle : this->Triangles)
  {
    for (std::size_t k = 0; k < triangle.Corners.size(); ++k)
    {
      const Corner& corner = triangle.Corners[k];
      this->Texels.insert(this->Texels.end(),
        { corner[0], corner[1], corner[2], k == 1 ? static_cast<float>(triangle.Body) : 0.0f });
    }
  }
  // The last triangle of a box is before the first of the next.
  for (std::size_t box = 0; box < begin; box += FloatsOfBox)
  {
    const float first = this->Texels[box + FloatsOfBox - 1];
    if (first > 0.0f)
    {
      this->Texels[begin + 12 * (static_cast<std::size_t>(first) - 1) + PlaceOfSkip] = 1.0f;
    }
  }
  this->Texels[this->Texels.size() - 12 + PlaceOfSkip] = 1.0f;
}

//------------------------------------------------------------------------------
// Into two parts whose boxes rays meet least often, by their surfaces and by what is in them (I.
// Wald, On fast construction of SAH-based bounding volume hierarchies, 2007).
TriangleTree::Place TriangleTree::Divide(Place first, Place last)
{
  Box middles = MakeEmptyBox();
  std::for_each(first, last, [&](const Triangle& triangle) { middles.Add(GetMiddle(triangle)); });
  const int axis = middles.GetLongestAxis();
  const float size = middles.Upper[axis] - middles.Lower[axis];
  if (!(size > 0.0f))
  {
    return first + (last - first) / 2;
  }
  const auto getBin = [&](const Triangle& triangle)
  {
    const float part = (GetMiddle(triangle)[axis] - middles.Lower[axis]) / size;
    return std::min(static_cast<int>(part * NumberOfBins), NumberOfBins - 1);
  };
  std::array<Box, NumberOfBins> boxes;
  std::array<std::ptrdiff_t, NumberOfBins> counts = {};
  boxes.fill(MakeEmptyBox());
  std::for_each(first, last,
    [&](const Triangle& triangle)
    {
      const int bin = getBin(triangle);
      boxes[bin].Add(triangle);
      ++counts[bin];
    });
  // Of all from a bin on, and then of all up to one.
  std::array<float, NumberOfBins> costs = {};
  Box box = MakeEmptyBox();
  std::ptrdiff_t count = 0;
  for (int bin = NumberOfBins - 1; bin > 0; --bin)
  {
    box.Add(boxes[bin]);
    count += counts[bin];
    costs[bin] = static_cast<float>(count) * box.GetSurface();
  }
  box = MakeEmptyBox();
  count = 0;
  int best = 1;
  for (int bin = 1; bin < NumberOfBins; ++bin)
  {
    box.Add(boxes[bin - 1]);
    count += counts[bin - 1];
    costs[bin] += static_cast<float>(count) * box.GetSurface();
    best = costs[bin] < costs[best] ? bin : best;
  }
  return std::partition(first, last,
    [&](const Triangle& triangle) { return getBin(triangle) < best; });
}

//------------------------------------------------------------------------------
void TriangleTree::AddBoxes(Place first, Place last)
{
  const std::size_t texel = this->Texels.size();
  const Box box = GetBox(first, last);
  const bool isLeaf = last - first <= MostTriangles;
  const auto number = static_cast<float>(first - this->Triangles.begin());
  this->Texels.insert(this->Texels.end(),
    { box.Lower[0] - this->Spare, box.Lower[1] - this->Spare, box.Lower[2] - this->Spare, 0.0f,
      box.Upper[0] + this->Spare, box.Upper[1] + this->Spare, box.Upper[2] + this->Spare,
      isLeaf ? number : -1.0f });
  if (!isLeaf)
  {
    const Place middle = Divide(first, last);
    this->AddBoxes(first, middle);
    this->AddBoxes(middle, last);
  }
  this->Texels[texel + PlaceOfSkip] = static_cast<float>(this->Texels.size() / FloatsOfBox);
}
} // namespace LightTransport
