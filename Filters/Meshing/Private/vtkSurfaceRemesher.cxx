// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSurfaceRemesher.h"

#include "vtkMath.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{
namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using KeptEdges = Mesh::Property_map<Mesh::Edge_index, bool>;
using FaceParts = Mesh::Property_map<Mesh::Face_index, std::size_t>;

constexpr std::size_t NONE = std::numeric_limits<std::size_t>::max();

// Edges up to this multiple of the target length may stay: the remesher ends only if no edge that
// it must keep is longer. A little less, since halving a length is not exact.
constexpr double LONGEST_KEPT_EDGE = 4.0 / 3.0 * (1.0 - 1e-6);

struct Interrupted
{
};

//------------------------------------------------------------------------------
// The points of the mesh for the remesher. It has no hook to report or to stop, but it looks up
// points all the time; so the look-ups are counted.
class MonitoredPoints
{
public:
  using Points = Mesh::Property_map<Mesh::Vertex_index, Kernel::Point_3>;
  using key_type = Mesh::Vertex_index;
  using value_type = Kernel::Point_3;
  using reference = const Kernel::Point_3&;
  using category = boost::read_write_property_map_tag;

  struct Counter
  {
    const vtkSurfaceRemesher::Monitor* Monitor;
    double ExpectedLookUps;
    std::size_t Interval;
    std::size_t LookUps = 0;
  };

  MonitoredPoints() = default;
  MonitoredPoints(const Points& points, Counter* counter) : Map(points), Count(counter) {}

  friend reference get(const MonitoredPoints& map, Mesh::Vertex_index vertex)
  {
    if (++map.Count->LookUps % map.Count->Interval == 0)
    {
      const double fraction = map.Count->LookUps / map.Count->ExpectedLookUps;
      if (!(*map.Count->Monitor)(std::min(fraction, 1.0)))
      {
        throw Interrupted();
      }
    }
    return get(map.Map, vertex);
  }
  friend void put(const MonitoredPoints& map, Mesh::Vertex_index vertex,
    const Kernel::Point_3& point)
  {
    put(map.Map, vertex, point);
  }

private:
  Points Map;
  Counter* Count = nullptr;
};

//------------------------------------------------------------------------------
Kernel::Vector_3 GetNormal(const Mesh& mesh, Mesh::Face_index face)
{
  const Mesh::Halfedge_index h = mesh.halfedge(face);
  const Kernel::Point_3& p = mesh.point(mesh.source(h));
  return CGAL::cross_product(mesh.point(mesh.target(h)) - p,
    mesh.point(mesh.target(mesh.next(h))) - p);
}

//------------------------------------------------------------------------------
// Whether the normals at an edge differ by more than the angle with this cosine.
bool IsSharp(const Mesh& mesh, Mesh::Face_index a, Mesh::Face_index b, double cosine)
{
  const Kernel::Vector_3 m = GetNormal(mesh, a);
  const Kernel::Vector_3 n = GetNormal(mesh, b);
  const double lengths = std::sqrt(m.squared_length() * n.squared_length());
  // Rounding must not make an edge within a plane sharp.
  const double tolerance = 1e-12;
  return m * n < (cosine - tolerance) * lengths;
}
} // namespace

//------------------------------------------------------------------------------
struct vtkSurfaceRemesher::Internals
{
  Mesh Triangles;
  KeptEdges Kept;
  FaceParts Parts;
  double Area = 0.0;
  double LengthOfKeptEdges = 0.0;
};

//------------------------------------------------------------------------------
vtkSurfaceRemesher::vtkSurfaceRemesher() : Surface(new Internals) {}

//------------------------------------------------------------------------------
vtkSurfaceRemesher::~vtkSurfaceRemesher() = default;

//------------------------------------------------------------------------------
bool vtkSurfaceRemesher::Build(const vtkTriangleSoup& soup, const std::vector<int>& regions,
  double featureAngle)
{
  Mesh& mesh = this->Surface->Triangles;
  std::vector<Mesh::Vertex_index> vertices(soup.Points.size());
  for (const vtkTriangleSoup::Triangle& triangle : soup.Triangles)
  {
    for (const std::size_t corner : triangle)
    {
      if (vertices[corner] == Mesh::null_vertex())
      {
        const vtkTriangleSoup::Point& point = soup.Points[corner];
        vertices[corner] = mesh.add_vertex(Kernel::Point_3(point[0], point[1], point[2]));
      }
    }
    // Faces are numbered as the triangles are: `regions` and PartsOfSoup rely on it.
    if (mesh.add_face(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]) ==
      Mesh::null_face())
    {
      return false;
    }
    this->Surface->Area += 0.5 * vtkMath::Norm(soup.GetNormal(triangle).data());
  }

  this->Surface->Kept = mesh.add_property_map<Mesh::Edge_index, bool>("e:kept", false).first;
  const double cosine = std::cos(vtkMath::RadiansFromDegrees(featureAngle));
  for (const Mesh::Edge_index edge : mesh.edges())
  {
    const Mesh::Face_index a = mesh.face(mesh.halfedge(edge, 0));
    const Mesh::Face_index b = mesh.face(mesh.halfedge(edge, 1));
    const bool kept =
      mesh.is_border(edge) || regions[a] != regions[b] || IsSharp(mesh, a, b, cosine);
    this->Surface->Kept[edge] = kept;
    if (kept)
    {
      this->Surface->LengthOfKeptEdges += std::sqrt(
        CGAL::squared_distance(mesh.point(mesh.vertex(edge, 0)), mesh.point(mesh.vertex(edge, 1))));
    }
  }
  this->PartsOfSoup.resize(soup.Triangles.size());
  return true;
}

//------------------------------------------------------------------------------
double vtkSurfaceRemesher::EstimateNumberOfTriangles(double targetEdgeLength) const
{
  const double areaOfTriangle = std::sqrt(3.0) / 4.0 * targetEdgeLength * targetEdgeLength;
  return this->Surface->Area / areaOfTriangle + this->Surface->LengthOfKeptEdges / targetEdgeLength;
}

//------------------------------------------------------------------------------
void vtkSurfaceRemesher::SplitKeptEdges(double targetEdgeLength)
{
  Mesh& mesh = this->Surface->Triangles;
  std::vector<Mesh::Edge_index> kept;
  for (const Mesh::Edge_index edge : mesh.edges())
  {
    if (this->Surface->Kept[edge])
    {
      kept.push_back(edge);
    }
  }
  PMP::split_long_edges(kept, LONGEST_KEPT_EDGE * targetEdgeLength, mesh,
    CGAL::parameters::edge_is_constrained_map(this->Surface->Kept));

  this->Surface->Parts = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:part", NONE).first;
  this->NumberOfParts = PMP::connected_components(mesh, this->Surface->Parts,
    CGAL::parameters::edge_is_constrained_map(this->Surface->Kept));
  // Splitting cuts pieces off a face but never removes it, so it still tells its part.
  for (std::size_t i = 0; i < this->PartsOfSoup.size(); ++i)
  {
    this->PartsOfSoup[i] = this->Surface->Parts[Mesh::Face_index(static_cast<Mesh::size_type>(i))];
  }
}

//------------------------------------------------------------------------------
bool vtkSurfaceRemesher::Remesh(double targetEdgeLength, int numberOfIterations,
  const Monitor& monitor)
{
  // Measured: 50 to 200 look-ups per triangle and iteration.
  const double lookUps = 100.0;
  Mesh& mesh = this->Surface->Triangles;
  const double numberOfReports = 200.0;
  MonitoredPoints::Counter counter;
  counter.Monitor = &monitor;
  counter.ExpectedLookUps =
    lookUps * numberOfIterations * this->EstimateNumberOfTriangles(targetEdgeLength);
  counter.Interval = 1 + static_cast<std::size_t>(counter.ExpectedLookUps / numberOfReports);
  try
  {
    PMP::isotropic_remeshing(mesh.faces(), targetEdgeLength, mesh,
      CGAL::parameters::number_of_iterations(numberOfIterations)
        .protect_constraints(true)
        .edge_is_constrained_map(this->Surface->Kept)
        .face_patch_map(this->Surface->Parts)
        .vertex_point_map(MonitoredPoints(mesh.points(), &counter)));
  }
  catch (const Interrupted&)
  {
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkSurfaceRemesher::Result vtkSurfaceRemesher::GetResult() const
{
  const Mesh& mesh = this->Surface->Triangles;
  Result result;
  std::vector<std::size_t> indices(mesh.num_vertices(), NONE);
  for (const Mesh::Face_index face : mesh.faces())
  {
    vtkTriangleSoup::Triangle triangle;
    int corner = 0;
    for (const Mesh::Vertex_index vertex : mesh.vertices_around_face(mesh.halfedge(face)))
    {
      if (indices[vertex] == NONE)
      {
        const Kernel::Point_3& point = mesh.point(vertex);
        indices[vertex] = result.Points.size();
        result.Points.push_back({ point.x(), point.y(), point.z() });
      }
      triangle[corner++] = indices[vertex];
    }
    result.Triangles.push_back(triangle);
    result.Parts.push_back(this->Surface->Parts[face]);
  }
  return result;
}
