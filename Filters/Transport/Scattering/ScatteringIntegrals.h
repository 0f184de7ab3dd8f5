// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Diffuse reflectance profiles of three bands, integrated over pairs of triangles. The profiles
 * change over a fraction of a millimetre near by and over centimetres far away, and triangles may
 * be much smaller or much larger than either; some go like 1/r at the centre. So:
 *
 * - a triangle with itself: exact, by the moments of the profile. A triangle and its copy displaced
 * by r in direction theta overlap in a similar triangle, of area A (1 - r gamma(theta))^2, which
 * leaves one integral, over theta;
 * - two triangles: products of symmetric rules with 1, 3 and 6 points, compared with each other;
 * where the largest is not enough the larger triangle is cut in four;
 * - two with a long edge in common (EdgeNeighbours), and two wide ones in parallel planes
 * (ParallelTriangles): exact along the radius;
 * - two in one plane, near a peak of 1/r (CoplanarTriangles): along their edges.
 *
 * All values are divided by the profiles' totals, so that one tolerance serves all bands.
 */
#ifndef ScatteringIntegrals_h
#define ScatteringIntegrals_h

#include "Scattering/ProfileMoments.h"
#include "Scattering/RadialTable.h"
#include "Scattering/ScatteringProfile.h"
#include "Shared/GaussLegendre.h"
#include "vtkDeviceLinkRefiner.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace LightTransport
{
class ScatteringIntegrals
{
public:
  static constexpr int NumberOfBands = RadialTable::NumberOfBands;
  using Vector = Eigen::Vector3d;
  /// One value per band; the fourth is padding and stays 0.
  using Bands = Eigen::Array4d;

  struct Triangle
  {
    Triangle() = default;
    Triangle(const Vector& a, const Vector& b, const Vector& c);

    Vector Corners[3];
    Vector Centroid;
    double Area;
    /// Of a sphere around the centroid that holds the triangle.
    double Radius;
    /// Mean squared distance from the centroid.
    double Moment;
    /// The points of the rule with three.
    Vector Points[3];
  };

  struct Result
  {
    Bands Value = Bands::Zero();
    /// Estimate of the error of the worst band.
    double Error = 0.0;
  };

  /**
   * `profiles` has one profile per band and must outlive this, `maximumDistance` is the longest
   * distance that will be asked for. Of each integral an error of `relativeTolerance` times its
   * value is allowed.
   */
  ScatteringIntegrals(const ScatteringProfiles& profiles, double maximumDistance,
    double relativeTolerance);

  /// Largest of all bands' R_d(distance) / total: an upper bound, as profiles fall with distance.
  double GetBound(double distance) const;

  /// Upper bound of what an area can give back of its own light, over the total; at most 1.
  double GetLargestShare(double area) const;

  /// The profiles at a distance.
  Bands GetValue(double squaredDistance) const
  {
    return this->Evaluate(squaredDistance).cast<double>();
  }
  /// And their derivative by the squared distance.
  Bands GetValue(double squaredDistance, Bands& derivative) const
  {
    const RadialTable::Place place = this->Table.Find(squaredDistance);
    derivative = this->Table.GetDerivative(place).cast<double>();
    return this->Table.Evaluate(place).cast<double>();
  }
  /// Whether any of them goes like 1/r at the centre.
  bool AreSingular() const { return this->Singular; }
  /// By how much their logarithms change per mm, at most, far out.
  const Bands& GetDecays() const { return this->Decays; }
  /// The table behind GetValue, for a device.
  void Describe(vtkDeviceLinkRefiner::ProfileTable& table) const;

  /// Add the integral over both triangles; an error of `tolerance` is allowed as well.
  void AddPair(const Triangle& a, const Triangle& b, double tolerance, Result& result) const;

  /// Add the integral over twice the same triangle, which must have an area.
  void AddSelf(const Triangle& triangle, Result& result) const;

private:
  using Lane = RadialTable::Lane;

  /// What the error of a part of an integral may be: Absolute + Relative v + sqrt(Shared v), v its
  /// value.
  struct Goal
  {
    double Absolute = 0.0;
    double Relative = 0.0;
    Bands Shared = Bands::Zero();
  };

  struct Sum
  {
    Bands Value = Bands::Zero();
    double SquaredError = 0.0;
  };

  Lane Evaluate(double squaredDistance) const { return this->Table.Evaluate(squaredDistance); }
  Bands GetSlopes(double squaredDistance) const
  {
    Bands slopes = this->SlopesOfSource / (squaredDistance + this->SquaredScales).sqrt();
    if (this->Singular)
    {
      slopes += this->SlopesOfCentre / std::sqrt(squaredDistance + this->SquaredCore);
    }
    return slopes + this->Decays;
  }
  Bands IntegrateProduct(const Vector* a, const float* weightsA, int countA, const Vector* b,
    const float* weightsB, int countB) const;
  bool TryRules(const Triangle& a, const Triangle& b, const Goal& goal, bool last, Sum& sum) const;
  void AddParts(const Triangle& a, const Triangle& b, const Goal& goal, int depth, Sum& sum) const;
  /// Whether two corners are the same.
  static bool HaveEdge(const Triangle& a, const Triangle& b);
  /// For what cannot be cut at a bounded price; false for all else.
  bool AddWidePair(const Triangle& a, const Triangle& b, double tolerance, Sum& sum) const;
  bool AddCoplanarPair(const Triangle& a, const Triangle& b, double tolerance, Sum& sum) const;
  static void RefineRule(const std::function<Bands(const GaussLegendre&)>& integrate,
    double relativeTolerance, double tolerance, Sum& sum);
  void Tabulate(double maximumDistance);
  double EvaluateExactly(int band, double squaredDistance) const;
  double IntegratePotential(int band, double begin, double end) const;

  const ScatteringProfiles& Profiles;
  double InverseTotals[NumberOfBands];
  double RelativeTolerance;
  /// Smallest scale of all profiles.
  double Scale = 0.0;
  /// Within its root the tables do not change: the scale, or little of it for singular profiles.
  double SquaredCore = 0.0;
  bool Singular = false;
  ///@{ Per band; the padding is flat.
  Bands SquaredScales = Bands::Constant(std::numeric_limits<double>::infinity());
  Bands Decays = Bands::Zero();
  Bands SlopesOfSource = Bands::Zero();
  Bands SlopesOfCentre = Bands::Zero();
  ///@}
  RadialTable Table;
  RadialTable Potentials; ///< whose Laplacians in the plane the profiles are
  ProfileMoments Moments;
};
} // namespace LightTransport

#endif
