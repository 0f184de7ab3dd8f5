// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The halfedge mesh that IsotropicRemesher changes step by step, with all that it knows.
#ifndef WorkingMesh_h
#define WorkingMesh_h

#include "Mesher/SourceSurface.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace LightTransport
{
struct WorkingMesh
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  using Vector = Kernel::Vector_3;
  using Surface = CGAL::Surface_mesh<Point>;
  using Vertex = Surface::Vertex_index;
  using Halfedge = Surface::Halfedge_index;
  using Edge = Surface::Edge_index;
  using Face = Surface::Face_index;
  template <typename Key, typename Value>
  using Map = Surface::Property_map<Key, Value>;

  WorkingMesh();
  WorkingMesh(const WorkingMesh& other);
  void operator=(const WorkingMesh&) = delete;

  Surface Mesh;
  /// The edges to keep.
  Map<Edge, bool> Kept;
  /// The part of the surface that each face belongs to.
  Map<Face, std::size_t> Parts;
  /// The triangle of the soup that each face comes from; of no meaning once places are known.
  Map<Face, std::size_t> Sources;
  /// Whether that triangle is long.
  Map<Face, bool> Long;
  /// The length that edges may have inside this face, if longer than those at its corners.
  Map<Face, double> Ceilings;
  /// The length that edges should have at each vertex.
  Map<Vertex, double> Lengths;
  /// Whether the vertex is on an edge to keep, and so must stay where it is.
  Map<Vertex, bool> Fixed;
  /// Whether the vertex is an end of a rung of a ladder: see IsotropicRemesher::Prepare().
  Map<Vertex, bool> OnLadder;
  /// The point of the original surface that a fixed vertex is, and the place of the others.
  Map<Vertex, std::size_t> Origins;
  Map<Vertex, SourceSurface::Place> Places;

  /// The vector from the start of a halfedge to its end.
  Vector GetVector(Halfedge h) const;
  double GetLength(Edge edge) const;
  /// The length that an edge should have.
  double GetWantedLength(Edge edge) const;
  /// Twice the area times the unit normal.
  Vector GetNormal(Face face) const;
  /// Whether a vertex has two edges to keep that lie on one line.
  bool IsStraight(Vertex vertex) const;

  /**
   * Put a new vertex on an edge, which cuts the faces beside it in two. Their properties are
   * inherited, those of the vertex (but Fixed) left to the caller. The half of the edge that ends
   * where `h` does keeps its index.
   */
  Vertex Split(Halfedge h, const Point& point);

private:
  void FindMaps();
};
} // namespace LightTransport

#endif
