// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The edges of patches, those between the same two points beside each other.
#ifndef PatchEdges_h
#define PatchEdges_h

#include "Scene/PatchGeometry.h"
#include "vtkType.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace LightTransport
{
struct PatchEdge
{
  vtkIdType Low, High; ///< its points
  vtkIdType Patch;
  bool IsForward; ///< around the patch, from the lower to the higher one

  bool IsAt(const PatchEdge& other) const
  {
    return this->Low == other.Low && this->High == other.High;
  }
};

//------------------------------------------------------------------------------
/// In order of their points, then of patches.
inline std::vector<PatchEdge> FindPatchEdges(const PatchGeometry& patches)
{
  std::vector<PatchEdge> edges;
  for (vtkIdType patch = 0; patch < patches.GetNumberOfPatches(); ++patch)
  {
    const int count = patches.GetNumberOfCorners(patch);
    for (int corner = 0; corner < count; ++corner)
    {
      const vtkIdType begin = patches.GetCorners(patch)[corner];
      const vtkIdType end = patches.GetCorners(patch)[(corner + 1) % count];
      edges.push_back({ std::min(begin, end), std::max(begin, end), patch, begin < end });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const PatchEdge& a, const PatchEdge& b)
    { return std::tie(a.Low, a.High, a.Patch) < std::tie(b.Low, b.High, b.Patch); });
  return edges;
}
} // namespace LightTransport

#endif
