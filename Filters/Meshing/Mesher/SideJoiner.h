// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which triangles of a soup are neighbours. Each side of a triangle gets one partner at most, so
 * whatever comes in, a manifold comes out: points are what the corners of neighbours have in
 * common.
 *
 * First sides between the same two points are joined, then sides in the same two places that are
 * left. So what is one surface by its points stays that, whatever it touches (two solids with a
 * face, an edge or a point in common, the two sides of a sheet), and triangles that have points of
 * their own (as STL files have) are joined all the same.
 *
 * Two sides alone in a place are partners, unless their triangles lie on each other. Where there
 * are more, those of one component (what has been joined so far) come first, then the order around
 * the edge decides: material is behind triangles, so that the sides of solids that touch alternate,
 * and partners are those with material between them; or those with air between them where there is
 * no room for material, as where two rooms touch. Where they do not alternate the pair that goes on
 * most smoothly is joined first, and what is left stays a border.
 */
#ifndef SideJoiner_h
#define SideJoiner_h

#include "Common/TriangleSoup.h"
#include "Shared/DisjointSets.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace LightTransport
{
class SideJoiner
{
public:
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  /// The soup must stay as it is. Coordinates may be off by `rounding`.
  SideJoiner(const TriangleSoup& soup, double rounding);

  /// Join the sides that are left, by the places of their points. Once for the points themselves,
  /// then for places that several of them share.
  void Join(const std::vector<std::size_t>& places, bool placesArePoints);

  /// Undo it, for a side that turns out to be in the way of others.
  void Part(std::size_t side);

  /// Side 3 t + i goes from corner i of triangle t to the next one.
  std::size_t GetNumberOfSides() const { return this->Partners.size(); }
  std::size_t GetPartner(std::size_t side) const { return this->Partners[side]; }
  /// Of a side without a partner: whether that is because too many others are there.
  bool IsCrowded(std::size_t side) const { return this->Crowded[side]; }
  /// The points at both ends.
  std::array<std::size_t, 2> GetEnds(std::size_t side) const
  {
    const TriangleSoup::Triangle& triangle = this->Soup.Triangles[side / 3];
    return { triangle[side % 3], triangle[(side + 1) % 3] };
  }
  std::size_t FindComponent(std::size_t triangle) { return this->Components.Find(triangle); }

  /// Whether the triangles of two sides on one line lie on each other there.
  bool IsFold(std::size_t side, std::size_t other) const;

private:
  /// A side among others in its place.
  struct Leaf
  {
    std::size_t Side;
    bool IsForward; ///< from the lower to the higher place
    double Angle;   ///< of its triangle around the edge
  };
  using Crowd = std::vector<Leaf>;

  void JoinPair(std::size_t side, std::size_t other);
  void JoinCrowd(const Crowd& crowd);
  void Match(Crowd crowd);
  bool MatchAlternating(const Crowd& crowd, double tolerance, bool acrossMaterial);
  void MatchSmooth(const Crowd& crowd);
  double FindAngles(Crowd& crowd) const;
  TriangleSoup::Point GetAxis(std::size_t side) const;
  TriangleSoup::Point GetArm(std::size_t leaf, std::size_t hinge,
    const TriangleSoup::Point& axis) const;
  double GetAngleTolerance(const TriangleSoup::Point& arm) const;
  bool AreTwins(std::size_t triangle, std::size_t other) const;

  const TriangleSoup& Soup;
  double Rounding;
  std::vector<std::size_t> Partners;
  std::vector<bool> Crowded;
  DisjointSets Components;
};
} // namespace LightTransport

#endif
