// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringIntegrals.h"

#include "Scattering/CoplanarTriangles.h"
#include "Scattering/EdgeNeighbours.h"
#include "Scattering/ParallelTriangles.h"
#include "Shared/GaussLegendre.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <iterator>
#include <limits>

namespace LightTransport
{
namespace
{
using Vector = ScatteringIntegrals::Vector;
using Triangle = ScatteringIntegrals::Triangle;

/// Cuts after which the rules have the last word: sides are 2^-6 of what they were. Patches wider
/// than some 60 mean free paths then get a worse error estimate, but never endless work.
constexpr int MaximumDepth = 12;
/// Towards a peak of 1/r, of pairs folded along an edge, which nothing else takes: they are little
/// but that. (Of any pair near another it would be endless work where polygons cross.)
constexpr int MaximumDepthAtPeak = 16;

/// A common edge, or an extent across, of more than this many of the profile's smallest scales
/// would be cut into as many parts, and more: exact along the radius is cheaper.
constexpr double WidePair = 16.0;

/// Of the rough value of a pair of triangles that has to be cut.
constexpr double RoughTolerance = 0.1;
/// Parts of pairs are left alone when their sum is below this much of the tolerance.
constexpr double NegligiblePart = 0.01;

///@{ In a triangle with itself: how much of the logarithmic range of distances one rule takes, and
/// its points.
constexpr double WidestPart = 1.5;
constexpr int PointsOfPart = 12;
///@}

/// Of the relative tolerance: what leaves a plane by less of its size is in it.
constexpr double Flatness = 0.1;
/// Of the rule between two values of a potential.
constexpr int PointsOfPotential = 2;

/// Of the smaller of a singular profile's scale and the longest distance: closer than this all is
/// one. What that changes of an integral is less than this, of all that is given back.
constexpr double CoreSize = 1e-6;
/// Of the core's square: the table's value at 0.
constexpr double CentreOfCore = 0.01;

///@{ The logarithm of a profile changes by about ScatteringProfile::GetNearbySlope + decay per
/// length, and there is a margin. The distance of the points from the
/// centroids on that scale is the spread s of a pair. Each rule's error is estimated from its value
/// v and its difference from the rule before; these factors bound 99 of 100 errors of random pairs.
constexpr double SlopeMargin = 3.5 / 3.0;
constexpr double ErrorOfOne = 0.15;               // s^2 v1
constexpr double ErrorOfThree[] = { 0.1, 0.01 };  // s |v3 - v1| and s^4 v3
constexpr double ErrorOfSix[] = { 0.05, 0.0005 }; // s |v6 - v3| and s^6 v6
/// Of s^2; beyond it no rule is good.
constexpr double WidestSpread2 = 4.0;
///@}

constexpr float WeightsOfThree[] = { 1.0f / 3.0f, 1.0f / 3.0f, 1.0f / 3.0f };
/// D. A. Dunavant, 1985: degree 4.
constexpr double PlacesOfSix[] = { 0.445948490915965, 0.091576213509771 };
constexpr float WeightsOfSix[] = { 0.223381589678011f, 0.223381589678011f, 0.223381589678011f,
  0.109951743655322f, 0.109951743655322f, 0.109951743655322f };

//------------------------------------------------------------------------------
void PlaceSix(const Triangle& triangle, Vector* points)
{
  for (int k = 0; k < 6; ++k)
  {
    const double place = PlacesOfSix[k / 3];
    // Corner with weight 1 - 2 place, the two others with place.
    points[k] = 3.0 * place * triangle.Centroid + (1.0 - 3.0 * place) * triangle.Corners[k % 3];
  }
}
} // namespace

//------------------------------------------------------------------------------
ScatteringIntegrals::Triangle::Triangle(const Vector& a, const Vector& b, const Vector& c)
  : Corners{ a, b, c }, Centroid((a + b + c) / 3.0), Area(0.5 * (b - a).cross(c - a).norm())
{
  double largest = 0.0;
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const double squared = (this->Corners[k] - this->Centroid).squaredNorm();
    largest = std::max(largest, squared);
    sum += squared;
    this->Points[k] = 0.5 * (this->Centroid + this->Corners[k]);
  }
  this->Radius = std::sqrt(largest);
  this->Moment = sum / 12.0;
}

//------------------------------------------------------------------------------
ScatteringIntegrals::ScatteringIntegrals(const ScatteringProfiles& profiles, double maximumDistance,
  double relativeTolerance)
  : Profiles(profiles), RelativeTolerance(relativeTolerance)
{
  this->Scale = profiles[0]->GetSmallestScale();
  double core = std::numeric_limits<double>::infinity();
  for (int band = 0; band < NumberOfBands; ++band)
  {
    const ScatteringProfile& profile = *profiles[band];
    const double total = profile.GetTotal();
    const double scale = profile.GetSmallestScale();
    const double slopeOfCentre = profile.IsSingular() ? ScatteringProfile::SlopeOfCentre : 0.0;
    this->InverseTotals[band] = total > 0.0 ? 1.0 / total : 0.0;
    this->SquaredScales[band] = scale * scale;
    this->Decays[band] = profile.GetDecay();
    this->SlopesOfSource[band] = SlopeMargin * (ScatteringProfile::SlopeOfSource - slopeOfCentre);
    this->SlopesOfCentre[band] = SlopeMargin * slopeOfCentre;
    this->Scale = std::min(this->Scale, scale);
    this->Singular = this->Singular || profile.IsSingular();
    core =
      std::min(core, profile.IsSingular() ? CoreSize * std::min(scale, maximumDistance) : scale);
  }
  this->SquaredCore = core * core;
  this->Tabulate(maximumDistance);
}

//------------------------------------------------------------------------------
void ScatteringIntegrals::Tabulate(double maximumDistance)
{
  this->Table = RadialTable(this->SquaredCore, maximumDistance,
    [this](int band, double squared) { return this->EvaluateExactly(band, squared); });
  this->SquaredCore = this->Table.GetSquaredCore();
  Bands potentials = Bands::Zero();
  Bands reached = Bands::Zero();
  this->Potentials = RadialTable(this->SquaredCore, maximumDistance,
    [&](int band, double squared)
    {
      const double radius = std::sqrt(squared);
      potentials[band] += this->IntegratePotential(band, reached[band], radius);
      reached[band] = radius;
      return potentials[band];
    });
  this->Moments = ProfileMoments(this->Profiles, maximumDistance);
}

//------------------------------------------------------------------------------
// What flows through a circle, over its circumference, is the slope.
double ScatteringIntegrals::IntegratePotential(int band, double begin, double end) const
{
  static const GaussLegendre rule(PointsOfPotential);
  double sum = 0.0;
  for (std::size_t k = 0; k < rule.Nodes.size() && end > begin; ++k)
  {
    const double radius = begin + (end - begin) * rule.Nodes[k];
    double moments[3];
    this->Profiles[band]->GetMoments(radius, moments);
    sum += (end - begin) * rule.Weights[k] * moments[0] / radius;
  }
  return this->InverseTotals[band] * sum;
}

//------------------------------------------------------------------------------
void ScatteringIntegrals::Describe(vtkDeviceLinkRefiner::ProfileTable& table) const
{
  const std::vector<RadialTable::Piece>& pieces = this->Table.GetPieces();
  table.SquaredCore = this->Table.GetSquaredCore();
  table.PieceBits = RadialTable::PieceBits;
  table.FirstPiece = this->Table.GetFirstPiece();
  table.IsSingular = this->Singular;
  table.Pieces.resize(pieces.size());
  for (int band = 0; band < NumberOfBands; ++band)
  {
    table.Decays[band] = this->Decays[band];
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    {
      for (int k = 0; k < 3; ++k)
      {
        table.Pieces[piece][k][band] = pieces[piece].Coefficients[k][band];
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Over the total, finite at 0, too.
double ScatteringIntegrals::EvaluateExactly(int band, double squaredDistance) const
{
  const double nearest =
    this->Profiles[band]->IsSingular() ? CentreOfCore * this->SquaredCore : 0.0;
  return this->InverseTotals[band] *
    this->Profiles[band]->Evaluate(std::sqrt(std::max(nearest, squaredDistance)));
}

//------------------------------------------------------------------------------
double ScatteringIntegrals::GetBound(double distance) const
{
  double bound = 0.0;
  for (int band = 0; band < NumberOfBands; ++band)
  {
    bound = std::max(bound,
      this->InverseTotals[band] * this->Profiles[band]->Evaluate(std::max(0.0, distance)));
  }
  return bound;
}

//------------------------------------------------------------------------------
double ScatteringIntegrals::GetLargestShare(double area) const
{
  double share = 0.0;
  for (int band = 0; band < NumberOfBands; ++band)
  {
    const ScatteringProfile& profile = *this->Profiles[band];
    double value = this->InverseTotals[band];
    if (profile.IsSingular())
    {
      // No area has more of the profile than a disc around the centre.
      double moments[3];
      profile.GetMoments(std::sqrt(area / vtkMath::Pi()), moments);
      value *= 2.0 * vtkMath::Pi() * moments[0];
    }
    else
    {
      value *= profile.Evaluate(0.0);
      value *= area;
    }
    share = std::max(share, value);
  }
  return std::min(1.0, share);
}

//------------------------------------------------------------------------------
ScatteringIntegrals::Bands ScatteringIntegrals::IntegrateProduct(const Vector* a,
  const float* weightsA, int countA, const Vector* b, const float* weightsB, int countB) const
{
  Lane sum = Lane::Zero();
  for (int i = 0; i < countA; ++i)
  {
    Lane row = Lane::Zero();
    for (int j = 0; j < countB; ++j)
    {
      row += weightsB[j] * this->Evaluate((a[i] - b[j]).squaredNorm());
    }
    sum += weightsA[i] * row;
  }
  return sum.cast<double>();
}

//------------------------------------------------------------------------------
bool ScatteringIntegrals::TryRules(const Triangle& a, const Triangle& b, const Goal& goal,
  bool last, Sum& sum) const
{
  const double areas = a.Area * b.Area;
  const double distance2 = (a.Centroid - b.Centroid).squaredNorm();
  const Bands spread2 = this->GetSlopes(distance2).square() * (a.Moment + b.Moment);
  const auto accept = [&](const Bands& value, const Bands& error)
  {
    // Where a profile ends in underflow its parabolas may dip below 0.
    const Bands integral = (areas * value).max(0.0);
    const Bands allowed =
      goal.Absolute + goal.Relative * integral + (goal.Shared * integral).sqrt();
    const bool good = last || (areas * error <= allowed).all();
    if (good)
    {
      sum.Value += integral;
      const double worst = areas * error.maxCoeff();
      sum.SquaredError += worst * worst;
    }
    return good;
  };
  const Bands one = this->Evaluate(distance2).cast<double>();
  // A band for which the triangles are too large for any rule may be one for which they are too far
  // apart to matter.
  Bands peak = Bands::Zero();
  const auto wide = (spread2 > WidestSpread2).eval();
  if (!last && wide.any())
  {
    const double nearest = std::max(0.0, std::sqrt(distance2) - a.Radius - b.Radius);
    peak = this->Evaluate(nearest * nearest).cast<double>();
    if ((wide && areas * peak > goal.Absolute).any())
    {
      return false;
    }
  }
  if (!last && accept(one, wide.select(peak, ErrorOfOne * spread2 * one)))
  {
    return true;
  }
  const Bands three =
    this->IntegrateProduct(a.Points, WeightsOfThree, 3, b.Points, WeightsOfThree, 3);
  const Bands spread = spread2.sqrt();
  const Bands errorOfThree =
    ErrorOfThree[0] * spread * (three - one).abs() + ErrorOfThree[1] * spread2.square() * three;
  if (!last && accept(three, wide.select(peak, errorOfThree)))
  {
    return true;
  }
  Vector pointsA[6];
  Vector pointsB[6];
  PlaceSix(a, pointsA);
  PlaceSix(b, pointsB);
  const Bands six = this->IntegrateProduct(pointsA, WeightsOfSix, 6, pointsB, WeightsOfSix, 6);
  const Bands difference = (six - three).abs();
  const Bands error = (ErrorOfSix[0] * spread * difference + ErrorOfSix[1] * spread2.cube() * six)
                        .min(six + difference);
  return accept(six, last ? error : Bands(wide.select(peak, error)));
}

//------------------------------------------------------------------------------
void ScatteringIntegrals::AddParts(const Triangle& a, const Triangle& b, const Goal& goal,
  int depth, Sum& sum) const
{
  if (this->TryRules(a, b, goal, depth == 0, sum))
  {
    return;
  }
  const bool cutFirst = a.Radius >= b.Radius;
  const Triangle& whole = cutFirst ? a : b;
  const Triangle& other = cutFirst ? b : a;
  const Vector& p = whole.Corners[0];
  const Vector& q = whole.Corners[1];
  const Vector& r = whole.Corners[2];
  const Vector pq = 0.5 * (p + q);
  const Vector qr = 0.5 * (q + r);
  const Vector rp = 0.5 * (r + p);
  this->AddParts(Triangle(p, pq, rp), other, goal, depth - 1, sum);
  this->AddParts(Triangle(pq, q, qr), other, goal, depth - 1, sum);
  this->AddParts(Triangle(rp, qr, r), other, goal, depth - 1, sum);
  this->AddParts(Triangle(qr, rp, pq), other, goal, depth - 1, sum);
}

//------------------------------------------------------------------------------
bool ScatteringIntegrals::HaveEdge(const Triangle& a, const Triangle& b)
{
  int common = 0;
  for (const Vector& corner : a.Corners)
  {
    common += static_cast<int>(std::count(std::begin(b.Corners), std::end(b.Corners), corner));
  }
  return common == 2;
}

//------------------------------------------------------------------------------
void ScatteringIntegrals::AddPair(const Triangle& a, const Triangle& b, double tolerance,
  Result& result) const
{
  Goal goal;
  goal.Relative = this->RelativeTolerance;
  goal.Absolute = tolerance;
  Sum sum;
  if (!this->TryRules(a, b, goal, false, sum) && !this->AddWidePair(a, b, tolerance, sum))
  {
    // A rough value first. The errors of the many parts that a fine one takes differ in sign and
    // add up like random numbers: of a total error e, a part with the share s of the value may have
    // e sqrt(s).
    goal.Relative = RoughTolerance;
    goal.Absolute = NegligiblePart * tolerance;
    const int depth = this->Singular && HaveEdge(a, b) ? MaximumDepthAtPeak : MaximumDepth;
    Sum rough;
    this->AddParts(a, b, goal, depth, rough);
    const Bands allowed = this->RelativeTolerance * rough.Value + tolerance;
    goal.Relative = 0.0;
    goal.Shared =
      allowed.square() / rough.Value.max(tolerance).max(std::numeric_limits<double>::min());
    this->AddParts(a, b, goal, depth, sum);
  }
  result.Value += sum.Value;
  result.Error += std::sqrt(sum.SquaredError);
}

//------------------------------------------------------------------------------
bool ScatteringIntegrals::AddWidePair(const Triangle& a, const Triangle& b, double tolerance,
  Sum& sum) const
{
  // What changes like 1/r is wide at any width.
  const double core = std::sqrt(this->SquaredCore);
  const double scale = this->Singular ? this->Scale : core;
  const double wide = WidePair * core;
  // No edge is longer than its triangle's sphere is wide.
  if (2.0 * std::min(a.Radius, b.Radius) < wide)
  {
    return false;
  }
  if (this->AddCoplanarPair(a, b, tolerance, sum))
  {
    return true;
  }
  EdgeNeighbours neighbours;
  ParallelTriangles sheets;
  std::function<Bands(const GaussLegendre&)> integrate;
  if (neighbours.Set(a.Corners, b.Corners) && neighbours.GetSharedLength() >= wide)
  {
    integrate = [&](const GaussLegendre& rule)
    { return neighbours.Integrate(this->Moments, rule); };
  }
  else if (std::min(a.Radius, b.Radius) >= wide && sheets.Set(a.Corners, b.Corners, scale, core) &&
    (!this->Singular || std::min(a.Radius, b.Radius) >= WidePair * sheets.GetScale()))
  {
    integrate = [&](const GaussLegendre& rule)
    {
      return sheets.Integrate([this](double squaredDistance)
        { return Bands(this->Evaluate(squaredDistance).cast<double>()); },
        rule);
    };
  }
  if (!integrate)
  {
    return false;
  }
  RefineRule(integrate, this->RelativeTolerance, tolerance, sum);
  return true;
}

//------------------------------------------------------------------------------
// Of the widest ones little is left of the potentials.
bool ScatteringIntegrals::AddCoplanarPair(const Triangle& a, const Triangle& b, double tolerance,
  Sum& sum) const
{
  CoplanarTriangles plane;
  if (!this->Singular || std::max(a.Radius, b.Radius) > WidePair * this->Scale ||
    !plane.Set(a.Corners, b.Corners, Flatness * this->RelativeTolerance))
  {
    return false;
  }
  const CoplanarTriangles::Sum whole = plane.Integrate([this](double squaredDistance)
    { return Bands(this->Potentials.Evaluate(squaredDistance).cast<double>()); },
    this->RelativeTolerance, tolerance);
  sum.Value += whole.Value;
  sum.SquaredError += whole.SquaredError.maxCoeff();
  return true;
}

//------------------------------------------------------------------------------
// The difference from the rule before is the error.
void ScatteringIntegrals::RefineRule(const std::function<Bands(const GaussLegendre&)>& integrate,
  double relativeTolerance, double tolerance, Sum& sum)
{
  static const GaussLegendre rules[] = { GaussLegendre(3), GaussLegendre(5), GaussLegendre(8),
    GaussLegendre(12), GaussLegendre(18) };
  Bands value = Bands::Zero();
  double error = 0.0;
  for (const GaussLegendre& rule : rules)
  {
    const Bands before = value;
    value = integrate(rule);
    const Bands change = (value - before).abs();
    error = change.maxCoeff();
    if ((change <= relativeTolerance * value + tolerance).all())
    {
      break;
    }
  }
  sum.Value += value;
  sum.SquaredError += error * error;
}

//------------------------------------------------------------------------------
void ScatteringIntegrals::AddSelf(const Triangle& triangle, Result& result) const
{
  // Directions from a corner to the opposite edge, of height h: gamma = 1 / (h cosh t) where the
  // edge is met h sinh(t) from the foot of the height, and the angle changes by dt / cosh t. The
  // three corners together see all directions, up to their opposites, once. In t the integrand is
  // smooth for the thinnest triangle and for any ratio of its size to the profile's.
  static const GaussLegendre rule(PointsOfPart);
  for (int corner = 0; corner < 3; ++corner)
  {
    const Vector& apex = triangle.Corners[corner];
    const Vector& begin = triangle.Corners[(corner + 1) % 3];
    const Vector& end = triangle.Corners[(corner + 2) % 3];
    const double length = (end - begin).norm();
    const Vector axis = (end - begin) / length;
    const double height = 2.0 * triangle.Area / length;
    const double first = std::asinh((begin - apex).dot(axis) / height);
    const double last = std::asinh((end - apex).dot(axis) / height);
    const int parts = static_cast<int>(std::ceil((last - first) / WidestPart));
    const double width = (last - first) / parts;
    for (int part = 0; part < parts; ++part)
    {
      for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
      {
        const double stretch = std::cosh(first + width * (part + rule.Nodes[k]));
        const double reach = height * stretch;
        const double weight = 2.0 * triangle.Area * width * rule.Weights[k] / stretch;
        const ProfileMoments::Means means = this->Moments.GetMeans(reach);
        result.Value += weight * reach *
          (means.Of[0] - 2.0f * means.Of[1] + means.Of[2]).max(0.0f).cast<double>();
      }
    }
  }
}
} // namespace LightTransport
