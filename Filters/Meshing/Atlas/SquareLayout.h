// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Places the points of a disc in the unit square when it is known which points lie on which side:
 * those slide along their side, and all others are free.
 *
 * The start is the balance of springs along the edges, which is one-to-one for positive springs:
 * reflected at its sides, the square is a torus, for which Gortler, Gotsman and Thurston ("Discrete
 * one-forms on meshes and applications to 3D mesh parameterization", 2006) prove it. Springs that
 * are weakened where the stretch is large lower the stretch (Yoshizawa, Belyaev and Seidel, "A fast
 * and simple stretch-minimizing mesh parameterization", 2004); Newton's method then takes it to a
 * minimum without turning a triangle over.
 */
#ifndef SquareLayout_h
#define SquareLayout_h

#include "Atlas/SquareMap.h"
#include "Atlas/StepSolver.h"

#include <array>
#include <memory>
#include <vector>

namespace LightTransport
{
class SquareLayout
{
public:
  using Coordinates = SquareMap::Coordinates;

  /// Sides of the square, as bits: a corner has two, an inner point none.
  enum Side : unsigned char
  {
    Left = 1,
    Right = 2,
    Bottom = 4,
    Top = 8
  };

  enum class SpringKind
  {
    /// As stiff as makes the map nearly conformal, but never negative.
    Conformal,
    /// All alike (Tutte).
    Uniform
  };

  /// All must outlive this object.
  SquareLayout(const SquareMap::Disc& disc, const std::vector<unsigned char>& sides,
    const Watch& watch);

  /// Place all points where the springs balance. False if rounding does not allow it.
  bool Balance(SpringKind kind);

  /// Weaken the springs where the stretch is large and balance again, as long as this helps.
  void Reweight(int maximumNumberOfIterations);

  /// Newton's method on the stretch. Needs triangles that are all counter-clockwise.
  void Minimize(int maximumNumberOfIterations);

  const std::vector<Coordinates>& GetCoordinates() const { return this->UV; }

  /// Whether all triangles are counter-clockwise as far as rounded arithmetic can tell.
  bool IsOneToOne() const;

  ///@{ As in SquareMap; infinite when a triangle is not counter-clockwise.
  double GetL2Stretch() const { return this->MeasureL2Stretch(this->UV); }
  double GetLInfinityStretch() const;
  ///@}

private:
  /// A triangle on the surface, which is scaled to have the square's area: in its plane, with the
  /// first corner at the origin and the second one at (Length, 0), the third one is Apex.
  struct Shape
  {
    double Length;
    Coordinates Apex;
    double Area;
  };
  Shape MakeShape(const SquareMap::Triangle& triangle) const;
  double MeasureL2Stretch(const std::vector<Coordinates>& uv) const;
  double GetSquaredStretch(std::size_t triangle, const std::vector<Coordinates>& uv) const;
  std::vector<double> GetPointStretch(const std::vector<Coordinates>& uv) const;
  void MakeConformalSprings();
  StepSolver<3>& GetSolver(int axis, const std::vector<std::array<int, 2>>& unknowns,
    int numberOfUnknowns);
  bool Solve(std::vector<Coordinates>& uv);
  double GetLargestStep(const std::vector<Coordinates>& step) const;
  double MeasureSquaredStretch(const std::vector<Coordinates>& uv) const;
  bool Descend(const std::vector<Coordinates>& step, double slope, double& value);

  const SquareMap::Disc& Surface;
  const std::vector<unsigned char>& Sides;
  const Watch& Watcher;
  std::vector<Shape> Shapes;
  /// Per triangle: its part in the springs of the edges opposite to its corners.
  std::vector<std::array<double, 3>> Springs;
  std::vector<Coordinates> UV;
  /// Of the springs' balance, for each coordinate.
  std::array<std::unique_ptr<StepSolver<3>>, 2> Solvers;
};
} // namespace LightTransport

#endif
