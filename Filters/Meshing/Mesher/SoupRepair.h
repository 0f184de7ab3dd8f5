// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Repairs that need no neighbours: triangles without area and duplicates, orientation and edges of
/// a soup. See ManifoldRepair for the others.
#ifndef SoupRepair_h
#define SoupRepair_h

#include "Common/TriangleSoup.h"
#include "Mesher/RepairCounts.h"

#include <vector>

namespace LightTransport
{
class SoupRepair
{
public:
  /// Both must outlive this object.
  SoupRepair(TriangleSoup& soup, RepairCounts& counts);

  ///@{ In this order.
  void DropDegenerateTriangles();
  void DropDuplicateTriangles();
  /// Split non-manifold edges and points and orient neighbours alike, unless this is not needed.
  void Orient();
  ///@}

private:
  bool SplitNeighboursOfDegenerateTriangles();
  void MarkEdgesToSplit();
  void TurnComponentsToMajority(const std::vector<bool>& reversed);
  void Keep(const std::vector<bool>& kept);

  TriangleSoup& Soup;
  RepairCounts& Counts;
};
} // namespace LightTransport

#endif
