// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Convex bodies of a scene: patches that bound one all around, or all around but for one flat side
 * that has the whole scene in front of it, as a house on the ground. Such a body hides as a whole,
 * and of the patches that bound it those that face a point outside hide all that the body hides
 * from there: a segment that enters it does so through one of them.
 *
 * What is not outside, patches that reach into a body or lie against it, is known patch by patch.
 */
#ifndef ConvexBodies_h
#define ConvexBodies_h

#include "Scene/PatchGeometry.h"
#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class PatchScene;

class ConvexBodies
{
public:
  using Vector = PatchGeometry::Vector;

  /// `walls` are what patches beside each other in one plane fill, `wallOf` those of all patches.
  void Find(const PatchScene& scene, const PatchGeometry& walls,
    const std::vector<vtkIdType>& wallOf);

  /// The body that a wall bounds; -1 where it bounds none.
  int GetBody(vtkIdType wall) const { return this->BodyOf[wall]; }
  int GetNumberOfBodies() const { return static_cast<int>(this->Bodies.size()); }

  /// Whether a patch is outside all bodies, or one of those that bound them.
  bool IsOutside(vtkIdType patch) const { return this->Outside[patch]; }

  /// Whether all segments between the hulls of two sets of points, up to MostPoints each, pass
  /// through a body. Where one end of them is outside nothing of one is then seen from the other.
  bool IsBetween(int body, const std::vector<Vector>& from, const std::vector<Vector>& to) const;
  static constexpr std::size_t MostPoints = PatchGeometry::MaximumCorners + 2;

private:
  class Builder;

  struct Body
  {
    std::vector<PatchPlane> Sides; ///< normals outwards
    Vector Lower, Upper;
    ///@{ Around the centre: a sphere inside, and one that holds all.
    Vector Center;
    double InnerRadius = 0.0;
    double OuterRadius = 0.0;
    ///@}
  };

  void MarkInside(const PatchScene& scene, const std::vector<vtkIdType>& wallOf, int body);
  bool IsBeside(const PatchScene& scene, vtkIdType patch, int body) const;

  std::vector<Body> Bodies;
  std::vector<int> BodyOf;
  std::vector<bool> Outside;
};
} // namespace LightTransport

#endif
