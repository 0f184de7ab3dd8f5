// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Divides a patch into what a light without extent reaches and what it does not, exactly: the
 * shadow of a patch is where all planes through the light and one of its edges, and its own plane,
 * have the right side, and so a convex polygon in the plane of the patch that is lit, which is cut
 * away. What the coordinates of the two patches cannot tell apart (PatchPlane) casts no shadow.
 *
 * Pieces with many patches before them are halved until few are left, and given up as undecided
 * where they get too small: rays tell about those.
 */
#ifndef ShadowClipper_h
#define ShadowClipper_h

#include "Lighting/LightSource.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace LightTransport
{
class ShadowClipper
{
public:
  using Vector = LitPatch::Vector;
  using Place = Eigen::Vector2d;
  /// A convex polygon in the plane of the patch, counter-clockwise.
  using Piece = std::vector<Place>;

  /// A point, or a direction in which light comes from infinitely far away.
  struct Origin
  {
    bool IsPoint = false;
    Vector Position = Vector::Zero();
    Vector Direction = Vector::Zero(); ///< of the light on its way, a unit vector
  };

  struct Result
  {
    std::vector<Piece> Lit;
    std::vector<Piece> Undecided;
  };

  explicit ShadowClipper(const LitPatch& patch);

  const LitPatch& GetPatch() const { return this->Lit; }
  /// The whole patch.
  const Piece& GetWhole() const { return this->Whole; }
  Vector GetPoint(const Place& place) const
  {
    return this->Center + place.x() * this->Axes[0] + place.y() * this->Axes[1];
  }
  static double GetArea(const Piece& piece);
  /// A place of a piece, evenly spread for two numbers evenly spread in (0, 1).
  static Place Choose(const Piece& piece, double u, double v);
  /// Keep what is in front of the plane through `point` with `normal`.
  void Cut(const Vector& point, const Vector& normal, Piece& piece) const;

  /// The patches that may be between a piece and the light. A directional light may come from all
  /// directions within an angle (its radius, in radians) of its own.
  std::vector<vtkIdType> FindBlockers(const Piece& piece, const Origin& light,
    double radius = 0.0) const;

  /// Divide a piece, in pieces of at least the area `least` where they stay undecided.
  void Divide(const Piece& piece, const Origin& light, const std::vector<vtkIdType>& blockers,
    double least, Result& result) const;

private:
  // Heights over it are Slope . place + Offset.
  struct Line
  {
    Place Slope;
    double Offset;
    double GetHeight(const Place& place) const { return this->Slope.dot(place) + this->Offset; }
  };
  // The shadow of a patch: where the heights over all lines are positive, those of the last one,
  // its own plane's, by more than its tolerance.
  struct Shadow
  {
    std::vector<Line> Lines;
    Place Foot;   // of the patch's centroid
    double Above; // its height over the plane that is lit
    double Rounding, Slope;
    double GetTolerance(const Place& place) const;
  };
  using Shadows = std::vector<const Shadow*>;

  Line MakeLine(const Vector& point, const Vector& normal) const;
  bool MakeShadow(vtkIdType blocker, const Origin& light, Shadow& shadow) const;
  static bool Misses(const Shadow& shadow, const Piece& piece);
  static bool Covers(const Shadow& shadow, const Piece& piece);
  static void Split(const Piece& piece, const std::vector<double>& heights, Piece& front,
    Piece& behind);
  void DividePiece(const Piece& piece, const Shadows& before, double least, Result& result) const;
  static std::array<Piece, 2> Halve(const Piece& piece);
  static void Scatter(const Piece& piece, double least, Result& result);
  void CutShadow(const Piece& piece, const Shadows& shadows, double least, Result& result) const;

  const LitPatch& Lit;
  Vector Center;
  Vector Axes[2];
  Piece Whole;
};
} // namespace LightTransport

#endif
