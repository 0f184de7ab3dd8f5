// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Where light from a place or a direction enters a body so that, refracted there, it reaches a
 * point inside: on all patches that it can come through, by Snell's law in the plane of each.
 * Nothing is approximated; where facets focus light a point has several entries, between the beams
 * of two facets none.
 *
 * The tree of the patches is searched: of a node's box and the cone of its normals follows a cone
 * of refracted directions. A turn of the normal turns the refracted ray by 1 - d theta_t / d
 * theta_i of that at most, a turn of the ray outside by the inverse of the refractive index. B.
 * Walter, S. Zhao, N. Holzschuch, K. Bala, "Single Scattering in Refractive Media with Triangle
 * Mesh Boundaries", SIGGRAPH 2009, search so for smooth normals.
 */
#ifndef EntrySearch_h
#define EntrySearch_h

#include "Photons/PhotonInterface.h"
#include "Scene/PatchScene.h"

#include <vector>

namespace LightTransport
{
class EntrySearch
{
public:
  using Vector = Eigen::Vector3d;

  /// Where the light is: a point, or the unit vector towards what is infinitely far away.
  struct Origin
  {
    bool IsPoint;
    Vector Place;
  };

  struct Entry
  {
    vtkIdType Patch;
    Vector Point;
    Vector Towards;   ///< the light, from the entry
    Vector Direction; ///< from the entry to the point inside
    double Distance;  ///< between them
    /// Irradiance at the point inside, across the ray, over that at the entry outside; without what
    /// the medium takes.
    double Spread;
  };

  EntrySearch(const PatchScene& scene, double refractiveIndex)
    : Scene(scene), Index(refractiveIndex), Interface(refractiveIndex)
  {
  }

  /// Add the entries within a distance of a point inside. What is in the way is not looked at.
  void Find(const Vector& point, const Origin& light, double reach,
    std::vector<Entry>& entries) const;

private:
  /// From a light above a plane to a point below it: where along the plane, from the foot of the
  /// light on.
  struct Refraction
  {
    double Index;
    double Height; ///< of the light
    double Depth;  ///< of the point
    double Width;  ///< between their feet

    double GetExcess(double place) const;
    bool CrossesBetween(double low, double high) const;
    double FindCrossing() const;
  };

  bool CanReach(const PatchTree::Node& node, const Vector& point, const Origin& light,
    double reach) const;
  double GetTurn(double incidence) const;
  bool FindOnPatch(vtkIdType patch, const Vector& point, const Origin& light, Entry& entry) const;
  void EnterFromAfar(const Vector& normal, double depth, const Vector& point, const Vector& towards,
    Entry& entry) const;
  bool EnterFromPoint(const Vector& normal, double depth, double height, const Vector& point,
    const Vector& light, Entry& entry) const;
  bool MayCross(vtkIdType patch, const Vector& foot, const Vector& along,
    const Refraction& refraction) const;
  bool Contains(vtkIdType patch, const Vector& point) const;

  const PatchScene& Scene;
  double Index;
  PhotonInterface Interface;
};
} // namespace LightTransport

#endif
