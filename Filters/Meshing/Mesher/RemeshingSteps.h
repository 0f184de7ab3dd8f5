// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The steps that isotropic remeshing repeats (Botsch and Kobbelt, "A Remeshing Approach to
 * Multiresolution Modeling", 2004; with a length per vertex: Dunyach et al., "Adaptive remeshing
 * for real-time mesh deformation", 2013): split long edges, collapse short ones, flip edges, move
 * vertices along the surface.
 *
 * Edges to keep are never split or flipped, and collapsed only along a straight line. No step turns
 * a triangle over.
 */
#ifndef RemeshingSteps_h
#define RemeshingSteps_h

#include "Mesher/SourceSurface.h"
#include "Mesher/WorkingMesh.h"
#include "Shared/Monitor.h"

#include <vector>

namespace LightTransport
{
class RemeshingSteps
{
public:
  /// `lengths` are those of the points of `sources`. The monitor is asked now and then.
  RemeshingSteps(WorkingMesh& mesh, const SourceSurface& sources,
    const std::vector<double>& lengths, Monitor monitor);

  /// Tell the monitor how much is done. False when it is to stop, as of all steps below.
  bool Report(double fraction);

  /// Split edges longer than `longest` times the wanted length, up to `most` faces.
  bool SplitLongEdges(double longest, std::size_t most);
  /// Collapse edges shorter than `shortest` times the wanted length, down to `fewest` faces.
  bool CollapseShortEdges(double shortest, std::size_t fewest);
  /// Flip edges until all are Delaunay, or flat enough no more.
  bool FlipEdges();
  bool MoveVertices();

  /// The triangle of `sources` that is closest to the center of a face.
  std::size_t FindSource(WorkingMesh::Face face) const;

private:
  using Vertex = WorkingMesh::Vertex;
  using Halfedge = WorkingMesh::Halfedge;
  using Edge = WorkingMesh::Edge;
  using Face = WorkingMesh::Face;
  using Point = WorkingMesh::Point;
  using Vector = WorkingMesh::Vector;

  double GetRatio(Edge edge) const;
  SourceSurface::Place Find(Vertex start, std::size_t part, const Point& position) const;
  void Put(Vertex vertex, const SourceSurface::Place& place);
  bool CanSplit(Halfedge h, const Point& to) const;
  /// The halfedge whose start may be moved into its end; none if the edge must stay.
  Halfedge FindCollapse(Edge edge) const;
  bool CanCollapse(Halfedge h) const;
  Vertex Collapse(Halfedge h);
  bool ShouldFlip(Edge edge) const;
  bool CanMove(Vertex vertex, const Point& to) const;
  void Move(Vertex vertex);
  bool CountStep();

  WorkingMesh& Work;
  WorkingMesh::Surface& Mesh;
  const SourceSurface& Sources;
  const std::vector<double>& Lengths;
  Monitor Watcher;
  double Fraction = 0.0;
  std::size_t Steps = 0;
};
} // namespace LightTransport

#endif
