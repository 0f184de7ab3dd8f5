// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What vtkSurfaceAtlas promises of every surface, proved from its outputs alone.
#ifndef SurfaceAtlasChecks_h
#define SurfaceAtlasChecks_h

#include "AtlasTestTools.h"

#include "vtkAtlasToSurface.h"
#include "vtkExecutive.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkSMPTools.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <set>

namespace atlasTest
{
using meshTest::Checker;
using Surface = vtkSmartPointer<vtkPolyData>;

//------------------------------------------------------------------------------
/// Numbers things that are equal alike, in the order of their first appearance.
template <typename Key>
class Numbers
{
public:
  int operator()(const Key& key)
  {
    return this->Known.emplace(key, static_cast<int>(this->Known.size())).first->second;
  }
  int GetSize() const { return static_cast<int>(this->Known.size()); }

private:
  std::map<Key, int> Known;
};

//------------------------------------------------------------------------------
/// Sets that are joined one by one.
class Sets
{
public:
  explicit Sets(std::size_t size) : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0);
  }
  int Find(int i)
  {
    while (this->Parents[i] != i)
    {
      this->Parents[i] = this->Parents[this->Parents[i]];
      i = this->Parents[i];
    }
    return i;
  }
  void Join(int i, int j) { this->Parents[this->Find(i)] = this->Find(j); }

private:
  std::vector<int> Parents;
};

//------------------------------------------------------------------------------
inline std::array<vtkIdType, 3> GetCorners(vtkPolyData* mesh, vtkIdType cell)
{
  vtkIdType size;
  const vtkIdType* ids;
  mesh->GetCellPoints(cell, size, ids);
  return { ids[0], ids[1], ids[2] };
}

//------------------------------------------------------------------------------
/// The same cells, with points of equal coordinates one.
inline Surface MergePoints(vtkPolyData* mesh)
{
  Numbers<Vector> numbers;
  std::vector<vtkIdType> merged(mesh->GetNumberOfPoints());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const Vector point = meshTest::GetPoint(mesh, i);
    merged[i] = numbers(point);
    if (merged[i] == points->GetNumberOfPoints())
    {
      points->InsertNextPoint(point.data());
    }
  }
  vtkNew<vtkCellArray> cells;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    mesh->GetCellPoints(cell, size, ids);
    cells->InsertNextCell(static_cast<int>(size));
    for (vtkIdType i = 0; i < size; ++i)
    {
      cells->InsertCellPoint(merged[ids[i]]);
    }
  }
  auto result = Surface::New();
  result->SetPoints(points);
  result->SetPolys(cells);
  return result;
}

//------------------------------------------------------------------------------
/// A row of the table "Charts".
struct Node
{
  int Chart;
  int Parent;
  int Level;
  int X;
  int Y;
  int Size;
  double SurfaceArea;
  double Stretch;
};

//------------------------------------------------------------------------------
/// The outputs of one run, in a form to look into.
struct Atlas
{
  Surface Input;
  Surface Output;
  vtkSmartPointer<vtkTable> Table;
  vtkSmartPointer<vtkImageData> Maps;
  std::string Errors;

  int Resolution = 0;
  std::vector<Node> Nodes;
  /// The row of each chart.
  std::vector<int> Rows;
  /// Of each cell.
  std::vector<int> Charts;
  std::vector<double> Areas;
  /// Of each point, u and v.
  std::vector<std::array<double, 2>> Coordinates;
};

//------------------------------------------------------------------------------
/// A linear function of position, which a point array of the input holds.
inline double GetLinear(const Vector& point)
{
  return 2.0 * point[0] - point[1] + 0.5 * point[2];
}

//------------------------------------------------------------------------------
/// Arrays whose values in the output are known.
inline void AddArrays(vtkPolyData* input)
{
  vtkNew<vtkDoubleArray> linear;
  linear->SetName("Linear");
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    linear->InsertNextValue(GetLinear(meshTest::GetPoint(input, i)));
  }
  input->GetPointData()->AddArray(linear);
  vtkNew<vtkIntArray> cells;
  cells->SetName("Cell");
  for (vtkIdType i = 0; i < input->GetNumberOfCells(); ++i)
  {
    cells->InsertNextValue(static_cast<int>(i));
  }
  input->GetCellData()->AddArray(cells);
  vtkNew<vtkDoubleArray> field;
  field->SetName("Field");
  field->InsertNextValue(7.0);
  input->GetFieldData()->AddArray(field);
}

//------------------------------------------------------------------------------
inline void ReadTable(Atlas& atlas)
{
  vtkTable* table = atlas.Table;
  const auto get = [table](vtkIdType row, const char* name)
  {
    auto column = vtkDataArray::SafeDownCast(table->GetColumnByName(name));
    return column ? column->GetTuple1(row) : vtkMath::Nan();
  };
  const auto getInteger = [&get](vtkIdType row, const char* name)
  { return static_cast<int>(get(row, name)); };
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    atlas.Nodes.push_back({ getInteger(row, "Chart"), getInteger(row, "Parent"),
      getInteger(row, "Level"), getInteger(row, "X"), getInteger(row, "Y"), getInteger(row, "Size"),
      get(row, "SurfaceArea"), get(row, "Stretch") });
  }
}

//------------------------------------------------------------------------------
/// Unfold a surface by a number of threads.
inline Atlas Unfold(vtkPolyData* input, int resolution, double maximumStretch, int threads)
{
  Atlas atlas;
  atlas.Input = input;
  atlas.Resolution = resolution;
  vtkNew<vtkSurfaceAtlas> filter;
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> executive;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  filter->SetInputData(input);
  filter->SetResolution(resolution);
  filter->SetMaximumStretch(maximumStretch);
  vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
    [&filter]() { filter->Update(); });
  atlas.Errors = errors->GetErrorMessage();
  atlas.Output = filter->GetOutput();
  atlas.Table = filter->GetCharts();
  atlas.Maps = filter->GetMaps();
  ReadTable(atlas);
  vtkDataArray* charts = atlas.Output->GetCellData()->GetArray("ChartId");
  vtkDataArray* coordinates = atlas.Output->GetPointData()->GetArray("AtlasCoordinates");
  for (vtkIdType i = 0; charts && i < charts->GetNumberOfTuples(); ++i)
  {
    atlas.Charts.push_back(static_cast<int>(charts->GetTuple1(i)));
  }
  for (vtkIdType i = 0; coordinates && i < coordinates->GetNumberOfTuples(); ++i)
  {
    atlas.Coordinates.push_back(
      { coordinates->GetComponent(i, 0), coordinates->GetComponent(i, 1) });
  }
  atlas.Areas = GetCellAreas(atlas.Output);
  return atlas;
}

//------------------------------------------------------------------------------
/// Whether there is something to look into at all. Finds the rows of the charts.
inline bool CheckOutputs(Atlas& atlas, Checker& check)
{
  check.True(atlas.Errors.empty(), "no error: " + atlas.Errors);
  vtkPolyData* output = atlas.Output;
  const auto charts = static_cast<int>(meshTest::GetSummary(output, "NumberOfCharts"));
  bool sound = output->GetNumberOfCells() > 0 && !atlas.Nodes.empty() && charts > 0 &&
    output->GetNumberOfPolys() == output->GetNumberOfCells() &&
    atlas.Charts.size() == atlas.Areas.size() &&
    atlas.Coordinates.size() == static_cast<std::size_t>(output->GetNumberOfPoints()) &&
    output->GetPointData()->GetTCoords() == output->GetPointData()->GetArray("AtlasCoordinates");
  check.True(sound, "surface, table and their arrays are there");
  atlas.Rows.assign(sound ? charts : 0, -1);
  for (std::size_t row = 0; sound && row < atlas.Nodes.size(); ++row)
  {
    const int chart = atlas.Nodes[row].Chart;
    if (chart >= 0)
    {
      sound = chart < charts && atlas.Rows[chart] < 0;
      atlas.Rows[sound ? chart : 0] = static_cast<int>(row);
    }
  }
  sound = sound && std::count(atlas.Rows.begin(), atlas.Rows.end(), -1) == 0;
  sound = sound && *std::min_element(atlas.Charts.begin(), atlas.Charts.end()) == 0;
  sound = sound && *std::max_element(atlas.Charts.begin(), atlas.Charts.end()) == charts - 1;
  check.True(sound, "each chart has one row");
  return sound;
}

//------------------------------------------------------------------------------
/// Blocks nest, siblings are apart, so all blocks are; areas add up.
inline void CheckTable(const Atlas& atlas, Checker& check)
{
  const std::vector<Node>& nodes = atlas.Nodes;
  check.True(nodes[0].Parent == -1 && nodes[0].X == 0 && nodes[0].Y == 0 &&
      nodes[0].Size == atlas.Resolution,
    "the root is the whole atlas");
  std::vector<double> sums(nodes.size(), 0.0);
  for (std::size_t cell = 0; cell < atlas.Areas.size(); ++cell)
  {
    sums[atlas.Rows[atlas.Charts[cell]]] += atlas.Areas[cell];
  }
  std::set<std::array<int, 3>> places;
  for (std::size_t row = nodes.size(); row-- > 0;)
  {
    const Node& node = nodes[row];
    const std::string name = "node " + std::to_string(row);
    check.True(node.Size == 1 << node.Level, name + ": level and size");
    check.True((node.Chart < 0) == vtkMath::IsNan(node.Stretch), name + ": stretch of charts");
    check.True(places.insert({ node.X, node.Y, node.Size }).second, name + ": a block of its own");
    check.Equal(node.SurfaceArea / sums[row], 1.0, 1e-11, name + ": area");
    if (row == 0)
    {
      break;
    }
    const bool afterParent = node.Parent >= 0 && node.Parent < static_cast<int>(row);
    check.True(afterParent, name + ": after its parent");
    if (afterParent)
    {
      const Node& parent = nodes[node.Parent];
      check.True(parent.Chart < 0 && parent.Size == 2 * node.Size &&
          parent.X == node.X / parent.Size * parent.Size &&
          parent.Y == node.Y / parent.Size * parent.Size && node.X % node.Size == 0 &&
          node.Y % node.Size == 0,
        name + ": a quarter of its parent");
      sums[node.Parent] += sums[row];
    }
  }
}

//------------------------------------------------------------------------------
/// The triangles of one chart in the atlas, where points with the same coordinates are one.
class ChartInAtlas
{
public:
  using Point = std::array<double, 2>;

  void Add(const std::array<Point, 3>& corners)
  {
    std::array<int, 3> triangle;
    for (int i = 0; i < 3; ++i)
    {
      triangle[i] = this->Number(corners[i]);
    }
    for (int i = 0; i < 3; ++i)
    {
      const std::array<int, 2> side{ triangle[i], triangle[(i + 1) % 3] };
      this->RepeatedSides += !this->Sides.emplace(side, this->NumberOfTriangles).second;
    }
    ++this->NumberOfTriangles;
    const Point& o = corners[0];
    this->Area += 0.5 *
      ((corners[1][0] - o[0]) * (corners[2][1] - o[1]) -
        (corners[1][1] - o[1]) * (corners[2][0] - o[0]));
  }

  double GetArea() const { return this->Area; }

  /// Whether it is one manifold piece without holes.
  bool IsDisc() const
  {
    Sets parts(this->NumberOfTriangles);
    int edges = 0;
    int numberOfParts = this->NumberOfTriangles;
    for (const auto& side : this->Sides)
    {
      const auto other = this->Sides.find({ side.first[1], side.first[0] });
      edges += other == this->Sides.end() || side.first[0] < side.first[1];
      if (other != this->Sides.end() && parts.Find(side.second) != parts.Find(other->second))
      {
        parts.Join(side.second, other->second);
        --numberOfParts;
      }
    }
    return numberOfParts == 1 && this->RepeatedSides == 0 &&
      static_cast<int>(this->Points.size()) - edges + this->NumberOfTriangles == 1;
  }

  /// How far its border goes counter-clockwise around a square; NaN where it leaves the square's
  /// border or turns back.
  double GetWayAround(double x, double y, double side) const
  {
    double way = 0.0;
    for (const auto& edge : this->Sides)
    {
      if (this->Sides.count({ edge.first[1], edge.first[0] }) == 0)
      {
        const Point& a = this->Points[edge.first[0]];
        const Point& b = this->Points[edge.first[1]];
        const bool bottom = a[1] == y && b[1] == y && b[0] > a[0];
        const bool right = a[0] == x + side && b[0] == x + side && b[1] > a[1];
        const bool top = a[1] == y + side && b[1] == y + side && b[0] < a[0];
        const bool left = a[0] == x && b[0] == x && b[1] < a[1];
        const bool alongBorder = bottom || right || top || left;
        way += alongBorder ? std::abs(b[0] - a[0]) + std::abs(b[1] - a[1]) : vtkMath::Nan();
      }
    }
    return way;
  }

private:
  int Number(const Point& point)
  {
    const int number = this->Known(point);
    if (number == static_cast<int>(this->Points.size()))
    {
      this->Points.push_back(point);
    }
    return number;
  }

  Numbers<Point> Known;
  std::vector<Point> Points;
  std::map<std::array<int, 2>, int> Sides;
  int NumberOfTriangles = 0;
  int RepeatedSides = 0;
  double Area = 0.0;
};

//------------------------------------------------------------------------------
/// Each chart is mapped one-to-one onto its whole block: no triangle is turned over, the chart is
/// a disc, and its border goes around the block once.
inline void CheckBijection(const Atlas& atlas, Checker& check)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<ChartInAtlas> charts(atlas.Rows.size());
  int turned = 0;
  int outside = 0;
  const double unit = 1.0 / atlas.Resolution;
  for (std::size_t cell = 0; cell < atlas.Charts.size(); ++cell)
  {
    const Node& node = atlas.Nodes[atlas.Rows[atlas.Charts[cell]]];
    std::array<ChartInAtlas::Point, 3> corners;
    Kernel::Point_2 points[3];
    int i = 0;
    for (const vtkIdType id : GetCorners(atlas.Output, static_cast<vtkIdType>(cell)))
    {
      corners[i] = atlas.Coordinates[id];
      const double u = corners[i][0];
      const double v = corners[i][1];
      outside += !(u >= node.X * unit && u <= (node.X + node.Size) * unit && v >= node.Y * unit &&
        v <= (node.Y + node.Size) * unit);
      points[i++] = Kernel::Point_2(u, v);
    }
    turned += CGAL::orientation(points[0], points[1], points[2]) != CGAL::LEFT_TURN;
    charts[atlas.Charts[cell]].Add(corners);
  }
  check.Equal(turned, 0, 0, "triangles that are not counter-clockwise");
  check.Equal(outside, 0, 0, "corners outside the block of their chart");
  for (std::size_t i = 0; i < charts.size(); ++i)
  {
    const Node& node = atlas.Nodes[atlas.Rows[i]];
    const std::string name = "chart " + std::to_string(i);
    const double side = node.Size * unit;
    check.Equal(charts[i].GetArea() / (side * side), 1.0, 1e-9, name + ": area in the atlas");
    check.True(charts[i].IsDisc(), name + ": a disc");
    check.Equal(charts[i].GetWayAround(node.X * unit, node.Y * unit, side) / (4.0 * side), 1.0,
      1e-12, name + ": the way of its border around the block");
  }
}

//------------------------------------------------------------------------------
/// The faces of each component of a surface, points of which are merged.
inline std::vector<int> FindComponents(vtkPolyData* merged, std::vector<std::array<int, 2>>& pairs)
{
  Sets components(merged->GetNumberOfCells());
  std::map<std::array<vtkIdType, 2>, int> sides;
  for (vtkIdType cell = 0; cell < merged->GetNumberOfCells(); ++cell)
  {
    const std::array<vtkIdType, 3> corners = GetCorners(merged, cell);
    for (int i = 0; i < 3; ++i)
    {
      sides[{ corners[i], corners[(i + 1) % 3] }] = static_cast<int>(cell);
    }
  }
  for (const auto& side : sides)
  {
    const auto other = sides.find({ side.first[1], side.first[0] });
    if (other != sides.end() && side.first[0] < side.first[1])
    {
      pairs.push_back({ side.second, other->second });
      components.Join(side.second, other->second);
    }
  }
  std::vector<int> result(merged->GetNumberOfCells());
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    result[i] = components.Find(static_cast<int>(i));
  }
  return result;
}

//------------------------------------------------------------------------------
/// The share of all nodes that hold one connected piece of each component of which they hold any.
inline double GetConnectedShare(const Atlas& atlas, vtkPolyData* merged)
{
  std::vector<std::array<int, 2>> pairs;
  const std::vector<int> components = FindComponents(merged, pairs);
  // Charts in place of faces: each is connected, and of one component.
  std::set<std::array<int, 2>> neighbors;
  for (const std::array<int, 2>& pair : pairs)
  {
    neighbors.insert({ atlas.Charts[pair[0]], atlas.Charts[pair[1]] });
  }
  std::vector<int> componentOfChart(atlas.Rows.size());
  for (std::size_t cell = 0; cell < atlas.Charts.size(); ++cell)
  {
    componentOfChart[atlas.Charts[cell]] = components[cell];
  }
  std::vector<std::vector<int>> members(atlas.Nodes.size());
  int connected = 0;
  for (int row = static_cast<int>(atlas.Nodes.size()) - 1; row >= 0; --row)
  {
    const Node& node = atlas.Nodes[row];
    if (node.Chart >= 0)
    {
      members[row].push_back(node.Chart);
    }
    const std::set<int> inside(members[row].begin(), members[row].end());
    std::set<int> found;
    Sets parts(atlas.Rows.size());
    int excess = static_cast<int>(inside.size());
    for (const int chart : inside)
    {
      found.insert(componentOfChart[chart]);
      for (auto pair = neighbors.lower_bound({ chart, 0 });
           pair != neighbors.end() && (*pair)[0] == chart; ++pair)
      {
        if (inside.count((*pair)[1]) != 0 && parts.Find(chart) != parts.Find((*pair)[1]))
        {
          parts.Join(chart, (*pair)[1]);
          --excess;
        }
      }
    }
    connected += excess == static_cast<int>(found.size());
    if (node.Parent >= 0)
    {
      std::vector<int>& all = members[node.Parent];
      all.insert(all.end(), members[row].begin(), members[row].end());
    }
  }
  return static_cast<double>(connected) / static_cast<double>(atlas.Nodes.size());
}

//------------------------------------------------------------------------------
inline double GetBorderLength(vtkPolyData* mesh)
{
  double length = 0.0;
  for (const auto& side : meshTest::GetEdges(mesh).Borders)
  {
    length += std::sqrt(vtkMath::Distance2BetweenPoints(meshTest::GetPoint(mesh, side.first).data(),
      meshTest::GetPoint(mesh, side.second).data()));
  }
  return length;
}

//------------------------------------------------------------------------------
/// Twice the area vector of a triangle.
inline Vector GetNormal(const Vector& a, const Vector& b, const Vector& c)
{
  Vector u;
  Vector v;
  Vector normal;
  vtkMath::Subtract(b.data(), a.data(), u.data());
  vtkMath::Subtract(c.data(), a.data(), v.data());
  vtkMath::Cross(u.data(), v.data(), normal.data());
  return normal;
}

//------------------------------------------------------------------------------
/// The surface is the input's: its triangles cover those of the input, their seams fit together.
inline void CheckSurface(const Atlas& atlas, vtkPolyData* merged, Checker& check)
{
  Surface input = MergePoints(atlas.Input);
  const double area = meshTest::GetArea(input);
  const double size = input->GetLength();
  double bounds[6];
  input->GetBounds(bounds);
  const double distance = std::max({ size, std::abs(bounds[0]), std::abs(bounds[1]),
    std::abs(bounds[2]), std::abs(bounds[3]), std::abs(bounds[4]), std::abs(bounds[5]) });
  const double rounding = 1e-12 * distance / size;
  check.Equal(meshTest::GetArea(merged) / area, 1.0, rounding, "area");
  check.Equal(meshTest::GetVolume(merged) / (area * distance),
    meshTest::GetVolume(input) / (area * distance), 1e-12, "volume");
  const double border = GetBorderLength(input);
  check.Equal(GetBorderLength(merged) / size, border / size, rounding * (1.0 + border / size),
    "length of the border");
  // Edges of repaired surfaces may coincide without being connected.
  check.True(meshTest::GetEdges(merged).Bad == 0 || meshTest::GetEdges(input).Bad > 0,
    "no edges that are not manifold");

  vtkDataArray* cells = atlas.Output->GetCellData()->GetArray("OriginalCellIds");
  vtkDataArray* points = atlas.Output->GetPointData()->GetArray("OriginalPointIds");
  check.True(vtkIdTypeArray::SafeDownCast(cells) && vtkIdTypeArray::SafeDownCast(points),
    "arrays of original ids");
  vtkIdType moved = 0;
  for (vtkIdType i = 0; i < atlas.Output->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<vtkIdType>(points->GetTuple1(i));
    moved += id >= 0 && meshTest::GetPoint(atlas.Output, i) != meshTest::GetPoint(atlas.Input, id);
  }
  check.Equal(static_cast<double>(moved), 0, 0, "points that moved");

  std::vector<double> parts(atlas.Input->GetNumberOfCells(), 0.0);
  double offPlane = 0.0;
  for (vtkIdType cell = 0; cell < atlas.Output->GetNumberOfCells(); ++cell)
  {
    const auto id = static_cast<vtkIdType>(cells->GetTuple1(cell));
    parts[id] += atlas.Areas[cell];
    if (atlas.Input->GetCellSize(id) != 3)
    {
      continue;
    }
    const std::array<vtkIdType, 3> corners = GetCorners(atlas.Input, id);
    Vector p[3];
    for (int i = 0; i < 3; ++i)
    {
      p[i] = meshTest::GetPoint(atlas.Input, corners[i]);
    }
    const Vector normal = GetNormal(p[0], p[1], p[2]);
    for (const vtkIdType corner : GetCorners(atlas.Output, cell))
    {
      Vector q = meshTest::GetPoint(atlas.Output, corner);
      vtkMath::Subtract(q.data(), p[0].data(), q.data());
      offPlane = std::max(offPlane,
        std::abs(vtkMath::Dot(q.data(), normal.data())) / vtkMath::Norm(normal.data()) / distance);
    }
  }
  check.Equal(offPlane, 0.0, 1e-9, "distance from the plane of the original cell");
  double uncovered = 0.0;
  for (vtkIdType cell = 0; cell < atlas.Input->GetNumberOfCells(); ++cell)
  {
    uncovered = std::max(uncovered,
      std::abs(parts[cell] - vtkMath::Norm(meshTest::GetAreaVector(atlas.Input, cell).data())));
  }
  check.Equal(uncovered / area, 0.0, rounding, "area of an original cell that is not covered");
}

//------------------------------------------------------------------------------
inline void CheckArrays(const Atlas& atlas, Checker& check)
{
  vtkDataArray* linear = atlas.Output->GetPointData()->GetArray("Linear");
  vtkDataArray* sources = atlas.Output->GetCellData()->GetArray("OriginalCellIds");
  vtkDataArray* cells = atlas.Output->GetCellData()->GetArray("Cell");
  check.Equal(meshTest::GetSummary(atlas.Output, "Field"), 7.0, 0, "field data");
  check.True(linear && cells, "arrays of the input");
  double largest = 0.0;
  double wrong = 0.0;
  for (vtkIdType i = 0; linear && i < linear->GetNumberOfTuples(); ++i)
  {
    const Vector point = meshTest::GetPoint(atlas.Output, i);
    wrong = std::max(wrong, std::abs(linear->GetTuple1(i) - GetLinear(point)));
    largest = std::max({ largest, std::abs(point[0]), std::abs(point[1]), std::abs(point[2]) });
  }
  check.Equal(wrong / largest, 0.0, 1e-14, "error of a linear function");
  vtkIdType mistaken = 0;
  for (vtkIdType i = 0; cells && i < cells->GetNumberOfTuples(); ++i)
  {
    mistaken += cells->GetTuple1(i) != sources->GetTuple1(i);
  }
  check.Equal(static_cast<double>(mistaken), 0, 0, "cells whose data are another's");
}

//------------------------------------------------------------------------------
/// The chart that each texel belongs to, as the table says; -1 for none.
inline std::vector<int> PaintBlocks(const Atlas& atlas)
{
  std::vector<int> texels(static_cast<std::size_t>(atlas.Resolution) * atlas.Resolution, -1);
  for (std::size_t chart = 0; chart < atlas.Rows.size(); ++chart)
  {
    const Node& node = atlas.Nodes[atlas.Rows[chart]];
    for (int y = node.Y; y < node.Y + node.Size; ++y)
    {
      const auto first = texels.begin() + static_cast<std::ptrdiff_t>(y) * atlas.Resolution;
      std::fill_n(first + node.X, node.Size, static_cast<int>(chart));
    }
  }
  return texels;
}

//------------------------------------------------------------------------------
/// Every texel of a block has surface of its chart, and the texels of a node have all of its.
inline void CheckMaps(const Atlas& atlas, const std::vector<int>& painted, Checker& check)
{
  vtkImageData* maps = atlas.Maps;
  const int side = atlas.Resolution;
  vtkDataArray* areas = maps->GetPointData()->GetArray("Area");
  vtkDataArray* charts = maps->GetPointData()->GetArray("ChartId");
  vtkDataArray* positions = maps->GetPointData()->GetArray("Position");
  vtkDataArray* normals = maps->GetPointData()->GetArray("Normal");
  const bool there = areas && charts && positions && normals &&
    maps->GetNumberOfPoints() == static_cast<vtkIdType>(painted.size());
  check.True(there, "texel maps");
  if (!there)
  {
    return;
  }
  check.True(maps->GetDimensions()[0] == side && maps->GetDimensions()[1] == side &&
      maps->GetSpacing()[0] == 1.0 / side && maps->GetSpacing()[1] == 1.0 / side &&
      maps->GetOrigin()[0] == 0.5 / side && maps->GetOrigin()[1] == 0.5 / side,
    "points of the maps lie where their atlas coordinates are");
  vtkIdType foreign = 0;
  vtkIdType empty = 0;
  std::vector<double> sums(atlas.Nodes.size(), 0.0);
  Vector moment{ 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < painted.size(); ++i)
  {
    const auto texel = static_cast<vtkIdType>(i);
    const double area = areas->GetTuple1(texel);
    foreign += charts->GetTuple1(texel) != painted[i];
    empty += (area > 0.0) != (painted[i] >= 0);
    if (painted[i] >= 0)
    {
      sums[atlas.Rows[painted[i]]] += area;
    }
    for (int j = 0; j < 3; ++j)
    {
      moment[j] += area * positions->GetComponent(texel, j);
    }
  }
  check.Equal(static_cast<double>(foreign), 0, 0, "texels with another chart");
  check.Equal(static_cast<double>(empty), 0, 0, "texels of charts without surface");
  for (std::size_t row = atlas.Nodes.size(); row-- > 0;)
  {
    check.Equal(sums[row] / atlas.Nodes[row].SurfaceArea, 1.0, 1e-9,
      "area in the texels of node " + std::to_string(row));
    if (row > 0)
    {
      sums[atlas.Nodes[row].Parent] += sums[row];
    }
  }
  const double area = atlas.Nodes[0].SurfaceArea;
  check.Equal(sums[0] / area, 1.0, 1e-11, "area in all texels");
  Vector expected{ 0.0, 0.0, 0.0 };
  double farthest = 0.0;
  for (std::size_t cell = 0; cell < atlas.Areas.size(); ++cell)
  {
    for (const vtkIdType id : GetCorners(atlas.Output, static_cast<vtkIdType>(cell)))
    {
      const Vector point = meshTest::GetPoint(atlas.Output, id);
      for (int j = 0; j < 3; ++j)
      {
        expected[j] += atlas.Areas[cell] * point[j] / 3.0;
        farthest = std::max(farthest, std::abs(point[j]));
      }
    }
  }
  for (int j = 0; j < 3; ++j)
  {
    check.Equal(moment[j] / (area * farthest), expected[j] / (area * farthest), 1e-11,
      "centroid of all texels");
  }
}

//------------------------------------------------------------------------------
inline void AddRandom(vtkDataSetAttributes* data, const char* name, vtkIdType size)
{
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> random(-1.0, 3.0);
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < size; ++i)
  {
    array->InsertNextValue(random(engine));
  }
  data->AddArray(array);
}

//------------------------------------------------------------------------------
inline double Integrate(vtkDataArray* values, vtkDataArray* areas)
{
  long double sum = 0.0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    sum += values->GetTuple1(i) * areas->GetTuple1(i);
  }
  return static_cast<double>(sum);
}

//------------------------------------------------------------------------------
inline vtkSmartPointer<vtkImageData> ToTexels(const Surface& surface, int resolution)
{
  vtkNew<vtkSurfaceToAtlas> filter;
  filter->SetInputData(surface);
  filter->SetResolution(resolution);
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
/// On the deepest level without leaks, each texel still has values of one chart, by cells' "Color".
inline void CheckDeepestLevel(const Atlas& atlas, const Surface& surface, Checker& check)
{
  const auto level = static_cast<int>(meshTest::GetSummary(atlas.Output, "DeepestLeakFreeLevel"));
  vtkSmartPointer<vtkImageData> coarse = ToTexels(surface, atlas.Resolution >> level);
  vtkDataArray* charts = coarse->GetPointData()->GetArray("ChartId");
  vtkDataArray* colors = coarse->GetPointData()->GetArray("Color");
  vtkIdType mixed = charts && colors ? 0 : 1;
  for (vtkIdType i = 0; charts && colors && i < coarse->GetNumberOfPoints(); ++i)
  {
    mixed += charts->GetTuple1(i) >= 0.0 && colors->GetTuple1(i) != charts->GetTuple1(i);
  }
  check.Equal(static_cast<double>(mixed), 0, 0, "texels of the deepest level that mix charts");
}

//------------------------------------------------------------------------------
/// The integral of a random array is the same on the surface and in texels, both ways; a constant
/// stays.
inline void CheckTransfer(const Atlas& atlas, Checker& check)
{
  auto surface = Surface::New();
  surface->ShallowCopy(atlas.Output);
  const vtkIdType size = surface->GetNumberOfCells();
  AddRandom(surface->GetCellData(), "Random", size);
  vtkNew<vtkDoubleArray> areas;
  vtkNew<vtkDoubleArray> constant;
  vtkNew<vtkDoubleArray> color;
  constant->SetName("Constant");
  color->SetName("Color");
  for (std::size_t cell = 0; cell < atlas.Areas.size(); ++cell)
  {
    areas->InsertNextValue(atlas.Areas[cell]);
    constant->InsertNextValue(0.1);
    color->InsertNextValue(atlas.Charts[cell]);
  }
  surface->GetCellData()->AddArray(constant);
  surface->GetCellData()->AddArray(color);
  const auto differs = [](vtkDataArray* values, double expected, vtkDataArray* where)
  {
    vtkIdType count = values ? 0 : 1;
    for (vtkIdType i = 0; values && i < values->GetNumberOfTuples(); ++i)
    {
      count += (!where || where->GetTuple1(i) > 0.0) && values->GetTuple1(i) != expected;
    }
    return static_cast<double>(count);
  };

  const double area = atlas.Nodes[0].SurfaceArea;
  vtkSmartPointer<vtkImageData> image = ToTexels(surface, 0);
  vtkPointData* texels = image->GetPointData();
  check.True(image->GetDimensions()[0] == atlas.Resolution, "texels for the whole resolution");
  vtkDataArray* texelAreas = texels->GetArray("Area");
  check.Equal(differs(texels->GetArray("Constant"), 0.1, texelAreas), 0, 0,
    "texels that are not the constant");
  check.Equal(Integrate(texels->GetArray("Random"), texelAreas) / area,
    Integrate(surface->GetCellData()->GetArray("Random"), areas) / area, 1e-11,
    "mean of cells in texels");

  texels->RemoveArray("Random");
  AddRandom(texels, "Random", image->GetNumberOfPoints());
  vtkNew<vtkAtlasToSurface> back;
  back->SetInputData(0, surface);
  back->SetInputData(1, image);
  back->Update();
  vtkCellData* cells = back->GetOutput()->GetCellData();
  vtkPointData* points = back->GetOutput()->GetPointData();
  check.Equal(differs(cells->GetArray("Constant"), 0.1, nullptr), 0, 0,
    "cells that are not the constant");
  check.Equal(differs(points->GetArray("Constant"), 0.1, nullptr), 0, 0,
    "points that are not the constant");
  const double mean = Integrate(texels->GetArray("Random"), texelAreas) / area;
  check.Equal(Integrate(cells->GetArray("Random"), areas) / area, mean, 1e-11,
    "mean of texels in cells");
  vtkNew<vtkDoubleArray> pointAreas;
  pointAreas->SetNumberOfTuples(surface->GetNumberOfPoints());
  pointAreas->Fill(0.0);
  for (vtkIdType cell = 0; cell < size; ++cell)
  {
    for (const vtkIdType id : GetCorners(surface, cell))
    {
      pointAreas->SetValue(id, pointAreas->GetValue(id) + atlas.Areas[cell] / 3.0);
    }
  }
  check.Equal(Integrate(points->GetArray("Random"), pointAreas) / area, mean, 1e-11,
    "mean of texels in points");
  CheckDeepestLevel(atlas, surface, check);
}

//------------------------------------------------------------------------------
/// Stretch as Sander et al. define it, by derivatives of the surface by atlas coordinates.
struct Stretch
{
  double Area = 0.0;
  double TextureArea = 0.0;
  double SumOfSquares = 0.0;
  double LargestSquare = 0.0;

  double GetL2() const { return std::sqrt(this->SumOfSquares * this->TextureArea) / this->Area; }
  double GetLInfinity() const
  {
    return std::sqrt(this->LargestSquare * this->TextureArea / this->Area);
  }
};

//------------------------------------------------------------------------------
inline void AddTriangle(const Vector q[3], const std::array<double, 2> p[3], Stretch& stretch,
  double& textureArea)
{
  textureArea =
    0.5 * ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]));
  double a = 0.0;
  double b = 0.0;
  double c = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const double e1 = q[1][i] - q[0][i];
    const double e2 = q[2][i] - q[0][i];
    const double s = (e1 * (p[2][1] - p[0][1]) - e2 * (p[1][1] - p[0][1])) / (2.0 * textureArea);
    const double t = (e2 * (p[1][0] - p[0][0]) - e1 * (p[2][0] - p[0][0])) / (2.0 * textureArea);
    a += s * s;
    b += s * t;
    c += t * t;
  }
  const double area = 0.5 * vtkMath::Norm(GetNormal(q[0], q[1], q[2]).data());
  stretch.Area += area;
  stretch.TextureArea += textureArea;
  stretch.SumOfSquares += 0.5 * (a + c) * area;
  stretch.LargestSquare =
    std::max(stretch.LargestSquare, 0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4.0 * b * b)));
}

//------------------------------------------------------------------------------
/// The numbers in field data and in the table are those that follow from the output.
inline void CheckMetrics(const Atlas& atlas, const std::vector<int>& painted, Checker& check)
{
  Stretch all;
  std::vector<Stretch> charts(atlas.Rows.size());
  std::vector<double> textureAreas(atlas.Areas.size());
  for (std::size_t cell = 0; cell < atlas.Areas.size(); ++cell)
  {
    Vector q[3];
    std::array<double, 2> p[3];
    int i = 0;
    for (const vtkIdType id : GetCorners(atlas.Output, static_cast<vtkIdType>(cell)))
    {
      q[i] = meshTest::GetPoint(atlas.Output, id);
      p[i++] = atlas.Coordinates[id];
    }
    AddTriangle(q, p, all, textureAreas[cell]);
    AddTriangle(q, p, charts[atlas.Charts[cell]], textureAreas[cell]);
  }
  double distortion = 0.0;
  for (std::size_t cell = 0; cell < atlas.Areas.size(); ++cell)
  {
    const double density = textureAreas[cell] / all.TextureArea * all.Area / atlas.Areas[cell];
    distortion += std::max(density, 1.0 / density) * atlas.Areas[cell] / all.Area;
  }
  int smallest = atlas.Resolution;
  for (std::size_t chart = 0; chart < charts.size(); ++chart)
  {
    const Node& node = atlas.Nodes[atlas.Rows[chart]];
    check.Equal(node.Stretch / charts[chart].GetL2(), 1.0, 1e-6,
      "stretch of chart " + std::to_string(chart));
    smallest = std::min(smallest, node.Size);
  }
  const double used =
    static_cast<double>(painted.size()) - std::count(painted.begin(), painted.end(), -1);
  const auto get = [&atlas](const char* name) { return meshTest::GetSummary(atlas.Output, name); };
  check.Equal(get("L2Stretch") / all.GetL2(), 1.0, 1e-6, "L2 stretch");
  check.Equal(get("LInfinityStretch") / all.GetLInfinity(), 1.0, 1e-6, "L-infinity stretch");
  check.Equal(get("AreaDistortion") / distortion, 1.0, 1e-6, "area distortion");
  check.Equal(get("TexelUse"), used / static_cast<double>(painted.size()), 1e-9, "texel use");
  check.Equal(1 << static_cast<int>(get("DeepestLeakFreeLevel")), smallest, 0, "smallest block");
  check.Equal(get("NumberOfCharts"), static_cast<double>(charts.size()), 0, "number of charts");
  check.Equal(get("AtlasResolution"), atlas.Resolution, 0, "resolution");
  check.True(get("AtlasSeconds") >= 0.0 && get("TexelMapSeconds") >= 0.0, "times");
  check.True(get("L2Stretch") >= 1.0 - 1e-12 && get("LInfinityStretch") >= get("L2Stretch") &&
      get("AreaDistortion") >= 1.0 - 1e-12,
    "no map is better than an isometry");
}

//------------------------------------------------------------------------------
inline bool IsSame(vtkDataArray* a, vtkDataArray* b)
{
  bool same = a && b && a->GetNumberOfValues() == b->GetNumberOfValues();
  for (vtkIdType i = 0; same && i < a->GetNumberOfTuples(); ++i)
  {
    for (int j = 0; same && j < a->GetNumberOfComponents(); ++j)
    {
      const double x = a->GetComponent(i, j);
      const double y = b->GetComponent(i, j);
      same = x == y || (vtkMath::IsNan(x) && vtkMath::IsNan(y));
    }
  }
  return same;
}

//------------------------------------------------------------------------------
inline bool IsSame(vtkFieldData* a, vtkFieldData* b)
{
  bool same = a->GetNumberOfArrays() == b->GetNumberOfArrays();
  for (int i = 0; same && i < a->GetNumberOfArrays(); ++i)
  {
    same = IsSame(a->GetArray(i), b->GetArray(a->GetArrayName(i)));
  }
  return same;
}

//------------------------------------------------------------------------------
inline void CheckSame(const Atlas& a, const Atlas& b, Checker& check)
{
  check.True(IsSame(a.Output->GetPointData(), b.Output->GetPointData()) &&
      IsSame(a.Output->GetCellData(), b.Output->GetCellData()) &&
      IsSame(a.Output->GetPoints()->GetData(), b.Output->GetPoints()->GetData()) &&
      IsSame(a.Output->GetPolys()->GetConnectivityArray(),
        b.Output->GetPolys()->GetConnectivityArray()),
    "the same surface with one thread and with two");
  check.True(IsSame(a.Table->GetRowData(), b.Table->GetRowData()),
    "the same table with one thread and with two");
  check.True(IsSame(a.Maps->GetPointData(), b.Maps->GetPointData()),
    "the same maps with one thread and with two");
}

/// What an atlas must reach, a little worse than what was measured.
struct Limits
{
  double L2Stretch;
  double TexelUse;
  double ConnectedShare;
};

//------------------------------------------------------------------------------
/// Unfold a surface twice and check everything.
inline void CheckAtlas(const std::string& name, vtkPolyData* input, int resolution,
  const Limits& limits, Checker& check)
{
  AddArrays(input);
  const double maximumStretch = 1.2;
  Atlas atlas = Unfold(input, resolution, maximumStretch, 1);
  check.SetSubject(name);
  if (!CheckOutputs(atlas, check))
  {
    return;
  }
  Surface merged = MergePoints(atlas.Output);
  const std::vector<int> painted = PaintBlocks(atlas);
  CheckTable(atlas, check);
  CheckBijection(atlas, check);
  CheckSurface(atlas, merged, check);
  CheckArrays(atlas, check);
  CheckMaps(atlas, painted, check);
  CheckTransfer(atlas, check);
  CheckMetrics(atlas, painted, check);
  CheckSame(atlas, Unfold(input, resolution, maximumStretch, 2), check);

  const auto get = [&atlas](const char* what) { return meshTest::GetSummary(atlas.Output, what); };
  const double connected = GetConnectedShare(atlas, merged);
  std::printf("%-22s %4d^2 triangles %6d to %6d, charts %4d, L2 %.3f, L-infinity %7.2f, area "
              "distortion %.3f, texel use %.3f, connected nodes %.4f, deepest level %d\n",
    name.c_str(), resolution, static_cast<int>(input->GetNumberOfCells()),
    static_cast<int>(atlas.Output->GetNumberOfCells()), static_cast<int>(get("NumberOfCharts")),
    get("L2Stretch"), get("LInfinityStretch"), get("AreaDistortion"), get("TexelUse"), connected,
    static_cast<int>(get("DeepestLeakFreeLevel")));
  check.True(get("L2Stretch") <= limits.L2Stretch, "L2 stretch within its limit");
  check.True(get("TexelUse") >= limits.TexelUse, "texel use above its limit");
  check.True(connected >= limits.ConnectedShare, "share of connected nodes above its limit");
}
} // namespace atlasTest

#endif
