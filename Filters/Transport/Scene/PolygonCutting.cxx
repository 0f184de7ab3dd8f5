// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/PolygonCutting.h"

#include "Scene/EarClipper.h"
#include "Scene/PolygonMeasures.h"
#include "Shared/Pulse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace LightTransport
{
namespace
{
using Vector = PolygonCutting::Vector;
using Loop = std::vector<int>;
using Edge = std::pair<int, int>;

// The pieces must have the area of the polygon but for this part of it.
constexpr double AreaDifference = 1e-6;

//------------------------------------------------------------------------------
std::vector<EarClipper::Vector> Project(const std::vector<Vector>& corners, const Vector& normal)
{
  const Vector u = normal.unitOrthogonal();
  const Vector v = normal.cross(u);
  std::vector<EarClipper::Vector> points;
  for (const Vector& corner : corners)
  {
    const Vector place = corner - corners[0];
    points.emplace_back(place.dot(u), place.dot(v));
  }
  return points;
}

//------------------------------------------------------------------------------
/// Joins pieces across their diagonals where that leaves them convex: first where it leaves most
/// of an angle to join more.
class PieceJoiner
{
public:
  explicit PieceJoiner(const EarClipper& clipper) : Clipper(clipper), Pieces(clipper.GetTriangles())
  {
    for (std::size_t piece = 0; piece < this->Pieces.size(); ++piece)
    {
      this->Enter(piece);
    }
  }

  std::vector<Loop> Join()
  {
    for (const Edge& diagonal : this->SortDiagonals())
    {
      Pulse::Beat();
      this->JoinAcross(diagonal);
    }
    std::vector<Loop> joined;
    std::copy_if(this->Pieces.begin(), this->Pieces.end(), std::back_inserter(joined),
      [](const Loop& piece) { return !piece.empty(); });
    return joined;
  }

private:
  void Enter(std::size_t piece)
  {
    const Loop& loop = this->Pieces[piece];
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      this->Owners[{ loop[k], loop[(k + 1) % loop.size()] }] = piece;
    }
  }

  std::vector<Edge> SortDiagonals() const
  {
    std::vector<std::pair<double, Edge>> diagonals;
    for (const auto& owner : this->Owners)
    {
      const Edge& edge = owner.first;
      const auto other = this->Owners.find({ edge.second, edge.first });
      if (edge.first < edge.second && other != this->Owners.end())
      {
        const auto getAngle = [&](int corner)
        { return this->GetAngle(owner.second, corner) + this->GetAngle(other->second, corner); };
        diagonals.emplace_back(std::max(getAngle(edge.first), getAngle(edge.second)), edge);
      }
    }
    std::sort(diagonals.begin(), diagonals.end());
    std::vector<Edge> sorted;
    std::transform(diagonals.begin(), diagonals.end(), std::back_inserter(sorted),
      [](const std::pair<double, Edge>& diagonal) { return diagonal.second; });
    return sorted;
  }

  /// Of a triangle.
  double GetAngle(std::size_t piece, int corner) const
  {
    const Loop& loop = this->Pieces[piece];
    const auto at = std::find(loop.begin(), loop.end(), corner) - loop.begin();
    return this->Clipper.GetAngle(loop[(at + 2) % 3], corner, loop[(at + 1) % 3]);
  }

  void JoinAcross(const Edge& diagonal)
  {
    const std::size_t one = this->Owners.at(diagonal);
    const std::size_t other = this->Owners.at({ diagonal.second, diagonal.first });
    // From behind the diagonal all around to its beginning: the shared corners at both ends.
    Loop a = this->Pieces[one];
    Loop b = this->Pieces[other];
    std::rotate(a.begin(), std::find(a.begin(), a.end(), diagonal.second), a.end());
    std::rotate(b.begin(), std::find(b.begin(), b.end(), diagonal.first), b.end());
    if (this->Clipper.IsConvex(a[a.size() - 2], diagonal.first, b[1]) &&
      this->Clipper.IsConvex(b[b.size() - 2], diagonal.second, a[1]))
    {
      a.insert(a.end(), b.begin() + 1, b.end() - 1);
      std::rotate(a.begin(), std::min_element(a.begin(), a.end()), a.end());
      this->Pieces[one] = a;
      this->Pieces[other].clear();
      this->Enter(one);
    }
  }

  const EarClipper& Clipper;
  std::vector<Loop> Pieces;
  std::map<Edge, std::size_t> Owners; // of directed edges
};

//------------------------------------------------------------------------------
// Parts of a convex piece, as few as may be with no more corners than they may have.
void Divide(const Loop& piece, std::size_t mostCorners, std::vector<Loop>& pieces)
{
  const std::size_t triangles = piece.size() - 2;
  const std::size_t parts = (triangles + mostCorners - 3) / (mostCorners - 2);
  if (parts <= 1)
  {
    pieces.push_back(piece);
    return;
  }
  const auto cut = static_cast<std::ptrdiff_t>(triangles * (parts / 2) / parts + 1);
  Divide(Loop(piece.begin(), piece.begin() + cut + 1), mostCorners, pieces);
  Loop rest(piece.begin() + cut, piece.end());
  rest.insert(rest.begin(), piece.front());
  Divide(rest, mostCorners, pieces);
}

//------------------------------------------------------------------------------
std::vector<Loop> DivideAll(const std::vector<Loop>& pieces, int mostCorners)
{
  std::vector<Loop> parts;
  for (const Loop& piece : pieces)
  {
    Divide(piece, static_cast<std::size_t>(mostCorners), parts);
  }
  return parts;
}

//------------------------------------------------------------------------------
Loop MakeLoop(int count)
{
  Loop loop(count);
  std::iota(loop.begin(), loop.end(), 0);
  return loop;
}

//------------------------------------------------------------------------------
// Leaves out pieces without area. Whether the others are the whole.
bool CheckPieces(const std::vector<Vector>& corners, const PolygonMeasures& whole, double rounding,
  PolygonCutting::Pieces& pieces)
{
  double area = 0.0;
  const bool isWarped = pieces.Is == PolygonCutting::Shape::Warped;
  const auto isNothing = [&](const Loop& loop)
  {
    std::vector<Vector> places;
    for (const int corner : loop)
    {
      places.push_back(corners[corner]);
    }
    const PolygonMeasures measures(places.data(), static_cast<int>(places.size()),
      isWarped ? nullptr : &whole.Normal);
    area += measures.Area * measures.Normal.dot(whole.Normal);
    return !measures.HasArea(rounding);
  };
  pieces.Corners.erase(std::remove_if(pieces.Corners.begin(), pieces.Corners.end(), isNothing),
    pieces.Corners.end());
  const double lost = rounding * whole.Radius * static_cast<double>(corners.size());
  return std::abs(area - whole.Area) <= AreaDifference * whole.Area + lost;
}
} // namespace

//------------------------------------------------------------------------------
PolygonCutting::Pieces PolygonCutting::Cut(const std::vector<Vector>& corners, int mostCorners,
  double rounding)
{
  Pieces pieces;
  const int count = static_cast<int>(corners.size());
  if (count < 3)
  {
    return pieces;
  }
  const PolygonMeasures whole(corners.data(), count);
  if (!whole.HasArea(rounding))
  {
    return pieces;
  }
  pieces.Normal = whole.Normal;
  const bool isPlane = whole.IsPlane();
  if (isPlane && whole.IsConvex())
  {
    pieces.Is = count <= mostCorners ? Shape::Whole : Shape::Cut;
    pieces.Corners = DivideAll({ MakeLoop(count) }, mostCorners);
    return pieces;
  }
  pieces.Is = isPlane ? Shape::Cut : Shape::Warped;
  EarClipper clipper(Project(corners, whole.Normal), rounding);
  const bool isClipped = clipper.Clip();
  pieces.Corners =
    isPlane ? DivideAll(PieceJoiner(clipper).Join(), mostCorners) : clipper.GetTriangles();
  if (!isClipped || !CheckPieces(corners, whole, rounding, pieces))
  {
    pieces.Is = Shape::Crossing;
    pieces.Corners.clear();
  }
  return pieces;
}
} // namespace LightTransport
