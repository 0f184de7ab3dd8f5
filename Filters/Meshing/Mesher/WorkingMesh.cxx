// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Mesher/WorkingMesh.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace LightTransport
{
//------------------------------------------------------------------------------
WorkingMesh::WorkingMesh()
{
  this->FindMaps();
}

//------------------------------------------------------------------------------
WorkingMesh::WorkingMesh(const WorkingMesh& other) : Mesh(other.Mesh)
{
  // The copied maps belong to the copied mesh; only their handles must be found again.
  this->FindMaps();
}

//------------------------------------------------------------------------------
void WorkingMesh::FindMaps()
{
  const std::size_t none = SourceSurface::None;
  this->Kept = this->Mesh.add_property_map<Edge, bool>("e:kept", false).first;
  this->Parts = this->Mesh.add_property_map<Face, std::size_t>("f:part", none).first;
  this->Sources = this->Mesh.add_property_map<Face, std::size_t>("f:source", none).first;
  this->Long = this->Mesh.add_property_map<Face, bool>("f:long", false).first;
  this->Ceilings = this->Mesh.add_property_map<Face, double>("f:ceiling", 0.0).first;
  this->Lengths = this->Mesh.add_property_map<Vertex, double>("v:length", 0.0).first;
  this->Fixed = this->Mesh.add_property_map<Vertex, bool>("v:fixed", false).first;
  this->OnLadder = this->Mesh.add_property_map<Vertex, bool>("v:ladder", false).first;
  this->Origins = this->Mesh.add_property_map<Vertex, std::size_t>("v:origin", none).first;
  this->Places = this->Mesh.add_property_map<Vertex, SourceSurface::Place>("v:place").first;
}

//------------------------------------------------------------------------------
WorkingMesh::Vector WorkingMesh::GetVector(Halfedge h) const
{
  return this->Mesh.point(this->Mesh.target(h)) - this->Mesh.point(this->Mesh.source(h));
}

//------------------------------------------------------------------------------
double WorkingMesh::GetLength(Edge edge) const
{
  return std::sqrt(this->GetVector(this->Mesh.halfedge(edge)).squared_length());
}

//------------------------------------------------------------------------------
double WorkingMesh::GetWantedLength(Edge edge) const
{
  return 0.5 *
    (this->Lengths[this->Mesh.vertex(edge, 0)] + this->Lengths[this->Mesh.vertex(edge, 1)]);
}

//------------------------------------------------------------------------------
WorkingMesh::Vector WorkingMesh::GetNormal(Face face) const
{
  const Halfedge h = this->Mesh.halfedge(face);
  return CGAL::cross_product(this->GetVector(h), this->GetVector(this->Mesh.next(h)));
}

//------------------------------------------------------------------------------
bool WorkingMesh::IsStraight(Vertex vertex) const
{
  std::vector<Vector> kept;
  for (const Halfedge h : this->Mesh.halfedges_around_target(this->Mesh.halfedge(vertex)))
  {
    if (this->Kept[this->Mesh.edge(h)])
    {
      kept.push_back(this->GetVector(h));
    }
  }
  const double tolerance = 1e-10;
  return kept.size() == 2 && kept[0] * kept[1] < 0.0 &&
    CGAL::cross_product(kept[0], kept[1]).squared_length() <=
    tolerance * tolerance * kept[0].squared_length() * kept[1].squared_length();
}

//------------------------------------------------------------------------------
WorkingMesh::Vertex WorkingMesh::Split(Halfedge h, const Point& point)
{
  Surface& mesh = this->Mesh;
  const bool kept = this->Kept[mesh.edge(h)];
  const Halfedge first = CGAL::Euler::split_edge(h, mesh);
  const Vertex vertex = mesh.target(first);
  mesh.point(vertex) = point;
  this->Kept[mesh.edge(first)] = kept;
  this->Fixed[vertex] = kept;
  const Halfedge back = mesh.opposite(h);
  const std::array<std::pair<Halfedge, Halfedge>, 2> sides{ { { first, mesh.next(h) },
    { back, mesh.next(mesh.next(back)) } } };
  for (const auto& side : sides)
  {
    if (mesh.is_border(side.first))
    {
      continue;
    }
    const Face old = mesh.face(side.first);
    const std::size_t part = this->Parts[old];
    const std::size_t source = this->Sources[old];
    const bool isLong = this->Long[old];
    const double ceiling = this->Ceilings[old];
    const Halfedge cut = CGAL::Euler::split_face(side.first, side.second, mesh);
    for (const Face face : { mesh.face(cut), mesh.face(mesh.opposite(cut)) })
    {
      this->Parts[face] = part;
      this->Sources[face] = source;
      this->Long[face] = isLong;
      this->Ceilings[face] = ceiling;
    }
  }
  return vertex;
}
} // namespace LightTransport
