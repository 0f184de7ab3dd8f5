// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Tracing/TriangleTree.h"

#include <algorithm>
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
/// Of the scene, for rounded distances to the sides of boxes.
constexpr float Margin = 1e-6f;
constexpr std::size_t FloatsOfBox = 8;
constexpr std::size_t PlaceOfSkip = 3;
} // namespace

//------------------------------------------------------------------------------
void TriangleTree::Box::Add(const Triangle& triangle)
{
  for (const Corner& corner : triangle)
  {
    for (std::size_t axis = 0; axis < corner.size(); ++axis)
    {
      this->Lower[axis] = std::min(this->Lower[axis], corner[axis]);
      this->Upper[axis] = std::max(this->Upper[axis], corner[axis]);
    }
  }
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
TriangleTree::Box TriangleTree::GetBox(Place first, Place last)
{
  constexpr float Far = std::numeric_limits<float>::max();
  Box box{ { Far, Far, Far }, { -Far, -Far, -Far } };
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
    for (const Corner& corner : triangle)
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
    for (const Corner& corner : triangle)
    {
      this->Texels.insert(this->Texels.end(), { corner[0], corner[1], corner[2], 0.0f });
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
// Halves by number, along the longest side: as deep as few.
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
    const int axis = box.GetLongestAxis();
    const Place middle = first + (last - first) / 2;
    std::nth_element(first, middle, last,
      [axis](const Triangle& a, const Triangle& b)
      { return a[0][axis] + a[1][axis] + a[2][axis] < b[0][axis] + b[1][axis] + b[2][axis]; });
    this->AddBoxes(first, middle);
    this->AddBoxes(middle, last);
  }
  this->Texels[texel + PlaceOfSkip] = static_cast<float>(this->Texels.size() / FloatsOfBox);
}
} // namespace LightTransport
