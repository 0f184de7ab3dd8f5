// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/TexelPieces.h"

#include "Common/Heartbeat.h"
#include "Shared/ArrayNames.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
using Triangle = std::array<vtkIdType, 3>;

//------------------------------------------------------------------------------
vtkDataArray* GetCoordinates(vtkPolyData* surface)
{
  vtkDataArray* coordinates = surface->GetPointData()->GetArray(ArrayNames::AtlasCoordinates);
  return coordinates ? coordinates : surface->GetPointData()->GetTCoords();
}

//------------------------------------------------------------------------------
template <typename Function>
void ForEachTriangle(vtkPolyData* surface, Function&& function)
{
  vtkCellArray* cells = surface->GetPolys();
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* corners;
    cells->GetCellAtId(cell, size, corners);
    function(cell, Triangle{ corners[0], corners[1], corners[2] });
  }
}

//------------------------------------------------------------------------------
Outcome CheckCells(vtkPolyData* surface)
{
  vtkCellArray* cells = surface->GetPolys();
  const vtkIdType size = cells->GetNumberOfCells();
  if (size == 0)
  {
    return Outcome::Failed("The surface has no triangles: give it the output of vtkSurfaceAtlas.");
  }
  for (vtkIdType cell = 0; cell < size; ++cell)
  {
    if (cells->GetCellSize(cell) != 3)
    {
      return Outcome::Failed("Cell " + std::to_string(cell) +
        " is not a triangle: give the surface as vtkSurfaceAtlas makes it.");
    }
  }
  if (surface->GetNumberOfCells() != size)
  {
    return Outcome::Failed("The surface has vertices, lines or strips: give only triangles, as "
                           "vtkSurfaceAtlas makes them.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome CheckCoordinatesOf(vtkIdType cell, const Triangle& corners, vtkDataArray* coordinates)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::array<Kernel::Point_2, 3> points;
  for (int i = 0; i < 3; ++i)
  {
    const double u = coordinates->GetComponent(corners[i], 0);
    const double v = coordinates->GetComponent(corners[i], 1);
    if (!(u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0))
    {
      std::ostringstream text;
      text << "The atlas coordinates of point " << corners[i] << " are (" << u << ", " << v
           << "): they must lie between 0 and 1.";
      return Outcome::Failed(text.str());
    }
    points[i] = Kernel::Point_2(u, v);
  }
  if (CGAL::orientation(points[0], points[1], points[2]) != CGAL::LEFT_TURN)
  {
    return Outcome::Failed("Triangle " + std::to_string(cell) +
      " is turned over or has no area in the atlas: its corners must go around "
      "counter-clockwise in atlas coordinates, as vtkSurfaceAtlas makes them.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome CheckCoordinates(vtkPolyData* surface, const Monitor& monitor)
{
  vtkDataArray* coordinates = GetCoordinates(surface);
  if (!coordinates || coordinates->GetNumberOfComponents() < 2)
  {
    return Outcome::Failed("The surface has neither a point array \"AtlasCoordinates\" with two "
                           "components nor texture coordinates: make them with vtkSurfaceAtlas.");
  }
  Outcome outcome = Outcome::Done();
  Heartbeat heart(monitor);
  ForEachTriangle(surface,
    [&](vtkIdType cell, const Triangle& corners)
    {
      heart.Beat();
      if (outcome)
      {
        outcome = CheckCoordinatesOf(cell, corners, coordinates);
      }
    });
  return outcome;
}

struct Box
{
  std::array<double, 2> Least{ 1.0, 1.0 };
  std::array<double, 2> Largest{ 0.0, 0.0 };
};

//------------------------------------------------------------------------------
std::map<double, Box> GetBoxesOfCharts(vtkPolyData* surface)
{
  vtkDataArray* charts = surface->GetCellData()->GetArray(ArrayNames::ChartId);
  vtkDataArray* coordinates = GetCoordinates(surface);
  std::map<double, Box> boxes;
  if (charts)
  {
    ForEachTriangle(surface,
      [&](vtkIdType cell, const Triangle& corners)
      {
        Box& box = boxes[charts->GetComponent(cell, 0)];
        for (const vtkIdType corner : corners)
        {
          for (int axis = 0; axis < 2; ++axis)
          {
            const double value = coordinates->GetComponent(corner, axis);
            box.Least[axis] = std::min(box.Least[axis], value);
            box.Largest[axis] = std::max(box.Largest[axis], value);
          }
        }
      });
  }
  return boxes;
}

//------------------------------------------------------------------------------
double GetArea(vtkPolyData* surface, const Triangle& corners)
{
  std::array<std::array<double, 3>, 3> points;
  for (int i = 0; i < 3; ++i)
  {
    surface->GetPoint(corners[i], points[i].data());
  }
  std::array<double, 3> u;
  std::array<double, 3> v;
  std::array<double, 3> cross;
  vtkMath::Subtract(points[1].data(), points[0].data(), u.data());
  vtkMath::Subtract(points[2].data(), points[0].data(), v.data());
  vtkMath::Cross(u.data(), v.data(), cross.data());
  return 0.5 * vtkMath::Norm(cross.data());
}

//------------------------------------------------------------------------------
Outcome CheckResolution(vtkPolyData* surface, int resolution)
{
  const std::string size = std::to_string(resolution) + " x " + std::to_string(resolution);
  if (resolution < 1 || resolution > TexelPieces::MaximumResolution ||
    (resolution & (resolution - 1)) != 0)
  {
    return Outcome::Failed("A map of " + size +
      " texels cannot be made or read: the number must be a "
      "power of two, not above " +
      std::to_string(TexelPieces::MaximumResolution) + ".");
  }
  const int smallest = TexelPieces::GetSmallestResolution(surface);
  if (smallest > TexelPieces::MaximumResolution)
  {
    return Outcome::Failed("The charts of the surface do not end between texels at any resolution: "
                           "make the atlas with vtkSurfaceAtlas.");
  }
  if (resolution < smallest)
  {
    const std::string needed = std::to_string(smallest);
    return Outcome::Failed("In a map of " + size +
      " texels some would belong to two charts: take at "
      "least " +
      needed + " x " + needed + ".");
  }
  return Outcome::Done();
}

struct Vertex
{
  /// In texels.
  std::array<double, 2> Position;
  /// Barycentric coordinates in the triangle.
  std::array<double, 3> Weights;
};

// A part of a triangle in a rectangle of the grid. Each of its edges lies on one of the triangle's
// three sides or on one of the rectangle's four.
struct Polygon
{
  std::array<Vertex, 7> Vertices;
  int Size = 0;

  void Add(const Vertex& vertex) { this->Vertices[this->Size++] = vertex; }
};

// Columns and rows of texels, the last one not included.
struct Range
{
  std::array<int, 2> First;
  std::array<int, 2> Last;
};

//------------------------------------------------------------------------------
// The point of an edge at which a coordinate has a value. Kept between the ends against rounding,
// so that polygons stay convex along each axis, and never leave the block of their chart.
Vertex Cut(const Vertex& from, const Vertex& to, int axis, double value)
{
  const double t = (value - from.Position[axis]) / (to.Position[axis] - from.Position[axis]);
  const int other = 1 - axis;
  const auto ends = std::minmax(from.Position[other], to.Position[other]);
  Vertex cut;
  cut.Position[axis] = value;
  cut.Position[other] =
    std::clamp(from.Position[other] + t * (to.Position[other] - from.Position[other]), ends.first,
      ends.second);
  for (int i = 0; i < 3; ++i)
  {
    cut.Weights[i] = (1.0 - t) * from.Weights[i] + t * to.Weights[i];
  }
  return cut;
}

//------------------------------------------------------------------------------
// The two halves share the points of the cut, so nothing is lost or counted twice between them.
void Split(const Polygon& polygon, int axis, double value, Polygon& below, Polygon& above)
{
  for (int i = 0; i < polygon.Size; ++i)
  {
    const Vertex& vertex = polygon.Vertices[i];
    const Vertex& next = polygon.Vertices[i + 1 < polygon.Size ? i + 1 : 0];
    const double here = vertex.Position[axis];
    const double there = next.Position[axis];
    if (here <= value)
    {
      below.Add(vertex);
    }
    if (here >= value)
    {
      above.Add(vertex);
    }
    if ((here < value && there > value) || (here > value && there < value))
    {
      const Vertex cut = Cut(vertex, next, axis, value);
      below.Add(cut);
      above.Add(cut);
    }
  }
}

//------------------------------------------------------------------------------
// Leave out rows and columns that the polygon does not reach into. At least one is kept: a polygon
// that rounding has made a part of a grid line must not leave the texels of its triangle.
void Shrink(const Polygon& polygon, Range& range)
{
  for (int axis = 0; axis < 2; ++axis)
  {
    double least = polygon.Vertices[0].Position[axis];
    double largest = least;
    for (int i = 1; i < polygon.Size; ++i)
    {
      least = std::min(least, polygon.Vertices[i].Position[axis]);
      largest = std::max(largest, polygon.Vertices[i].Position[axis]);
    }
    const int first = static_cast<int>(least);
    const int last = static_cast<int>(largest) + (largest > static_cast<int>(largest) ? 1 : 0);
    range.First[axis] = std::max(range.First[axis], std::min(first, range.Last[axis] - 1));
    range.Last[axis] = std::min(range.Last[axis], std::max(last, range.First[axis] + 1));
  }
}

//------------------------------------------------------------------------------
// Twice the area of the triangle of a polygon's first vertex and two others in barycentric
// coordinates, in which a triangle that is a needle in the atlas is as wide as any other.
double GetPart(const Polygon& polygon, int second)
{
  const std::array<double, 3>& o = polygon.Vertices[0].Weights;
  const std::array<double, 3>& p = polygon.Vertices[second].Weights;
  const std::array<double, 3>& q = polygon.Vertices[second + 1].Weights;
  return (p[1] - o[1]) * (q[2] - o[2]) - (p[2] - o[2]) * (q[1] - o[1]);
}

//------------------------------------------------------------------------------
double GetSize(const Polygon& polygon)
{
  double size = 0.0;
  for (int i = 1; i + 1 < polygon.Size; ++i)
  {
    size += GetPart(polygon, i);
  }
  return std::max(size, 0.0);
}

//------------------------------------------------------------------------------
// Never outside the polygon, even if rounding has turned parts of it over.
std::array<double, 3> GetCentroid(const Polygon& polygon)
{
  std::array<double, 3> moment{ 0.0, 0.0, 0.0 };
  double size = 0.0;
  for (int i = 1; i + 1 < polygon.Size; ++i)
  {
    const double part = std::max(GetPart(polygon, i), std::numeric_limits<double>::min());
    size += part;
    for (int j = 0; j < 3; ++j)
    {
      moment[j] += part *
        (polygon.Vertices[0].Weights[j] + polygon.Vertices[i].Weights[j] +
          polygon.Vertices[i + 1].Weights[j]);
    }
  }
  for (double& weight : moment)
  {
    weight /= 3.0 * size;
  }
  return moment;
}

// Halves a triangle along the lines of the grid until each part lies in one texel: the parts have
// been cut only a few times each, so that rounding does not add up even in a triangle that covers
// millions of texels. At each cut the area is shared out, so that none is lost or made.
class Divider
{
public:
  Divider(int resolution, const TexelPieces::Visitor& visitor, const Monitor& monitor,
    vtkIdType numberOfCells)
    : Resolution(resolution), Visitor(visitor), Watcher(monitor), NumberOfCells(numberOfCells)
  {
  }

  void Divide(vtkIdType cell, double area, const Polygon& triangle)
  {
    this->Piece.Cell = cell;
    this->Divide(triangle, area, Range{ { 0, 0 }, { this->Resolution, this->Resolution } });
  }

private:
  void Divide(const Polygon& polygon, double area, Range range)
  {
    Shrink(polygon, range);
    const int columns = range.Last[0] - range.First[0];
    const int rows = range.Last[1] - range.First[1];
    if (columns == 1 && rows == 1)
    {
      this->Piece.Texel =
        range.First[0] + static_cast<vtkIdType>(this->Resolution) * range.First[1];
      this->Beat();
      this->Piece.Area = std::max(area, std::numeric_limits<double>::min());
      this->Piece.Weights = GetCentroid(polygon);
      this->Visitor(this->Piece);
      return;
    }
    const int axis = columns >= rows ? 0 : 1;
    const int middle = (range.First[axis] + range.Last[axis]) / 2;
    Polygon below;
    Polygon above;
    Split(polygon, axis, middle, below, above);
    const double sizeBelow = GetSize(below);
    const double sizeAbove = GetSize(above);
    if (sizeBelow > 0.0)
    {
      Range lower = range;
      lower.Last[axis] = middle;
      this->Divide(below, area * (sizeBelow / (sizeBelow + sizeAbove)), lower);
    }
    if (sizeAbove > 0.0 || sizeBelow == 0.0)
    {
      range.First[axis] = middle;
      const double share = sizeBelow == 0.0 ? 1.0 : sizeAbove / (sizeBelow + sizeAbove);
      this->Divide(above, area * share, range);
    }
  }

  // A triangle may have millions of pieces, so these are what is counted.
  void Beat()
  {
    constexpr std::size_t interval = 16384;
    if (++this->NumberOfPieces % interval == 0 &&
      !this->Watcher.Report(
        static_cast<double>(this->Piece.Cell) / static_cast<double>(this->NumberOfCells)))
    {
      throw Heartbeat::Stopped();
    }
  }

  int Resolution;
  const TexelPieces::Visitor& Visitor;
  const Monitor& Watcher;
  vtkIdType NumberOfCells;
  std::size_t NumberOfPieces = 0;
  TexelPieces::Piece Piece;
};
} // namespace

//------------------------------------------------------------------------------
Outcome TexelPieces::Check(vtkPolyData* surface, int resolution, const Monitor& monitor)
{
  if (Outcome checked = CheckCells(surface); !checked)
  {
    return checked;
  }
  if (Outcome checked = CheckCoordinates(surface, monitor); !checked)
  {
    return checked;
  }
  return CheckResolution(surface, resolution);
}

//------------------------------------------------------------------------------
int TexelPieces::GetSmallestResolution(vtkPolyData* surface)
{
  int resolution = 1;
  for (const auto& chart : GetBoxesOfCharts(surface))
  {
    const Box& box = chart.second;
    for (const double value : { box.Least[0], box.Least[1], box.Largest[0], box.Largest[1] })
    {
      while (
        resolution <= MaximumResolution && value * resolution != std::floor(value * resolution))
      {
        resolution *= 2;
      }
    }
  }
  return resolution;
}

//------------------------------------------------------------------------------
void TexelPieces::Visit(vtkPolyData* surface, int resolution, const Visitor& visitor,
  const Monitor& monitor)
{
  vtkDataArray* coordinates = GetCoordinates(surface);
  Divider divider(resolution, visitor, monitor, surface->GetNumberOfCells());
  Polygon polygon;
  polygon.Size = 3;
  for (int i = 0; i < 3; ++i)
  {
    polygon.Vertices[i].Weights = { 0.0, 0.0, 0.0 };
    polygon.Vertices[i].Weights[i] = 1.0;
  }
  ForEachTriangle(surface,
    [&](vtkIdType cell, const Triangle& corners)
    {
      for (int i = 0; i < 3; ++i)
      {
        for (int axis = 0; axis < 2; ++axis)
        {
          // Exact, as the resolution is a power of two.
          polygon.Vertices[i].Position[axis] =
            coordinates->GetComponent(corners[i], axis) * resolution;
        }
      }
      divider.Divide(cell, GetArea(surface, corners), polygon);
    });
}
} // namespace LightTransport
