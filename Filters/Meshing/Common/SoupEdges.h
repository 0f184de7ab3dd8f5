// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The edges of triangles that know nothing of their neighbours, found by sorting.
#ifndef SoupEdges_h
#define SoupEdges_h

#include "Common/TriangleSoup.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace SoupEdges
{
/// The lower point, the higher point.
using Edge = std::pair<std::size_t, std::size_t>;

//------------------------------------------------------------------------------
inline Edge Make(std::size_t a, std::size_t b)
{
  return a < b ? Edge(a, b) : Edge(b, a);
}

//------------------------------------------------------------------------------
/// Calls function(edge, uses from its lower point to its higher one, uses the other way) for each
/// edge.
template <typename Function>
void ForEach(const std::vector<TriangleSoup::Triangle>& triangles, const Function& function)
{
  std::vector<std::pair<Edge, bool>> uses;
  uses.reserve(3 * triangles.size());
  for (const TriangleSoup::Triangle& triangle : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      const std::size_t from = triangle[i];
      const std::size_t to = triangle[(i + 1) % 3];
      uses.emplace_back(Make(from, to), from < to);
    }
  }
  std::sort(uses.begin(), uses.end());
  for (std::size_t i = 0; i < uses.size();)
  {
    int numbers[2] = { 0, 0 };
    const Edge edge = uses[i].first;
    for (; i < uses.size() && uses[i].first == edge; ++i)
    {
      ++numbers[uses[i].second];
    }
    function(edge, numbers[1], numbers[0]);
  }
}
} // namespace SoupEdges
} // namespace LightTransport

#endif
