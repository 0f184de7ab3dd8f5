// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The quadtree of an atlas, over a surface and over the square of the texels at once: every node is
 * a piece of the surface, connected where the surface is, and a square block of texels. Blocks are
 * quartered, pieces are bisected twice into parts of about equal area, so that a block has its
 * share of the texels without any packing. A leaf is a chart: a piece that is a disc, mapped onto
 * its whole block.
 */
#ifndef AtlasQuadtree_h
#define AtlasQuadtree_h

#include "Atlas/AtlasSurface.h"
#include "Atlas/SquareMap.h"
#include "Shared/Outcome.h"

#include <array>
#include <string>
#include <vector>

namespace LightTransport
{
class AtlasQuadtree
{
public:
  struct Node
  {
    int Parent = -1;
    /// The block, in texels of the finest level.
    int X = 0;
    int Y = 0;
    int Size = 0;
    double Area = 0.0;
    int Chart = -1;
    /// Emptied when the node is divided.
    std::vector<int> Faces;
  };
  struct Chart
  {
    int Node = -1;
    SquareMap::Disc Disc; ///< its sources are faces of the surface
    /// The point of the surface that each of the first points of the disc is.
    std::vector<std::size_t> Points;
    /// Within the square of the whole atlas, [0,1]^2.
    std::vector<SquareMap::Coordinates> Coordinates;
    double L2Stretch = 0.0;
  };

  /// The surface must outlive the tree; `resolution` is a power of two.
  AtlasQuadtree(const AtlasSurface& surface, int resolution, double maximumStretch);

  /// Divide the surface until all leaves are charts. Fails when the resolution is too small. The
  /// watch hears the share of the surface that is done.
  Outcome Build(Watch& watch);

  /// Parents come before their children.
  const std::vector<Node>& GetNodes() const { return this->Nodes; }
  const std::vector<Chart>& GetCharts() const { return this->Charts; }

private:
  struct Piece
  {
    std::vector<int> Faces;
    /// The share of all texels that belongs to the piece.
    double TexelShare;
    /// Whether its block is so small that shares no longer matter.
    bool IsLast;
  };

  Outcome FindNodesToDivide(const std::vector<int>& level, std::vector<int>& others,
    const Watch& watch);
  bool MakeChart(const Node& node, Chart& chart, std::string& problem, const Watch& watch);
  bool Place(const Node& node, const SquareMap& map, Chart& chart) const;
  bool IsFlatEnough(const std::vector<int>& faces) const;
  double GetArea(const std::vector<int>& faces) const;
  std::vector<Piece> Bisect(const std::vector<Piece>& pieces, const Watch& watch);
  std::vector<int> Divide(const std::vector<int>& nodes, const Watch& watch);

  const AtlasSurface& Surface;
  int Resolution;
  double MaximumStretch;
  std::vector<Node> Nodes;
  std::vector<Chart> Charts;
  /// The piece that each face belongs to, and its number within the piece.
  std::vector<int> Owners;
  std::vector<int> Local;
  int NumberOfPieces = 0;
};
} // namespace LightTransport

#endif
