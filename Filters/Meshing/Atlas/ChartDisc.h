// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The topology of a piece of a surface, and the piece as a disc. A connected piece with a border
 * that is no disc, because of a hole or a handle, is made one by slits: points along them are there
 * twice. (All edges that a spanning tree over the faces does not cross cut the surface into a disc;
 * those on dangling branches are joined again.) Points at which parts of the piece only touch are
 * there once for each.
 */
#ifndef ChartDisc_h
#define ChartDisc_h

#include "Atlas/AtlasSurface.h"
#include "Atlas/SquareMap.h"

#include <array>
#include <cstddef>
#include <vector>

namespace LightTransport
{
class ChartDisc
{
public:
  /// `owners` tells the piece that each face of the surface belongs to; `local` is room for one
  /// number per face, of which those of this piece are used. All but the watch must outlive this.
  ChartDisc(const AtlasSurface& surface, const std::vector<int>& faces,
    const std::vector<int>& owners, std::vector<int>& local, const Watch& watch);

  int GetNumberOfComponents() const { return this->NumberOfComponents; }
  bool IsClosed() const { return this->NumberOfBorderEdges == 0; }
  /// Euler characteristic: 1 for a disc, less by one for every hole and by two for every handle.
  int GetEulerCharacteristic() const { return this->EulerCharacteristic; }

  int GetNumberOfBorderEdges() const { return this->NumberOfBorderEdges; }

  /// Cut a connected piece with a border into a disc.
  void Slit();
  /// Cut a disc along one edge from its border inwards, if it has points inside: that lengthens the
  /// border by two edges. A square needs four.
  void SlitOneEdge();

  /// The piece; a disc when it is connected and its Euler characteristic is 1.
  SquareMap::Disc GetDisc() const;
  /// The point of the surface that each point of the disc is.
  const std::vector<std::size_t>& GetPoints() const { return this->Points; }

private:
  void NumberPoints();
  std::vector<bool> FindBorderPoints(const std::vector<std::array<int, 3>>& neighbors) const;
  std::vector<int> FindFacesFromInside() const;
  void CutAllButTree();
  void JoinDanglingCuts();
  int GetOppositeEdge(int face, int edge) const;

  const AtlasSurface& Surface;
  const std::vector<int>& Faces;
  /// Within the piece; -1 across its border and across cuts.
  std::vector<std::array<int, 3>> Neighbors;
  /// The same without regard to cuts.
  std::vector<std::array<int, 3>> UncutNeighbors;
  std::vector<TriangleSoup::Triangle> Corners;
  std::vector<std::size_t> Points;
  int NumberOfComponents = 0;
  int NumberOfBorderEdges = 0;
  int EulerCharacteristic = 0;
};
} // namespace LightTransport

#endif
