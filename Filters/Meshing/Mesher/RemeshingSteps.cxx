// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/RemeshingSteps.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>

namespace LightTransport
{
namespace
{
using Point = WorkingMesh::Point;
using Vector = WorkingMesh::Vector;

// Limit of the length over the wanted one that edges may get when others are collapsed. It lets the
// legs of right triangles, which halving leads to, be collapsed as long as they are short.
constexpr double LongestCollapsed = 1.5;
// Limit of the length of the halves of an edge over its own.
constexpr double LongestHalf = 0.65;
// Limits of the quality of the triangles that splitting makes: at all, and over that of the old
// one.
constexpr double WorstSplit = 1e-4;
constexpr double LargestLoss = 0.2;
// New triangles may be as bad as this, or as the worst they replace. See GetQuality().
constexpr double GoodEnough = 0.5;
// But worse by this factor on a ladder, whose rungs can go only one by one.
constexpr double LossOnLadder = 0.5;
// Cosine by which the normal of a triangle may turn in one step.
constexpr double LargestTurn = 0.5;

//------------------------------------------------------------------------------
SourceSurface::Point ToArray(const Point& point)
{
  return { point.x(), point.y(), point.z() };
}

//------------------------------------------------------------------------------
Point ToPoint(const SourceSurface::Point& point)
{
  return Point(point[0], point[1], point[2]);
}

//------------------------------------------------------------------------------
// Area over the sum of the squared sides, 1 for an equilateral triangle, 0 for a degenerate one.
double GetQuality(const Point& a, const Point& b, const Point& c)
{
  const double sides =
    (b - a).squared_length() + (c - b).squared_length() + (a - c).squared_length();
  const double area2 = CGAL::cross_product(b - a, c - a).squared_length();
  return sides > 0.0 ? 2.0 * std::sqrt(3.0 * area2) / sides : 0.0;
}

//------------------------------------------------------------------------------
bool TurnsTooFar(const Vector& from, const Vector& to)
{
  // A degenerate triangle has no normal to keep.
  const double lengths2 = from.squared_length() * to.squared_length();
  return lengths2 > 0.0 && from * to < LargestTurn * std::sqrt(lengths2);
}

//------------------------------------------------------------------------------
// Cotangent of the angle at `a`.
double GetCotangent(const Point& a, const Point& b, const Point& c)
{
  const Vector u = b - a;
  const Vector v = c - a;
  return u * v / std::sqrt(CGAL::cross_product(u, v).squared_length());
}
} // namespace

//------------------------------------------------------------------------------
RemeshingSteps::RemeshingSteps(WorkingMesh& mesh, const SourceSurface& sources,
  const std::vector<double>& lengths, Monitor monitor)
  : Work(mesh), Mesh(mesh.Mesh), Sources(sources), Lengths(lengths), Watcher(std::move(monitor))
{
}

//------------------------------------------------------------------------------
bool RemeshingSteps::Report(double fraction)
{
  this->Fraction = fraction;
  return this->Watcher.Report(fraction);
}

//------------------------------------------------------------------------------
bool RemeshingSteps::CountStep()
{
  const std::size_t interval = 4096;
  return ++this->Steps % interval != 0 || this->Watcher.Report(this->Fraction);
}

//------------------------------------------------------------------------------
double RemeshingSteps::GetRatio(Edge edge) const
{
  return this->Work.GetLength(edge) / this->Work.GetWantedLength(edge);
}

//------------------------------------------------------------------------------
SourceSurface::Place RemeshingSteps::Find(Vertex start, std::size_t part,
  const Point& position) const
{
  std::vector<std::size_t> starts;
  if (this->Work.Fixed[start])
  {
    for (const std::size_t triangle : this->Sources.GetTrianglesAround(this->Work.Origins[start]))
    {
      if (this->Sources.Parts[triangle] == part)
      {
        starts.push_back(triangle);
      }
    }
  }
  else
  {
    starts.push_back(this->Work.Places[start].Triangle);
  }
  return this->Sources.Find(starts, ToArray(position));
}

//------------------------------------------------------------------------------
void RemeshingSteps::Put(Vertex vertex, const SourceSurface::Place& place)
{
  this->Work.Places[vertex] = place;
  this->Mesh.point(vertex) = ToPoint(place.Position);
  const SourceSurface::Triangle& corners = this->Sources.Triangles[place.Triangle];
  double length = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    length += place.Weights[i] * this->Lengths[corners[i]];
  }
  this->Work.Lengths[vertex] = length;
}

//------------------------------------------------------------------------------
std::size_t RemeshingSteps::FindSource(Face face) const
{
  const Halfedge first = this->Mesh.halfedge(face);
  Vector sum = CGAL::NULL_VECTOR;
  Vertex start = this->Mesh.target(first);
  for (const Vertex vertex : this->Mesh.vertices_around_face(first))
  {
    sum = sum + (this->Mesh.point(vertex) - CGAL::ORIGIN);
    start = this->Work.Fixed[start] ? vertex : start;
  }
  return this->Find(start, this->Work.Parts[face], CGAL::ORIGIN + sum / 3.0).Triangle;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::CanSplit(Halfedge h, const Point& to) const
{
  // Over a gap the surface may have nothing near the middle, and in a degenerate triangle there is
  // a point already: the new edges would be no shorter, and splitting would never end.
  const Point& p = this->Mesh.point(this->Mesh.source(h));
  const Point& q = this->Mesh.point(this->Mesh.target(h));
  const double length2 = CGAL::squared_distance(p, q);
  const double longestHalf2 =
    std::max(CGAL::squared_distance(p, to), CGAL::squared_distance(q, to));
  bool good = longestHalf2 < LongestHalf * LongestHalf * length2;
  for (const Halfedge side : { h, this->Mesh.opposite(h) })
  {
    const Point& apex = this->Mesh.point(this->Mesh.target(this->Mesh.next(side)));
    const double longest2 =
      std::max(length2, std::max(CGAL::squared_distance(p, apex), CGAL::squared_distance(q, apex)));
    const double quality = std::min(GetQuality(p, to, apex), GetQuality(q, to, apex));
    good = good && CGAL::squared_distance(to, apex) <= longest2 &&
      quality >= std::max(WorstSplit, LargestLoss * GetQuality(p, q, apex));
  }
  return good;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::SplitLongEdges(double longest, std::size_t most)
{
  std::priority_queue<std::pair<double, Edge>> queue;
  const auto add = [&](Edge edge)
  {
    const double ratio = this->GetRatio(edge);
    if (ratio > longest && !this->Work.Kept[edge])
    {
      queue.emplace(ratio, edge);
    }
  };
  for (const Edge edge : this->Mesh.edges())
  {
    add(edge);
  }
  while (!queue.empty() && this->Mesh.number_of_faces() < most)
  {
    const std::pair<double, Edge> top = queue.top();
    queue.pop();
    if (!this->CountStep())
    {
      return false;
    }
    if (top.first != this->GetRatio(top.second))
    {
      continue;
    }
    Halfedge h = this->Mesh.halfedge(top.second);
    h = this->Work.Fixed[this->Mesh.target(h)] ? this->Mesh.opposite(h) : h;
    const Point middle = CGAL::midpoint(this->Mesh.point(this->Mesh.source(h)),
      this->Mesh.point(this->Mesh.target(h)));
    const SourceSurface::Place place =
      this->Find(this->Mesh.target(h), this->Work.Parts[this->Mesh.face(h)], middle);
    if (!this->CanSplit(h, ToPoint(place.Position)))
    {
      continue;
    }
    const Vertex vertex = this->Work.Split(h, middle);
    this->Put(vertex, place);
    for (const Halfedge around : this->Mesh.halfedges_around_target(this->Mesh.halfedge(vertex)))
    {
      add(this->Mesh.edge(around));
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::CanCollapse(Halfedge h) const
{
  const Vertex p = this->Mesh.source(h);
  const Vertex q = this->Mesh.target(h);
  const Point& to = this->Mesh.point(q);
  const bool alongKept = this->Work.Kept[this->Mesh.edge(h)];
  if (this->Work.Fixed[p] && !(alongKept && this->Work.IsStraight(p)))
  {
    return false;
  }
  double oldQuality = 1.0;
  double newQuality = 1.0;
  for (const Halfedge in : this->Mesh.halfedges_around_target(this->Mesh.opposite(h)))
  {
    const Vertex around = this->Mesh.source(in);
    const double wanted = 0.5 * (this->Work.Lengths[q] + this->Work.Lengths[around]);
    const double length2 = CGAL::squared_distance(to, this->Mesh.point(around));
    if (length2 > LongestCollapsed * LongestCollapsed * wanted * wanted)
    {
      return false;
    }
    if (this->Mesh.is_border(in))
    {
      continue;
    }
    const Vertex next = this->Mesh.target(this->Mesh.next(in));
    const Point& a = this->Mesh.point(around);
    const Point& b = this->Mesh.point(p);
    const Point& c = this->Mesh.point(next);
    oldQuality = std::min(oldQuality, GetQuality(a, b, c));
    if (around == q || next == q)
    {
      continue;
    }
    newQuality = std::min(newQuality, GetQuality(a, to, c));
    if (TurnsTooFar(CGAL::cross_product(b - a, c - a), CGAL::cross_product(to - a, c - a)))
    {
      return false;
    }
  }
  const double factor = this->Work.OnLadder[p] ? LossOnLadder : 1.0;
  return newQuality >= factor * std::min(oldQuality, GoodEnough) && newQuality > 0.0;
}

//------------------------------------------------------------------------------
RemeshingSteps::Halfedge RemeshingSteps::FindCollapse(Edge edge) const
{
  // The link condition looks at all edges around both ends, which may be many: it comes last.
  for (const unsigned int side : { 0u, 1u })
  {
    if (this->CanCollapse(this->Mesh.halfedge(edge, side)))
    {
      return CGAL::Euler::does_satisfy_link_condition(edge, this->Mesh)
        ? this->Mesh.halfedge(edge, side)
        : WorkingMesh::Surface::null_halfedge();
    }
  }
  return WorkingMesh::Surface::null_halfedge();
}

//------------------------------------------------------------------------------
RemeshingSteps::Vertex RemeshingSteps::Collapse(Halfedge h)
{
  const Vertex q = this->Mesh.target(h);
  const Point point = this->Mesh.point(q);
  const double length = this->Work.Lengths[q];
  const bool fixed = this->Work.Fixed[q];
  const std::size_t origin = this->Work.Origins[q];
  const SourceSurface::Place place = this->Work.Places[q];
  this->Work.Kept[this->Mesh.edge(h)] = false;
  const Vertex vertex = CGAL::Euler::collapse_edge(this->Mesh.edge(h), this->Mesh, this->Work.Kept);
  this->Mesh.point(vertex) = point;
  this->Work.Lengths[vertex] = length;
  this->Work.Fixed[vertex] = fixed;
  this->Work.Origins[vertex] = origin;
  this->Work.Places[vertex] = place;
  return vertex;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::CollapseShortEdges(double shortest, std::size_t fewest)
{
  using Entry = std::pair<double, Edge>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  const auto add = [&](Edge edge)
  {
    const double ratio = this->GetRatio(edge);
    if (ratio < shortest)
    {
      queue.emplace(ratio, edge);
    }
  };
  for (const Edge edge : this->Mesh.edges())
  {
    add(edge);
  }
  while (!queue.empty() && this->Mesh.number_of_faces() > fewest)
  {
    const Entry top = queue.top();
    queue.pop();
    if (!this->CountStep())
    {
      return false;
    }
    if (this->Mesh.is_removed(top.second) || top.first != this->GetRatio(top.second))
    {
      continue;
    }
    const Halfedge h = this->FindCollapse(top.second);
    if (h == WorkingMesh::Surface::null_halfedge())
    {
      continue;
    }
    const Vertex vertex = this->Collapse(h);
    for (const Halfedge around : this->Mesh.halfedges_around_target(this->Mesh.halfedge(vertex)))
    {
      add(this->Mesh.edge(around));
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::ShouldFlip(Edge edge) const
{
  if (this->Work.Kept[edge])
  {
    return false;
  }
  const Halfedge h = this->Mesh.halfedge(edge);
  const Halfedge back = this->Mesh.opposite(h);
  const Vertex left = this->Mesh.target(this->Mesh.next(h));
  const Vertex right = this->Mesh.target(this->Mesh.next(back));
  const Point& p = this->Mesh.point(this->Mesh.source(h));
  const Point& q = this->Mesh.point(this->Mesh.target(h));
  const Point& l = this->Mesh.point(left);
  const Point& r = this->Mesh.point(right);
  const double tolerance = 1e-6;
  // Written so that degenerate triangles, where it is not a number, are flipped if possible.
  if (GetCotangent(l, p, q) + GetCotangent(r, p, q) >= -tolerance ||
    this->Mesh.halfedge(left, right) != WorkingMesh::Surface::null_halfedge())
  {
    return false;
  }
  const Vector normal =
    this->Work.GetNormal(this->Mesh.face(h)) + this->Work.GetNormal(this->Mesh.face(back));
  const double oldQuality = std::min(GetQuality(p, q, l), GetQuality(p, q, r));
  const double newQuality = std::min(GetQuality(l, r, p), GetQuality(l, r, q));
  return newQuality > oldQuality && !TurnsTooFar(normal, CGAL::cross_product(p - l, r - l)) &&
    !TurnsTooFar(normal, CGAL::cross_product(r - l, q - l));
}

//------------------------------------------------------------------------------
bool RemeshingSteps::FlipEdges()
{
  std::vector<Edge> stack(this->Mesh.edges().begin(), this->Mesh.edges().end());
  while (!stack.empty())
  {
    const Edge edge = stack.back();
    stack.pop_back();
    if (!this->CountStep())
    {
      return false;
    }
    if (!this->ShouldFlip(edge))
    {
      continue;
    }
    const Halfedge h = this->Mesh.halfedge(edge);
    CGAL::Euler::flip_edge(h, this->Mesh);
    for (const Halfedge side : { h, this->Mesh.opposite(h) })
    {
      stack.push_back(this->Mesh.edge(this->Mesh.next(side)));
      stack.push_back(this->Mesh.edge(this->Mesh.prev(side)));
    }
  }
  return true;
}

//------------------------------------------------------------------------------
bool RemeshingSteps::CanMove(Vertex vertex, const Point& to) const
{
  double oldQuality = 1.0;
  double newQuality = 1.0;
  for (const Halfedge in : this->Mesh.halfedges_around_target(this->Mesh.halfedge(vertex)))
  {
    const Point& a = this->Mesh.point(this->Mesh.source(in));
    const Point& b = this->Mesh.point(vertex);
    const Point& c = this->Mesh.point(this->Mesh.target(this->Mesh.next(in)));
    if (TurnsTooFar(CGAL::cross_product(b - a, c - a), CGAL::cross_product(to - a, c - a)))
    {
      return false;
    }
    oldQuality = std::min(oldQuality, GetQuality(a, b, c));
    newQuality = std::min(newQuality, GetQuality(a, to, c));
  }
  return newQuality >= std::min(oldQuality, GoodEnough) && newQuality > 0.0;
}

//------------------------------------------------------------------------------
void RemeshingSteps::Move(Vertex vertex)
{
  const Point from = this->Mesh.point(vertex);
  Vector normal = CGAL::NULL_VECTOR;
  Vector sum = CGAL::NULL_VECTOR;
  double weights = 0.0;
  for (const Halfedge in : this->Mesh.halfedges_around_target(this->Mesh.halfedge(vertex)))
  {
    const Vertex a = this->Mesh.source(in);
    const Vertex c = this->Mesh.target(this->Mesh.next(in));
    const Vector u = this->Mesh.point(a) - from;
    const Vector v = this->Mesh.point(c) - from;
    const Vector cross = CGAL::cross_product(v, u);
    const double length =
      this->Work.Lengths[a] + this->Work.Lengths[c] + this->Work.Lengths[vertex];
    const double weight = std::sqrt(cross.squared_length()) / (length * length);
    normal = normal + cross;
    sum = sum + weight / 3.0 * (u + v);
    weights += weight;
  }
  const double normal2 = normal.squared_length();
  if (!(weights > 0.0) || !(normal2 > 0.0))
  {
    return;
  }
  const Vector shift = sum / weights;
  const Vector along = shift - (shift * normal) / normal2 * normal;
  for (const double part : { 1.0, 0.5, 0.25 })
  {
    const SourceSurface::Place place = this->Find(vertex, SourceSurface::None, from + part * along);
    if (this->CanMove(vertex, ToPoint(place.Position)))
    {
      this->Put(vertex, place);
      return;
    }
  }
}

//------------------------------------------------------------------------------
bool RemeshingSteps::MoveVertices()
{
  for (const Vertex vertex : this->Mesh.vertices())
  {
    if (!this->Work.Fixed[vertex] && !this->Mesh.is_isolated(vertex))
    {
      this->Move(vertex);
    }
    if (!this->CountStep())
    {
      return false;
    }
  }
  return true;
}
} // namespace LightTransport
