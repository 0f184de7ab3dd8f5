// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SideJoiner.h"

#include "Common/SoupEdges.h"

#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
using Point = TriangleSoup::Point;

// So many triangles at one edge are no surface: nobody could say how they belong together.
constexpr std::size_t LargestCrowd = 64;
// Angles between triangles that are rounding at worst, in radians.
constexpr double LargestAngleTolerance = 0.05;
constexpr double Arithmetic = 1e-9;
// A triangle that is no higher than this many roundings says nothing about directions.
constexpr double RoundingsOfSliver = 16.0;
} // namespace

//------------------------------------------------------------------------------
SideJoiner::SideJoiner(const TriangleSoup& soup, double rounding)
  : Soup(soup), Rounding(rounding), Partners(3 * soup.Triangles.size(), None),
    Crowded(3 * soup.Triangles.size(), false), Components(soup.Triangles.size())
{
}

//------------------------------------------------------------------------------
void SideJoiner::Join(const std::vector<std::size_t>& places, bool placesArePoints)
{
  struct Use
  {
    SoupEdges::Edge Edge;
    std::size_t Side;
  };
  std::vector<Use> uses;
  uses.reserve(placesArePoints ? this->Partners.size() : 0);
  for (std::size_t side = 0; side < this->Partners.size(); ++side)
  {
    const auto [from, to] = this->GetEnds(side);
    if (this->Partners[side] == None && places[from] != places[to])
    {
      uses.push_back({ SoupEdges::Make(places[from], places[to]), side });
    }
  }
  std::sort(uses.begin(), uses.end(),
    [](const Use& a, const Use& b) { return std::tie(a.Edge, a.Side) < std::tie(b.Edge, b.Side); });
  std::vector<Crowd> crowds;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    while (end < uses.size() && uses[end].Edge == uses[begin].Edge)
    {
      ++end;
    }
    if (end - begin == 2)
    {
      const std::size_t one = uses[begin].Side;
      const std::size_t other = uses[begin + 1].Side;
      const bool isApart =
        placesArePoints ? this->AreTwins(one / 3, other / 3) : this->IsFold(one, other);
      if (!isApart)
      {
        this->JoinPair(one, other);
      }
    }
    else if (end - begin > 2)
    {
      Crowd& crowd = crowds.emplace_back();
      for (std::size_t i = begin; i < end; ++i)
      {
        const std::size_t side = uses[i].Side;
        crowd.push_back({ side, places[this->GetEnds(side)[0]] == uses[i].Edge.first, 0.0 });
      }
    }
  }
  for (const Crowd& crowd : crowds)
  {
    this->JoinCrowd(crowd);
  }
}

//------------------------------------------------------------------------------
void SideJoiner::JoinPair(std::size_t side, std::size_t other)
{
  this->Partners[side] = other;
  this->Partners[other] = side;
  this->Crowded[side] = this->Crowded[other] = false;
  this->Components.Join(side / 3, other / 3);
}

//------------------------------------------------------------------------------
void SideJoiner::Part(std::size_t side)
{
  const std::size_t partner = this->Partners[side];
  for (const std::size_t one : { side, partner })
  {
    if (one != None)
    {
      this->Partners[one] = None;
      this->Crowded[one] = true;
    }
  }
}

//------------------------------------------------------------------------------
void SideJoiner::JoinCrowd(const Crowd& crowd)
{
  if (crowd.size() <= LargestCrowd)
  {
    std::map<std::size_t, Crowd> parts;
    for (const Leaf& leaf : crowd)
    {
      parts[this->FindComponent(leaf.Side / 3)].push_back(leaf);
    }
    for (const auto& part : parts)
    {
      this->Match(part.second);
    }
    Crowd rest;
    std::copy_if(crowd.begin(), crowd.end(), std::back_inserter(rest),
      [this](const Leaf& leaf) { return this->Partners[leaf.Side] == None; });
    this->Match(rest);
  }
  for (const Leaf& leaf : crowd)
  {
    this->Crowded[leaf.Side] = this->Partners[leaf.Side] == None;
  }
}

//------------------------------------------------------------------------------
void SideJoiner::Match(Crowd crowd)
{
  if (crowd.size() < 2)
  {
    return;
  }
  const double tolerance = this->FindAngles(crowd);
  if (!this->MatchAlternating(crowd, tolerance, true) &&
    !this->MatchAlternating(crowd, tolerance, false))
  {
    this->MatchSmooth(crowd);
  }
}

//------------------------------------------------------------------------------
// Sides that go forward have their material below their angle, those that go backward above. Of
// sides at one angle, two solids touch if what ends comes before what begins, two rooms if after.
bool SideJoiner::MatchAlternating(const Crowd& crowd, double tolerance, bool acrossMaterial)
{
  Crowd order = crowd;
  const auto byAngle = [](const Leaf& a, const Leaf& b)
  { return std::tie(a.Angle, a.Side) < std::tie(b.Angle, b.Side); };
  std::sort(order.begin(), order.end(), byAngle);
  const std::size_t size = order.size();
  // Begin behind the widest gap, so that no tie goes over the end.
  std::size_t first = 0;
  double widest = order[0].Angle + 2.0 * vtkMath::Pi() - order[size - 1].Angle;
  for (std::size_t i = 1; i < size; ++i)
  {
    if (order[i].Angle - order[i - 1].Angle > widest)
    {
      widest = order[i].Angle - order[i - 1].Angle;
      first = i;
    }
  }
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(first), order.end());
  for (auto begin = order.begin(), end = begin; begin != order.end(); begin = end)
  {
    for (++end; end != order.end() &&
         std::abs(std::remainder(end->Angle - (end - 1)->Angle, 2.0 * vtkMath::Pi())) <= tolerance;
         ++end)
    {
    }
    std::stable_sort(begin, end,
      [acrossMaterial](const Leaf& a, const Leaf& b)
      { return acrossMaterial ? a.IsForward > b.IsForward : a.IsForward < b.IsForward; });
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    if (order[i].IsForward == order[(i + 1) % size].IsForward)
    {
      return false;
    }
  }
  for (std::size_t i = 0; i < size; ++i)
  {
    const Leaf& next = order[(i + 1) % size];
    if (order[i].IsForward != acrossMaterial && !this->IsFold(order[i].Side, next.Side))
    {
      this->JoinPair(order[i].Side, next.Side);
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void SideJoiner::MatchSmooth(const Crowd& crowd)
{
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < crowd.size(); ++i)
  {
    for (std::size_t j = i + 1; j < crowd.size(); ++j)
    {
      if (crowd[i].IsForward != crowd[j].IsForward && !this->IsFold(crowd[i].Side, crowd[j].Side))
      {
        const double turn = std::remainder(crowd[i].Angle - crowd[j].Angle, 2.0 * vtkMath::Pi());
        pairs.emplace_back(vtkMath::Pi() - std::abs(turn), crowd[i].Side, crowd[j].Side);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [turn, side, other] : pairs)
  {
    if (this->Partners[side] == None && this->Partners[other] == None)
    {
      this->JoinPair(side, other);
    }
  }
}

//------------------------------------------------------------------------------
// Returns below which difference angles are the same.
double SideJoiner::FindAngles(Crowd& crowd) const
{
  Point axis = this->GetAxis(crowd[0].Side);
  if (!crowd[0].IsForward)
  {
    vtkMath::MultiplyScalar(axis.data(), -1.0);
  }
  const Point first = this->GetArm(crowd[0].Side, crowd[0].Side, axis);
  Point across;
  vtkMath::Cross(axis.data(), first.data(), across.data());
  double tolerance = Arithmetic;
  for (Leaf& leaf : crowd)
  {
    const Point arm = this->GetArm(leaf.Side, crowd[0].Side, axis);
    leaf.Angle =
      std::atan2(vtkMath::Dot(across.data(), arm.data()), vtkMath::Dot(first.data(), arm.data()));
    tolerance = std::max(tolerance, 2.0 * this->GetAngleTolerance(arm));
  }
  return std::min(tolerance, LargestAngleTolerance);
}

//------------------------------------------------------------------------------
Point SideJoiner::GetAxis(std::size_t side) const
{
  const auto [from, to] = this->GetEnds(side);
  Point axis;
  vtkMath::Subtract(this->Soup.Points[to].data(), this->Soup.Points[from].data(), axis.data());
  vtkMath::Normalize(axis.data());
  return axis;
}

//------------------------------------------------------------------------------
// From the line of a side, along `axis`, to the third corner of the triangle of another.
Point SideJoiner::GetArm(std::size_t leaf, std::size_t hinge, const Point& axis) const
{
  const Point& origin = this->Soup.Points[this->GetEnds(hinge)[0]];
  const std::size_t third = this->Soup.Triangles[leaf / 3][(leaf + 2) % 3];
  Point arm;
  vtkMath::Subtract(this->Soup.Points[third].data(), origin.data(), arm.data());
  const double along = vtkMath::Dot(arm.data(), axis.data());
  for (int i = 0; i < 3; ++i)
  {
    arm[i] -= along * axis[i];
  }
  return arm;
}

//------------------------------------------------------------------------------
double SideJoiner::GetAngleTolerance(const Point& arm) const
{
  return std::min(Arithmetic + 2.0 * this->Rounding / vtkMath::Norm(arm.data()),
    LargestAngleTolerance);
}

//------------------------------------------------------------------------------
bool SideJoiner::IsFold(std::size_t side, std::size_t other) const
{
  const Point axis = this->GetAxis(side);
  const Point arm = this->GetArm(side, side, axis);
  const Point otherArm = this->GetArm(other, side, axis);
  const double lengths[] = { vtkMath::Norm(arm.data()), vtkMath::Norm(otherArm.data()) };
  if (std::min(lengths[0], lengths[1]) <= RoundingsOfSliver * this->Rounding)
  {
    return this->AreTwins(side / 3, other / 3);
  }
  Point cross;
  vtkMath::Cross(arm.data(), otherArm.data(), cross.data());
  return vtkMath::Dot(arm.data(), otherArm.data()) > 0.0 &&
    vtkMath::Norm(cross.data()) <=
    lengths[0] * lengths[1] * (this->GetAngleTolerance(arm) + this->GetAngleTolerance(otherArm));
}

//------------------------------------------------------------------------------
// Whether two triangles have the same three corners.
bool SideJoiner::AreTwins(std::size_t triangle, std::size_t other) const
{
  std::array<Point, 3> corners[2];
  for (int i = 0; i < 3; ++i)
  {
    corners[0][i] = this->Soup.Points[this->Soup.Triangles[triangle][i]];
    corners[1][i] = this->Soup.Points[this->Soup.Triangles[other][i]];
  }
  std::sort(corners[0].begin(), corners[0].end());
  std::sort(corners[1].begin(), corners[1].end());
  return corners[0] == corners[1];
}
} // namespace LightTransport
