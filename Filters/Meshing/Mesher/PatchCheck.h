// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Compares patches with the surface that they were made of, in what remeshing must not change:
 * nothing crosses that did not before, and no component shrinks.
 *
 * A component is what is connected. Throws Heartbeat::Stopped when aborted.
 */
#ifndef PatchCheck_h
#define PatchCheck_h

#include "Common/TriangleSoup.h"
#include "Mesher/IsotropicRemesher.h"
#include "Mesher/TriangleCrossings.h"
#include "Shared/Monitor.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace LightTransport
{
class PatchCheck
{
public:
  /// The soup must stay.
  explicit PatchCheck(const TriangleSoup& soup);

  /// The component of each triangle of the soup.
  const std::vector<std::size_t>& GetComponents() const { return this->Components; }
  std::size_t GetNumberOfComponents() const { return this->Before.size(); }
  double GetArea(std::size_t component) const { return this->Before[component].Area; }
  /// The center of its bounding box.
  TriangleSoup::Point GetCenter(std::size_t component) const;

  struct Findings
  {
    /// The pairs of patches that cross.
    std::vector<TriangleCrossings::Pair> Crossings;
    /// Those of them where the surface does not meet itself: between the same components, and about
    /// as far away as patches are large.
    std::vector<TriangleCrossings::Pair> NewCrossings;
    /// The part of its area, or of its volume if it is closed, that each component has lost.
    std::vector<double> Losses;
  };
  Findings Compare(const IsotropicRemesher::Result& patches, const Monitor& monitor);

private:
  struct Measures
  {
    double Area = 0.0;
    double Volume = 0.0;
    bool IsClosed = true;
    CGAL::Bbox_3 Box;
  };
  using Points = TriangleCrossings::Points;
  using Triangles = TriangleCrossings::Triangles;

  void FindComponents();
  /// Of all components, the box excepted. `sources` are the soup's triangles; none for itself.
  std::vector<Measures> Measure(const Points& points, const Triangles& triangles,
    const std::vector<std::size_t>* sources) const;
  std::vector<TriangleCrossings::Pair> FindNew(const IsotropicRemesher::Result& patches,
    const std::vector<TriangleCrossings::Pair>& pairs, const Monitor& monitor);

  const TriangleSoup& Soup;
  std::vector<std::size_t> Components;
  std::vector<Measures> Before;
  /// Where the surface meets itself; looked for when it is wanted.
  std::optional<std::vector<TriangleCrossings::Pair>> Meetings;
};
} // namespace LightTransport

#endif
