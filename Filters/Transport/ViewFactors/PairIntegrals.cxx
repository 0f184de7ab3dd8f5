// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PairIntegrals.h"

#include "ViewFactors/QuadratureKernels.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
using PairIntegrals::Estimate;
using Vector = Polygon::Vector;

// Bisections of an edge: enough to resolve the logarithm at a shared corner to rounding.
constexpr int MaximumDepth = 24;
// The halves of a part may each have this much of its tolerance: not half, since as a rule only one
// of them holds the singularity. Down one path these sum to 1 / (1 - DepthFactor).
constexpr double DepthFactor = 0.7;
// Triangles that an integral over points may take.
constexpr int MaximumTriangles = 1000;
// Relative error of a double integral over two edges by rounding, lengths being of order one.
constexpr double Rounding = 4e-16;

struct Edge
{
  Vector Origin;
  Vector End;
  Vector Axis;
  double Length;
};

//------------------------------------------------------------------------------
// The double integral over two edges: a Gauss-Kronrod rule along one, in parts, and the closed form
// along the other.
//
// How far the difference of two rules is off is a matter of luck close to a singularity, so parts
// are cut by bounds known beforehand. As a function of complex s the integrand is singular where
// |x(s) - y|^2 = 0 for an end y of the inner edge, and where x(s) passes through the inside of the
// inner edge. Over a part of half length h the rule, exact for degree 22, is off by at most
//
//   SingularConstant h^2,  and by  AnalyticConstant h min(h, L) rho^-22 / (rho - 1)
//
// where the ellipse with the part's ends as foci and half-axes that sum to rho h goes through the
// nearest singularity (Trefethen, Approximation Theory and Approximation Practice, theorem 8.2).
// The constants are one and a half times the largest seen for 200,000 random edges of 0.01 to 100
// half lengths, meeting the part, nearly (gaps down to 1e-6, angles down to 1e-4) or not.
class EdgePair
{
public:
  EdgePair(const Edge& outer, const Edge& inner)
  {
    const Vector offset = outer.Origin - inner.Origin;
    this->Segments.Along[0] = offset.dot(inner.Axis);
    this->Segments.Along[1] = outer.Axis.dot(inner.Axis);
    // Not |offset|^2 - along^2, whose rounding would set points on the line next to it.
    const Vector across = offset.cross(inner.Axis);
    const Vector slope = outer.Axis.cross(inner.Axis);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Segments.Across[axis][0] = across[axis];
      this->Segments.Across[axis][1] = slope[axis];
    }
    this->Segments.Length = inner.Length;
    this->AddEnd(outer, inner.Origin);
    this->AddEnd(outer, inner.End);
    this->AddCrossing(outer, across, slope);
  }

  Estimate Integrate(double begin, double end, double tolerance, int depth = 0) const
  {
    const double error = this->GetBound(begin, end);
    if (error <= tolerance || depth == MaximumDepth)
    {
      return { QuadratureKernels::IntegrateKronrod(this->Segments, begin, end), error };
    }
    const double center = 0.5 * (begin + end);
    const double part = DepthFactor * tolerance;
    const Estimate first = this->Integrate(begin, center, part, depth + 1);
    const Estimate second = this->Integrate(center, end, part, depth + 1);
    return { first.Value + second.Value, first.Error + second.Error };
  }

private:
  double GetBound(double begin, double end) const
  {
    const double half = 0.5 * (end - begin);
    const double singular = SingularConstant * half * half;
    double sum = std::numeric_limits<double>::max();
    for (int point = 0; point < this->NumberOfPoints; ++point)
    {
      const double squared = this->Imaginary[point] * this->Imaginary[point];
      const double fromBegin = this->Real[point] - begin;
      const double fromEnd = this->Real[point] - end;
      sum = std::min(sum,
        std::sqrt(fromBegin * fromBegin + squared) + std::sqrt(fromEnd * fromEnd + squared));
    }
    const double axis = std::max(1.0, 0.5 * sum / half);
    const double rho = axis + std::sqrt(axis * axis - 1.0);
    const double rho2 = rho * rho;
    const double rho4 = rho2 * rho2;
    const double rho8 = rho4 * rho4;
    const double rho22 = rho8 * rho8 * rho4 * rho2;
    const double analytic = AnalyticConstant * half * std::min(half, this->Segments.Length);
    return singular * rho22 * (rho - 1.0) > analytic ? analytic / (rho22 * (rho - 1.0)) : singular;
  }

  void AddEnd(const Edge& outer, const Vector& end)
  {
    const Vector offset = end - outer.Origin;
    this->AddPoint(offset.dot(outer.Axis), offset.cross(outer.Axis).norm());
  }

  // Where the distance from the inner edge's line is zero: across + s slope = 0, s complex.
  void AddCrossing(const Edge& outer, const Vector& across, const Vector& slope)
  {
    const double squared = slope.squaredNorm();
    if (squared < 1e-30)
    {
      return;
    }
    const double real = -across.dot(slope) / squared;
    const double imaginary = across.cross(slope).norm() / squared;
    const double along = this->Segments.Along[0] + real * this->Segments.Along[1];
    const double reach = std::abs(imaginary * this->Segments.Along[1]);
    if (along >= -reach && along <= this->Segments.Length + reach && real > -outer.Length &&
      real < 2.0 * outer.Length)
    {
      this->AddPoint(real, imaginary);
    }
  }

  void AddPoint(double real, double imaginary)
  {
    this->Real[this->NumberOfPoints] = real;
    this->Imaginary[this->NumberOfPoints] = imaginary;
    ++this->NumberOfPoints;
  }

  static constexpr double SingularConstant = 0.034;
  static constexpr double AnalyticConstant = 0.016;

  QuadratureKernels::Segments Segments;
  // Singularities in the upper half of the plane of s.
  int NumberOfPoints = 0;
  double Real[3];
  double Imaginary[3];
};

//------------------------------------------------------------------------------
// The double integrals over pairs of edges that share a corner, which are singular there. With both
// edges from that corner r(s, t) is homogeneous, div((s, t) ln r) = 2 ln r + 1, so that the double
// integral over [0, a] x [0, b] is half of a * (integral over one edge as seen from the end of the
// other) + b * (the other way round) - a b. An edge with itself is a pair of this kind, too.
class CornerPairs
{
public:
  /// Returns false where the edges share no corner.
  bool Add(const Edge& a, const Edge& b, double cosine)
  {
    const bool atStartOfA = a.Origin == b.Origin || a.Origin == b.End;
    const bool atEndOfA = a.End == b.Origin || a.End == b.End;
    if (!atStartOfA && !atEndOfA)
    {
      return false;
    }
    const Vector& corner = atStartOfA ? a.Origin : a.End;
    this->AddTerm(atStartOfA ? a.End : a.Origin, b, cosine * a.Length);
    this->AddTerm(corner == b.Origin ? b.End : b.Origin, a, cosine * b.Length);
    this->Sum -= 0.5 * cosine * a.Length * b.Length;
    return true;
  }

  double GetSum()
  {
    this->Flush();
    return this->Sum;
  }

private:
  static constexpr int Most = 2 * QuadratureKernels::Lanes;

  void AddTerm(const Vector& x, const Edge& edge, double factor)
  {
    if (this->Count == Most)
    {
      this->Flush();
    }
    const Vector offset = x - edge.Origin;
    this->Along[this->Count] = offset.dot(edge.Axis);
    this->Squared[this->Count] = offset.cross(edge.Axis).squaredNorm();
    this->Lengths[this->Count] = edge.Length;
    this->Factors[this->Count] = 0.5 * factor;
    ++this->Count;
  }

  void Flush()
  {
    double results[Most];
    QuadratureKernels::IntegrateLogarithms(this->Along, this->Squared, this->Lengths, this->Count,
      results);
    for (int term = 0; term < this->Count; ++term)
    {
      this->Sum += this->Factors[term] * results[term];
    }
    this->Count = 0;
  }

  double Along[Most];
  double Squared[Most];
  double Lengths[Most];
  double Factors[Most];
  int Count = 0;
  double Sum = 0.0;
};

//------------------------------------------------------------------------------
int MakeEdges(const Polygon& polygon, const Vector& origin, double scale, Edge* edges)
{
  int count = 0;
  for (int corner = 0; corner < polygon.Count; ++corner)
  {
    const Vector begin = (polygon.Corners[corner] - origin) / scale;
    const Vector end = (polygon.Corners[(corner + 1) % polygon.Count] - origin) / scale;
    const double length = (end - begin).norm();
    if (length > 0.0)
    {
      edges[count++] = { begin, end, (end - begin) / length, length };
    }
  }
  return count;
}

//------------------------------------------------------------------------------
// The integral over one polygon of the part of its light that falls on the other, which is exact at
// each point (Lambert 1760): a rule on triangles that are cut into four where it has not settled.
class PointIntegral
{
public:
  PointIntegral(const Polygon& outer, const Polygon& inner) : Outer(outer), Inner(inner)
  {
    // Points of a small polygon would lose digits far from zero.
    Move(this->Outer, outer.Corners[0]);
    Move(this->Inner, outer.Corners[0]);
  }

  Estimate Integrate(double tolerance) const
  {
    Estimate total;
    int budget = MaximumTriangles;
    Polygon triangle = this->Outer;
    triangle.Count = 3;
    for (int corner = 1; corner + 1 < this->Outer.Count; ++corner)
    {
      triangle.Corners[1] = this->Outer.Corners[corner];
      triangle.Corners[2] = this->Outer.Corners[corner + 1];
      const Estimate part =
        this->Refine(triangle, this->IntegrateTriangle(triangle), tolerance, 0, budget);
      total.Value += part.Value;
      total.Error += part.Error;
    }
    // Angles come to some roundings of 1.
    total.Error += 4.0 * Rounding * this->Outer.GetArea();
    return total;
  }

private:
  double IntegrateTriangle(const Polygon& triangle) const
  {
    constexpr int rule = QuadratureRules::NumberOfRules - 1;
    Vector points[QuadratureRules::MaximumTrianglePoints];
    double weights[QuadratureRules::MaximumTrianglePoints];
    QuadratureRules::Make(triangle, rule, points, weights);
    double sum = 0.0;
    for (int point = 0; point < QuadratureRules::GetNumberOfPoints(rule); ++point)
    {
      sum += weights[point] *
        PairIntegrals::GetPointFactor(this->Inner, points[point], this->Outer.Normal);
    }
    return sum;
  }

  Estimate Refine(const Polygon& triangle, double whole, double tolerance, int depth,
    int& budget) const
  {
    Polygon parts[4];
    double values[4];
    double sum = 0.0;
    for (int part = 0; part < 4; ++part)
    {
      parts[part] = GetQuarter(triangle, part);
      values[part] = this->IntegrateTriangle(parts[part]);
      sum += values[part];
    }
    budget -= 4;
    const double error = std::abs(sum - whole);
    if (error <= tolerance || depth == MaximumDepth || budget <= 0)
    {
      return { sum, error };
    }
    Estimate total;
    for (int part = 0; part < 4; ++part)
    {
      const Estimate refined =
        this->Refine(parts[part], values[part], 0.5 * tolerance, depth + 1, budget);
      total.Value += refined.Value;
      total.Error += refined.Error;
    }
    return total;
  }

  // Three at the corners and one in the middle.
  static Polygon GetQuarter(const Polygon& triangle, int part)
  {
    Polygon quarter;
    quarter.Count = 3;
    quarter.Normal = triangle.Normal;
    for (int corner = 0; corner < 3; ++corner)
    {
      const int partner = part == 3 ? (corner + 1) % 3 : part;
      quarter.Corners[corner] = 0.5 * (triangle.Corners[corner] + triangle.Corners[partner]);
    }
    return quarter;
  }

  static void Move(Polygon& polygon, const Vector& origin)
  {
    for (int corner = 0; corner < polygon.Count; ++corner)
    {
      polygon.Corners[corner] -= origin;
    }
  }

  Polygon Outer;
  Polygon Inner;
};
} // namespace

namespace PairIntegrals
{
//------------------------------------------------------------------------------
double GetPointFactor(const Polygon& polygon, const Vector& point, const Vector& normal)
{
  double sum = 0.0;
  Vector from = polygon.Corners[polygon.Count - 1] - point;
  for (int corner = 0; corner < polygon.Count; ++corner)
  {
    const Vector to = polygon.Corners[corner] - point;
    const Vector across = from.cross(to);
    const double sine = across.norm();
    if (sine > 0.0)
    {
      sum -= std::atan2(sine, from.dot(to)) * across.dot(normal) / sine;
    }
    from = to;
  }
  return std::max(0.0, sum / (2.0 * vtkMath::Pi()));
}

//------------------------------------------------------------------------------
double IntegrateRules(const QuadratureRules::Points& a, const Vector& normalA,
  const QuadratureRules::Points& b, const Vector& normalB)
{
  double total = 0.0;
  for (int i = 0; i < a.Count; ++i)
  {
    double sum = 0.0;
    for (int j = 0; j < b.Count; ++j)
    {
      const Vector ray = b.Places[j] - a.Places[i];
      const double cosines = std::max(0.0, ray.dot(normalA)) * std::max(0.0, -ray.dot(normalB));
      const double squared = ray.squaredNorm();
      sum += b.Weights[j] * cosines / (squared * squared);
    }
    total += a.Weights[i] * sum;
  }
  return total / vtkMath::Pi();
}

//------------------------------------------------------------------------------
Estimate IntegrateContours(const Polygon& a, const Polygon& b, double tolerance)
{
  // In units of the pair's own size ln r is of order one, and a change of unit changes nothing.
  const Vector middleA = a.GetMiddle();
  double scale = (b.GetMiddle() - middleA).norm();
  for (int corner = 0; corner < a.Count; ++corner)
  {
    scale = std::max(scale, (a.Corners[corner] - middleA).norm());
  }
  std::array<Edge, Polygon::MaximumCorners + 2> edgesA;
  std::array<Edge, Polygon::MaximumCorners + 2> edgesB;
  const int countA = MakeEdges(a, middleA, scale, edgesA.data());
  const int countB = MakeEdges(b, middleA, scale, edgesB.data());
  const double share = 2.0 * vtkMath::Pi() * tolerance / (scale * scale * countA * countB);
  CornerPairs corners;
  Estimate total;
  for (int i = 0; i < countA; ++i)
  {
    for (int j = 0; j < countB; ++j)
    {
      const double cosine = edgesA[i].Axis.dot(edgesB[j].Axis);
      if (std::abs(cosine) < 1e-15)
      {
        continue;
      }
      if (corners.Add(edgesA[i], edgesB[j], cosine))
      {
        total.Error += Rounding * std::abs(cosine) * edgesA[i].Length * edgesB[j].Length;
        continue;
      }
      // The adaptive rule runs along the shorter edge: the closed form takes the longer one.
      const bool swap = edgesA[i].Length > edgesB[j].Length;
      const Edge& outer = swap ? edgesB[j] : edgesA[i];
      const Edge& inner = swap ? edgesA[i] : edgesB[j];
      // Rounding alone leaves this much: asking for less would cut the edge for ever.
      const double rounding = Rounding * outer.Length * inner.Length;
      const Estimate part =
        EdgePair(outer, inner)
          .Integrate(0.0, outer.Length, std::max((1.0 - DepthFactor) * share, rounding));
      total.Value += cosine * part.Value;
      total.Error += std::abs(cosine) * (part.Error + rounding);
    }
  }
  total.Value += corners.GetSum();
  const double unit = scale * scale / (2.0 * vtkMath::Pi());
  return { std::max(0.0, unit * total.Value), unit * total.Error };
}

//------------------------------------------------------------------------------
Estimate IntegratePoints(const Polygon& a, const Polygon& b, double tolerance)
{
  const bool swap = a.GetArea() > b.GetArea();
  const PointIntegral integral(swap ? b : a, swap ? a : b);
  return integral.Integrate(tolerance);
}

//------------------------------------------------------------------------------
Estimate Integrate(const Polygon& a, const Polygon& b, double tolerance)
{
  const Estimate contours = IntegrateContours(a, b, tolerance);
  if (contours.Error <= tolerance)
  {
    return contours;
  }
  const Estimate points = IntegratePoints(a, b, tolerance);
  return points.Error < contours.Error ? points : contours;
}
} // namespace PairIntegrals
} // namespace LightTransport
