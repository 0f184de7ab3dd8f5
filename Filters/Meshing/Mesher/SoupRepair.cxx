// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/SoupRepair.h"

#include "Common/SoupEdges.h"
#include "Mesher/LooseTriangles.h"
#include "Mesher/NearSides.h"
#include "Shared/DisjointSets.h"

#include "vtkMath.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
using Triangle = TriangleSoup::Triangle;

constexpr std::size_t None = std::numeric_limits<std::size_t>::max();
// Two points that coordinates put in one place are at most so many roundings apart, and some.
constexpr double RoundingsPerWeld = 4.0;
// Noise goes on where the next point is nearer than so many times its size, and is none above this
// part of the sides.
constexpr double NextGap = 4.0;
constexpr double LargestNoise = 0.02;
constexpr int MostWidenings = 30;
// Splitting a side may bring others near; real surfaces need two rounds.
constexpr int MostRounds = 10;

//------------------------------------------------------------------------------
// The places of a triangle in the order that it has them, beginning with the lowest.
Triangle GetOrdered(const Triangle& triangle, const std::vector<std::size_t>& places)
{
  Triangle ordered{ places[triangle[0]], places[triangle[1]], places[triangle[2]] };
  std::rotate(ordered.begin(), std::min_element(ordered.begin(), ordered.end()), ordered.end());
  return ordered;
}

//------------------------------------------------------------------------------
// How many triangles each one hangs together with by the points of the soup.
class PointComponents
{
public:
  explicit PointComponents(const TriangleSoup& soup)
    : Soup(soup), Points(soup.Points.size()), Sizes(soup.Points.size(), 0)
  {
    for (const Triangle& triangle : soup.Triangles)
    {
      this->Points.Join(triangle[0], triangle[1]);
      this->Points.Join(triangle[0], triangle[2]);
    }
    for (const Triangle& triangle : soup.Triangles)
    {
      ++this->Sizes[this->Points.Find(triangle[0])];
    }
  }
  std::size_t Find(std::size_t triangle)
  {
    return this->Points.Find(this->Soup.Triangles[triangle][0]);
  }
  std::size_t GetSize(std::size_t triangle) { return this->Sizes[this->Find(triangle)]; }

private:
  const TriangleSoup& Soup;
  DisjointSets Points;
  std::vector<std::size_t> Sizes;
};

//------------------------------------------------------------------------------
std::vector<std::size_t> CountUp(std::size_t size)
{
  std::vector<std::size_t> numbers(size);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}
} // namespace

//------------------------------------------------------------------------------
SoupRepair::SoupRepair(TriangleSoup& soup, double weldTolerance, RepairCounts& counts)
  : Soup(soup), Counts(counts),
    Tolerance(weldTolerance > 0.0 ? weldTolerance : RoundingsPerWeld * soup.Rounding),
    IsDefaultTolerance(!(weldTolerance > 0.0))
{
}

//------------------------------------------------------------------------------
vtkIdType SoupRepair::DropDegenerateTriangles()
{
  std::vector<bool> kept(this->Soup.Triangles.size());
  std::transform(this->Soup.Triangles.begin(), this->Soup.Triangles.end(), kept.begin(),
    [this](const Triangle& triangle) { return !this->Soup.IsDegenerate(triangle); });
  const auto dropped = static_cast<vtkIdType>(std::count(kept.begin(), kept.end(), false));
  this->Counts.NumberOfDroppedTriangles += dropped;
  this->Keep(kept);
  return dropped;
}

//------------------------------------------------------------------------------
void SoupRepair::DropCopies()
{
  const std::vector<std::size_t> places = this->Soup.FindPlaces();
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  sorted.reserve(this->Soup.Triangles.size());
  for (const Triangle& triangle : this->Soup.Triangles)
  {
    sorted.emplace_back(GetOrdered(triangle, places), sorted.size());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::pair<std::size_t, std::size_t>> copies;
  for (std::size_t i = 1, first = 0; i < sorted.size(); ++i)
  {
    first = sorted[i].first == sorted[i - 1].first ? first : i;
    if (first < i)
    {
      copies.emplace_back(sorted[i].second, sorted[first].second);
    }
  }
  if (copies.empty())
  {
    return;
  }
  PointComponents components(this->Soup);
  std::map<std::size_t, std::size_t> copiesOfComponents;
  for (const auto& copy : copies)
  {
    ++copiesOfComponents[components.Find(copy.first)];
  }
  std::vector<bool> kept(this->Soup.Triangles.size(), true);
  for (const auto& [copy, first] : copies)
  {
    const std::size_t component = components.Find(copy);
    kept[copy] = component != components.Find(first) &&
      copiesOfComponents[component] < components.GetSize(copy);
    for (std::size_t i = 0; i < 3 && !kept[copy]; ++i)
    {
      this->Soup.SplitPoints[this->Soup.Triangles[copy][i]] = true;
      this->Soup.SplitPoints[this->Soup.Triangles[first][i]] = true;
    }
  }
  this->Counts.NumberOfDroppedTriangles += std::count(kept.begin(), kept.end(), false);
  this->Keep(kept);
}

//------------------------------------------------------------------------------
Outcome SoupRepair::Join(const Monitor& monitor)
{
  this->Exact = this->Soup.FindPlaces();
  this->Places = this->Exact;
  this->StartJoining();
  if (!monitor.Report(0.2))
  {
    return Outcome::Aborted();
  }
  if (Outcome widened = this->WidenTolerance(monitor.GetStage(0.2, 0.4)); !widened)
  {
    return widened;
  }
  if (Outcome joined = this->JoinNearSides(monitor.GetStage(0.4, 0.8)); !joined)
  {
    return joined;
  }
  this->DropStrayTwins();
  this->NoteLooseTriangles();
  std::vector<bool> reversed = this->FindReversed();
  this->TurnComponentsToMajority(reversed);
  this->MakePoints(reversed);
  for (std::size_t i = 0; i < reversed.size(); ++i)
  {
    if (reversed[i])
    {
      std::swap(this->Soup.Triangles[i][1], this->Soup.Triangles[i][2]);
    }
    this->Counts.NumberOfReversedTriangles += reversed[i];
  }
  return monitor.Check(1.0);
}

//------------------------------------------------------------------------------
void SoupRepair::StartJoining()
{
  this->Joiner = std::make_unique<SideJoiner>(this->Soup, this->Tolerance / RoundingsPerWeld);
  this->Joiner->Join(CountUp(this->Soup.Points.size()), true);
  this->Joiner->Join(this->Exact, false);
  if (this->Places != this->Exact)
  {
    this->Joiner->Join(this->Places, false);
  }
}

//------------------------------------------------------------------------------
// Coordinates that went through arithmetic may be off by more than their type and digits say, and
// what is welded in part only is torn. Where points are just beyond the default tolerance it is
// widened, until none are for a while.
Outcome SoupRepair::WidenTolerance(const Monitor& monitor)
{
  double tolerance = this->Tolerance;
  for (int i = 0; i < MostWidenings && this->IsDefaultTolerance; ++i)
  {
    NearSides sides(this->Soup, *this->Joiner, this->Places, NextGap * tolerance);
    if (const Outcome found = sides.Find(monitor); !found)
    {
      return found.HasFailed() ? Outcome::Done() : found;
    }
    const double gap = sides.FindLargestGap();
    if (gap > LargestNoise * sides.GetTypicalLength())
    {
      break; // of a surface, not of its coordinates
    }
    if (gap <= tolerance)
    {
      const bool isWider = tolerance > this->Tolerance;
      this->Tolerance = tolerance;
      if (isWider)
      {
        this->StartJoining();
      }
      break;
    }
    tolerance = gap;
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome SoupRepair::JoinNearSides(const Monitor& monitor)
{
  for (int round = 0; round < MostRounds; ++round)
  {
    NearSides sides(this->Soup, *this->Joiner, this->Places, this->Tolerance);
    if (Outcome found = sides.Find(monitor); !found)
    {
      return found;
    }
    const bool isWelded = sides.Weld();
    if (isWelded)
    {
      this->Joiner->Join(this->Places, false);
    }
    const auto splits = sides.FindSplits();
    if (!splits.empty())
    {
      this->SplitSides(splits);
      this->StartJoining();
    }
    else if (!isWelded)
    {
      break;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void SoupRepair::SplitSides(const std::map<std::size_t, std::vector<std::size_t>>& splits)
{
  std::map<std::size_t, std::array<std::vector<std::size_t>, 3>> triangles;
  for (const auto& [side, points] : splits)
  {
    triangles[side / 3][side % 3] = points;
    this->Counts.NumberOfSplitEdges += static_cast<vtkIdType>(points.size());
  }
  for (const auto& [triangle, points] : triangles)
  {
    this->SplitTriangle(triangle, points);
  }
}

//------------------------------------------------------------------------------
// Cut a triangle into a fan over the points on its first such side, and go on with those that keep
// the other two sides.
void SoupRepair::SplitTriangle(std::size_t triangle, std::array<std::vector<std::size_t>, 3> points)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::vector<std::size_t> on = points[i];
    if (on.empty())
    {
      continue;
    }
    const Triangle whole = this->Soup.Triangles[triangle];
    const std::size_t tip = whole[(i + 2) % 3];
    this->Soup.Triangles[triangle] = { whole[i], on[0], tip };
    std::size_t last = triangle;
    for (std::size_t k = 0; k < on.size(); ++k)
    {
      last = this->Soup.Triangles.size();
      this->Soup.Triangles.push_back(
        { on[k], k + 1 < on.size() ? on[k + 1] : whole[(i + 1) % 3], tip });
      this->Soup.CellIds.push_back(this->Soup.CellIds[triangle]);
    }
    this->SplitTriangle(triangle, { { {}, {}, points[(i + 2) % 3] } });
    this->SplitTriangle(last, { { {}, points[(i + 1) % 3], {} } });
    return;
  }
}

//------------------------------------------------------------------------------
// Triangles with their corners in the same places, in sets of two and more.
std::vector<std::vector<std::size_t>> SoupRepair::FindTwins() const
{
  const std::vector<bool> isFirst = this->Soup.FindFirstOfDuplicates(this->Exact);
  if (std::find(isFirst.begin(), isFirst.end(), false) == isFirst.end())
  {
    return {}; // as most surfaces
  }
  std::map<Triangle, std::vector<std::size_t>> known;
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    Triangle corners = GetOrdered(this->Soup.Triangles[i], this->Exact);
    std::sort(corners.begin(), corners.end());
    known[corners].push_back(i);
  }
  std::vector<std::vector<std::size_t>> twins;
  for (auto& [corners, triangles] : known)
  {
    if (triangles.size() > 1)
    {
      twins.push_back(std::move(triangles));
    }
  }
  return twins;
}

//------------------------------------------------------------------------------
std::map<std::size_t, SoupRepair::ComponentTwins> SoupRepair::SortTwins(
  const std::vector<std::vector<std::size_t>>& sets)
{
  std::map<std::size_t, ComponentTwins> components;
  PointComponents points(this->Soup);
  for (const std::vector<std::size_t>& triangles : sets)
  {
    for (const std::size_t one : triangles)
    {
      const std::size_t own = this->Joiner->FindComponent(one);
      ComponentTwins& twins = components[own];
      bool isCopy = false;
      for (const std::size_t other : triangles)
      {
        if (const std::size_t component = this->Joiner->FindComponent(other); component != own)
        {
          isCopy = isCopy || points.Find(one) == points.Find(other);
          twins.Others.insert(component);
        }
      }
      if (isCopy)
      {
        twins.Copies.push_back(one);
      }
      // What has a copy, and is open and small, is a crumb.
      for (std::size_t i = 0; i < 3 && (isCopy || points.GetSize(one) <= 2); ++i)
      {
        this->Soup.SplitPoints[this->Soup.Triangles[one][i]] = true;
      }
      twins.NumberLoose += !isCopy && points.GetSize(one) == 1;
    }
  }
  return components;
}

//------------------------------------------------------------------------------
std::vector<bool> SoupRepair::FindOpenComponents() const
{
  std::vector<bool> isOpen(this->Soup.Triangles.size(), false);
  for (std::size_t side = 0; side < this->Joiner->GetNumberOfSides(); ++side)
  {
    const std::size_t component = this->Joiner->FindComponent(side / 3);
    isOpen[component] = isOpen[component] || this->Joiner->GetPartner(side) == SideJoiner::None;
  }
  return isOpen;
}

//------------------------------------------------------------------------------
// Turned copies of triangles, on open components smaller than that of what they are copies of, if
// they share points with it; and whole components of copies that share points with nothing. So the
// other side of a whole sheet stays, and so do solids that touch.
void SoupRepair::DropStrayTwins()
{
  const std::vector<std::vector<std::size_t>> sets = this->FindTwins();
  if (sets.empty())
  {
    return;
  }
  const std::vector<bool> isOpen = this->FindOpenComponents();
  std::vector<std::size_t> sizes(this->Soup.Triangles.size(), 0);
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    ++sizes[this->Joiner->FindComponent(i)];
  }
  std::vector<bool> kept(this->Soup.Triangles.size(), true);
  std::set<std::size_t> dropped;
  for (const auto& [component, twins] : this->SortTwins(sets))
  {
    std::size_t others = 0;
    for (const std::size_t other : twins.Others)
    {
      others += sizes[other];
    }
    for (const std::size_t copy : twins.Copies)
    {
      kept[copy] = others <= sizes[component] || !isOpen[component];
    }
    if (others > sizes[component] && twins.NumberLoose == sizes[component])
    {
      dropped.insert(component);
    }
  }
  for (std::size_t i = 0; i < kept.size() && !dropped.empty(); ++i)
  {
    kept[i] = kept[i] && dropped.count(this->Joiner->FindComponent(i)) == 0;
  }
  const auto number = std::count(kept.begin(), kept.end(), false);
  if (number > 0)
  {
    this->Counts.NumberOfDroppedTriangles += number;
    this->Keep(kept);
    this->StartJoining();
  }
}

//------------------------------------------------------------------------------
// Whether two partners go along their edge in the same direction, so that their triangles are
// oriented against each other.
bool SoupRepair::AreOpposed(std::size_t side, std::size_t partner) const
{
  return this->Places[this->Joiner->GetEnds(side)[0]] ==
    this->Places[this->Joiner->GetEnds(partner)[0]];
}

//------------------------------------------------------------------------------
// In rings around a first triangle, so that where the surface comes back to itself turned over it
// meets along one seam.
std::vector<bool> SoupRepair::FindReversed()
{
  const std::size_t size = this->Soup.Triangles.size();
  std::vector<bool> reversed(size, false);
  std::vector<bool> known(size, false);
  this->Seams.assign(3 * size, false);
  std::vector<std::size_t> ring;
  vtkIdType seamEdges = 0;
  TriangleSoup::Point place{ 0.0, 0.0, 0.0 };
  for (std::size_t first = 0; first < size; ++first)
  {
    if (known[first])
    {
      continue;
    }
    known[first] = true;
    ring.assign(1, first);
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      for (std::size_t side = 3 * ring[i]; side < 3 * ring[i] + 3; ++side)
      {
        const std::size_t partner = this->Joiner->GetPartner(side);
        if (partner == SideJoiner::None)
        {
          continue;
        }
        const bool turned = reversed[ring[i]] != this->AreOpposed(side, partner);
        if (!known[partner / 3])
        {
          known[partner / 3] = true;
          reversed[partner / 3] = turned;
          ring.push_back(partner / 3);
        }
        else if (reversed[partner / 3] != turned && !this->Seams[side])
        {
          this->Seams[side] = this->Seams[partner] = true;
          place = seamEdges++ == 0 ? this->Soup.Points[this->Joiner->GetEnds(side)[0]] : place;
        }
      }
    }
  }
  this->Counts.NumberOfSeamEdges = seamEdges;
  if (seamEdges > 0)
  {
    std::ostringstream text;
    text << "The surface has one side only, as a Moebius band has: it was cut along " << seamEdges
         << " edges, where its triangles disagree, the first near (" << place[0] << ", " << place[1]
         << ", " << place[2] << ").";
    this->Counts.AddNote(text.str());
  }
  return reversed;
}

//------------------------------------------------------------------------------
// Orienting starts at an arbitrary triangle, which may be the only wrong one.
void SoupRepair::TurnComponentsToMajority(std::vector<bool>& reversed)
{
  if (std::find(reversed.begin(), reversed.end(), true) == reversed.end())
  {
    return;
  }
  std::vector<double> balance(reversed.size(), 0.0);
  for (std::size_t i = 0; i < reversed.size(); ++i)
  {
    const double area = vtkMath::Norm(this->Soup.GetNormal(this->Soup.Triangles[i]).data());
    balance[this->Joiner->FindComponent(i)] += reversed[i] ? -area : area;
  }
  for (std::size_t i = 0; i < reversed.size(); ++i)
  {
    reversed[i] = reversed[i] != (balance[this->Joiner->FindComponent(i)] < 0.0);
  }
}

//------------------------------------------------------------------------------
// The point of each corner, numbered as they come: what the corners of partners have in common.
std::vector<std::size_t> SoupRepair::FindPoints()
{
  const std::size_t sides = this->Joiner->GetNumberOfSides();
  DisjointSets corners(sides);
  const auto getNext = [](std::size_t side) { return 3 * (side / 3) + (side % 3 + 1) % 3; };
  for (std::size_t side = 0; side < sides; ++side)
  {
    const std::size_t partner = this->Joiner->GetPartner(side);
    if (partner != SideJoiner::None && partner > side && !this->Seams[side])
    {
      const bool opposed = this->AreOpposed(side, partner);
      corners.Join(side, opposed ? partner : getNext(partner));
      corners.Join(getNext(side), opposed ? getNext(partner) : partner);
    }
  }
  std::vector<std::size_t> numbers(sides, None);
  std::vector<std::size_t> points(sides);
  std::size_t next = 0;
  for (std::size_t corner = 0; corner < sides; ++corner)
  {
    std::size_t& number = numbers[corners.Find(corner)];
    number = number == None ? next++ : number;
    points[corner] = number;
  }
  return points;
}

//------------------------------------------------------------------------------
// Two pairs of partners may share both points, where the surface comes back to an edge around them:
// more triangles than an edge can have. Apart from each other they leave points of their own.
// Returns whether there were any.
bool SoupRepair::PartCrowds(const std::vector<std::size_t>& points,
  const std::vector<bool>& reversed)
{
  struct Use
  {
    SoupEdges::Edge Edge;
    std::size_t Side;
    bool IsForward;
  };
  std::vector<Use> uses(points.size());
  for (std::size_t side = 0; side < points.size(); ++side)
  {
    const std::size_t from = points[side];
    const std::size_t to = points[3 * (side / 3) + (side % 3 + 1) % 3];
    uses[side] = { SoupEdges::Make(from, to), side, (from < to) != reversed[side / 3] };
  }
  std::sort(uses.begin(), uses.end(),
    [](const Use& a, const Use& b) { return std::tie(a.Edge, a.Side) < std::tie(b.Edge, b.Side); });
  bool found = false;
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    bool joined = false;
    while (end < uses.size() && uses[end].Edge == uses[begin].Edge)
    {
      joined = this->Joiner->GetPartner(uses[end].Side) != SideJoiner::None || joined;
      ++end;
    }
    const bool isFine = uses[begin].Edge.first != uses[begin].Edge.second &&
      (end - begin == 1 ||
        (end - begin == 2 && uses[begin].IsForward != uses[begin + 1].IsForward));
    for (std::size_t i = begin; !isFine && i < end; ++i)
    {
      // Where the sides are apart already, their triangles hang together around the ends.
      const std::size_t first = joined ? uses[i].Side : 3 * (uses[i].Side / 3);
      for (std::size_t side = first; side < first + (joined ? 1 : 3); ++side)
      {
        found = found || this->Joiner->GetPartner(side) != SideJoiner::None;
        this->Joiner->Part(side);
      }
    }
  }
  return found;
}

//------------------------------------------------------------------------------
// A point is where the first of its corners is.
void SoupRepair::MakePoints(const std::vector<bool>& reversed)
{
  std::vector<std::size_t> points = this->FindPoints();
  while (this->PartCrowds(points, reversed))
  {
    points = this->FindPoints();
  }
  TriangleSoup joined;
  for (std::size_t corner = 0; corner < points.size(); ++corner)
  {
    const std::size_t old = this->Soup.Triangles[corner / 3][corner % 3];
    if (points[corner] == joined.Points.size())
    {
      joined.Points.push_back(this->Soup.Points[old]);
      joined.PointIds.push_back(this->Soup.PointIds[old]);
      joined.SplitPoints.push_back(false);
    }
    const std::size_t before = 3 * (corner / 3) + (corner % 3 + 2) % 3;
    joined.SplitPoints[points[corner]] = joined.SplitPoints[points[corner]] ||
      this->Soup.SplitPoints[old] || this->Joiner->IsCrowded(corner) ||
      this->Joiner->IsCrowded(before);
  }
  this->CountPoints(points, joined);
  for (std::size_t corner = 0; corner < points.size(); ++corner)
  {
    this->Soup.Triangles[corner / 3][corner % 3] = points[corner];
  }
  this->Soup.Points = std::move(joined.Points);
  this->Soup.PointIds = std::move(joined.PointIds);
  this->Soup.SplitPoints = std::move(joined.SplitPoints);
}

//------------------------------------------------------------------------------
void SoupRepair::CountPoints(const std::vector<std::size_t>& pointsOfCorners,
  const TriangleSoup& joined)
{
  const std::vector<std::size_t> places = joined.FindPlaces();
  const std::vector<std::size_t> numbers = CountUp(places.size());
  this->Counts.NumberOfSplitPoints = static_cast<vtkIdType>(places.size()) -
    std::inner_product(places.begin(), places.end(), numbers.begin(), vtkIdType(0), std::plus<>(),
      std::equal_to<>());
  if (this->Places == this->Exact)
  {
    return;
  }
  std::set<std::pair<std::size_t, std::size_t>> different;
  for (std::size_t corner = 0; corner < pointsOfCorners.size(); ++corner)
  {
    different.emplace(pointsOfCorners[corner],
      this->Exact[this->Soup.Triangles[corner / 3][corner % 3]]);
  }
  this->Counts.NumberOfWeldedPoints += static_cast<vtkIdType>(different.size() - places.size());
}

//------------------------------------------------------------------------------
void SoupRepair::NoteLooseTriangles()
{
  const std::string note = LooseTriangles::Describe(this->Soup, *this->Joiner);
  if (!note.empty())
  {
    this->Counts.AddNote(note);
  }
}

//------------------------------------------------------------------------------
void SoupRepair::Keep(const std::vector<bool>& kept)
{
  std::size_t next = 0;
  for (std::size_t i = 0; i < this->Soup.Triangles.size(); ++i)
  {
    if (kept[i])
    {
      this->Soup.Triangles[next] = this->Soup.Triangles[i];
      this->Soup.CellIds[next] = this->Soup.CellIds[i];
      ++next;
    }
  }
  this->Soup.Triangles.resize(next);
  this->Soup.CellIds.resize(next);
}
} // namespace LightTransport
