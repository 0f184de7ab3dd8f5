// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Two triangles in one plane: a profile of distance integrated over both, by Gauss's theorem,
 * twice. With a potential whose Laplacian is the profile it is the sum over pairs of edges of what
 * the potential is between their points, times the product of the edges' ways. A profile that goes
 * like 1/r has a potential that goes like r: whether the two overlap, touch or lie apart makes no
 * difference, and no more than a kink is left where edges meet.
 */
#ifndef CoplanarTriangles_h
#define CoplanarTriangles_h

#include "Shared/GaussLegendre.h"

#include <Eigen/Core>

#include <cstddef>

namespace LightTransport
{
class CoplanarTriangles
{
public:
  using Vector = Eigen::Vector3d;
  using Bands = Eigen::Array4d;

  struct Sum
  {
    Bands Value = Bands::Zero();
    Bands SquaredError = Bands::Zero();
  };

  /// False where corners leave the other one's plane by more than `flatness` of the smaller size.
  bool Set(const Vector a[3], const Vector b[3], double flatness);

  /// `potential` takes a squared distance, and may be in single precision. The error may be about
  /// `tolerance` and `relative` of the integral; what is less than rounding cannot be had.
  template <typename Potential>
  Sum Integrate(const Potential& potential, double relative, double tolerance) const;

private:
  static constexpr int NumberOfPairs = 9;
  static constexpr int PointsOfRough = 3;
  static constexpr int PointsOfFine = 5;
  /// Halvings of both edges of a pair, at most.
  static constexpr int MaximumDepth = 12;
  /// Of the difference between both rules, what the better one is off by at a kink.
  static constexpr double ErrorOfFine = 0.3;
  /// Of the sum of what the pairs of edges are for themselves.
  static constexpr double Rounding = 3e-7;

  struct Segment
  {
    Vector Begin;
    Vector Way;
    Segment GetHalf(int half) const
    {
      return { this->Begin + 0.5 * half * this->Way, 0.5 * this->Way };
    }
  };
  struct Pair
  {
    Segment First;
    Segment Second;
    double Weight; ///< of the potential's mean over both
  };

  Pair GetPair(int number) const;
  template <typename Potential>
  static Bands GetMean(const Potential& potential, const Pair& pair, const GaussLegendre& rule);
  template <typename Potential>
  static Sum Measure(const Potential& potential, const Pair& pair);
  template <typename Potential>
  static void Refine(const Potential& potential, const Pair& pair, const Sum& whole,
    const Bands& allowed, int depth, Sum& sum);

  Segment Edges[2][3];
  double Sign = 1.0; ///< of the product of the two normals
};

//------------------------------------------------------------------------------
template <typename Potential>
CoplanarTriangles::Bands CoplanarTriangles::GetMean(const Potential& potential, const Pair& pair,
  const GaussLegendre& rule)
{
  Bands mean = Bands::Zero();
  for (std::size_t i = 0; i < rule.Nodes.size(); ++i)
  {
    const Vector offset = pair.First.Begin + rule.Nodes[i] * pair.First.Way - pair.Second.Begin;
    Bands row = Bands::Zero();
    for (std::size_t j = 0; j < rule.Nodes.size(); ++j)
    {
      row += rule.Weights[j] * potential((offset - rule.Nodes[j] * pair.Second.Way).squaredNorm());
    }
    mean += rule.Weights[i] * row;
  }
  return mean;
}

//------------------------------------------------------------------------------
template <typename Potential>
CoplanarTriangles::Sum CoplanarTriangles::Measure(const Potential& potential, const Pair& pair)
{
  static const GaussLegendre rough(PointsOfRough);
  static const GaussLegendre fine(PointsOfFine);
  Sum sum;
  sum.Value = pair.Weight * GetMean(potential, pair, fine);
  const Bands change = sum.Value - pair.Weight * GetMean(potential, pair, rough);
  sum.SquaredError = (ErrorOfFine * change).square();
  return sum;
}

//------------------------------------------------------------------------------
// Errors of many parts differ in sign and add up like random numbers: `allowed` is of squares.
template <typename Potential>
void CoplanarTriangles::Refine(const Potential& potential, const Pair& pair, const Sum& whole,
  const Bands& allowed, int depth, Sum& sum)
{
  if (depth == 0 || (whole.SquaredError <= allowed).all())
  {
    sum.Value += whole.Value;
    sum.SquaredError += whole.SquaredError;
    return;
  }
  for (int part = 0; part < 4; ++part)
  {
    const Pair finer{ pair.First.GetHalf(part / 2), pair.Second.GetHalf(part % 2),
      0.25 * pair.Weight };
    Refine(potential, finer, Measure(potential, finer), 0.25 * allowed, depth - 1, sum);
  }
}

//------------------------------------------------------------------------------
template <typename Potential>
CoplanarTriangles::Sum CoplanarTriangles::Integrate(const Potential& potential, double relative,
  double tolerance) const
{
  Sum parts[NumberOfPairs];
  Bands rough = Bands::Zero();
  Bands size = Bands::Zero();
  for (int number = 0; number < NumberOfPairs; ++number)
  {
    parts[number] = Measure(potential, this->GetPair(number));
    rough += parts[number].Value;
    size += parts[number].Value.abs();
  }
  const Bands allowed =
    (tolerance + relative * rough.max(0.0) + Rounding * size).square() / NumberOfPairs;
  Sum sum;
  for (int number = 0; number < NumberOfPairs; ++number)
  {
    Refine(potential, this->GetPair(number), parts[number], allowed, MaximumDepth, sum);
  }
  sum.Value = sum.Value.max(0.0);
  return sum;
}
} // namespace LightTransport

#endif
