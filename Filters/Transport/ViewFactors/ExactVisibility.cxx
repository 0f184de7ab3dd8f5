// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ExactVisibility.h"

#include "ViewFactors/PairIntegrals.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
using Vector = Polygon::Vector;

// Simpson's rule.
constexpr double Nodes[] = { 0.0, 0.5, 1.0 };
constexpr double Weights[] = { 1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0 };
// At an edge that two polygons share there is nothing to cut planes through, and beside a wall
// rounding decides on which side of it a place is: the rim is looked from a little further inside.
constexpr double LeastInset = 1e-9;
constexpr double InsetRoundings = 8.0;
constexpr double LargestInset = 1e-3;
// Shadows that have met parts after which no piece is cut any more: some ten milliseconds.
constexpr double MaximumWork = 1e5;
// How much of what a piece may be off by a cut leaves to each half, however little it has changed:
// the points of two rules may agree by luck.
constexpr double LeastLeft = 1.0 / 24.0;

//------------------------------------------------------------------------------
void CopyCorners(const Polygon& from, Polygon& to)
{
  std::copy_n(from.Corners.begin(), from.Count, to.Corners.begin());
  to.Count = from.Count;
}

//------------------------------------------------------------------------------
// What of a polygon is on the inner side of a plane through a point. More corners than there is
// room for come only of shadows on shadows that hardly differ: the last of them count for nothing.
void CutAtPlane(const Polygon& polygon, const Vector& point, const Vector& inward, Polygon& kept)
{
  constexpr int most = Polygon::MaximumCorners + 2;
  kept.Count = 0;
  double from = (polygon.Corners[0] - point).dot(inward);
  for (int corner = 0; corner < polygon.Count; ++corner)
  {
    const Vector& a = polygon.Corners[corner];
    const Vector& b = polygon.Corners[(corner + 1) % polygon.Count];
    const double to = (b - point).dot(inward);
    if (from >= 0.0 && kept.Count < most)
    {
      kept.Corners[kept.Count++] = a;
    }
    if (from * to < 0.0 && kept.Count < most)
    {
      kept.Corners[kept.Count++] = a + from / (from - to) * (b - a);
    }
    from = to;
  }
}
} // namespace

//------------------------------------------------------------------------------
void ExactVisibility::Set(const Polygon& a, const Polygon& b, double open, double rounding)
{
  this->Open = open;
  const bool swap = a.GetArea() > b.GetArea();
  this->Outer = swap ? b : a;
  this->Inner = swap ? a : b;
  this->Occluders.clear();
  this->Inset =
    std::min(std::max(InsetRoundings * rounding / std::sqrt(this->Outer.GetArea()), LeastInset),
      LargestInset);
}

//------------------------------------------------------------------------------
ExactVisibility::Estimate ExactVisibility::Integrate(double tolerance)
{
  this->Work = 0.0;
  this->AddPieces();
  const auto sum = [this](auto&& get)
  {
    return std::accumulate(this->Pieces.begin(), this->Pieces.end(), 0.0,
      [&](double total, const Piece& piece) { return total + get(piece); });
  };
  const auto getError = [](const Piece& piece) { return piece.GetError(); };
  while (this->Work < MaximumWork && sum(getError) > tolerance)
  {
    this->CutWorst();
  }
  return { sum([](const Piece& piece) { return piece.Value; }), sum(getError) };
}

//------------------------------------------------------------------------------
// Those of the polygon's fan, the last of which may be a triangle.
void ExactVisibility::AddPieces()
{
  this->Pieces.clear();
  this->Quadrilaterals.clear();
  const double pieces = std::ceil(0.5 * (this->Outer.Count - 2));
  for (int corner = 1; corner + 1 < this->Outer.Count; corner += 2)
  {
    Quadrilateral whole;
    whole.Corners[0] = this->Outer.Corners[0];
    for (int k = 0; k < 3; ++k)
    {
      whole.Corners[k + 1] = this->Outer.Corners[std::min(corner + k, this->Outer.Count - 1)];
    }
    Piece piece{ static_cast<int>(this->Quadrilaterals.size()), { 0.0, 0.0 }, { 1.0, 1.0 }, {}, 0.0,
      {} };
    this->Quadrilaterals.push_back(whole);
    for (int line = 0; line < Points; ++line)
    {
      this->LookAlong(piece, 0, line);
    }
    piece.Value = this->IntegrateViews(piece);
    // Nothing is known yet: what is visible is between nothing and all.
    piece.Errors[0] = piece.Errors[1] = this->Open / pieces;
    this->Pieces.push_back(piece);
  }
}

//------------------------------------------------------------------------------
Vector ExactVisibility::Quadrilateral::GetPlace(double s, double t) const
{
  return (1.0 - t) * ((1.0 - s) * this->Corners[0] + s * this->Corners[1]) +
    t * ((1.0 - s) * this->Corners[3] + s * this->Corners[2]);
}

//------------------------------------------------------------------------------
double ExactVisibility::Quadrilateral::GetDensity(double s, double t) const
{
  const Vector u = this->Corners[1] - this->Corners[0];
  const Vector v = this->Corners[3] - this->Corners[0];
  const Vector twist = this->Corners[2] - this->Corners[1] - v;
  return (u + t * twist).cross(v + s * twist).norm();
}

//------------------------------------------------------------------------------
double ExactVisibility::Piece::GetNode(int direction, int line) const
{
  return this->Begin[direction] + Nodes[line] * (this->End[direction] - this->Begin[direction]);
}

//------------------------------------------------------------------------------
// The views of places on one of the lines across a direction.
void ExactVisibility::LookAlong(Piece& piece, int direction, int line)
{
  const auto getInside = [this](double place)
  { return std::min(std::max(place, this->Inset), 1.0 - this->Inset); };
  for (int k = 0; k < Points; ++k)
  {
    const int i = direction == 0 ? line : k;
    const int j = direction == 0 ? k : line;
    piece.Views[i][j] = this->GetView(this->Quadrilaterals[piece.Whole].GetPlace(
      getInside(piece.GetNode(0, i)), getInside(piece.GetNode(1, j))));
  }
}

//------------------------------------------------------------------------------
double ExactVisibility::IntegrateViews(const Piece& piece) const
{
  double sum = 0.0;
  for (int i = 0; i < Points; ++i)
  {
    for (int j = 0; j < Points; ++j)
    {
      const double density =
        this->Quadrilaterals[piece.Whole].GetDensity(piece.GetNode(0, i), piece.GetNode(1, j));
      sum += Weights[i] * Weights[j] * density * piece.Views[i][j];
    }
  }
  return sum * (piece.End[0] - piece.Begin[0]) * (piece.End[1] - piece.Begin[1]);
}

//------------------------------------------------------------------------------
// How much the value of a piece changes by a cut is an estimate of what its error was: its halves
// are better than that. They have two of the three lines of their places already.
void ExactVisibility::CutWorst()
{
  std::pop_heap(this->Pieces.begin(), this->Pieces.end());
  const Piece whole = this->Pieces.back();
  this->Pieces.pop_back();
  const int direction = whole.Errors[1] > whole.Errors[0] ? 1 : 0;
  Piece halves[2] = { whole, whole };
  halves[0].End[direction] = halves[1].Begin[direction] = whole.GetNode(direction, 1);
  double change = -whole.Value;
  for (int half = 0; half < 2; ++half)
  {
    for (int k = 0; k < Points; ++k)
    {
      const auto getView = [ direction, k ](auto& piece, int line) -> auto&
      {
        return direction == 0 ? piece.Views[line][k] : piece.Views[k][line];
      };
      getView(halves[half], 0) = getView(whole, half);
      getView(halves[half], 2) = getView(whole, half + 1);
    }
    this->LookAlong(halves[half], direction, 1);
    halves[half].Value = this->IntegrateViews(halves[half]);
    change += halves[half].Value;
  }
  for (Piece& half : halves)
  {
    half.Errors[direction] = std::max(0.5 * std::abs(change), LeastLeft * whole.Errors[direction]);
    half.Errors[1 - direction] = 0.5 * whole.Errors[1 - direction];
    this->Pieces.push_back(half);
    std::push_heap(this->Pieces.begin(), this->Pieces.end());
  }
}

//------------------------------------------------------------------------------
double ExactVisibility::GetView(const Vector& point)
{
  this->Parts.Count = 0;
  this->Parts.Add(this->Inner);
  for (const Polygon& occluder : this->Occluders)
  {
    this->TakeShadow(occluder, point);
  }
  double view = 0.0;
  for (std::size_t part = 0; part < this->Parts.Count; ++part)
  {
    view += PairIntegrals::GetPointFactor(this->Parts.Polygons[part], point, this->Outer.Normal);
  }
  return view;
}

//------------------------------------------------------------------------------
// A shadow is bounded by the planes through the point and the occluder's edges.
void ExactVisibility::TakeShadow(const Polygon& occluder, const Vector& point)
{
  const double height = occluder.Normal.dot(occluder.Corners[0] - point);
  if (height == 0.0 || this->Parts.Count == 0)
  {
    return; // seen edge on, or nothing is left
  }
  this->Sides.clear();
  for (int corner = 0; corner < occluder.Count; ++corner)
  {
    const Vector across = (occluder.Corners[corner] - point)
                            .cross(occluder.Corners[(corner + 1) % occluder.Count] - point);
    this->Sides.push_back(height > 0.0 ? across : Vector(-across));
  }
  this->Left.Count = 0;
  for (std::size_t part = 0; part < this->Parts.Count; ++part)
  {
    this->Split(this->Parts.Polygons[part], point);
  }
  std::swap(this->Parts, this->Left);
}

//------------------------------------------------------------------------------
// Adds what the shadow leaves: the part as it is, where it does not meet it.
void ExactVisibility::Split(const Polygon& part, const Vector& point)
{
  this->Work += 1.0;
  const auto isBeyond = [&](const Vector& side)
  {
    return std::all_of(part.Corners.begin(), part.Corners.begin() + part.Count,
      [&](const Vector& corner) { return (corner - point).dot(side) <= 0.0; });
  };
  if (std::any_of(this->Sides.begin(), this->Sides.end(), isBeyond))
  {
    this->Left.Add(part);
    return;
  }
  const std::size_t before = this->Left.Count;
  Polygon rest, cut;
  CopyCorners(part, rest);
  for (const Vector& side : this->Sides)
  {
    CutAtPlane(rest, point, -side, cut);
    if (cut.Count > 2)
    {
      this->Left.Add(cut);
    }
    CutAtPlane(rest, point, side, cut);
    if (cut.Count < 3)
    {
      this->Left.Count = before;
      this->Left.Add(part);
      return;
    }
    CopyCorners(cut, rest);
  }
}

//------------------------------------------------------------------------------
void ExactVisibility::PartList::Add(const Polygon& part)
{
  if (this->Count == this->Polygons.size())
  {
    this->Polygons.emplace_back();
  }
  CopyCorners(part, this->Polygons[this->Count++]);
}
} // namespace LightTransport
