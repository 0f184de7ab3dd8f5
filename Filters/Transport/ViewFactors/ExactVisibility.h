// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The visible part of the exchange of two polygons that are close to each other, past a few
 * occluders. From a point of the smaller one, what the shadows of the occluders leave of the other
 * is cut into convex parts, whose light is known in closed form (Lambert 1760): exact at each
 * point, however close things are, where the samples of ShadowRaster would be too coarse. Over the
 * points it is a product of Simpson's rules on quadrilaterals, whose points on the rim see what
 * changes there; the one with the largest error is cut into two until the sum keeps the tolerance.
 * What a cut changes is known for each of the two directions apart: one tells nothing of the other.
 *
 * One object per thread: it keeps its buffers.
 */
#ifndef ExactVisibility_h
#define ExactVisibility_h

#include "ViewFactors/PairIntegrals.h"

#include <cstddef>
#include <vector>

namespace LightTransport
{
class ExactVisibility
{
public:
  using Estimate = PairIntegrals::Estimate;

  ///@{
  /**
   * The visible exchange of two polygons, each in front of the plane of the other, past convex
   * polygons that lie in front of both planes. `open` is the exchange with nothing in between,
   * `rounding` what coordinates are known to.
   * `tolerance` is absolute, in units of area; the work is bounded, the error says what was
   * reached.
   */
  void Set(const Polygon& a, const Polygon& b, double open, double rounding);
  void AddOccluder(const Polygon& occluder) { this->Occluders.push_back(occluder); }
  Estimate Integrate(double tolerance);
  ///@}

private:
  using Vector = Polygon::Vector;

  static constexpr int Points = 3; ///< in each direction

  /// A quadrilateral of the outer polygon, whose last two corners may be the same. From corner 0,
  /// the first direction is towards corner 1, the second towards corner 3; places go from 0 to 1.
  struct Quadrilateral
  {
    Vector Corners[4];
    Vector GetPlace(double s, double t) const;
    /// Area for a unit of s and t.
    double GetDensity(double s, double t) const;
  };

  /// A part of a quadrilateral.
  struct Piece
  {
    int Whole; ///< its number
    double Begin[2];
    double End[2];
    double Views[Points][Points];
    double Value;     ///< their integral
    double Errors[2]; ///< estimates, by the directions
    double GetError() const { return this->Errors[0] + this->Errors[1]; }
    bool operator<(const Piece& other) const { return this->GetError() < other.GetError(); }
    double GetNode(int direction, int line) const;
  };

  void AddPieces();
  void CutWorst();
  void LookAlong(Piece& piece, int direction, int line);
  double IntegrateViews(const Piece& piece) const;
  double GetView(const Vector& point);
  void TakeShadow(const Polygon& occluder, const Vector& point);
  void Split(const Polygon& part, const Vector& point);

  Polygon Outer, Inner; ///< the smaller and the larger one
  double Open = 0.0;
  double Inset = 0.0; ///< of places on the rim
  std::vector<Quadrilateral> Quadrilaterals;
  std::vector<Polygon> Occluders;
  std::vector<Piece> Pieces; ///< a heap, the largest error first
  double Work = 0.0;         ///< shadows on parts

  /// Polygons without normals; memory is kept.
  struct PartList
  {
    std::vector<Polygon> Polygons;
    std::size_t Count = 0;
    void Add(const Polygon& part);
  };

  // From one point: what is left of the inner polygon, and the planes of a shadow.
  PartList Parts, Left;
  std::vector<Vector> Sides;
};
} // namespace LightTransport

#endif
