// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A manifold surface that is remeshed with CGAL. The edges to keep cut it into parts; each part is
 * remeshed on its own and projected onto itself only.
 *
 * All methods throw what CGAL throws (std::exception).
 */
#ifndef vtkSurfaceRemesher_h
#define vtkSurfaceRemesher_h

#include "vtkTriangleSoup.h"

#include <functional>
#include <memory>
#include <vector>

class vtkSurfaceRemesher
{
public:
  vtkSurfaceRemesher();
  ~vtkSurfaceRemesher();
  vtkSurfaceRemesher(const vtkSurfaceRemesher&) = delete;
  void operator=(const vtkSurfaceRemesher&) = delete;

  /**
   * Take the triangles of a soup without defects, and mark the edges to keep: borders, edges
   * between triangles of different `regions` (one per triangle), and edges whose normals differ by
   * more than `featureAngle` degrees. Returns false when the soup is not a manifold.
   */
  bool Build(const vtkTriangleSoup& soup, const std::vector<int>& regions, double featureAngle);

  /// How many triangles edges of this length will give, about.
  double EstimateNumberOfTriangles(double targetEdgeLength) const;

  /// Split the edges to keep, and tell the parts between them apart.
  void SplitKeptEdges(double targetEdgeLength);

  /**
   * Called now and then while Remesh() works, with the fraction of the work that is done (an
   * estimate); when it returns false, Remesh() gives up.
   */
  using Monitor = std::function<bool(double)>;

  /// Remesh between the edges to keep. Returns false when the monitor said so.
  bool Remesh(double targetEdgeLength, int numberOfIterations, const Monitor& monitor);

  struct Result
  {
    std::vector<vtkTriangleSoup::Point> Points;
    std::vector<vtkTriangleSoup::Triangle> Triangles;
    /// The part that each triangle belongs to.
    std::vector<std::size_t> Parts;
  };
  Result GetResult() const;

  /// The part that each triangle of the soup belongs to; valid after SplitKeptEdges().
  const std::vector<std::size_t>& GetPartsOfSoup() const { return this->PartsOfSoup; }
  std::size_t GetNumberOfParts() const { return this->NumberOfParts; }

private:
  struct Internals;
  std::unique_ptr<Internals> Surface;
  std::vector<std::size_t> PartsOfSoup;
  std::size_t NumberOfParts = 0;
};

#endif
