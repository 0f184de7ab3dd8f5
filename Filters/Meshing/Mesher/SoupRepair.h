// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Repairs that need no neighbours, and those that find them: triangles without area and
/// duplicates, sides that belong together, orientation of a soup. See ManifoldRepair for the
/// others.
#ifndef SoupRepair_h
#define SoupRepair_h

#include "Common/TriangleSoup.h"
#include "Mesher/RepairCounts.h"
#include "Mesher/SideJoiner.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <map>
#include <memory>
#include <set>
#include <vector>

namespace LightTransport
{
class SoupRepair
{
public:
  /// Both must outlive this object. `weldTolerance` 0: what the coordinates are worth.
  SoupRepair(TriangleSoup& soup, double weldTolerance, RepairCounts& counts);

  ///@{ In this order.
  /// Returns their number. What they leave open Join() closes.
  vtkIdType DropDegenerateTriangles();
  /// Triangles with the corners and the direction of one before, but for those of a surface of its
  /// own that only touches that one.
  void DropCopies();
  /// Make the soup an oriented manifold: points become those of joined triangles, neighbours are
  /// oriented alike, and cut along a seam where that cannot be. Unless everything is so already.
  Outcome Join(const Monitor& monitor);
  ///@}

private:
  /// Triangles of a component that have twins.
  struct ComponentTwins
  {
    std::vector<std::size_t> Copies; ///< that share points with what they are copies of
    std::size_t NumberLoose = 0;     ///< that share none with anything
    std::set<std::size_t> Others;    ///< components that the twins are on
  };

  void StartJoining();
  Outcome WidenTolerance(const Monitor& monitor);
  Outcome JoinNearSides(const Monitor& monitor);
  void SplitSides(const std::map<std::size_t, std::vector<std::size_t>>& splits);
  void SplitTriangle(std::size_t triangle, std::array<std::vector<std::size_t>, 3> points);
  std::vector<std::vector<std::size_t>> FindTwins() const;
  std::map<std::size_t, ComponentTwins> SortTwins(
    const std::vector<std::vector<std::size_t>>& sets);
  std::vector<bool> FindOpenComponents() const;
  void DropStrayTwins();
  std::vector<bool> FindReversed();
  bool AreOpposed(std::size_t side, std::size_t partner) const;
  void TurnComponentsToMajority(std::vector<bool>& reversed);
  std::vector<std::size_t> FindPoints();
  bool PartCrowds(const std::vector<std::size_t>& points, const std::vector<bool>& reversed);
  void MakePoints(const std::vector<bool>& reversed);
  void CountPoints(const std::vector<std::size_t>& pointsOfCorners, const TriangleSoup& joined);
  void NoteLooseTriangles();
  void Keep(const std::vector<bool>& kept);

  TriangleSoup& Soup;
  RepairCounts& Counts;
  double Tolerance;
  bool IsDefaultTolerance;
  /// Of the points of the soup: exactly, and after welding.
  std::vector<std::size_t> Exact;
  std::vector<std::size_t> Places;
  std::unique_ptr<SideJoiner> Joiner;
  /// Sides along which a surface with one side is cut.
  std::vector<bool> Seams;
};
} // namespace LightTransport

#endif
