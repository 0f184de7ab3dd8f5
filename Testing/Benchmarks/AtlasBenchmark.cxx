// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Atlases of meshes: how good they are and what they cost, a row for each mesh.
 *
 * Not a test: times depend on the machine and on what else it does, which is why they are seconds
 * of the processor, of all threads together: of the mesher, the atlas, its texel maps with their
 * areas, and one array to texels and back. "peak MB" is the most resident memory of the process so
 * far. See vtkSurfaceAtlas for the other numbers; "error" is by how much the integral over the
 * surface changes on the way to the texels and back, relative to itself.
 *
 * With --measure files are not unfolded, but have texture coordinates from elsewhere, which are
 * measured alike. Triangles without area in the texture, which nothing can be painted on, are left
 * out: "in" counts them, "out" does not.
 */
#include "Atlas/AtlasMetrics.h"
#include "vtkAtlasToSurface.h"
#include "vtkPatchMesher.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkLinearSubdivisionFilter.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTriangle.h"
#include "vtkTriangleFilter.h"
#include "vtkXMLPolyDataReader.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

using namespace LightTransport;

namespace
{
constexpr const char* Usage =
  "usage: AtlasBenchmark [option value]... [MESH]...\n"
  "  MESH           a file (.ply, .off, .obj, .vtp), or a number: a sphere with bumps and about\n"
  "                 so many triangles (default 20 20000 200000)\n"
  "  --measure      1: measure the texture coordinates that the files have (0)\n"
  "  --patches      about so many triangles are made of each mesh at first; 0 for none (0)\n"
  "  --divide       each triangle becomes 4, so many times (0)\n"
  "  --resolution   of the atlas (512)\n"
  "  --stretch      the largest of a chart (1.2)\n";

struct Options
{
  bool Measure = false;
  vtkIdType Patches = 0;
  int Divisions = 0;
  int Resolution = 512;
  double Stretch = 1.2;
  std::vector<std::string> Meshes;
};

struct Measurement
{
  vtkIdType TrianglesIn = 0;
  vtkIdType TrianglesOut = 0;
  double Charts = 0.0;
  double DeepestLevel = 0.0;
  double MesherSeconds = 0.0;
  double AtlasSeconds = 0.0;
  double MapSeconds = 0.0;
  double TransferSeconds = 0.0;
  double IntegralError = 0.0;
};

//------------------------------------------------------------------------------
/// What the process has used since the last call, on all its threads.
double TakeSeconds()
{
  static std::clock_t last = 0;
  const std::clock_t now = std::clock();
  const double seconds = static_cast<double>(now - last) / CLOCKS_PER_SEC;
  last = now;
  return seconds;
}

//------------------------------------------------------------------------------
/// In MB; NaN where the system does not tell.
double GetPeakMemory()
{
  std::ifstream status("/proc/self/status");
  std::string line;
  while (std::getline(status, line))
  {
    if (line.compare(0, 6, "VmHWM:") == 0)
    {
      return 1024e-6 * std::atof(line.c_str() + 6);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
bool ParseOptions(int argc, char* argv[], Options& options)
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string name = argv[i];
    if (name.compare(0, 2, "--") != 0)
    {
      options.Meshes.push_back(name);
      continue;
    }
    if (++i == argc)
    {
      return false;
    }
    const double value = std::atof(argv[i]);
    if (name == "--measure")
    {
      options.Measure = value != 0.0;
    }
    else if (name == "--patches")
    {
      options.Patches = static_cast<vtkIdType>(value);
    }
    else if (name == "--divide")
    {
      options.Divisions = static_cast<int>(value);
    }
    else if (name == "--resolution")
    {
      options.Resolution = static_cast<int>(value);
    }
    else if (name == "--stretch")
    {
      options.Stretch = value;
    }
    else
    {
      return false;
    }
  }
  if (options.Meshes.empty())
  {
    options.Meshes = { "20", "20000", "200000" };
  }
  return true;
}

//------------------------------------------------------------------------------
/// An octahedron whose faces are cut into n x n triangles, blown up to a sphere with bumps.
class BumpySphere
{
public:
  explicit BumpySphere(double triangles)
    : Cuts(std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 8.0)))))
  {
    this->Points->SetDataTypeToDouble();
    for (int octant = 0; octant < 8; ++octant)
    {
      this->AddOctant({ octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1 });
    }
  }

  vtkSmartPointer<vtkPolyData> GetSurface() const
  {
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(this->Points);
    surface->SetPolys(this->Cells);
    return surface;
  }

private:
  using Steps = std::array<int, 3>;

  void AddOctant(const Steps& signs)
  {
    const auto get = [&](int i, int j) {
      return this->GetPoint({ signs[0] * i, signs[1] * j, signs[2] * (this->Cuts - i - j) });
    };
    const bool turned = signs[0] * signs[1] * signs[2] < 0;
    const auto insert = [&](vtkIdType a, vtkIdType b, vtkIdType c)
    {
      const vtkIdType triangle[3] = { a, turned ? c : b, turned ? b : c };
      this->Cells->InsertNextCell(3, triangle);
    };
    for (int i = 0; i < this->Cuts; ++i)
    {
      for (int j = 0; i + j < this->Cuts; ++j)
      {
        insert(get(i, j), get(i + 1, j), get(i, j + 1));
        if (i + j + 1 < this->Cuts)
        {
          insert(get(i + 1, j), get(i + 1, j + 1), get(i, j + 1));
        }
      }
    }
  }

  vtkIdType GetPoint(const Steps& steps)
  {
    const auto place = this->Ids.emplace(steps, this->Points->GetNumberOfPoints());
    if (place.second)
    {
      double p[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        p[axis] = std::sin(0.5 * vtkMath::Pi() * steps[axis] / this->Cuts);
      }
      vtkMath::Normalize(p);
      const double radius = 1.0 + 0.05 * std::sin(8.0 * p[0]) * std::sin(7.0 * p[1] + 2.0 * p[2]);
      this->Points->InsertNextPoint(radius * p[0], radius * p[1], radius * p[2]);
    }
    return place.first->second;
  }

  int Cuts;
  std::map<Steps, vtkIdType> Ids;
  vtkNew<vtkPoints> Points;
  vtkNew<vtkCellArray> Cells;
};

//------------------------------------------------------------------------------
/// Numbers of points, faces and edges, then the points, then the faces; nothing on damage.
vtkSmartPointer<vtkPolyData> ReadOFF(const std::string& name)
{
  std::ifstream file(name);
  std::string head;
  vtkIdType numberOfPoints = 0;
  vtkIdType numberOfFaces = 0;
  vtkIdType numberOfEdges = 0;
  file >> head >> numberOfPoints >> numberOfFaces >> numberOfEdges;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  double p[3];
  while (points->GetNumberOfPoints() < numberOfPoints && file >> p[0] >> p[1] >> p[2])
  {
    points->InsertNextPoint(p);
  }
  vtkNew<vtkCellArray> faces;
  vtkIdType size = 0;
  while (faces->GetNumberOfCells() < numberOfFaces && file >> size)
  {
    faces->InsertNextCell(static_cast<int>(size));
    vtkIdType id = 0;
    for (vtkIdType i = 0; i < size && file >> id; ++i)
    {
      faces->InsertCellPoint(id);
    }
    // Colours may follow.
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  if (file)
  {
    surface->SetPoints(points);
    surface->SetPolys(faces);
  }
  return surface;
}

//------------------------------------------------------------------------------
template <typename Reader>
vtkSmartPointer<vtkPolyData> Read(const std::string& name)
{
  vtkNew<Reader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
/// Triangles; none where the mesh cannot be had.
vtkSmartPointer<vtkPolyData> GetMesh(const std::string& name)
{
  const std::string ending = vtksys::SystemTools::GetFilenameLastExtension(name);
  vtkSmartPointer<vtkPolyData> mesh;
  if (ending.empty())
  {
    mesh = BumpySphere(std::atof(name.c_str())).GetSurface();
  }
  else if (ending == ".ply")
  {
    mesh = Read<vtkPLYReader>(name);
  }
  else if (ending == ".obj")
  {
    mesh = Read<vtkOBJReader>(name);
  }
  else if (ending == ".vtp")
  {
    mesh = Read<vtkXMLPolyDataReader>(name);
  }
  else
  {
    mesh = ReadOFF(name);
  }
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  return triangles->GetOutput();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Prepare(vtkSmartPointer<vtkPolyData> mesh, const Options& options,
  Measurement& row)
{
  TakeSeconds();
  if (options.Patches > 0)
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetInputData(mesh);
    mesher->SetTargetNumberOfPatches(options.Patches);
    mesher->Update();
    mesh = mesher->GetOutput();
  }
  row.MesherSeconds = TakeSeconds();
  if (options.Divisions > 0)
  {
    vtkNew<vtkLinearSubdivisionFilter> divide;
    divide->SetInputData(mesh);
    divide->SetNumberOfSubdivisions(options.Divisions);
    divide->Update();
    mesh = divide->GetOutput();
  }
  return mesh;
}

//------------------------------------------------------------------------------
/// An array to the texels and back.
void MeasureTransfer(vtkPolyData* surface, Measurement& row)
{
  vtkNew<vtkPolyData> painted;
  painted->ShallowCopy(surface);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Value");
  values->SetNumberOfTuples(surface->GetNumberOfCells());
  std::vector<double> areas(surface->GetNumberOfCells());
  double before = 0.0;
  double after = 0.0;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    areas[cell] = vtkTriangle::SafeDownCast(surface->GetCell(cell))->ComputeArea();
    values->SetValue(cell, 1.0 + std::sin(0.001 * static_cast<double>(cell)));
    before += areas[cell] * values->GetValue(cell);
  }
  painted->GetCellData()->AddArray(values);

  TakeSeconds();
  vtkNew<vtkSurfaceToAtlas> there;
  there->SetInputData(painted);
  vtkNew<vtkAtlasToSurface> back;
  back->SetInputData(0, surface);
  back->SetInputConnection(1, there->GetOutputPort());
  back->Update();
  row.TransferSeconds = TakeSeconds();
  vtkDataArray* result = back->GetOutput()->GetCellData()->GetArray("Value");
  for (vtkIdType cell = 0; result && cell < surface->GetNumberOfCells(); ++cell)
  {
    after += areas[cell] * result->GetComponent(cell, 0);
  }
  row.IntegralError = std::abs(after - before) / before;
}

//------------------------------------------------------------------------------
/// Null where there is no atlas.
vtkSmartPointer<vtkPolyData> Unfold(vtkPolyData* mesh, const Options& options, Measurement& row)
{
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetResolution(options.Resolution);
  atlas->SetMaximumStretch(options.Stretch);
  atlas->TexelMapsOff();
  atlas->SetInputData(mesh);
  TakeSeconds();
  atlas->Update();
  row.AtlasSeconds = TakeSeconds();
  const vtkSmartPointer<vtkPolyData> surface = atlas->GetOutput();
  if (surface->GetNumberOfCells() == 0)
  {
    return nullptr;
  }
  vtkFieldData* metrics = surface->GetFieldData();
  row.Charts = metrics->GetArray("NumberOfCharts")->GetComponent(0, 0);
  row.DeepestLevel = metrics->GetArray("DeepestLeakFreeLevel")->GetComponent(0, 0);

  vtkNew<vtkPolyData> bare;
  bare->CopyStructure(surface);
  bare->GetPointData()->SetTCoords(surface->GetPointData()->GetTCoords());
  bare->GetCellData()->AddArray(
    surface->GetCellData()->GetArray(vtkSurfaceAtlas::GetChartArrayName()));
  vtkNew<vtkSurfaceToAtlas> maps;
  maps->SetResolution(options.Resolution);
  maps->SetInputData(bare);
  TakeSeconds();
  maps->Update();
  row.MapSeconds = TakeSeconds();
  MeasureTransfer(surface, row);
  return surface;
}

//------------------------------------------------------------------------------
/// Without triangles that have no area in the texture; null where there are no coordinates.
vtkSmartPointer<vtkPolyData> DropUnpaintable(vtkPolyData* mesh)
{
  vtkDataArray* coordinates = mesh->GetPointData()->GetTCoords();
  if (!coordinates)
  {
    return nullptr;
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(mesh->GetPoints());
  result->GetPointData()->SetTCoords(coordinates);
  vtkNew<vtkCellArray> triangles;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, ids);
    double uv[3][2];
    for (int corner = 0; corner < 3; ++corner)
    {
      uv[corner][0] = coordinates->GetComponent(ids->GetId(corner), 0);
      uv[corner][1] = coordinates->GetComponent(ids->GetId(corner), 1);
    }
    if ((uv[1][0] - uv[0][0]) * (uv[2][1] - uv[0][1]) !=
      (uv[2][0] - uv[0][0]) * (uv[1][1] - uv[0][1]))
    {
      triangles->InsertNextCell(ids);
    }
  }
  result->SetPolys(triangles);
  return result;
}

//------------------------------------------------------------------------------
void PrintHead()
{
  std::cout << std::setw(24) << "mesh" << std::setw(10) << "in" << std::setw(10) << "out"
            << std::setw(8) << "charts" << std::setw(8) << "L2" << std::setw(8) << "Linf"
            << std::setw(8) << "area" << std::setw(8) << "texels" << std::setw(7) << "level"
            << std::setw(10) << "mesher s" << std::setw(9) << "atlas s" << std::setw(8) << "maps s"
            << std::setw(12) << "transfer s" << std::setw(10) << "error" << std::setw(9)
            << "peak MB"
            << "\n";
}

//------------------------------------------------------------------------------
void PrintRow(const std::string& mesh, const Measurement& row, const AtlasMetrics& metrics,
  bool unfolded)
{
  std::cout << std::setw(24) << vtksys::SystemTools::GetFilenameName(mesh) << std::setw(10)
            << row.TrianglesIn << std::setw(10) << row.TrianglesOut << std::fixed;
  const auto print = [](int width, int digits, double value)
  { std::cout << std::setw(width) << std::setprecision(digits) << value; };
  const auto printOwn = [&](int width, int digits, double value)
  {
    if (unfolded)
    {
      print(width, digits, value);
    }
    else
    {
      std::cout << std::setw(width) << "-";
    }
  };
  printOwn(8, 0, row.Charts);
  print(8, 3, metrics.L2Stretch);
  print(8, 2, metrics.LInfinityStretch);
  print(8, 3, metrics.AreaDistortion);
  print(8, 3, metrics.TexelUse);
  printOwn(7, 0, row.DeepestLevel);
  printOwn(10, 2, row.MesherSeconds);
  printOwn(9, 2, row.AtlasSeconds);
  printOwn(8, 2, row.MapSeconds);
  printOwn(12, 2, row.TransferSeconds);
  std::cout << std::scientific;
  printOwn(10, 1, row.IntegralError);
  std::cout << std::fixed;
  print(9, 0, GetPeakMemory());
  std::cout << std::endl;
}
} // namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  Options options;
  if (!ParseOptions(argc, argv, options))
  {
    std::cerr << Usage;
    return EXIT_FAILURE;
  }
  int result = EXIT_SUCCESS;
  PrintHead();
  for (const std::string& name : options.Meshes)
  {
    Measurement row;
    vtkSmartPointer<vtkPolyData> surface = GetMesh(name);
    if (!options.Measure)
    {
      surface = Prepare(surface, options, row);
    }
    row.TrianglesIn = surface->GetNumberOfCells();
    surface = options.Measure ? DropUnpaintable(surface) : Unfold(surface, options, row);
    if (!surface || surface->GetNumberOfCells() == 0)
    {
      std::cerr << name << " cannot be " << (options.Measure ? "measured" : "unfolded") << ".\n";
      result = EXIT_FAILURE;
      continue;
    }
    row.TrianglesOut = surface->GetNumberOfCells();
    const AtlasMetrics metrics(surface, surface->GetPointData()->GetTCoords());
    PrintRow(name, row, metrics, !options.Measure);
  }
  return result;
}
