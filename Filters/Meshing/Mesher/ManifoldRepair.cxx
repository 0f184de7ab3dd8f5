// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/ManifoldRepair.h"

#include "Common/Heartbeat.h"
#include "Mesher/SoupLocator.h"
#include "Mesher/TriangleCrossings.h"
#include "vtkMath.h"
#include "vtkSphere.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#if __has_include(<CGAL/boost/graph/border.h>) // CGAL 6.2 and later
#include <CGAL/boost/graph/border.h>
#else
#include <CGAL/Polygon_mesh_processing/border.h>
#endif

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = Mesh::Vertex_index;
using Halfedge = Mesh::Halfedge_index;
using Face = Mesh::Face_index;
using Pair = std::pair<Face, Face>;

constexpr vtkIdType New = -1;

// A mesh that knows where its points and triangles come from.
struct RepairMesh
{
  RepairMesh()
  {
    this->PointIds = this->Triangles.add_property_map<Vertex, vtkIdType>("v:id", New).first;
    this->Split = this->Triangles.add_property_map<Vertex, bool>("v:split", false).first;
    this->CellIds = this->Triangles.add_property_map<Face, vtkIdType>("f:id", New).first;
  }
  RepairMesh(const RepairMesh&) = delete;
  void operator=(const RepairMesh&) = delete;

  Mesh Triangles;
  Mesh::Property_map<Vertex, vtkIdType> PointIds;
  Mesh::Property_map<Vertex, bool> Split;
  Mesh::Property_map<Face, vtkIdType> CellIds;
};

//------------------------------------------------------------------------------
std::array<Vertex, 3> GetCorners(const Mesh& mesh, Face face)
{
  const Halfedge h = mesh.halfedge(face);
  return { mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) };
}

//------------------------------------------------------------------------------
std::vector<Face> GetFaces(const Mesh& mesh)
{
  return { mesh.faces().begin(), mesh.faces().end() };
}

//------------------------------------------------------------------------------
Kernel::Triangle_3 GetTriangle(const Mesh& mesh, Face face)
{
  const std::array<Vertex, 3> corners = GetCorners(mesh, face);
  return { mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2]) };
}

//------------------------------------------------------------------------------
TriangleSoup::Point FromKernel(const Point& point)
{
  return { point.x(), point.y(), point.z() };
}

//------------------------------------------------------------------------------
double GetRadius(const Mesh& mesh, const std::vector<Vertex>& vertices)
{
  std::vector<double> coordinates;
  coordinates.reserve(3 * vertices.size());
  for (const Vertex vertex : vertices)
  {
    const Point& point = mesh.point(vertex);
    coordinates.insert(coordinates.end(), { point.x(), point.y(), point.z() });
  }
  double sphere[4];
  vtkSphere::ComputeBoundingSphere(coordinates.data(), static_cast<vtkIdType>(vertices.size()),
    sphere, nullptr);
  return sphere[3];
}

//------------------------------------------------------------------------------
std::vector<Vertex> GetVertices(const Mesh& mesh, const std::vector<Face>& faces)
{
  std::vector<Vertex> vertices;
  for (const Face face : faces)
  {
    const std::array<Vertex, 3> corners = GetCorners(mesh, face);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

//------------------------------------------------------------------------------
// The connected components of a mesh, in the order of their first triangles.
struct Components
{
  explicit Components(Mesh& mesh)
  {
    this->OfFace = mesh.add_property_map<Face, std::size_t>("f:component").first;
    this->Faces.resize(PMP::connected_components(mesh, this->OfFace));
    for (const Face face : mesh.faces())
    {
      this->Faces[this->OfFace[face]].push_back(face);
    }
  }

  Mesh::Property_map<Face, std::size_t> OfFace;
  std::vector<std::vector<Face>> Faces;
};

//------------------------------------------------------------------------------
// The pairs of triangles that have more in common than corners and sides, sorted. Where
// non-manifold edges and points were split, neighbours meet that share no point of the mesh.
std::vector<Pair> FindIntersections(const Mesh& mesh, const Monitor& monitor)
{
  TriangleCrossings::Points points(mesh.num_vertices());
  for (const Vertex vertex : mesh.vertices())
  {
    points[vertex] = FromKernel(mesh.point(vertex));
  }
  const std::vector<Face> faces = GetFaces(mesh);
  TriangleCrossings::Triangles triangles;
  triangles.reserve(faces.size());
  for (const Face face : faces)
  {
    const std::array<Vertex, 3> corners = GetCorners(mesh, face);
    triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  std::vector<Pair> pairs;
  for (const TriangleCrossings::Pair& pair : TriangleCrossings::Find(points, triangles, monitor))
  {
    if (!pair.OnlyTouches)
    {
      pairs.emplace_back(faces[pair.First], faces[pair.Second]);
    }
  }
  return pairs;
}

//------------------------------------------------------------------------------
bool HasDegenerateTriangle(const Mesh& mesh)
{
  const auto faces = mesh.faces();
  return std::any_of(faces.begin(), faces.end(),
    [&mesh](Face face) { return PMP::is_degenerate_triangle_face(face, mesh); });
}

//------------------------------------------------------------------------------
void Extract(const RepairMesh& whole, const std::vector<Face>& faces, Heartbeat& heart,
  RepairMesh& part)
{
  std::map<Vertex, Vertex> known;
  for (const Face face : faces)
  {
    heart.Beat();
    std::array<Vertex, 3> corners = GetCorners(whole.Triangles, face);
    for (Vertex& corner : corners)
    {
      const auto inserted = known.emplace(corner, Vertex());
      if (inserted.second)
      {
        inserted.first->second = part.Triangles.add_vertex(whole.Triangles.point(corner));
        part.PointIds[inserted.first->second] = whole.PointIds[corner];
      }
      corner = inserted.first->second;
    }
    part.CellIds[part.Triangles.add_face(corners[0], corners[1], corners[2])] = whole.CellIds[face];
  }
}

//------------------------------------------------------------------------------
void Append(const RepairMesh& surface, const std::vector<Face>& faces, TriangleSoup& soup)
{
  const std::size_t none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> indices(surface.Triangles.num_vertices(), none);
  for (const Face face : faces)
  {
    TriangleSoup::Triangle triangle;
    std::size_t i = 0;
    for (const Vertex corner : GetCorners(surface.Triangles, face))
    {
      if (indices[corner] == none)
      {
        indices[corner] = soup.Points.size();
        soup.Points.push_back(FromKernel(surface.Triangles.point(corner)));
        soup.PointIds.push_back(surface.PointIds[corner]);
        soup.SplitPoints.push_back(surface.Split[corner]);
      }
      triangle[i++] = indices[corner];
    }
    soup.Triangles.push_back(triangle);
    soup.CellIds.push_back(surface.CellIds[face]);
  }
}

//------------------------------------------------------------------------------
// Gives new triangles and points the ids of the old surface where it is closest.
void TakeNearestIds(RepairMesh& surface, const RepairMesh& old, Heartbeat& heart)
{
  TriangleSoup soup;
  Append(old, GetFaces(old.Triangles), soup);
  SoupLocator locator(soup);
  const double reach = soup.GetDiagonal() / 1000.0;
  const Mesh& mesh = surface.Triangles;
  for (const Face face : mesh.faces())
  {
    heart.Beat();
    if (surface.CellIds[face] == New)
    {
      const Point center = CGAL::centroid(GetTriangle(mesh, face));
      surface.CellIds[face] = soup.CellIds[locator.Find(FromKernel(center), reach).Triangle];
    }
  }
  for (const Vertex vertex : mesh.vertices())
  {
    heart.Beat();
    if (surface.PointIds[vertex] == New)
    {
      const auto place = locator.Find(FromKernel(mesh.point(vertex)), reach);
      const auto corner = std::max_element(place.Weights.begin(), place.Weights.end());
      surface.PointIds[vertex] =
        soup.PointIds[soup.Triangles[place.Triangle][corner - place.Weights.begin()]];
    }
  }
}

//------------------------------------------------------------------------------
// Gives the triangles that fill a hole the cells of those around it, from the border inward.
void TakeIdsOfNeighbours(RepairMesh& surface, const std::vector<Face>& added)
{
  const Mesh& mesh = surface.Triangles;
  std::vector<Face> open = added;
  for (bool changed = true; changed && !open.empty();)
  {
    std::vector<std::pair<Face, vtkIdType>> found;
    std::vector<Face> left;
    for (const Face face : open)
    {
      vtkIdType cell = New;
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(face)))
      {
        const Face neighbour = mesh.face(mesh.opposite(h));
        cell = std::max(cell, mesh.is_valid(neighbour) ? surface.CellIds[neighbour] : New);
      }
      if (cell == New)
      {
        left.push_back(face);
      }
      else
      {
        found.emplace_back(face, cell);
      }
    }
    for (const auto& face : found)
    {
      surface.CellIds[face.first] = face.second;
    }
    changed = !found.empty();
    open = left;
  }
}

//------------------------------------------------------------------------------
// A halfedge of each border. CGAL 6.2 has moved the function to the namespace of the mesh.
std::vector<Halfedge> FindBorders(const Mesh& mesh)
{
  using namespace CGAL::Polygon_mesh_processing;
  std::vector<Halfedge> borders;
  extract_boundary_cycles(mesh, std::back_inserter(borders));
  return borders;
}

//------------------------------------------------------------------------------
std::array<std::size_t, 3> GetTopology(const Mesh& input)
{
  Mesh mesh = input;
  mesh.collect_garbage();
  const Components components(mesh);
  return { components.Faces.size(), FindBorders(mesh).size(),
    mesh.number_of_vertices() + mesh.number_of_faces() - mesh.number_of_edges() };
}

// The points of a mesh for CGAL's algorithms, which read them all the time: they hear so that they
// are to stop, by an exception. What they were working on is lost then.
struct WatchedPoints
{
  using key_type = Vertex;
  using value_type = Point;
  using reference = Point&;
  using category = boost::lvalue_property_map_tag;

  friend Point& get(const WatchedPoints& points, Vertex vertex)
  {
    points.Heart->Beat();
    if ((*points.ReadsLeft)-- == 0)
    {
      throw TooMuchWork();
    }
    return get(points.Points, vertex);
  }
  // A map of this category has it; whether it is called depends on CGAL's version.
  [[maybe_unused]] friend void put(const WatchedPoints& points, Vertex vertex, const Point& point)
  {
    put(points.Points, vertex, point);
  }

  Mesh::Property_map<Vertex, Point> Points;
  Heartbeat* Heart;
  std::size_t* ReadsLeft;

  struct TooMuchWork
  {
  };
};

// Where algorithms take no such points: predicates that hear it.
struct WatchedKernel : public Kernel
{
  struct Do_intersect_3
  {
    using result_type = bool;
    template <typename... Items>
    bool operator()(const Items&... items) const
    {
      if (this->Heart)
      {
        this->Heart->Beat();
      }
      return Kernel::Do_intersect_3()(items...);
    }
    Heartbeat* Heart = nullptr;
  };
  Do_intersect_3 do_intersect_3_object() const { return Do_intersect_3{ this->Heart }; }

  /// Algorithms make their own, on a few triangles.
  WatchedKernel() = default;
  explicit WatchedKernel(Heartbeat& heart) : Heart(&heart) {}
  Heartbeat* Heart = nullptr;
};

using ResolvingVisitor = PMP::experimental::Remove_self_intersection_default_visitor<Mesh>;
struct WatchedResolving : public ResolvingVisitor
{
  explicit WatchedResolving(Heartbeat& heart) : Heart(&heart) {}
  bool stop() const
  {
    this->Heart->Beat();
    return false;
  }
  Heartbeat* Heart;
};

struct WatchedFilling : public PMP::Hole_filling::Default_visitor
{
  explicit WatchedFilling(Heartbeat& heart) : Heart(&heart) {}
  void quadratic_step() const { this->Heart->Beat(); }
  void cubic_step() const { this->Heart->Beat(); }
  Heartbeat* Heart;
};

//------------------------------------------------------------------------------
// Whether two meshes are within a distance of each other; false also where that takes too much
// work.
bool IsNear(const Mesh& a, const Mesh& b, double distance, Heartbeat& heart)
{
  // Of meshes that agree nowhere some distances are cut into triangles without end, a gigabyte and
  // more of them; others take some dozens of reads for each face.
  constexpr std::size_t leastReads = 20000000;
  constexpr std::size_t readsPerFace = 500;
  std::size_t reads = leastReads + readsPerFace * (a.number_of_faces() + b.number_of_faces());
  try
  {
    return !PMP::is_Hausdorff_distance_larger<CGAL::Sequential_tag>(a, b, distance, 0.01 * distance,
      CGAL::parameters::use_one_sided_hausdorff(false).vertex_point_map(
        WatchedPoints{ a.points(), &heart, &reads }),
      CGAL::parameters::vertex_point_map(WatchedPoints{ b.points(), &heart, &reads }));
  }
  catch (const WatchedPoints::TooMuchWork&)
  {
    return false;
  }
}

//------------------------------------------------------------------------------
bool Resolve(Mesh& mesh, double distance, Heartbeat& heart, const Monitor& monitor)
{
  Mesh old = mesh;
  const auto getCorners = [&mesh](Face face)
  {
    const Kernel::Triangle_3 triangle = GetTriangle(mesh, face);
    return TriangleCrossings::Corners{ FromKernel(triangle[0]), FromKernel(triangle[1]),
      FromKernel(triangle[2]) };
  };
  const auto touch = [&getCorners](const Pair& pair)
  { return TriangleCrossings::OnlyTouch(getCorners(pair.first), getCorners(pair.second)); };
  PMP::experimental::remove_self_intersections(mesh,
    CGAL::parameters::preserve_genus(true)
      .geom_traits(WatchedKernel(heart))
      .filter(touch)
      .visitor(WatchedResolving(heart)));
  mesh.collect_garbage();
  return !HasDegenerateTriangle(mesh) && FindIntersections(mesh, monitor).empty() &&
    GetTopology(mesh) == GetTopology(old) && IsNear(old, mesh, distance, heart);
}

//------------------------------------------------------------------------------
// CGAL 6 takes as a named parameter what CGAL 5.5 takes as an argument.
std::vector<Face> TriangulateHole(Mesh& mesh, Halfedge border, const Monitor& monitor)
{
  std::vector<Face> added;
  Heartbeat heart(monitor);
  const auto parameters = CGAL::parameters::visitor(WatchedFilling(heart));
#if CGAL_VERSION_NR >= 1060000000
  PMP::triangulate_hole(mesh, border, parameters.face_output_iterator(std::back_inserter(added)));
#else
  PMP::triangulate_hole(mesh, border, std::back_inserter(added), parameters);
#endif
  return added;
}
} // namespace

//------------------------------------------------------------------------------
struct ManifoldRepair::Internals : public RepairMesh
{
  /// The pairs of triangles of one component that intersect.
  std::vector<Pair> Within;
  /// Components that have been replaced by others, which are not in the mesh.
  std::vector<bool> Replaced;
  std::vector<std::unique_ptr<RepairMesh>> Replacements;
};

//------------------------------------------------------------------------------
ManifoldRepair::ManifoldRepair() : Surface(new Internals) {}

//------------------------------------------------------------------------------
Outcome ManifoldRepair::Build(const TriangleSoup& soup)
{
  Mesh& mesh = this->Surface->Triangles;
  std::vector<Vertex> vertices(soup.Points.size());
  for (std::size_t i = 0; i < soup.Triangles.size(); ++i)
  {
    const TriangleSoup::Triangle& triangle = soup.Triangles[i];
    for (const std::size_t corner : triangle)
    {
      if (vertices[corner] == Mesh::null_vertex())
      {
        const TriangleSoup::Point& point = soup.Points[corner];
        vertices[corner] = mesh.add_vertex(Point(point[0], point[1], point[2]));
        this->Surface->PointIds[vertices[corner]] = soup.PointIds[corner];
        this->Surface->Split[vertices[corner]] =
          corner < soup.SplitPoints.size() && soup.SplitPoints[corner];
      }
    }
    const Face face =
      mesh.add_face(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]);
    if (face == Mesh::null_face())
    {
      return Outcome::Failed("The surface is not a manifold: split it first.");
    }
    this->Surface->CellIds[face] = soup.CellIds[i];
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
ManifoldRepair::~ManifoldRepair() = default;

//------------------------------------------------------------------------------
vtkIdType ManifoldRepair::DropCrumbs(double size)
{
  Mesh& mesh = this->Surface->Triangles;
  const auto isOpen = [&mesh](const std::vector<Face>& faces)
  {
    return std::any_of(faces.begin(), faces.end(),
      [&mesh](Face face)
      {
        const Halfedge h = mesh.halfedge(face);
        return mesh.is_border(mesh.opposite(h)) || mesh.is_border(mesh.opposite(mesh.next(h))) ||
          mesh.is_border(mesh.opposite(mesh.prev(h)));
      });
  };
  const auto wasSplit = [this, &mesh](const std::vector<Face>& faces)
  {
    return std::any_of(faces.begin(), faces.end(),
      [this, &mesh](Face face)
      {
        int corners = 0;
        for (const Vertex corner : GetCorners(mesh, face))
        {
          corners += this->Surface->Split[corner];
        }
        return corners > 1;
      });
  };
  const Components components(mesh);
  const auto smaller = [](const std::vector<Face>& a, const std::vector<Face>& b)
  { return a.size() < b.size(); };
  const auto largest = std::max_element(components.Faces.begin(), components.Faces.end(), smaller);
  vtkIdType dropped = 0;
  for (auto faces = components.Faces.begin(); faces != components.Faces.end(); ++faces)
  {
    if (faces != largest && isOpen(*faces) && wasSplit(*faces) &&
      GetRadius(mesh, GetVertices(mesh, *faces)) <= size)
    {
      for (const Face face : *faces)
      {
        CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
      }
      dropped += static_cast<vtkIdType>(faces->size());
    }
  }
  mesh.collect_garbage();
  return dropped;
}

//------------------------------------------------------------------------------
vtkIdType ManifoldRepair::FillHoles(double size, const Monitor& monitor)
{
  Mesh& mesh = this->Surface->Triangles;
  const Components components(mesh);
  std::map<std::size_t, double> radii;
  vtkIdType filled = 0;
  for (const Halfedge border : FindBorders(mesh))
  {
    std::vector<Vertex> vertices;
    for (const Halfedge h : mesh.halfedges_around_face(border))
    {
      vertices.push_back(mesh.target(h));
    }
    const double radius = GetRadius(mesh, vertices);
    if (radius > size)
    {
      continue;
    }
    const std::size_t component = components.OfFace[mesh.face(mesh.opposite(border))];
    const auto inserted = radii.emplace(component, 0.0);
    if (inserted.second)
    {
      inserted.first->second = GetRadius(mesh, GetVertices(mesh, components.Faces[component]));
    }
    if (radius <= 0.5 * inserted.first->second)
    {
      const std::vector<Face> added = TriangulateHole(mesh, border, monitor);
      TakeIdsOfNeighbours(*this->Surface, added);
      filled += !added.empty();
    }
  }
  return filled;
}

//------------------------------------------------------------------------------
ManifoldRepair::Intersections ManifoldRepair::FindSelfIntersections(const Monitor& monitor)
{
  const Components components(this->Surface->Triangles);
  this->Surface->Replaced.assign(components.Faces.size(), false);
  this->Surface->Replacements.clear();
  this->Surface->Within = FindIntersections(this->Surface->Triangles, monitor);
  const auto between = [&components](const Pair& pair)
  { return components.OfFace[pair.first] != components.OfFace[pair.second]; };
  std::vector<Pair>& within = this->Surface->Within;
  const std::size_t size = within.size();
  within.erase(std::remove_if(within.begin(), within.end(), between), within.end());
  Intersections result = this->DescribeIntersections();
  result.NumberBetween = static_cast<vtkIdType>(size - within.size());
  return result;
}

//------------------------------------------------------------------------------
ManifoldRepair::Intersections ManifoldRepair::DescribeIntersections() const
{
  Intersections result;
  const std::vector<Pair>& pairs = this->Surface->Within;
  if (!pairs.empty())
  {
    const Mesh& mesh = this->Surface->Triangles;
    const CGAL::Bbox_3 a = GetTriangle(mesh, pairs[0].first).bbox();
    const CGAL::Bbox_3 b = GetTriangle(mesh, pairs[0].second).bbox();
    for (int i = 0; i < 3; ++i)
    {
      result.Place[i] = 0.5 * (std::max(a.min(i), b.min(i)) + std::min(a.max(i), b.max(i)));
    }
    result.CellIds = { this->Surface->CellIds[pairs[0].first],
      this->Surface->CellIds[pairs[0].second] };
    result.NumberWithin = static_cast<vtkIdType>(pairs.size());
  }
  return result;
}

//------------------------------------------------------------------------------
Outcome ManifoldRepair::ResolveSelfIntersections(double distance, const Monitor& monitor,
  Intersections& left)
{
  const Components components(this->Surface->Triangles);
  std::vector<bool> tried(components.Faces.size(), false);
  std::vector<bool>& replaced = this->Surface->Replaced;
  for (const Pair& pair : this->Surface->Within)
  {
    const std::size_t component = components.OfFace[pair.first];
    if (!tried[component])
    {
      tried[component] = true;
      RepairMesh old;
      Heartbeat heart(monitor);
      Extract(*this->Surface, components.Faces[component], heart, old);
      auto part = std::make_unique<RepairMesh>();
      Extract(*this->Surface, components.Faces[component], heart, *part);
      if (Resolve(part->Triangles, distance, heart, monitor))
      {
        TakeNearestIds(*part, old, heart);
        replaced[component] = true;
        this->Surface->Replacements.push_back(std::move(part));
      }
    }
  }
  std::vector<Pair>& within = this->Surface->Within;
  const auto resolved = [&](const Pair& pair) { return replaced[components.OfFace[pair.first]]; };
  within.erase(std::remove_if(within.begin(), within.end(), resolved), within.end());
  left = this->DescribeIntersections();
  return monitor.Check(1.0);
}

//------------------------------------------------------------------------------
void ManifoldRepair::Write(TriangleSoup& soup) const
{
  const Components components(this->Surface->Triangles);
  std::vector<Face> faces;
  for (const Face face : this->Surface->Triangles.faces())
  {
    const std::size_t component = components.OfFace[face];
    if (component >= this->Surface->Replaced.size() || !this->Surface->Replaced[component])
    {
      faces.push_back(face);
    }
  }
  soup.Points.clear();
  soup.PointIds.clear();
  soup.SplitPoints.clear();
  soup.Triangles.clear();
  soup.CellIds.clear();
  Append(*this->Surface, faces, soup);
  for (const auto& part : this->Surface->Replacements)
  {
    Append(*part, GetFaces(part->Triangles), soup);
  }
}
} // namespace LightTransport
