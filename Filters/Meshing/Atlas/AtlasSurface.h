// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The surface that an atlas is made for: oriented manifold triangles that know their neighbours.
 * Edges that are long beside the surface, or beside their component, are halved at first: charts
 * are made of whole triangles, and few large ones leave no choice where to cut.
 *
 * A triangle that is long in two sides becomes a ladder: the diagonals between its rungs are not
 * halved but replaced by rungs, so that the triangles double where they would else treble each time
 * that their sides are halved.
 */
#ifndef AtlasSurface_h
#define AtlasSurface_h

#include "Common/TriangleSoup.h"
#include "Common/Watch.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace LightTransport
{
class AtlasSurface
{
public:
  using Vector = Eigen::Vector3d;

  /// Take the triangles of a soup without defects. Fails where the areas are beyond the numbers
  /// that can be reckoned with, or where halving makes too many triangles.
  Outcome Build(const TriangleSoup& soup, const Watch& watch);

  int GetNumberOfFaces() const { return static_cast<int>(this->Triangles.size()); }

  std::vector<TriangleSoup::Point> Points;
  /// The edges that were halved, in order: their middles are the last points. An edge may end at a
  /// point that an earlier one made.
  std::vector<std::array<std::size_t, 2>> HalvedEdges;

  std::vector<TriangleSoup::Triangle> Triangles;
  /// The triangle of the soup that each triangle is a part of.
  std::vector<std::size_t> Sources;
  /// The face across the edge from corner i to corner i + 1; -1 at a border.
  std::vector<std::array<int, 3>> Neighbors;
  std::vector<double> Areas;
  std::vector<Vector> Normals; ///< of length 1
  std::vector<Vector> Centers;
  double Area = 0.0;

  Vector GetPoint(std::size_t point) const
  {
    return Eigen::Map<const Vector>(this->Points[point].data());
  }
  double GetEdgeLength(int face, int edge) const;
  Vector GetEdgeMiddle(int face, int edge) const;
  /// Whether a face is far longer than high.
  bool IsThin(int face) const { return this->Bundles[face] >= 0; }
  /// The bundle of thin faces, side by side and together about as wide as long, that a face belongs
  /// to; -1 for one that is not thin. Charts had better not be cut between them.
  int GetBundle(int face) const { return this->Bundles[face]; }

  /**
   * The neighbours of the faces of one piece, numbered as `faces` is; -1 across the border of the
   * piece. `owners` tells the piece that each face of the surface belongs to. `local` is room for
   * one number per face; only those of the piece are used, so different pieces may be asked for at
   * the same time.
   */
  std::vector<std::array<int, 3>> GetNeighborsWithin(const std::vector<int>& faces,
    const std::vector<int>& owners, std::vector<int>& local) const;

private:
  std::vector<int> Bundles;

  /// The point in the middle of each halved edge, by the two points of the edge.
  using Middles = std::unordered_map<std::uint64_t, std::size_t>;
  struct Diagonal;

  void FindNeighbors(const Watch& watch);
  void FindGeometry();
  double GetLongestEdge(int face) const;
  void FindBundles(const Watch& watch);
  Outcome CheckAreas(const TriangleSoup& soup) const;
  std::vector<double> FindLongestEdges(const Watch& watch) const;
  int FindOtherLongEdge(int face, int edge, double longest) const;
  std::vector<Diagonal> FindDiagonals(const std::vector<double>& longest) const;
  int FindLongestHalvedEdge(std::size_t face, const Middles& middles) const;
  Middles HalveEdges(const std::vector<double>& longest, const std::vector<Diagonal>& kept);
  void CutFace(std::size_t face, const Middles& middles, std::vector<double>& longest);
  void Replace(const Diagonal& diagonal, int firstPart, int secondPart);
  bool HalveLongEdges(std::vector<double>& longest, const Watch& watch);
};
} // namespace LightTransport

#endif
