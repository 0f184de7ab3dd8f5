// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/PieceIntegral.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace LightTransport
{
namespace
{
/// Times a triangle may be quartered because a light is near.
constexpr int MostDepth = 16;
/// Triangles of a patch, after which it has to do.
constexpr std::size_t MostTriangles = 20000;
/// Triangles below this part of the whole may be off by more than their share.
constexpr double LeastShare = 1.0 / 64.0;
/// The better of the two rules is off by at most this part of their difference.
constexpr double Trust = 1.0 / 8.0;
} // namespace

//------------------------------------------------------------------------------
void PieceIntegral::Value::Add(const Value& other, double weight)
{
  this->Incident += weight * other.Incident;
  this->Transmitted += weight * other.Transmitted;
}

//------------------------------------------------------------------------------
PieceIntegral::PieceIntegral(const ShadowClipper& clipper, const Vector& light, double reach,
  Function function)
  : Clipper(clipper), Light(light), Reach(reach), Integrand(std::move(function))
{
}

//------------------------------------------------------------------------------
void PieceIntegral::Add(const ShadowClipper::Piece& piece)
{
  for (std::size_t corner = 1; corner + 1 < piece.size(); ++corner)
  {
    this->AddTriangle(piece[0], piece[corner], piece[corner + 1], 0);
  }
}

//------------------------------------------------------------------------------
void PieceIntegral::AddTriangle(const Place& a, const Place& b, const Place& c, int depth)
{
  const Place middle = (a + b + c) / 3.0;
  const double radius = std::sqrt(std::max(
    { (a - middle).squaredNorm(), (b - middle).squaredNorm(), (c - middle).squaredNorm() }));
  const double distance = (this->Clipper.GetPoint(middle) - this->Light).norm();
  if (radius > this->Reach * distance && depth < MostDepth &&
    this->Triangles.size() < MostTriangles)
  {
    const Place ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    this->AddTriangle(a, ab, ca, depth + 1);
    this->AddTriangle(ab, b, bc, depth + 1);
    this->AddTriangle(ca, bc, c, depth + 1);
    this->AddTriangle(ab, bc, ca, depth + 1);
    return;
  }
  Triangle triangle;
  triangle.Corners[0] = a;
  triangle.Corners[1] = b;
  triangle.Corners[2] = c;
  this->Measure(triangle);
  this->Triangles.push_back(triangle);
}

//------------------------------------------------------------------------------
// Rules of degree 5 (Radon 1948) and 2.
void PieceIntegral::Measure(Triangle& triangle) const
{
  const Place* corners = triangle.Corners;
  triangle.Area = ShadowClipper::GetArea({ corners[0], corners[1], corners[2] });
  const Place middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  const double root = std::sqrt(15.0);
  const auto at = [&](const Place& place)
  { return this->Integrand(this->Clipper.GetPoint(place)); };
  triangle.Integral = Value();
  triangle.Integral.Add(at(middle), triangle.Area * 9.0 / 40.0);
  Value rough;
  for (int corner = 0; corner < 3; ++corner)
  {
    const Place out = corners[corner] - middle;
    triangle.Integral.Add(at(middle + (1.0 + root) / 7.0 * out),
      triangle.Area * (155.0 - root) / 1200.0);
    triangle.Integral.Add(at(middle + (1.0 - root) / 7.0 * out),
      triangle.Area * (155.0 + root) / 1200.0);
    rough.Add(at(middle - 0.5 * out), triangle.Area / 3.0);
  }
  triangle.Doubt = std::abs(triangle.Integral.Incident - rough.Incident);
}

//------------------------------------------------------------------------------
void PieceIntegral::Quarter(const Triangle& triangle, std::vector<Triangle>& parts) const
{
  const Place* corners = triangle.Corners;
  const Place ab = 0.5 * (corners[0] + corners[1]);
  const Place bc = 0.5 * (corners[1] + corners[2]);
  const Place ca = 0.5 * (corners[2] + corners[0]);
  const Place quarters[4][3] = { { corners[0], ab, ca }, { ab, corners[1], bc },
    { ca, bc, corners[2] }, { ab, bc, ca } };
  for (const auto& quarter : quarters)
  {
    Triangle part;
    std::copy_n(quarter, 3, part.Corners);
    this->Measure(part);
    parts.push_back(part);
  }
}

//------------------------------------------------------------------------------
PieceIntegral::Value PieceIntegral::Get(double tolerance, double& error)
{
  double area = 0.0;
  double whole = 0.0;
  for (const Triangle& triangle : this->Triangles)
  {
    area += triangle.Area;
    whole += std::abs(triangle.Integral.Incident);
  }
  Value sum;
  double doubt = 0.0;
  std::vector<Triangle> open = this->Triangles;
  std::size_t measured = open.size();
  while (!open.empty())
  {
    const Triangle triangle = open.back();
    open.pop_back();
    const double share = std::max(triangle.Area / area, LeastShare);
    if (triangle.Doubt > tolerance * share * whole && measured < MostTriangles)
    {
      this->Quarter(triangle, open);
      measured += 4;
      continue;
    }
    sum.Add(triangle.Integral, 1.0);
    doubt += triangle.Doubt;
  }
  error = Trust * doubt;
  return sum;
}
} // namespace LightTransport
