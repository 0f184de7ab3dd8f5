// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A polygon in the plane as triangles. Its border may touch itself (the seams that join holes to
 * it, corners that repeat), but not cross itself.
 *
 * Why the triangles are right: cutting a corner off leaves the sum of all oriented areas at each
 * point as it was. Where the border does not cross itself that is 1 inside and 0 outside, so
 * triangles that are all counter-clockwise cover the inside once and nothing else.
 */
#ifndef EarClipper_h
#define EarClipper_h

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace LightTransport
{
class EarClipper
{
public:
  using Vector = Eigen::Vector2d;

  /// Counter-clockwise corners; what is flat by no more than `rounding` has no area.
  EarClipper(std::vector<Vector> corners, double rounding);

  /// False where the border crosses itself.
  bool Clip();

  /// Indices of corners, counter-clockwise; those without area too.
  const std::vector<std::vector<int>>& GetTriangles() const { return this->Triangles; }

  double GetLength(const std::pair<int, int>& edge) const
  {
    return (this->Corners[edge.second] - this->Corners[edge.first]).norm();
  }
  /// At corner b of a triangle, in radians.
  double GetAngle(int a, int b, int c) const;
  /// Whether the border from corner a over b to c turns left, or goes on as it was.
  bool IsConvex(int a, int b, int c) const;

private:
  enum class Kind : char
  {
    Spike,    ///< straight back, or a corner that repeats
    Flat,     ///< straight on
    Ear,      ///< can be cut off
    Touching, ///< can, but along a line that another corner is on
    Blocked,  ///< something is inside of the triangle
    Reflex
  };

  double GetTurn(int a, int b, int c) const;
  /// Turns that are no larger may be rounding.
  double GetFlatness(int a, int b, int c) const;
  bool Blocks(int corner, int a, int b, int c) const;
  bool IsBetween(int corner, int a, int b) const;
  bool CrossesItself() const;
  bool Cross(int a, int b) const;
  Kind Classify(int corner) const;
  void ClassifyAll();
  int FindNext() const;
  void Remove(int corner);

  std::vector<Vector> Corners;
  double Rounding;
  std::vector<std::vector<int>> Triangles;
  ///@{ Of the corners that are left, a ring from First on.
  std::vector<int> Next;
  std::vector<int> Previous;
  std::vector<Kind> Kinds;
  int First = 0;
  int Count;
  ///@}
};
} // namespace LightTransport

#endif
