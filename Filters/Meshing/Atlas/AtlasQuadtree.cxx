// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasQuadtree.h"

#include "Atlas/ChartDisc.h"
#include "Atlas/SurfaceBisection.h"
#include "Shared/Threads.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <numeric>
#include <sstream>
#include <utility>

namespace LightTransport
{
namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Stretch is no reason to divide a block that is this small or a piece of so few faces: what is
// gained in stretch is lost in texels at borders.
constexpr int SmallestBlock = 8;
constexpr std::size_t FewestFaces = 16;

// Maps cost more than in proportion to their faces, so that a piece of more of them is divided
// before any map is tried.
constexpr std::size_t MostFaces = 50000;

// The texels per area of a node may differ by this factor from those of the whole surface.
constexpr double LargestDensity = 1.5;

// A piece is not even tried as a chart when its mean normal is shorter than this (a hemisphere has
// one half), or when it has more holes and handles than this.
constexpr double ShortestMeanNormal = 0.35;
constexpr int LeastEulerCharacteristic = -2;

//------------------------------------------------------------------------------
// Call work(i) for all i < size on threads.
template <typename Work>
void ForEach(std::size_t size, const Work& work)
{
  const auto run = [&](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType i = first; i < last; ++i)
    {
      work(static_cast<std::size_t>(i));
    }
  };
  Threads::For(0, static_cast<vtkIdType>(size), 1, run);
}
} // namespace

//------------------------------------------------------------------------------
AtlasQuadtree::AtlasQuadtree(const AtlasSurface& surface, int resolution, double maximumStretch)
  : Surface(surface), Resolution(resolution), MaximumStretch(maximumStretch), Nodes(1),
    Owners(surface.GetNumberOfFaces(), 0), Local(surface.GetNumberOfFaces()), NumberOfPieces(1)
{
  Node& root = this->Nodes.front();
  root.Size = resolution;
  root.Area = surface.Area;
  root.Faces.resize(surface.GetNumberOfFaces());
  std::iota(root.Faces.begin(), root.Faces.end(), 0);
}

//------------------------------------------------------------------------------
Outcome AtlasQuadtree::Build(Watch& watch)
{
  std::vector<int> level(1, 0);
  double done = 0.0;
  while (!level.empty())
  {
    watch.Report(done / this->Surface.Area);
    const std::size_t first = this->Charts.size();
    std::vector<int> divided;
    if (Outcome found = this->FindNodesToDivide(level, divided, watch); !found)
    {
      return found;
    }
    for (std::size_t chart = first; chart < this->Charts.size(); ++chart)
    {
      done += this->Nodes[this->Charts[chart].Node].Area;
    }
    watch.Report(done / this->Surface.Area);
    level = this->Divide(divided, watch);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Make charts of the nodes that can be charts, and find the others.
Outcome AtlasQuadtree::FindNodesToDivide(const std::vector<int>& level, std::vector<int>& others,
  const Watch& watch)
{
  std::vector<Chart> charts(level.size());
  std::vector<char> made(level.size(), 0);
  std::vector<std::string> problems(level.size());
  ForEach(level.size(),
    [&](std::size_t i)
    { made[i] = this->MakeChart(this->Nodes[level[i]], charts[i], problems[i], watch); });

  for (std::size_t i = 0; i < level.size(); ++i)
  {
    Node& node = this->Nodes[level[i]];
    if (made[i])
    {
      charts[i].Node = level[i];
      node.Chart = static_cast<int>(this->Charts.size());
      this->Charts.push_back(std::move(charts[i]));
    }
    else if (node.Size == 1)
    {
      const auto& center = this->Surface.Centers[node.Faces.front()];
      std::ostringstream text;
      text << "Resolution " << this->Resolution << " leaves no texels for the surface near ("
           << center[0] << ", " << center[1] << ", " << center[2] << "), where " << problems[i]
           << ": double the Resolution, or remove such parts.";
      return Outcome::Failed(text.str());
    }
    else
    {
      others.push_back(level[i]);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool AtlasQuadtree::MakeChart(const Node& node, Chart& chart, std::string& problem,
  const Watch& watch)
{
  ChartDisc piece(this->Surface, node.Faces, this->Owners, this->Local, watch);
  if (piece.GetNumberOfComponents() > 1)
  {
    problem = std::to_string(piece.GetNumberOfComponents()) + " separate parts are too small";
    return false;
  }
  if (piece.IsClosed())
  {
    problem = "a closed part is too small to be cut open";
    return false;
  }
  const bool last = node.Size <= SmallestBlock || node.Faces.size() < FewestFaces;
  if (!last &&
    (node.Faces.size() > MostFaces || !this->IsFlatEnough(node.Faces) ||
      piece.GetEulerCharacteristic() < LeastEulerCharacteristic))
  {
    return false;
  }
  if (piece.GetEulerCharacteristic() < 1)
  {
    piece.Slit();
  }
  if (piece.GetNumberOfBorderEdges() < 4)
  {
    piece.SlitOneEdge();
  }
  chart.Disc = piece.GetDisc();
  chart.Points = piece.GetPoints();
  SquareMap map;
  if (!map.Map(chart.Disc, problem, watch))
  {
    return false;
  }
  if (!this->Place(node, map, chart))
  {
    problem = "triangles are too thin for double precision";
    return false;
  }
  chart.L2Stretch = map.GetL2Stretch();
  for (std::size_t& source : chart.Disc.Sources)
  {
    source = static_cast<std::size_t>(node.Faces[source]);
  }
  return last || map.GetL2Stretch() <= this->MaximumStretch;
}

//------------------------------------------------------------------------------
// The map is scaled down and shifted to the block: no triangle may be lost by that.
bool AtlasQuadtree::Place(const Node& node, const SquareMap& map, Chart& chart) const
{
  chart.Coordinates = map.GetCoordinates();
  for (SquareMap::Coordinates& uv : chart.Coordinates)
  {
    uv = { (node.X + uv[0] * node.Size) / this->Resolution,
      (node.Y + uv[1] * node.Size) / this->Resolution };
  }
  const auto get = [&chart](std::size_t point)
  { return Kernel::Point_2(chart.Coordinates[point][0], chart.Coordinates[point][1]); };
  return std::all_of(chart.Disc.Triangles.begin(), chart.Disc.Triangles.end(),
    [&get](const TriangleSoup::Triangle& t)
    { return CGAL::orientation(get(t[0]), get(t[1]), get(t[2])) == CGAL::LEFT_TURN; });
}

//------------------------------------------------------------------------------
bool AtlasQuadtree::IsFlatEnough(const std::vector<int>& faces) const
{
  AtlasSurface::Vector sum = AtlasSurface::Vector::Zero();
  for (const int face : faces)
  {
    sum += this->Surface.Areas[face] * this->Surface.Normals[face];
  }
  return sum.norm() >= ShortestMeanNormal * this->GetArea(faces);
}

//------------------------------------------------------------------------------
double AtlasQuadtree::GetArea(const std::vector<int>& faces) const
{
  double area = 0.0;
  for (const int face : faces)
  {
    area += this->Surface.Areas[face];
  }
  return area;
}

//------------------------------------------------------------------------------
// Replace each piece by its two halves, one of which may be empty.
std::vector<AtlasQuadtree::Piece> AtlasQuadtree::Bisect(const std::vector<Piece>& pieces,
  const Watch& watch)
{
  std::vector<std::array<std::vector<int>, 2>> halves(pieces.size());
  ForEach(pieces.size(),
    [&](std::size_t i)
    {
      watch.Check();
      const Piece& piece = pieces[i];
      if (piece.Faces.size() < 2)
      {
        halves[i][0] = piece.Faces;
        return;
      }
      // Area is compared with the piece's share of the texels.
      const double density = this->GetArea(piece.Faces) / (this->Surface.Area * piece.TexelShare);
      const double share = piece.IsLast
        ? 0.0
        : std::min(0.49,
            std::max(0.5 / (LargestDensity * density), 1.0 - 0.5 * LargestDensity / density));
      SurfaceBisection bisection(this->Surface, this->Owners, this->Local, watch);
      halves[i] = bisection.Divide(piece.Faces, share, density);
    });
  std::vector<Piece> result;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    for (std::vector<int>& half : halves[i])
    {
      for (const int face : half)
      {
        this->Owners[face] = this->NumberOfPieces;
      }
      ++this->NumberOfPieces;
      result.push_back({ std::move(half), 0.5 * pieces[i].TexelShare, pieces[i].IsLast });
    }
  }
  return result;
}

//------------------------------------------------------------------------------
// Quarter the nodes; returns their children.
std::vector<int> AtlasQuadtree::Divide(const std::vector<int>& nodes, const Watch& watch)
{
  std::vector<Piece> pieces;
  for (const int node : nodes)
  {
    const double side = static_cast<double>(this->Nodes[node].Size) / this->Resolution;
    pieces.push_back(
      { std::move(this->Nodes[node].Faces), side * side, this->Nodes[node].Size <= SmallestBlock });
  }
  pieces = this->Bisect(this->Bisect(pieces, watch), watch);

  std::vector<int> children;
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (pieces[i].Faces.empty())
    {
      continue;
    }
    const int parent = nodes[i / 4];
    Node child;
    child.Parent = parent;
    child.Size = this->Nodes[parent].Size / 2;
    child.X = this->Nodes[parent].X + (i & 2 ? child.Size : 0);
    child.Y = this->Nodes[parent].Y + (i & 1 ? child.Size : 0);
    child.Area = this->GetArea(pieces[i].Faces);
    child.Faces = std::move(pieces[i].Faces);
    children.push_back(static_cast<int>(this->Nodes.size()));
    this->Nodes.push_back(std::move(child));
  }
  return children;
}
} // namespace LightTransport
