// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/EarClipper.h"

#include "Shared/Pulse.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace LightTransport
{
namespace
{
// Rounding of arithmetic, relative to lengths.
constexpr double Arithmetic = 1e-14;
// Borders that cross by less than this part of the longer edge touch.
constexpr double CrossingTolerance = 1e-6;
} // namespace

//------------------------------------------------------------------------------
EarClipper::EarClipper(std::vector<Vector> corners, double rounding)
  : Corners(std::move(corners)), Rounding(rounding), Count(static_cast<int>(Corners.size()))
{
  this->Next.resize(this->Count);
  this->Previous.resize(this->Count);
  std::iota(this->Next.begin(), this->Next.end(), 1);
  std::iota(this->Previous.begin(), this->Previous.end(), -1);
  this->Next.back() = 0;
  this->Previous.front() = this->Count - 1;
}

//------------------------------------------------------------------------------
double EarClipper::GetTurn(int a, int b, int c) const
{
  const Vector u = this->Corners[b] - this->Corners[a];
  const Vector v = this->Corners[c] - this->Corners[a];
  return u.x() * v.y() - u.y() * v.x();
}

//------------------------------------------------------------------------------
double EarClipper::GetFlatness(int a, int b, int c) const
{
  const double longest =
    std::max({ this->GetLength({ a, b }), this->GetLength({ b, c }), this->GetLength({ c, a }) });
  return longest * (this->Rounding + Arithmetic * longest);
}

//------------------------------------------------------------------------------
double EarClipper::GetAngle(int a, int b, int c) const
{
  const Vector u = this->Corners[a] - this->Corners[b];
  const Vector v = this->Corners[c] - this->Corners[b];
  return std::atan2(std::abs(u.x() * v.y() - u.y() * v.x()), u.dot(v));
}

//------------------------------------------------------------------------------
bool EarClipper::IsConvex(int a, int b, int c) const
{
  return this->GetTurn(a, b, c) >= -this->GetFlatness(a, b, c);
}

//------------------------------------------------------------------------------
// Whether a corner is inside of a triangle, or on its rim with an edge that goes inside.
bool EarClipper::Blocks(int corner, int a, int b, int c) const
{
  const std::pair<int, int> rim[] = { { c, a }, { a, b }, { b, c } };
  bool isOn[3];
  for (int k = 0; k < 3; ++k)
  {
    const double turn = this->GetTurn(rim[k].first, rim[k].second, corner);
    const double flat = this->GetFlatness(rim[k].first, rim[k].second, corner);
    if (turn < -flat)
    {
      return false;
    }
    isOn[k] = turn <= flat;
  }
  const auto goesInside = [&](int neighbor)
  {
    for (int k = 0; k < 3; ++k)
    {
      const auto [from, to] = rim[k];
      if (isOn[k] && this->GetTurn(from, to, neighbor) <= this->GetFlatness(from, to, neighbor))
      {
        return false;
      }
    }
    return true;
  };
  return goesInside(this->Previous[corner]) || goesInside(this->Next[corner]);
}

//------------------------------------------------------------------------------
// On the line from a to b, and at neither end.
bool EarClipper::IsBetween(int corner, int a, int b) const
{
  const Vector along = this->Corners[b] - this->Corners[a];
  const Vector place = this->Corners[corner] - this->Corners[a];
  const double margin = this->GetFlatness(a, b, corner);
  return std::abs(this->GetTurn(a, b, corner)) <= margin && along.dot(place) > margin &&
    along.dot(along - place) > margin;
}

//------------------------------------------------------------------------------
EarClipper::Kind EarClipper::Classify(int corner) const
{
  const int a = this->Previous[corner];
  const int c = this->Next[corner];
  const double turn = this->GetTurn(a, corner, c);
  if (std::abs(turn) <= this->GetFlatness(a, corner, c))
  {
    const Vector arriving = this->Corners[corner] - this->Corners[a];
    return arriving.dot(this->Corners[c] - this->Corners[corner]) > 0.0 ? Kind::Flat : Kind::Spike;
  }
  if (turn < 0.0)
  {
    return Kind::Reflex;
  }
  const double margin = this->GetFlatness(a, corner, c) / this->GetLength({ a, c });
  const Vector lower = this->Corners[a].cwiseMin(this->Corners[corner]).cwiseMin(this->Corners[c]);
  const Vector upper = this->Corners[a].cwiseMax(this->Corners[corner]).cwiseMax(this->Corners[c]);
  Kind kind = Kind::Ear;
  for (int other = this->Next[c]; other != a; other = this->Next[other])
  {
    const Vector& place = this->Corners[other];
    if ((place.array() < lower.array() - margin).any() ||
      (place.array() > upper.array() + margin).any())
    {
      continue;
    }
    if (this->Blocks(other, a, corner, c))
    {
      return Kind::Blocked;
    }
    kind = this->IsBetween(other, c, a) ? Kind::Touching : kind;
  }
  return kind;
}

//------------------------------------------------------------------------------
void EarClipper::ClassifyAll()
{
  this->Kinds.resize(this->Corners.size());
  int corner = this->First;
  for (int k = 0; k < this->Count; ++k, corner = this->Next[corner])
  {
    Pulse::Beat();
    this->Kinds[corner] = this->Classify(corner);
  }
}

//------------------------------------------------------------------------------
// Spikes go first, then the ear that is cut off by the shortest line. What is flat comes later, so
// that lines may end there, and lines through other corners last; -1 where there is none of them.
int EarClipper::FindNext() const
{
  int ear = -1;
  int flat = -1;
  int touching = -1;
  double shortest = std::numeric_limits<double>::max();
  int corner = this->First;
  for (int k = 0; k < this->Count; ++k)
  {
    corner = this->Next[corner];
    const double length = this->GetLength({ this->Previous[corner], this->Next[corner] });
    switch (this->Kinds[corner])
    {
      case Kind::Spike:
        return corner;
      case Kind::Ear:
        ear = length < shortest ? corner : ear;
        shortest = std::min(shortest, length);
        break;
      case Kind::Flat:
        flat = corner;
        break;
      case Kind::Touching:
        touching = corner;
        break;
      default:
        break;
    }
  }
  return ear >= 0 ? ear : (flat >= 0 ? flat : touching);
}

//------------------------------------------------------------------------------
void EarClipper::Remove(int corner)
{
  const int before = this->Previous[corner];
  const int after = this->Next[corner];
  // There is nothing to cover in a spike.
  if (this->Kinds[corner] != Kind::Spike)
  {
    this->Triangles.push_back({ before, corner, after });
  }
  this->Next[before] = after;
  this->Previous[after] = before;
  this->First = before;
  --this->Count;
  this->Kinds[before] = this->Classify(before);
  this->Kinds[after] = this->Classify(after);
}

//------------------------------------------------------------------------------
bool EarClipper::Clip()
{
  if (this->CrossesItself())
  {
    return false;
  }
  this->ClassifyAll();
  while (this->Count > 2)
  {
    Pulse::Beat();
    int corner = this->FindNext();
    if (corner < 0)
    {
      this->ClassifyAll();
      corner = this->FindNext();
    }
    if (corner < 0)
    {
      return false;
    }
    this->Remove(corner);
  }
  return true;
}

//------------------------------------------------------------------------------
// Edges in the order of where they begin along an axis: few come near each other.
bool EarClipper::CrossesItself() const
{
  const int count = static_cast<int>(this->Corners.size());
  const auto getX = [this, count](int corner) { return this->Corners[corner % count].x(); };
  const auto getBegin = [&](int edge) { return std::min(getX(edge), getX(edge + 1)); };
  std::vector<int> edges(count);
  std::iota(edges.begin(), edges.end(), 0);
  std::sort(edges.begin(), edges.end(), [&](int a, int b) { return getBegin(a) < getBegin(b); });
  for (int a = 0; a < count; ++a)
  {
    Pulse::Beat();
    const double end = std::max(getX(edges[a]), getX(edges[a] + 1));
    for (int b = a + 1; b < count && getBegin(edges[b]) < end; ++b)
    {
      if (this->Cross(edges[a], edges[b]))
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool EarClipper::Cross(int a, int b) const
{
  const int count = static_cast<int>(this->Corners.size());
  const int ends[2][2] = { { a, (a + 1) % count }, { b, (b + 1) % count } };
  const double tolerance = this->Rounding +
    CrossingTolerance *
      std::max(this->GetLength({ ends[0][0], ends[0][1] }),
        this->GetLength({ ends[1][0], ends[1][1] }));
  for (int k = 0; k < 2; ++k)
  {
    const int* edge = ends[k];
    const double least = tolerance * this->GetLength({ edge[0], edge[1] });
    const double one = this->GetTurn(edge[0], edge[1], ends[1 - k][0]);
    const double other = this->GetTurn(edge[0], edge[1], ends[1 - k][1]);
    const bool isAcross = (one > least && other < -least) || (one < -least && other > least);
    if (!isAcross)
    {
      return false;
    }
  }
  return true;
}
} // namespace LightTransport
