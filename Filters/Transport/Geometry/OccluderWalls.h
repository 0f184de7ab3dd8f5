// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The patches of a scene as what they hide: those that lie beside each other in one plane and fill
 * a convex polygon together are one *wall*, all others are walls by themselves. How finely a wall
 * is cut does not matter to what it hides, and there are far fewer of them.
 */
#ifndef OccluderWalls_h
#define OccluderWalls_h

#include "Geometry/ConvexBodies.h"
#include "Scene/PatchGeometry.h"
#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class PatchScene;

/// "Patches" of the base class are the walls, in the order of their first patches.
class OccluderWalls : public PatchGeometry
{
public:
  explicit OccluderWalls(const PatchScene& scene);

  /// The wall that a patch of the scene belongs to.
  vtkIdType GetWall(vtkIdType patch) const { return this->WallOf[patch]; }

  /// A node of the scene's tree that holds all patches of a wall, and no child of it does.
  int GetNode(vtkIdType wall) const { return this->Nodes[wall]; }

  /// Convex bodies that walls bound.
  const ConvexBodies& GetBodies() const { return this->Bodies; }

  /// A convex hull of points, from which others are looked at.
  struct End
  {
    std::vector<Vector> Points;
    Vector Middle;
    double SquaredReach; ///< of two of the points that are far apart
    bool IsOutside;      ///< all of it is outside all bodies

    void Set(std::vector<Vector> points, bool isOutside);
  };

  /**
   * Whether a wall stands in the way of all segments between two hulls: then nothing of one is seen
   * from the other. With `strictly` all points must be off the wall's plane for certain; else one
   * of each side, what touches the plane from one side being no more than a border.
   */
  bool HidesAll(vtkIdType wall, const End& from, const End& to, bool strictly) const;

  /// The first of some walls that does so, or whose body does; -1 where there is none. getWall
  /// gives the wall of an item.
  template <typename Items, typename GetWall>
  vtkIdType FindHiding(const Items& items, const GetWall& getWall, const End& from, const End& to,
    bool strictly) const
  {
    int latest = -1;
    for (const auto& item : items)
    {
      const vtkIdType wall = getWall(item);
      const int body = this->Bodies.GetBody(wall);
      if (this->HidesAll(wall, from, to, strictly) ||
        (body >= 0 && body != latest && (from.IsOutside || to.IsOutside) &&
          this->Bodies.IsBetween(body, from.Points, to.Points)))
      {
        return wall;
      }
      latest = body;
    }
    return -1;
  }

private:
  class Builder;

  bool MayHide(vtkIdType wall, const Vector& from, const Vector& to) const;
  bool IsInside(vtkIdType wall, const Vector& place) const;
  void FindNodes(const PatchScene& scene);
  void FindBorders();

  std::vector<vtkIdType> WallOf;
  std::vector<int> Nodes;
  ///@{ Of the edge behind each corner: the direction inwards, and the height of the edge along it.
  std::vector<Vector> Inwards;
  std::vector<double> Heights;
  ///@}
  ConvexBodies Bodies;
};
} // namespace LightTransport

#endif
