// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of the meshing filters ask of a mesh, computed without the code under test.
#ifndef MeshTestTools_h
#define MeshTestTools_h

#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPatchMesher.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTestUtilities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace meshTest
{
using Vector = std::array<double, 3>;

/// Says what was wrong and counts it.
class Checker
{
public:
  /// What comes before all messages from now on.
  void SetSubject(const std::string& subject) { this->Subject = subject + ": "; }
  void True(bool condition, const std::string& what)
  {
    if (!condition)
    {
      std::cerr << "Failed: " << this->Subject << what << "\n";
      ++this->Failures;
    }
  }
  void Equal(double value, double expected, double tolerance, const std::string& what)
  {
    if (!(std::abs(value - expected) <= tolerance))
    {
      std::cerr.precision(17);
      std::cerr << "Failed: " << this->Subject << what << " is " << value << ", expected "
                << expected << " +- " << tolerance << "\n";
      ++this->Failures;
    }
  }
  int GetExitCode() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  std::string Subject;
  int Failures = 0;
};

//------------------------------------------------------------------------------
inline Vector GetPoint(vtkPolyData* mesh, vtkIdType id)
{
  Vector point;
  mesh->GetPoint(id, point.data());
  return point;
}

//------------------------------------------------------------------------------
/// The area vector of a polygon: along the normal, as long as the area is large.
inline Vector GetAreaVector(vtkPolyData* mesh, vtkIdType cell)
{
  vtkIdType size;
  const vtkIdType* ids;
  mesh->GetCellPoints(cell, size, ids);
  const Vector origin = GetPoint(mesh, ids[0]);
  Vector sum{ 0.0, 0.0, 0.0 };
  for (vtkIdType i = 1; i + 1 < size; ++i)
  {
    Vector u;
    Vector v;
    Vector cross;
    vtkMath::Subtract(GetPoint(mesh, ids[i]).data(), origin.data(), u.data());
    vtkMath::Subtract(GetPoint(mesh, ids[i + 1]).data(), origin.data(), v.data());
    vtkMath::Cross(u.data(), v.data(), cross.data());
    for (int j = 0; j < 3; ++j)
    {
      sum[j] += 0.5 * cross[j];
    }
  }
  return sum;
}

//------------------------------------------------------------------------------
inline double GetArea(vtkPolyData* mesh)
{
  double area = 0.0;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    area += vtkMath::Norm(GetAreaVector(mesh, cell).data());
  }
  return area;
}

//------------------------------------------------------------------------------
/// The area of the cells of each value of a cell array.
inline std::map<int, double> GetAreas(vtkPolyData* mesh, const char* array)
{
  std::map<int, double> areas;
  vtkDataArray* values = mesh->GetCellData()->GetArray(array);
  for (vtkIdType cell = 0; values && cell < mesh->GetNumberOfCells(); ++cell)
  {
    areas[static_cast<int>(values->GetTuple1(cell))] +=
      vtkMath::Norm(GetAreaVector(mesh, cell).data());
  }
  return areas;
}

//------------------------------------------------------------------------------
/// The volume that a closed surface encloses: negative when its normals point inward.
inline double GetVolume(vtkPolyData* mesh)
{
  double volume = 0.0;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    const Vector area = GetAreaVector(mesh, cell);
    volume += vtkMath::Dot(area.data(), GetPoint(mesh, mesh->GetCell(cell)->GetPointId(0)).data());
  }
  return volume / 3.0;
}

struct Edges
{
  /// Sides of cells that no other cell shares: from point, to point.
  std::vector<std::pair<vtkIdType, vtkIdType>> Borders;
  /// Sides that more than two cells, or two cells in the same direction, have in common.
  int Bad = 0;
  double Shortest = VTK_DOUBLE_MAX;
  double Longest = 0.0;
  double Mean = 0.0;
};

//------------------------------------------------------------------------------
inline Edges GetEdges(vtkPolyData* mesh)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> uses;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    mesh->GetCellPoints(cell, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      ++uses[std::make_pair(ids[i], ids[(i + 1) % size])];
    }
  }
  Edges edges;
  for (const auto& use : uses)
  {
    const auto opposite = uses.find(std::make_pair(use.first.second, use.first.first));
    edges.Bad += use.second > 1;
    if (opposite == uses.end())
    {
      edges.Borders.push_back(use.first);
    }
    const double length = std::sqrt(vtkMath::Distance2BetweenPoints(
      GetPoint(mesh, use.first.first).data(), GetPoint(mesh, use.first.second).data()));
    edges.Shortest = std::min(edges.Shortest, length);
    edges.Longest = std::max(edges.Longest, length);
    edges.Mean += length / uses.size();
  }
  return edges;
}

//------------------------------------------------------------------------------
inline bool IsClosed(vtkPolyData* mesh)
{
  const Edges edges = GetEdges(mesh);
  return mesh->GetNumberOfCells() > 0 && edges.Borders.empty() && edges.Bad == 0;
}

//------------------------------------------------------------------------------
/// A one-tuple field data array; NaN when there is none.
inline double GetSummary(vtkPolyData* mesh, const char* name)
{
  vtkDataArray* array = mesh->GetFieldData()->GetArray(name);
  return array && array->GetNumberOfValues() == 1 ? array->GetTuple1(0) : vtkMath::Nan();
}

//------------------------------------------------------------------------------
inline std::string GetDataFile(int argc, char* argv[], const char* name)
{
  char* path = vtkTestUtilities::ExpandDataFileName(argc, argv, name);
  const std::string file = path;
  delete[] path;
  return file;
}

//------------------------------------------------------------------------------
/// The mesh of a file in Geomview's Object File Format: points and polygons, without colours. No
/// points when there is no such file.
inline vtkSmartPointer<vtkPolyData> ReadOff(const std::string& path)
{
  std::ifstream file(path);
  std::stringstream text;
  for (std::string line; std::getline(file, line);)
  {
    text << line.substr(0, line.find('#')) << '\n';
  }
  std::string header;
  vtkIdType numberOfPoints = 0;
  vtkIdType numberOfCells = 0;
  vtkIdType numberOfEdges;
  text >> header >> numberOfPoints >> numberOfCells >> numberOfEdges;
  const auto skipColor = [&text]()
  { text.ignore(std::numeric_limits<std::streamsize>::max(), '\n'); };

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  Vector point;
  while (points->GetNumberOfPoints() < numberOfPoints && text >> point[0] >> point[1] >> point[2])
  {
    points->InsertNextPoint(point.data());
    skipColor();
  }
  vtkNew<vtkCellArray> cells;
  for (int size; cells->GetNumberOfCells() < numberOfCells && text >> size; skipColor())
  {
    std::vector<vtkIdType> ids(size);
    for (vtkIdType& id : ids)
    {
      text >> id;
    }
    cells->InsertNextCell(size, ids.data());
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(cells);
  return mesh;
}

//------------------------------------------------------------------------------
/// The mesh of an .off or a .ply file.
inline vtkSmartPointer<vtkPolyData> ReadMesh(const std::string& path)
{
  if (path.substr(path.rfind('.')) == ".off")
  {
    return ReadOff(path);
  }
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
/// What is known of the mesh in a file, by its name without folder and extension; nullptr if
/// nothing.
template <typename Known, std::size_t Size>
const Known* FindByFile(const Known (&known)[Size], const std::string& path)
{
  const std::size_t start = path.find_last_of("/\\") + 1;
  const std::string name = path.substr(start, path.rfind('.') - start);
  const Known* found = std::find_if(std::begin(known), std::end(known),
    [&name](const Known& candidate) { return candidate.Name == name; });
  return found == std::end(known) ? nullptr : found;
}

//------------------------------------------------------------------------------
/// A surface from coordinates and triangles, to which `Region` = 0, 1, 2... may be added.
inline vtkSmartPointer<vtkPolyData> MakeSurface(const std::vector<Vector>& coordinates,
  const std::vector<std::array<vtkIdType, 3>>& triangles)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vector& point : coordinates)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : triangles)
  {
    cells->InsertNextCell(3, triangle.data());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}
} // namespace meshTest

#endif
