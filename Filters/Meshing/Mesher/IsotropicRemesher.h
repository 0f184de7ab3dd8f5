// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Remeshes a manifold surface to a length per point. The edges to keep cut it into parts; each part
 * is remeshed on its own and projected onto itself only.
 *
 * Call Build(), SetLengths(), Prepare() and Remesh() in this order; Prepare() starts anew from what
 * SetLengths() left. All methods throw what CGAL throws (std::exception), and Heartbeat::Stopped
 * when a monitor aborts them.
 */
#ifndef IsotropicRemesher_h
#define IsotropicRemesher_h

#include "Common/TriangleSoup.h"
#include "Mesher/SourceSurface.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <memory>
#include <vector>

namespace LightTransport
{
class IsotropicRemesher
{
public:
  IsotropicRemesher();
  ~IsotropicRemesher();
  IsotropicRemesher(const IsotropicRemesher&) = delete;
  void operator=(const IsotropicRemesher&) = delete;

  /**
   * Take the triangles of a soup without defects, and mark the edges to keep: borders, edges
   * between triangles of different `regions` (one per triangle), and edges whose normals differ by
   * more than `featureAngle` degrees. Returns false when the soup is not a manifold.
   */
  bool Build(const TriangleSoup& soup, const std::vector<int>& regions, double featureAngle);

  /// The surface as it was built. Its points are those of the soup that triangles use, in order.
  SourceSurface GetSurface() const;
  /// The point of the soup that each point of GetSurface() is.
  const std::vector<std::size_t>& GetPointsOfSoup() const { return this->PointsOfSoup; }

  /// The length that edges should have at each point of GetSurface().
  void SetLengths(const std::vector<double>& lengths);

  /**
   * Let edges inside the planar `regions` be as long as `lengths`, both one per triangle; None
   * where there is no region. `keepBorders`: also keep the edges around them.
   */
  void SetPlanarRegions(const std::vector<std::size_t>& regions, const std::vector<double>& lengths,
    bool keepBorders);

  /// Also keep the edges at `points` of GetSurface() that are not flat: there patches will lie in
  /// the triangles of the surface.
  void KeepCreases(const std::vector<bool>& points);

  /**
   * Multiply all lengths by `factor`, split the edges to keep, limit the lengths to what these
   * allow and to the `grading`, and tell the parts apart. Returns how many triangles will come out,
   * about; where that is more than MostTriangles the mesh is not to be remeshed.
   */
  static constexpr double MostTriangles = 2e7;
  double Prepare(double factor, double grading, const Monitor& monitor);

  /// The fractions that the monitor hears are estimates.
  Outcome Remesh(int numberOfIterations, const Monitor& monitor);

  std::size_t GetNumberOfTriangles() const;
  /// After Remesh(): split the longest edges, or collapse the shortest, up or down to this number.
  Outcome AdjustNumberOfTriangles(std::size_t number, const Monitor& monitor);

  /// The prepared surface.
  const SourceSurface& GetSources() const { return this->Sources; }

  struct Result
  {
    std::vector<TriangleSoup::Point> Points;
    std::vector<TriangleSoup::Triangle> Triangles;
    /// The triangle of the soup that each point comes from, and each triangle.
    std::vector<std::size_t> SourcesOfPoints;
    std::vector<std::size_t> SourcesOfTriangles;
  };
  Result GetResult(const Monitor& monitor) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Meshes;
  std::vector<std::size_t> PointsOfSoup;
  SourceSurface Sources;
  std::vector<double> Lengths; ///< that edges should have, at each point of Sources
};
} // namespace LightTransport

#endif
