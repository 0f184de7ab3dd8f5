// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The pieces that texels cut from triangles: none is lost, none is in a foreign texel, each has the
// area and the centroid that integration finds.
#include "AtlasTestTools.h"

#include "Atlas/TexelPieces.h"

#include <algorithm>
#include <map>

using namespace LightTransport;

namespace
{
using meshTest::Checker;
using Point = std::array<double, 2>;
using Triangle = std::array<Point, 3>;
using Piece = TexelPieces::Piece;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeFlat(const std::vector<Triangle>& triangles)
{
  std::vector<meshTest::Vector> points;
  std::vector<std::array<vtkIdType, 3>> cells;
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(2);
  for (const Triangle& triangle : triangles)
  {
    const vtkIdType first = static_cast<vtkIdType>(points.size());
    cells.push_back({ first, first + 1, first + 2 });
    for (const Point& point : triangle)
    {
      points.push_back({ point[0], point[1], 0.0 });
      coordinates->InsertNextTuple(point.data());
    }
  }
  vtkSmartPointer<vtkPolyData> surface = meshTest::MakeSurface(points, cells);
  surface->GetPointData()->SetTCoords(coordinates);
  return surface;
}

// Area, and its product with the centroid, of the part of a triangle in a rectangle: integrals over
// x, by the rules that are exact for them, between the places where a side of one crosses or ends
// at a side of the other.
class Reference
{
public:
  Reference(const Triangle& corners, const Point& least, const Point& largest)
    : Corners(corners), Least(least), Largest(largest)
  {
    std::vector<double> places{ least[0], largest[0] };
    for (int i = 0; i < 3; ++i)
    {
      const Point& p = corners[i];
      const Point& q = corners[(i + 1) % 3];
      places.push_back(std::clamp(p[0], least[0], largest[0]));
      for (const double y : { least[1], largest[1] })
      {
        if ((p[1] < y) != (q[1] < y))
        {
          const double x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
          places.push_back(std::clamp(x, least[0], largest[0]));
        }
      }
    }
    std::sort(places.begin(), places.end());
    for (std::size_t i = 1; i < places.size(); ++i)
    {
      this->Add(places[i - 1], places[i]);
    }
  }

  double Area = 0.0;
  Point Moment{ 0.0, 0.0 };

private:
  // Simpson's rule over a column, each end of which is seen from inside.
  void Add(double from, double to)
  {
    const double middle = 0.5 * (from + to);
    const Point inside = this->GetEnds(middle);
    if (to <= from || inside[1] <= inside[0])
    {
      return;
    }
    const double inset = 0.25 * (to - from);
    const Point near = this->GetEnds(middle - inset);
    const Point far = this->GetEnds(middle + inset);
    for (const double sign : { -1.0, 0.0, 1.0 })
    {
      const double weight = (to - from) * (sign == 0.0 ? 4.0 : 1.0) / 6.0;
      const double low = inside[0] + sign * (far[0] - near[0]);
      const double high = inside[1] + sign * (far[1] - near[1]);
      this->Area += weight * (high - low);
      this->Moment[0] += weight * (high - low) * (middle + sign * 0.5 * (to - from));
      this->Moment[1] += weight * 0.5 * (high - low) * (high + low);
    }
  }

  // Where the vertical line at x enters and leaves.
  Point GetEnds(double x) const
  {
    Point ends{ this->Largest[1], this->Least[1] };
    for (int i = 0; i < 3; ++i)
    {
      const Point& p = this->Corners[i];
      const Point& q = this->Corners[(i + 1) % 3];
      if ((p[0] < x) != (q[0] < x))
      {
        const double y = p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
        ends[0] = std::min(ends[0], std::max(y, this->Least[1]));
        ends[1] = std::max(ends[1], std::min(y, this->Largest[1]));
      }
    }
    return ends;
  }

  Triangle Corners;
  Point Least;
  Point Largest;
};

//------------------------------------------------------------------------------
std::vector<Triangle> MakeRandomTriangles(int resolution)
{
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  std::vector<Triangle> triangles;
  // Anywhere, small, with corners on lines of the grid, and with corners on its crossings.
  for (int i = 0; i < 400; ++i)
  {
    Triangle triangle;
    const Point center{ random(engine), random(engine) };
    for (Point& point : triangle)
    {
      point = { random(engine), random(engine) };
      for (int axis = 0; axis < 2; ++axis)
      {
        if (i % 4 == 1)
        {
          point[axis] = std::min(1.0, center[axis] + 0.02 * point[axis]);
        }
        if (i % 4 == 3 || (i % 4 == 2 && random(engine) < 0.5))
        {
          point[axis] = std::round(point[axis] * resolution) / resolution;
        }
      }
    }
    const double turn = (triangle[1][0] - triangle[0][0]) * (triangle[2][1] - triangle[0][1]) -
      (triangle[1][1] - triangle[0][1]) * (triangle[2][0] - triangle[0][0]);
    if (turn < 0.0)
    {
      std::swap(triangle[1], triangle[2]);
    }
    if (turn != 0.0)
    {
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

//------------------------------------------------------------------------------
void TestAgainstIntegration(Checker& check)
{
  const int resolution = 8;
  const std::vector<Triangle> triangles = MakeRandomTriangles(resolution);
  std::map<std::pair<vtkIdType, vtkIdType>, Piece> pieces;
  int twice = 0;
  TexelPieces::Visit(MakeFlat(triangles), resolution,
    [&](const Piece& piece)
    { twice += !pieces.emplace(std::make_pair(piece.Cell, piece.Texel), piece).second; });
  check.Equal(twice, 0, 0, "pieces that have cell and texel in common");
  double worstArea = 0.0;
  double worstMoment = 0.0;
  for (std::size_t cell = 0; cell < triangles.size(); ++cell)
  {
    for (int texel = 0; texel < resolution * resolution; ++texel)
    {
      const Point least{ static_cast<double>(texel % resolution) / resolution,
        static_cast<double>(texel / resolution) / resolution };
      const Point largest{ least[0] + 1.0 / resolution, least[1] + 1.0 / resolution };
      const Reference expected(triangles[cell], least, largest);
      const auto found = pieces.find({ static_cast<vtkIdType>(cell), texel });
      const Piece piece =
        found == pieces.end() ? Piece{ texel, 0, 0.0, { 0, 0, 0 } } : found->second;
      worstArea = std::max(worstArea, std::abs(piece.Area - expected.Area));
      for (int axis = 0; axis < 2; ++axis)
      {
        double moment = 0.0;
        for (int i = 0; i < 3; ++i)
        {
          moment += piece.Area * piece.Weights[i] * triangles[cell][i][axis];
        }
        worstMoment = std::max(worstMoment, std::abs(moment - expected.Moment[axis]));
      }
    }
  }
  // A texel's area is 1/64.
  check.Equal(worstArea, 0.0, 1e-15, "largest error of a piece's area");
  check.Equal(worstMoment, 0.0, 1e-15, "largest error of a piece's area x centroid");
}

//------------------------------------------------------------------------------
// The pieces of each cell make up the cell, and each chart's lie in the chart's block.
void TestSums(vtkPolyData* surface, int resolution, const std::string& what, Checker& check)
{
  check.True(static_cast<bool>(TexelPieces::Check(surface, resolution)), "this is an atlas");
  vtkDataArray* charts = surface->GetCellData()->GetArray("ChartId");
  const std::vector<double> areas = atlasTest::GetCellAreas(surface);
  std::vector<std::array<double, 3>> moments(areas.size(), { 0.0, 0.0, 0.0 });
  std::vector<double> sums(areas.size(), 0.0);
  std::map<vtkIdType, double> chartOfTexel;
  int shared = 0;
  int outside = 0;
  TexelPieces::Visit(surface, resolution,
    [&](const Piece& piece)
    {
      const double chart = charts->GetTuple1(piece.Cell);
      shared += chartOfTexel.emplace(piece.Texel, chart).first->second != chart;
      sums[piece.Cell] += piece.Area;
      double sumOfWeights = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        outside += piece.Weights[i] < 0.0;
        sumOfWeights += piece.Weights[i];
        moments[piece.Cell][i] += piece.Area * piece.Weights[i];
      }
      outside += std::abs(sumOfWeights - 1.0) > 1e-14;
    });
  check.Equal(shared, 0, 0, "pieces in the texels of another chart, " + what);
  check.Equal(outside, 0, 0, "pieces outside their cells, " + what);
  check.Equal(static_cast<double>(chartOfTexel.size()), resolution * resolution, 0,
    "texels with surface, " + what);
  double worst = 0.0;
  for (std::size_t cell = 0; cell < areas.size(); ++cell)
  {
    worst = std::max(worst, std::abs(sums[cell] / areas[cell] - 1.0));
    for (const double moment : moments[cell])
    {
      worst = std::max(worst, std::abs(moment / areas[cell] - 1.0 / 3.0));
    }
  }
  check.Equal(worst, 0.0, 1e-12, "largest relative error of the sums over a cell, " + what);
}

//------------------------------------------------------------------------------
// Each texel of a flat chart has the same area, whatever the triangles.
void TestAreaOfTexels(vtkPolyData* square, int resolution, Checker& check)
{
  std::vector<double> areas(static_cast<std::size_t>(resolution) * resolution, 0.0);
  vtkIdType count = 0;
  TexelPieces::Visit(square, resolution,
    [&](const Piece& piece)
    {
      areas[piece.Texel] += piece.Area;
      ++count;
    });
  const double expected = 4.0 / (static_cast<double>(resolution) * resolution);
  double worst = 0.0;
  for (const double area : areas)
  {
    worst = std::max(worst, std::abs(area / expected - 1.0));
  }
  check.Equal(worst, 0.0, 1e-12, "largest relative error of a texel's area");
  if (square->GetNumberOfCells() == 2)
  {
    check.Equal(static_cast<double>(count), resolution * (resolution + 1.0), 0,
      "pieces of two triangles whose common side is the diagonal");
  }
}

//------------------------------------------------------------------------------
// Triangles one rounding unit wide beside a line of the grid, and across one: no piece on the other
// side of the line, nothing lost.
void TestNeedles(Checker& check)
{
  const int resolution = 64;
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> random(0.0, 1.0);
  std::vector<Triangle> triangles;
  for (int column = 1; column < resolution; ++column)
  {
    const double line = static_cast<double>(column) / resolution;
    for (const double beside : { std::nextafter(line, 0.0), std::nextafter(line, 1.0) })
    {
      const double low = random(engine);
      const double high = low + random(engine) * (1.0 - low);
      const double middle = low + random(engine) * (high - low);
      Triangle triangle{ { { line, low }, { beside, middle }, { line, high } } };
      if (beside < line)
      {
        std::swap(triangle[1], triangle[2]);
      }
      triangles.push_back(triangle);
      for (Point& point : triangle)
      {
        std::swap(point[0], point[1]);
      }
      std::swap(triangle[0], triangle[1]);
      triangles.push_back(triangle);
    }
  }
  vtkSmartPointer<vtkPolyData> surface = MakeFlat(triangles);
  // Wide in space, whatever they are in the atlas.
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    surface->GetPoints()->SetPoint(i, i % 3 == 0, i % 3 == 1, i % 3 == 2);
  }
  check.True(static_cast<bool>(TexelPieces::Check(surface, resolution)), "this is an atlas");
  std::vector<double> sums(triangles.size(), 0.0);
  int astray = 0;
  TexelPieces::Visit(surface, resolution,
    [&](const Piece& piece)
    {
      sums[piece.Cell] += piece.Area;
      const vtkIdType place[2] = { piece.Texel % resolution, piece.Texel / resolution };
      for (int axis = 0; axis < 2; ++axis)
      {
        const Triangle& triangle = triangles[piece.Cell];
        const auto ends = std::minmax({ triangle[0][axis], triangle[1][axis], triangle[2][axis] });
        astray += place[axis] + 1 <= ends.first * resolution;
        astray += place[axis] >= ends.second * resolution;
      }
    });
  check.Equal(astray, 0, 0, "pieces of needles beyond the line that the needle ends at");
  const double area = 0.5 * std::sqrt(3.0);
  for (const double sum : sums)
  {
    check.Equal(sum / area, 1.0, 1e-12, "area of the pieces of a needle");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestTexelPieces(int, char*[])
{
  Checker check;
  TestAgainstIntegration(check);
  for (const int resolution : { 2, 16, 128 })
  {
    const std::string what = " at resolution " + std::to_string(resolution);
    TestSums(atlasTest::MakeSquare(20, 0.2), resolution, "square" + what, check);
    TestSums(atlasTest::MakeCylinder(11), resolution, "cylinder" + what, check);
    TestSums(atlasTest::MakeMixture(), std::max(resolution, 4), "mixture" + what, check);
    TestAreaOfTexels(atlasTest::MakeSquare(50, 0.2), resolution, check);
  }
  TestAreaOfTexels(atlasTest::MakeSquare(1, 0.0), 1024, check);
  TestNeedles(check);
  check.Equal(TexelPieces::GetSmallestResolution(atlasTest::MakeSquare(2, 0.0)), 1, 0,
    "smallest resolution for one chart");
  check.Equal(TexelPieces::GetSmallestResolution(atlasTest::MakeMixture()), 4, 0,
    "smallest resolution for charts of a quarter of the side");
  return check.GetExitCode();
}
