// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Borders that are one place but for rounding: points near other points, which are welded, and
 * corners that lie on a side of another triangle (T-junctions), where that side is to be split.
 *
 * Both only give places in common: whether sides are joined there is for SideJoiner to say. No two
 * corners of one triangle are welded, no points further apart than a quarter of the sides there,
 * the nearest ones first; and a side is split only where it runs along another one.
 */
#ifndef NearSides_h
#define NearSides_h

#include "Common/TriangleSoup.h"
#include "Mesher/SideJoiner.h"
#include "Shared/Monitor.h"

#include <cstddef>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace LightTransport
{
class NearSides
{
public:
  /// `places` of the points of a soup; all must stay.
  NearSides(const TriangleSoup& soup, const SideJoiner& joiner, std::vector<std::size_t>& places,
    double tolerance);

  /// Fails where too many points are near each other.
  Outcome Find(const Monitor& monitor);

  /// How far apart points are that may be one, at most: no further than the tolerance, or on a side
  /// next to its end. 0 without any.
  double FindLargestGap() const;
  /// The median of the sides.
  double GetTypicalLength() const { return this->TypicalLength; }

  /// Give points that are one the same place. Returns whether there were any.
  bool Weld();

  /// The points at which each side is to be split, in the direction of the side.
  std::map<std::size_t, std::vector<std::size_t>> FindSplits() const;

private:
  void FindBorders();
  double GetReach(std::size_t point, std::size_t side) const;
  void Look(std::size_t point, std::size_t side);
  std::vector<std::vector<std::size_t>> FindTriangles() const;

  /// What lies on sides, and begins or ends there: by place.
  struct Incidence;
  bool RunsAlong(const Incidence& incidence, std::size_t side, std::size_t other) const;

  const TriangleSoup& Soup;
  const SideJoiner& Joiner;
  std::vector<std::size_t>& Places;
  double Tolerance;
  /// Sides without a partner, and one point for each place at their ends.
  std::vector<std::size_t> Sides;
  std::vector<std::size_t> Points;
  double TypicalLength = 0.0;
  /// Of the shortest of these sides at each point.
  std::vector<double> Shortest;
  /// Distance, and the points that may be one.
  std::vector<std::tuple<double, std::size_t, std::size_t>> Pairs;
  /// A side, a point on it, and how far along.
  std::vector<std::tuple<std::size_t, std::size_t, double>> Corners;
};
} // namespace LightTransport

#endif
