// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/EdgeNeighbours.h"

#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// Of the edge's length: how far from its line another one still is on it.
constexpr double OnLine = 1e-9;
// Of the angle between the triangles. Closer to folded, the integrand has a peak between them.
constexpr double LargestCosine = 0.9;
} // namespace

//------------------------------------------------------------------------------
bool EdgeNeighbours::Set(const Vector a[3], const Vector b[3])
{
  for (int edgeOfA = 0; edgeOfA < 3; ++edgeOfA)
  {
    for (int edgeOfB = 0; edgeOfB < 3; ++edgeOfB)
    {
      if (this->SetEdges(a, edgeOfA, b, edgeOfB))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool EdgeNeighbours::SetEdges(const Vector a[3], int edgeOfA, const Vector b[3], int edgeOfB)
{
  const Vector& origin = a[edgeOfA];
  const Vector edge = a[(edgeOfA + 1) % 3] - origin;
  const double length = edge.norm();
  const Vector axis = edge / length;
  Vector heights[2];
  const Vector* const corners[2] = { a, b };
  const int first[2] = { edgeOfA, edgeOfB };
  for (int side = 0; side < 2; ++side)
  {
    double along[3];
    for (int k = 0; k < 3; ++k)
    {
      const Vector offset = corners[side][(first[side] + k) % 3] - origin;
      along[k] = axis.dot(offset);
      heights[side] = offset - along[k] * axis;
      if (k < 2 && heights[side].norm() > OnLine * length)
      {
        return false;
      }
    }
    const auto ends = std::minmax(along[0], along[1]);
    const double height = heights[side].norm();
    this->Shadows[side] = { ends.first, (along[2] - ends.first) / height, ends.second,
      (along[2] - ends.second) / height };
    heights[side] /= height;
  }
  this->CosineOfAngle = heights[0].dot(heights[1]);
  this->SharedLength = std::min(this->Shadows[0].End, this->Shadows[1].End) -
    std::max(this->Shadows[0].Begin, this->Shadows[1].Begin);
  return this->SharedLength > OnLine * length && this->CosineOfAngle < LargestCosine;
}

//------------------------------------------------------------------------------
// The four lines fall below each other in the order of their slopes.
template <typename Segment>
void EdgeNeighbours::VisitRay(const Vector& direction, const Segment& visit) const
{
  const double s = direction[0];
  const double t = direction[1];
  const double w = direction[2];
  const Shadow& a = this->Shadows[0];
  const Shadow& b = this->Shadows[1];
  const Line ends[2] = { { a.End, a.EndSlope * s }, { b.End, b.EndSlope * t + w } };
  const Line begins[2] = { { a.Begin, a.BeginSlope * s }, { b.Begin, b.BeginSlope * t + w } };
  Line lines[4];
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k)
  {
    const Line& end = ends[k / 2];
    const Line& begin = begins[k % 2];
    lines[k] = { end.Start - begin.Start, end.Slope - begin.Slope };
    const double zero = -lines[k].Start / lines[k].Slope;
    if (lines[k].Slope < 0.0)
    {
      last = std::min(last, zero);
    }
    else if (lines[k].Start <= 0.0)
    {
      first = std::max(first, lines[k].Slope > 0.0 ? zero : last);
    }
  }
  const Line* line = std::min_element(lines, lines + 4,
    [first](const Line& p, const Line& q)
    {
      const double valueOfP = p.At(first);
      const double valueOfQ = q.At(first);
      return valueOfP < valueOfQ || (valueOfP == valueOfQ && p.Slope < q.Slope);
    });
  while (first < last)
  {
    const Line* below = line;
    double next = last;
    for (const Line& other : lines)
    {
      const double crossing = (other.Start - line->Start) / (line->Slope - other.Slope);
      if (other.Slope < line->Slope && crossing >= first && crossing < next)
      {
        next = crossing;
        below = &other;
      }
    }
    visit(first, next, *line);
    first = next;
    line = below;
  }
}

//------------------------------------------------------------------------------
// Where the two begin, and end, alike: between these elevations all is smooth, for edges of the
// same ends.
void EdgeNeighbours::SetParts(double s, double t, double bounds[4]) const
{
  const Shadow& a = this->Shadows[0];
  const Shadow& b = this->Shadows[1];
  const double begins = std::atan(a.BeginSlope * s - b.BeginSlope * t);
  const double ends = std::atan(a.EndSlope * s - b.EndSlope * t);
  bounds[0] = -0.5 * vtkMath::Pi();
  bounds[1] = std::min(begins, ends);
  bounds[2] = std::max(begins, ends);
  bounds[3] = 0.5 * vtkMath::Pi();
}

//------------------------------------------------------------------------------
EdgeNeighbours::Bands EdgeNeighbours::Integrate(const ProfileMoments& moments,
  const GaussLegendre& rule) const
{
  const double quarter = 0.5 * vtkMath::Pi();
  Bands sum = Bands::Zero();
  for (std::size_t i = 0; i < rule.Nodes.size(); ++i)
  {
    const double s = std::cos(quarter * rule.Nodes[i]);
    const double t = std::sin(quarter * rule.Nodes[i]);
    double bounds[4];
    this->SetParts(s, t, bounds);
    for (int part = 0; part < 3; ++part)
    {
      const double width = bounds[part + 1] - bounds[part];
      for (std::size_t j = 0; j < rule.Nodes.size(); ++j)
      {
        const double elevation = bounds[part] + width * rule.Nodes[j];
        const double across = std::cos(elevation);
        sum += quarter * rule.Weights[i] * width * rule.Weights[j] * across *
          this->IntegrateRay(moments, { across * s, across * t, std::sin(elevation) });
      }
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
EdgeNeighbours::Bands EdgeNeighbours::IntegrateRay(const ProfileMoments& moments,
  const Vector& direction) const
{
  const double stretch = std::sqrt(1.0 - 2.0 * direction[0] * direction[1] * this->CosineOfAngle);
  Bands sum = Bands::Zero();
  Bands atBegin[2] = { Bands::Zero(), Bands::Zero() };
  const auto reach = [&](double radius, Bands at[2])
  {
    const ProfileMoments::Means means = moments.GetMeans(radius);
    at[0] = radius * radius * means.Of[1].cast<double>();
    at[1] = radius * radius * radius * means.Of[2].cast<double>();
  };
  bool isFirst = true;
  this->VisitRay(direction,
    [&](double begin, double end, const Line& line)
    {
      if (isFirst && begin > 0.0)
      {
        reach(stretch * begin, atBegin);
      }
      isFirst = false;
      Bands atEnd[2];
      reach(stretch * end, atEnd);
      sum += line.Start * (atEnd[0] - atBegin[0]) + line.Slope / stretch * (atEnd[1] - atBegin[1]);
      std::copy(atEnd, atEnd + 2, atBegin);
    });
  return sum / (stretch * stretch * stretch);
}
} // namespace LightTransport
