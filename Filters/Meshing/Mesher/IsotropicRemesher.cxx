// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/IsotropicRemesher.h"

#include "Common/Heartbeat.h"
#include "Mesher/EdgeLengths.h"
#include "Mesher/RemeshingSteps.h"
#include "Mesher/WorkingMesh.h"

#include "vtkMath.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Edge = WorkingMesh::Edge;
using Face = WorkingMesh::Face;
using Halfedge = WorkingMesh::Halfedge;
using Point = WorkingMesh::Point;
using Vector = WorkingMesh::Vector;
using Vertex = WorkingMesh::Vertex;

constexpr std::size_t None = SourceSurface::None;

// Edges between these multiples of the wanted length may stay: halves of longer ones are no
// shorter.
constexpr double LongestRatio = 4.0 / 3.0;
constexpr double ShortestRatio = 4.0 / 5.0;
// Beside edges to keep that are shorter than wanted, others may be this much longer than they are:
// the smallest angle of such a triangle is 39 degrees.
constexpr double LongestBesideKept = 1.5;
// A triangle becomes a ladder when its shortest side is shorter than this part of the longest one;
// its diagonals become rungs that are shorter than this part of them, and are next after edges that
// are as long as this part of them: after the sides, before the halves of these.
constexpr double ShortSideOfLong = 0.125;
constexpr double ShortRung = 0.5;
constexpr double UrgencyOfDiagonal = 0.75;

//------------------------------------------------------------------------------
// Whether the normals at an edge differ by more than the angle with this cosine.
bool IsSharp(const WorkingMesh& work, Face a, Face b, double cosine)
{
  const Vector m = work.GetNormal(a);
  const Vector n = work.GetNormal(b);
  const double lengths = std::sqrt(m.squared_length() * n.squared_length());
  // Rounding must not make an edge within a plane sharp.
  const double tolerance = 1e-12;
  return m * n < (cosine - tolerance) * lengths;
}

//------------------------------------------------------------------------------
void FindParts(WorkingMesh& work)
{
  PMP::connected_components(work.Mesh, work.Parts,
    CGAL::parameters::edge_is_constrained_map(work.Kept));
}

//------------------------------------------------------------------------------
// The length at a new vertex between two old ones.
double GetNewLength(const WorkingMesh& work, Edge edge, double interpolated)
{
  double ceiling = std::numeric_limits<double>::max();
  for (const unsigned int side : { 0u, 1u })
  {
    const Halfedge h = work.Mesh.halfedge(edge, side);
    if (!work.Mesh.is_border(h))
    {
      ceiling = std::min(ceiling, work.Ceilings[work.Mesh.face(h)]);
    }
  }
  return std::max(ceiling, interpolated);
}

//------------------------------------------------------------------------------
// Where to split an edge, between 0 and 1; 0 if it is to stay. Edges to keep are split so that all
// pieces are alike, measured by the lengths wanted along them; other edges in the middle, if they
// are longer than wanted at both ends, so that lengths within them can be told apart.
double FindSplit(const WorkingMesh& work, Edge edge)
{
  const double length = work.GetLength(edge);
  const double a = work.Lengths[work.Mesh.vertex(edge, 0)];
  const double b = work.Lengths[work.Mesh.vertex(edge, 1)];
  if (!work.Kept[edge])
  {
    return length > LongestRatio * std::max(a, b) ? 0.5 : 0.0;
  }
  const double growth = std::log(b / a);
  const bool even = std::abs(growth) < 1e-6;
  // The integral of 1 / wanted length along the edge.
  const double count = even ? length / a : length * growth / (b - a);
  const double pieces = std::max(std::ceil(count / LongestRatio * (1.0 - 1e-9)), std::round(count));
  const double part = std::floor(0.5 * pieces) / pieces;
  return even ? part : std::expm1(part * growth) / std::expm1(growth);
}

//------------------------------------------------------------------------------
// Whether two sides of a triangle are so much longer than the third that it is split into a ladder.
bool IsLong(const WorkingMesh& work, Face face)
{
  double shortest = std::numeric_limits<double>::max();
  double longest = 0.0;
  for (const Halfedge h : work.Mesh.halfedges_around_face(work.Mesh.halfedge(face)))
  {
    const double length = work.GetLength(work.Mesh.edge(h));
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return shortest < ShortSideOfLong * longest;
}

//------------------------------------------------------------------------------
// Whether an edge lies within one long triangle of the soup.
bool IsOfLadder(const WorkingMesh& work, Edge edge)
{
  const Face a = work.Mesh.face(work.Mesh.halfedge(edge, 0));
  const Face b = work.Mesh.face(work.Mesh.halfedge(edge, 1));
  return !work.Kept[edge] && work.Sources[a] == work.Sources[b] && work.Long[a];
}

//------------------------------------------------------------------------------
// Replace a diagonal by the rung between the points that its sides have been split at, if that is
// much shorter.
bool ReplaceByRung(WorkingMesh& work, Edge edge)
{
  const Halfedge h = work.Mesh.halfedge(edge);
  const Halfedge back = work.Mesh.opposite(h);
  const Vertex left = work.Mesh.target(work.Mesh.next(h));
  const Vertex right = work.Mesh.target(work.Mesh.next(back));
  const Point& p = work.Mesh.point(work.Mesh.source(h));
  const Point& q = work.Mesh.point(work.Mesh.target(h));
  const Point& l = work.Mesh.point(left);
  const Point& r = work.Mesh.point(right);
  const Vector normal = work.GetNormal(work.Mesh.face(h)) + work.GetNormal(work.Mesh.face(back));
  if (CGAL::squared_distance(l, r) > ShortRung * ShortRung * CGAL::squared_distance(p, q) ||
    !(CGAL::cross_product(p - l, r - l) * normal > 0.0) ||
    !(CGAL::cross_product(r - l, q - l) * normal > 0.0) ||
    work.Mesh.halfedge(left, right) != WorkingMesh::Surface::null_halfedge())
  {
    return false;
  }
  CGAL::Euler::flip_edge(h, work.Mesh);
  work.OnLadder[left] = true;
  work.OnLadder[right] = true;
  return true;
}

// An edge that is to be split.
struct LongEdge
{
  double Urgency;
  Edge Index;
  double Length;

  bool operator<(const LongEdge& other) const
  {
    return std::tie(this->Urgency, this->Index) < std::tie(other.Urgency, other.Index);
  }
};

//------------------------------------------------------------------------------
// Longest edges come first: it keeps triangles from getting thin. Diagonals come after the sides of
// their ladder and become rungs, so that long triangles double, and do not treble, each time that
// their sides are halved.
void SplitEdges(WorkingMesh& work, Heartbeat& heart)
{
  std::priority_queue<LongEdge> queue;
  const auto add = [&](Edge edge)
  {
    if (FindSplit(work, edge) > 0.0)
    {
      const double length = work.GetLength(edge);
      queue.push({ IsOfLadder(work, edge) ? UrgencyOfDiagonal * length : length, edge, length });
    }
  };
  for (const Edge edge : work.Mesh.edges())
  {
    add(edge);
  }
  while (!queue.empty())
  {
    const LongEdge longest = queue.top();
    const Edge edge = longest.Index;
    queue.pop();
    heart.Beat();
    const double part = FindSplit(work, edge);
    if (longest.Length != work.GetLength(edge) || !(part > 0.0))
    {
      continue;
    }
    if (IsOfLadder(work, edge) && ReplaceByRung(work, edge))
    {
      add(edge);
      continue;
    }
    const Vertex from = work.Mesh.vertex(edge, 0);
    const Vertex to = work.Mesh.vertex(edge, 1);
    const double wanted =
      GetNewLength(work, edge, (1.0 - part) * work.Lengths[from] + part * work.Lengths[to]);
    const Point& start = work.Mesh.point(from);
    const Point middle = start + part * (work.Mesh.point(to) - start);
    // Coordinates hold nothing shorter.
    if (middle == start || middle == work.Mesh.point(to))
    {
      continue;
    }
    const Vertex vertex = work.Split(work.Mesh.halfedge(edge), middle);
    work.Lengths[vertex] = wanted;
    for (const Halfedge around : work.Mesh.halfedges_around_target(work.Mesh.halfedge(vertex)))
    {
      add(work.Mesh.edge(around));
    }
  }
}

//------------------------------------------------------------------------------
// Edges to keep that are short need short ones beside them, unless they can be joined.
void LimitToKeptEdges(WorkingMesh& work)
{
  std::vector<double> longest(work.Mesh.number_of_vertices(), 0.0);
  for (const Edge edge : work.Mesh.edges())
  {
    if (work.Kept[edge])
    {
      const double length = work.GetLength(edge);
      for (const unsigned int end : { 0u, 1u })
      {
        const Vertex vertex = work.Mesh.vertex(edge, end);
        longest[vertex] = std::max(longest[vertex], length);
      }
    }
  }
  for (const Vertex vertex : work.Mesh.vertices())
  {
    if (work.Fixed[vertex] && !work.IsStraight(vertex))
    {
      work.Lengths[vertex] = std::min(work.Lengths[vertex], LongestBesideKept * longest[vertex]);
    }
  }
}

//------------------------------------------------------------------------------
// The mesh as arrays. Nothing may have been removed from it.
SourceSurface ToSources(const WorkingMesh& work)
{
  SourceSurface sources;
  for (const Vertex vertex : work.Mesh.vertices())
  {
    const Point& point = work.Mesh.point(vertex);
    sources.Points.push_back({ point.x(), point.y(), point.z() });
  }
  for (const Face face : work.Mesh.faces())
  {
    SourceSurface::Triangle triangle;
    std::array<std::size_t, 3> neighbours;
    Halfedge h = work.Mesh.halfedge(face);
    for (int i = 0; i < 3; ++i)
    {
      triangle[i] = work.Mesh.source(h);
      neighbours[i] =
        work.Kept[work.Mesh.edge(h)] ? None : std::size_t(work.Mesh.face(work.Mesh.opposite(h)));
      h = work.Mesh.next(h);
    }
    sources.Triangles.push_back(triangle);
    sources.Neighbours.push_back(neighbours);
    sources.Parts.push_back(work.Parts[face]);
    sources.Sources.push_back(work.Sources[face]);
  }
  sources.Link();
  return sources;
}
} // namespace

//------------------------------------------------------------------------------
struct IsotropicRemesher::Internals
{
  /// The mesh that Build() and Set...() make, and the one that Prepare() and Remesh() change.
  WorkingMesh Original;
  std::unique_ptr<WorkingMesh> Work;

  void MarkFixed()
  {
    for (const Edge edge : this->Original.Mesh.edges())
    {
      if (this->Original.Kept[edge])
      {
        this->Original.Fixed[this->Original.Mesh.vertex(edge, 0)] = true;
        this->Original.Fixed[this->Original.Mesh.vertex(edge, 1)] = true;
      }
    }
  }
};

//------------------------------------------------------------------------------
IsotropicRemesher::IsotropicRemesher() : Meshes(new Internals) {}

//------------------------------------------------------------------------------
IsotropicRemesher::~IsotropicRemesher() = default;

//------------------------------------------------------------------------------
bool IsotropicRemesher::Build(const TriangleSoup& soup, const std::vector<int>& regions,
  double featureAngle)
{
  WorkingMesh& work = this->Meshes->Original;
  std::vector<Vertex> vertices(soup.Points.size());
  for (std::size_t i = 0; i < soup.Triangles.size(); ++i)
  {
    const TriangleSoup::Triangle& triangle = soup.Triangles[i];
    for (const std::size_t corner : triangle)
    {
      if (vertices[corner] == WorkingMesh::Surface::null_vertex())
      {
        const TriangleSoup::Point& point = soup.Points[corner];
        vertices[corner] = work.Mesh.add_vertex(Point(point[0], point[1], point[2]));
        this->PointsOfSoup.push_back(corner);
      }
    }
    const Face face =
      work.Mesh.add_face(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]);
    if (face == WorkingMesh::Surface::null_face())
    {
      return false;
    }
    work.Sources[face] = i;
    work.Long[face] = IsLong(work, face);
  }

  const double cosine = std::cos(vtkMath::RadiansFromDegrees(featureAngle));
  for (const Edge edge : work.Mesh.edges())
  {
    const Face a = work.Mesh.face(work.Mesh.halfedge(edge, 0));
    const Face b = work.Mesh.face(work.Mesh.halfedge(edge, 1));
    work.Kept[edge] = work.Mesh.is_border(edge) ||
      regions[work.Sources[a]] != regions[work.Sources[b]] || IsSharp(work, a, b, cosine);
  }
  this->Meshes->MarkFixed();
  FindParts(work);
  return true;
}

//------------------------------------------------------------------------------
SourceSurface IsotropicRemesher::GetSurface() const
{
  return ToSources(this->Meshes->Original);
}

//------------------------------------------------------------------------------
void IsotropicRemesher::SetLengths(const std::vector<double>& lengths)
{
  WorkingMesh& work = this->Meshes->Original;
  for (const Vertex vertex : work.Mesh.vertices())
  {
    work.Lengths[vertex] = lengths[vertex];
  }
}

//------------------------------------------------------------------------------
void IsotropicRemesher::SetPlanarRegions(const std::vector<std::size_t>& regions,
  const std::vector<double>& lengths, bool keepBorders)
{
  WorkingMesh& work = this->Meshes->Original;
  for (const Face face : work.Mesh.faces())
  {
    work.Ceilings[face] = regions[face] == None ? 0.0 : lengths[face];
  }
  for (const Edge edge : work.Mesh.edges())
  {
    if (keepBorders && !work.Kept[edge])
    {
      const Face a = work.Mesh.face(work.Mesh.halfedge(edge, 0));
      const Face b = work.Mesh.face(work.Mesh.halfedge(edge, 1));
      work.Kept[edge] = regions[a] != regions[b];
    }
  }
  this->Meshes->MarkFixed();
  FindParts(work);
}

//------------------------------------------------------------------------------
void IsotropicRemesher::KeepCreases(const std::vector<bool>& points)
{
  WorkingMesh& work = this->Meshes->Original;
  for (const Edge edge : work.Mesh.edges())
  {
    if (!work.Kept[edge] &&
      (points[work.Mesh.vertex(edge, 0)] || points[work.Mesh.vertex(edge, 1)]))
    {
      const Face a = work.Mesh.face(work.Mesh.halfedge(edge, 0));
      const Face b = work.Mesh.face(work.Mesh.halfedge(edge, 1));
      work.Kept[edge] = IsSharp(work, a, b, 1.0);
    }
  }
  this->Meshes->MarkFixed();
  FindParts(work);
}

//------------------------------------------------------------------------------
double IsotropicRemesher::Prepare(double factor, double grading, const Monitor& monitor)
{
  Heartbeat heart(monitor);
  this->Meshes->Work = std::make_unique<WorkingMesh>(this->Meshes->Original);
  WorkingMesh& work = *this->Meshes->Work;
  for (const Vertex vertex : work.Mesh.vertices())
  {
    work.Lengths[vertex] *= factor;
  }
  for (const Face face : work.Mesh.faces())
  {
    work.Ceilings[face] *= factor;
  }
  SplitEdges(work, heart);
  // Lengths that have become shorter may split edges once more, which shortens others a little.
  for (int i = 0; i < 2; ++i)
  {
    SplitEdges(work, heart);
    LimitToKeptEdges(work);
    this->Sources = ToSources(work);
    this->Lengths.clear();
    for (const Vertex vertex : work.Mesh.vertices())
    {
      this->Lengths.push_back(work.Lengths[vertex]);
    }
    EdgeLengths::Grade(this->Sources, grading, this->Lengths, monitor);
    for (const Vertex vertex : work.Mesh.vertices())
    {
      work.Lengths[vertex] = this->Lengths[vertex];
    }
    // A short edge and a small grading may ask for any number.
    const double number = EdgeLengths::EstimateNumberOfTriangles(this->Sources, this->Lengths);
    if (number > MostTriangles)
    {
      return number;
    }
  }
  for (const Vertex vertex : work.Mesh.vertices())
  {
    work.Origins[vertex] = vertex;
    work.Places[vertex].Triangle = *this->Sources.GetTrianglesAround(vertex).First;
    work.Places[vertex].Position = this->Sources.Points[vertex];
  }
  return EdgeLengths::EstimateNumberOfTriangles(this->Sources, this->Lengths);
}

//------------------------------------------------------------------------------
Outcome IsotropicRemesher::Remesh(int numberOfIterations, const Monitor& monitor)
{
  RemeshingSteps steps(*this->Meshes->Work, this->Sources, this->Lengths, monitor);
  // Never reached, unless the surface is so crumpled that places on it are of no use.
  const double largestExcess = 4.0;
  const double expected = EdgeLengths::EstimateNumberOfTriangles(this->Sources, this->Lengths);
  const std::size_t most =
    this->GetNumberOfTriangles() + static_cast<std::size_t>(largestExcess * expected);
  for (int i = 0; i < numberOfIterations; ++i)
  {
    const bool goesOn = steps.SplitLongEdges(LongestRatio, most) &&
      steps.CollapseShortEdges(ShortestRatio, 0) && steps.FlipEdges() && steps.MoveVertices() &&
      steps.Report((i + 1.0) / (numberOfIterations + 1.0));
    if (!goesOn)
    {
      return Outcome::Aborted();
    }
  }
  // The last move may have left edges that are better flipped, and better places then.
  return Outcome::DoneUnlessAborted(steps.FlipEdges() && steps.MoveVertices() && steps.FlipEdges());
}

//------------------------------------------------------------------------------
Outcome IsotropicRemesher::AdjustNumberOfTriangles(std::size_t number, const Monitor& monitor)
{
  RemeshingSteps steps(*this->Meshes->Work, this->Sources, this->Lengths, monitor);
  bool goesOn = true;
  // In rounds, so that edges that were moved apart or together can be next.
  const int rounds = 3;
  for (int i = 0; i < rounds && goesOn; ++i)
  {
    goesOn = steps.SplitLongEdges(ShortestRatio, number) &&
      steps.CollapseShortEdges(LongestRatio, number) && steps.FlipEdges() && steps.MoveVertices();
  }
  return Outcome::DoneUnlessAborted(goesOn && steps.FlipEdges());
}

//------------------------------------------------------------------------------
std::size_t IsotropicRemesher::GetNumberOfTriangles() const
{
  return this->Meshes->Work->Mesh.number_of_faces();
}

//------------------------------------------------------------------------------
IsotropicRemesher::Result IsotropicRemesher::GetResult(const Monitor& monitor) const
{
  Heartbeat heart(monitor);
  WorkingMesh& work = *this->Meshes->Work;
  const RemeshingSteps steps(work, this->Sources, this->Lengths, Monitor());
  Result result;
  std::vector<std::size_t> indices(
    work.Mesh.number_of_vertices() + work.Mesh.number_of_removed_vertices(), None);
  for (const Face face : work.Mesh.faces())
  {
    heart.Beat();
    TriangleSoup::Triangle triangle;
    int corner = 0;
    for (const Vertex vertex : work.Mesh.vertices_around_face(work.Mesh.halfedge(face)))
    {
      if (indices[vertex] == None)
      {
        const Point& point = work.Mesh.point(vertex);
        indices[vertex] = result.Points.size();
        result.Points.push_back({ point.x(), point.y(), point.z() });
        const std::size_t triangleOfPoint = work.Fixed[vertex]
          ? *this->Sources.GetTrianglesAround(work.Origins[vertex]).First
          : work.Places[vertex].Triangle;
        result.SourcesOfPoints.push_back(this->Sources.Sources[triangleOfPoint]);
      }
      triangle[corner++] = indices[vertex];
    }
    result.Triangles.push_back(triangle);
    result.SourcesOfTriangles.push_back(this->Sources.Sources[steps.FindSource(face)]);
  }
  return result;
}
} // namespace LightTransport
