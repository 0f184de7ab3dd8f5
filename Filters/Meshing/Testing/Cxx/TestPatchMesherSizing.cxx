// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// How good, how large and how true the patches are: over many surfaces, for each size field.
#include "PatchQuality.h"

#include "Mesher/EdgeLengths.h"
#include "Mesher/SourceSurface.h"
#include "Mesher/SurfaceCurvature.h"

#include "vtkCubeSource.h"
#include "vtkCylinderSource.h"
#include "vtkDiskSource.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkLine.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <vector>

using namespace LightTransport;

namespace
{
using meshTest::GetDistance;
using meshTest::GetQuality;
using meshTest::Quality;
using meshTest::Vector;
using Surface = vtkSmartPointer<vtkPolyData>;

//------------------------------------------------------------------------------
// A closed surface from a function of two angles.
Surface MakeTorus(int m, int n, const std::function<Vector(double, double)>& shape)
{
  std::vector<Vector> points;
  std::vector<std::array<vtkIdType, 3>> triangles;
  const auto index = [&](int i, int j) -> vtkIdType { return (i % m) * n + j % n; };
  for (int i = 0; i < m; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      points.push_back(shape(2.0 * vtkMath::Pi() * i / m, 2.0 * vtkMath::Pi() * j / n));
      triangles.push_back({ index(i, j), index(i + 1, j), index(i + 1, j + 1) });
      triangles.push_back({ index(i, j), index(i + 1, j + 1), index(i, j + 1) });
    }
  }
  return meshTest::MakeSurface(points, triangles);
}

//------------------------------------------------------------------------------
Surface MakeRing(double radius, int m, int n)
{
  return MakeTorus(m, n,
    [=](double u, double v)
    {
      const double r = 1.0 + radius * std::cos(v);
      return Vector{ r * std::cos(u), r * std::sin(u), radius * std::sin(v) };
    });
}

//------------------------------------------------------------------------------
// A trefoil knot, as a tube around its curve.
Surface MakeKnot()
{
  const auto curve = [](double u) -> Vector
  {
    return { std::sin(u) + 2.0 * std::sin(2.0 * u), std::cos(u) - 2.0 * std::cos(2.0 * u),
      -std::sin(3.0 * u) };
  };
  return MakeTorus(240, 24,
    [=](double u, double v)
    {
      Vector along;
      vtkMath::Subtract(curve(u + 1e-4).data(), curve(u - 1e-4).data(), along.data());
      Vector side;
      Vector up{ 0.0, 0.0, 1.0 };
      vtkMath::Cross(along.data(), up.data(), side.data());
      vtkMath::Normalize(side.data());
      vtkMath::Cross(side.data(), along.data(), up.data());
      vtkMath::Normalize(up.data());
      Vector point = curve(u);
      for (int i = 0; i < 3; ++i)
      {
        point[i] += 0.4 * (std::cos(v) * side[i] + std::sin(v) * up[i]);
      }
      return point;
    });
}

//------------------------------------------------------------------------------
template <typename Source>
Surface Get(Source* source)
{
  source->Update();
  auto surface = Surface::New();
  surface->ShallowCopy(source->GetOutput());
  return surface;
}

//------------------------------------------------------------------------------
Surface MakeSphere(int resolution, const Vector& axes)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(1.0);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution / 2);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  Surface sphere = Get(source.Get());
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    const Vector p = meshTest::GetPoint(sphere, i);
    sphere->GetPoints()->SetPoint(i, p[0] * axes[0], p[1] * axes[1], p[2] * axes[2]);
  }
  return sphere;
}

//------------------------------------------------------------------------------
Surface MakeBox(double x, double y, double z)
{
  vtkNew<vtkCubeSource> source;
  source->SetXLength(x);
  source->SetYLength(y);
  source->SetZLength(z);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  Surface box = Get(source.Get());
  vtkNew<vtkIntArray> region;
  region->SetName("Region");
  for (int i = 0; i < 6; ++i)
  {
    region->InsertNextValue(i);
  }
  box->GetCellData()->AddArray(region);
  return box;
}

//------------------------------------------------------------------------------
Surface MakeCylinder()
{
  vtkNew<vtkCylinderSource> source;
  source->SetResolution(40);
  source->SetHeight(3.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return Get(source.Get());
}

//------------------------------------------------------------------------------
Surface MakeDisk()
{
  vtkNew<vtkDiskSource> source;
  source->SetCircumferentialResolution(48);
  source->SetRadialResolution(3);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return Get(source.Get());
}

//------------------------------------------------------------------------------
Surface MakePlane(int resolution)
{
  vtkNew<vtkPlaneSource> source;
  source->SetResolution(resolution, resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  return Get(source.Get());
}

//------------------------------------------------------------------------------
Surface ReadBunny(const std::string& file)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  return Get(reader.Get());
}

//------------------------------------------------------------------------------
void AddLengths(vtkPolyData* surface, const char* name,
  const std::function<double(const Vector&)>& length)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    array->InsertNextValue(length(meshTest::GetPoint(surface, i)));
  }
  surface->GetPointData()->AddArray(array);
}

//------------------------------------------------------------------------------
Surface Remesh(vtkPatchMesher* mesher, vtkPolyData* input)
{
  mesher->SetInputData(input);
  mesher->Update();
  auto patches = Surface::New();
  patches->ShallowCopy(mesher->GetOutput());
  return patches;
}

//------------------------------------------------------------------------------
// Every patch looks the same way as the cell that it comes from, within 90 degrees.
bool IsOrientedAs(vtkPolyData* patches, vtkPolyData* input)
{
  vtkDataArray* ids = patches->GetCellData()->GetArray("OriginalCellIds");
  bool same = true;
  for (vtkIdType i = 0; i < patches->GetNumberOfCells(); ++i)
  {
    const Vector patch = meshTest::GetAreaVector(patches, i);
    const Vector cell = meshTest::GetAreaVector(input, static_cast<vtkIdType>(ids->GetTuple1(i)));
    same = same && vtkMath::Dot(patch.data(), cell.data()) > 0.0;
  }
  return same;
}

struct Case
{
  std::string Name;
  Surface Input;
  double Length;
  /// Least smallest angle, for uniform lengths and by curvature.
  double Angle;
  /// Largest distance over length.
  double Distance;
};

//------------------------------------------------------------------------------
std::vector<Case> MakeCases(const std::string& bunny)
{
  // The sides of the plate are ten times as narrow as the length of the edges to keep along them.
  return { { "sphere", MakeSphere(48, { 1, 1, 1 }), 0.1, 25, 0.1 },
    { "coarse sphere", MakeSphere(12, { 1, 1, 1 }), 0.1, 25, 0.3 },
    { "ellipsoid", MakeSphere(64, { 2, 1, 0.5 }), 0.1, 25, 0.2 },
    { "needle", MakeSphere(48, { 5, 0.3, 0.3 }), 0.15, 20, 0.4 },
    { "ring", MakeRing(0.3, 90, 30), 0.12, 25, 0.1 },
    { "thin ring", MakeRing(0.05, 200, 12), 0.06, 20, 0.4 }, { "knot", MakeKnot(), 0.3, 25, 0.3 },
    { "cube", MakeBox(1, 1, 1), 0.1, 25, 1e-12 }, { "plate", MakeBox(1, 1, 0.01), 0.1, 5, 1e-12 },
    { "cylinder", MakeCylinder(), 0.1, 20, 0.1 }, { "disk", MakeDisk(), 0.1, 20, 1e-12 },
    { "bunny", ReadBunny(bunny), 0.3, 20, 0.5 } };
}

//------------------------------------------------------------------------------
void TestShapes(const std::vector<Case>& cases, meshTest::Checker& check)
{
  std::cout << std::fixed << std::setprecision(2)
            << "surface, size field: patches, smallest angle (worst, 1 %, median), worst aspect "
               "ratio, distance over length (to and from the input)\n";
  for (const Case& one : cases)
  {
    for (const int field :
      { vtkPatchMesher::SIZE_FIELD_UNIFORM, vtkPatchMesher::SIZE_FIELD_CURVATURE })
    {
      vtkNew<vtkPatchMesher> mesher;
      mesher->SetTargetEdgeLength(one.Length);
      mesher->SetSizeField(field);
      Surface patches = Remesh(mesher, one.Input);
      const Quality quality = GetQuality(patches);
      const double there = GetDistance(patches, one.Input) / one.Length;
      const double back = GetDistance(one.Input, patches) / one.Length;
      const std::string name = one.Name + (field ? ", curvature" : ", uniform");
      std::cout << name << ": " << patches->GetNumberOfCells() << ", " << quality.SmallestAngle
                << ", " << quality.FirstPercentile << ", " << quality.Median << ", "
                << quality.LargestAspectRatio << ", " << there << ", " << back << "\n";
      check.True(quality.SmallestAngle > one.Angle, name + ": smallest angle");
      const bool narrow = one.Name == "plate";
      check.True(quality.FirstPercentile > (narrow ? 5.0 : 22.0), name + ": 1 % of angles");
      check.True(quality.Median > 40.0, name + ": median of angles");
      check.True(quality.LargestAspectRatio < (narrow ? 7.0 : 3.0), name + ": aspect ratio");
      check.True(std::max(there, back) <= one.Distance, name + ": distance");
      check.True(IsOrientedAs(patches, one.Input), name + ": orientation");
      const bool closed = one.Name != "disk";
      check.True(meshTest::IsClosed(patches) == closed, name + ": closed");
      check.Equal(meshTest::GetEdges(patches).Bad, 0, 0, name + ": bad edges");
    }
  }
}

//------------------------------------------------------------------------------
// Sorted edge lengths over wanted ones, which are given at the middle of the edge.
std::vector<double> GetRatios(vtkPolyData* patches,
  const std::function<double(const Vector&)>& wanted)
{
  std::vector<double> ratios;
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    patches->GetCellPoints(cell, size, ids);
    for (int i = 0; i < 3; ++i)
    {
      const Vector a = meshTest::GetPoint(patches, ids[i]);
      const Vector b = meshTest::GetPoint(patches, ids[(i + 1) % 3]);
      const Vector middle{ 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
      ratios.push_back(
        std::sqrt(vtkMath::Distance2BetweenPoints(a.data(), b.data())) / wanted(middle));
    }
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

//------------------------------------------------------------------------------
void CheckRatios(const std::vector<double>& ratios, const std::string& name,
  meshTest::Checker& check)
{
  const std::size_t size = ratios.size();
  check.Equal(ratios[size / 2], 0.95, 0.15, name + ": median of length over wanted length");
  check.True(ratios[size / 20] > 0.6, name + ": 5 % of the lengths");
  check.True(ratios[size - size / 20] < 1.35, name + ": 95 % of the lengths");
}

//------------------------------------------------------------------------------
void TestLengths(meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetSizeFieldToArray();
  const auto linear = [](const Vector& p) { return 0.045 + 0.05 * p[0]; };
  Surface plane = MakePlane(1);
  AddLengths(plane, "EdgeLength", linear);
  CheckRatios(GetRatios(Remesh(mesher, plane), linear), "linear array", check);
  Surface sphere = MakeSphere(60, { 1, 1, 1 });
  const auto around = [](const Vector& p) { return 0.08 + 0.05 * p[2]; };
  AddLengths(sphere, "Sizes", around);
  mesher->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Sizes");
  CheckRatios(GetRatios(Remesh(mesher, sphere), around), "array on a sphere", check);

  // Radius 1: sqrt(6 e - 3 e^2); and the limits.
  mesher->SetSizeFieldToCurvature();
  mesher->SetTargetEdgeLength(0.5);
  const auto test = [&](double error, double shortest, double wanted)
  {
    mesher->SetApproximationError(error);
    mesher->SetMinimumEdgeLength(shortest);
    CheckRatios(GetRatios(Remesh(mesher, sphere), [=](const Vector&) { return wanted; }),
      "curvature, error " + std::to_string(error), check);
  };
  test(0.002, 0.0, std::sqrt(0.012 - 12e-6));
  test(1e-6, 0.1, 0.1);
  test(0.1, 0.1, 0.5);
  // A facet of length L on radius 1 has its center 1 - sqrt(1 - L^2 / 3) inside.
  mesher->SetApproximationError(0.002);
  Surface fine = MakeSphere(200, { 1, 1, 1 });
  const double distance = GetDistance(Remesh(mesher, fine), fine);
  check.True(distance < 0.004 && distance > 0.001, "error of " + std::to_string(distance));
}

//------------------------------------------------------------------------------
SourceSurface MakeSource(vtkPolyData* mesh)
{
  SourceSurface surface;
  std::map<std::pair<vtkIdType, vtkIdType>, std::size_t> sides;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    surface.Points.push_back(meshTest::GetPoint(mesh, i));
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    mesh->GetCellPoints(i, ids);
    SourceSurface::Triangle triangle;
    for (int j = 0; j < 3; ++j)
    {
      triangle[j] = ids->GetId(j);
      sides[{ ids->GetId(j), ids->GetId((j + 1) % 3) }] = i;
    }
    surface.Triangles.push_back(triangle);
    surface.Parts.push_back(0);
    surface.Sources.push_back(i);
  }
  for (const SourceSurface::Triangle& triangle : surface.Triangles)
  {
    std::array<std::size_t, 3> neighbours;
    for (int j = 0; j < 3; ++j)
    {
      const auto side = sides.find({ triangle[(j + 1) % 3], triangle[j] });
      neighbours[j] = side == sides.end() ? SourceSurface::None : side->second;
    }
    surface.Neighbours.push_back(neighbours);
  }
  surface.Link();
  return surface;
}

//------------------------------------------------------------------------------
void TestCurvature(meshTest::Checker& check)
{
  // Ring: the tube's own curvature is the largest everywhere.
  const std::vector<double> ring = SurfaceCurvature::Find(MakeSource(MakeRing(0.25, 120, 48)));
  for (const double curvature : ring)
  {
    check.Equal(curvature, 4.0, 0.2, "curvature of the ring");
  }
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetTargetEdgeLength(0.03);
  Surface sphere = Remesh(mesher, MakeSphere(100, { 1, 1, 1 }));
  for (vtkIdType i = 0; i < sphere->GetNumberOfPoints(); ++i)
  {
    Vector point = meshTest::GetPoint(sphere, i);
    vtkMath::Normalize(point.data());
    sphere->GetPoints()->SetPoint(i, point.data());
  }
  std::vector<double> curvatures = SurfaceCurvature::Find(MakeSource(sphere));
  std::sort(curvatures.begin(), curvatures.end());
  check.Equal(curvatures[curvatures.size() / 2], 1.0, 0.15, "median curvature of the sphere");
  for (const double curvature : SurfaceCurvature::Find(MakeSource(MakePlane(3))))
  {
    check.Equal(curvature, 0.0, 1e-12, "curvature of the plane");
  }
}

//------------------------------------------------------------------------------
void TestGrading(meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetTargetEdgeLength(0.05);
  const SourceSurface plane = MakeSource(Remesh(mesher, MakePlane(1)));
  const double grading = 0.3;
  std::vector<double> lengths(plane.Points.size(), 10.0);
  lengths[7] = 0.01;
  EdgeLengths::Grade(plane, grading, lengths);
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    const double distance =
      std::sqrt(vtkMath::Distance2BetweenPoints(plane.Points[i].data(), plane.Points[7].data()));
    const double exact = 0.01 + grading * distance;
    check.True(lengths[i] >= exact - 1e-12 && lengths[i] <= 1.1 * exact,
      "graded length " + std::to_string(lengths[i]) + ", exact " + std::to_string(exact));
  }
  std::vector<double> slow;
  for (const Vector& p : plane.Points)
  {
    slow.push_back(1.0 + 0.2 * p[0] - 0.2 * p[1]);
  }
  std::vector<double> graded = slow;
  EdgeLengths::Grade(plane, grading, graded);
  check.True(graded == slow, "lengths that grow slowly enough stay");

  // A jump from 0.02 to 0.2 within a short way.
  Surface jump = MakePlane(50);
  AddLengths(jump, "EdgeLength", [](const Vector& p) { return p[0] < 0.0 ? 0.01 : 0.2; });
  mesher->SetSizeFieldToArray();
  for (const double growth : { 0.15, 0.3, 0.6 })
  {
    mesher->SetGrading(growth);
    Surface patches = Remesh(mesher, jump);
    const std::string name = "grading " + std::to_string(growth);
    const auto wanted = [&](const Vector& p)
    { return std::min(0.2, 0.01 + growth * std::max(p[0] + 0.02, 0.0)); };
    CheckRatios(GetRatios(patches, wanted), name, check);
    const double angle = GetQuality(patches).SmallestAngle;
    check.True(angle > 20.0, name + ": smallest angle " + std::to_string(angle));
  }
}

//------------------------------------------------------------------------------
void TestNumber(const std::vector<Case>& cases, meshTest::Checker& check)
{
  vtkNew<vtkPatchMesher> mesher;
  for (const Case& one : cases)
  {
    // Long edges to keep that are close together ask for many.
    const int number = one.Name == "plate" ? 20000 : 5000;
    mesher->SetTargetNumberOfPatches(number);
    Surface patches = Remesh(mesher, one.Input);
    check.Equal(patches->GetNumberOfCells() / double(number), 1.0, 0.05, one.Name + ": number");
    const double angle = GetQuality(patches).SmallestAngle;
    check.True(angle > std::min(one.Angle, 18.0),
      one.Name + ": smallest angle with a target number " + std::to_string(angle));
    const double triangle = meshTest::GetArea(patches) / number;
    check.Equal(meshTest::GetSummary(patches, "TargetEdgeLength") /
        std::sqrt(4.0 / std::sqrt(3.0) * triangle),
      1.2, 0.4, one.Name + ": length that leads to the number");
  }
  Surface ring = MakeRing(0.3, 90, 30);
  // Of lengths like that no edge shows anything.
  mesher->SetTargetEdgeLength(1e12);
  mesher->SetTargetNumberOfPatches(1000);
  check.Equal(Remesh(mesher, ring)->GetNumberOfCells() / 1000.0, 1.0, 0.05, "number from 1e12");
  AddLengths(ring, "EdgeLength", [](const Vector& p) { return 1.0 + 0.5 * p[0]; });
  for (const int field : { vtkPatchMesher::SIZE_FIELD_CURVATURE, vtkPatchMesher::SIZE_FIELD_ARRAY })
  {
    mesher->SetSizeField(field);
    mesher->SetTargetEdgeLength(0.0);
    for (const int number : { 500, 10000 })
    {
      mesher->SetTargetNumberOfPatches(number);
      check.Equal(Remesh(mesher, ring)->GetNumberOfCells() / double(number), 1.0, 0.05,
        "number " + std::to_string(number) + " by field " + std::to_string(field));
    }
  }
}

//------------------------------------------------------------------------------
// Regions stay exact and linear point data linear, whatever the lengths.
void TestExactness(meshTest::Checker& check)
{
  Surface box = MakeBox(1, 1, 1);
  AddLengths(box, "EdgeLength", [](const Vector& p) { return 0.1 + 0.08 * p[0]; });
  AddLengths(box, "Linear", [](const Vector& p) { return 1.0 + p[0] - 2.0 * p[1] + 3.0 * p[2]; });
  for (int i = 0; i < 6; ++i)
  {
    vtkNew<vtkPatchMesher> mesher;
    mesher->SetTargetEdgeLength(0.15);
    mesher->SetSizeField(i / 2);
    mesher->SetCoarsePlanarRegions(i % 2 != 0);
    Surface patches = Remesh(mesher, box);
    const std::string name = "box " + std::to_string(i);
    for (const auto& area : meshTest::GetAreas(patches, "Region"))
    {
      check.Equal(area.second, 1.0, 1e-12, name + ": area");
    }
    check.True(meshTest::IsClosed(patches), name + ": closed");
    check.Equal(patches->GetNumberOfCells() == 12, i % 2, 0, name + ": coarse");
    vtkDataArray* linear = patches->GetPointData()->GetArray("Linear");
    for (vtkIdType j = 0; j < patches->GetNumberOfPoints(); ++j)
    {
      const Vector p = meshTest::GetPoint(patches, j);
      check.Equal(linear->GetTuple1(j), 1.0 + p[0] - 2.0 * p[1] + 3.0 * p[2], 1e-12,
        name + ": linear data");
    }
  }
}

//------------------------------------------------------------------------------
// The border of a disk with a hole stays the same set of points.
void TestBorder(meshTest::Checker& check)
{
  Surface disk = MakeDisk();
  vtkNew<vtkPatchMesher> mesher;
  for (const double length : { 0.02, 0.1, 0.3 })
  {
    mesher->SetTargetEdgeLength(length);
    Surface patches = Remesh(mesher, disk);
    const std::vector<std::pair<vtkIdType, vtkIdType>> before = meshTest::GetEdges(disk).Borders;
    double sum = 0.0;
    double farthest = 0.0;
    for (const auto& edge : meshTest::GetEdges(patches).Borders)
    {
      const Vector a = meshTest::GetPoint(patches, edge.first);
      const Vector b = meshTest::GetPoint(patches, edge.second);
      sum += std::sqrt(vtkMath::Distance2BetweenPoints(a.data(), b.data()));
      double nearest = VTK_DOUBLE_MAX;
      for (const auto& old : before)
      {
        const Vector p = meshTest::GetPoint(disk, old.first);
        const Vector q = meshTest::GetPoint(disk, old.second);
        const auto distance = [&](const Vector& from)
        {
          double t;
          Vector closest;
          return vtkLine::DistanceToLine(from.data(), p.data(), q.data(), t, closest.data());
        };
        nearest = std::min(nearest, std::max(distance(a), distance(b)));
      }
      farthest = std::max(farthest, std::sqrt(nearest));
    }
    const double perimeter = 0.75 * 48.0 * 2.0 * std::sin(vtkMath::Pi() / 48.0);
    const std::string name = "border, length " + std::to_string(length);
    check.Equal(sum, perimeter, 1e-12, name + ": sum of lengths");
    check.Equal(farthest, 0.0, 1e-12, name + ": on the same lines");
    check.Equal(meshTest::GetArea(patches), meshTest::GetArea(disk), 1e-12, name + ": area");
  }
}

//------------------------------------------------------------------------------
// A cylinder: its caps are planar, its side is not.
void TestPlanarRegions(meshTest::Checker& check)
{
  Surface cylinder = MakeCylinder();
  vtkNew<vtkPatchMesher> mesher;
  for (const double length : { 0.1, 0.02 })
  {
    mesher->SetTargetEdgeLength(length);
    mesher->CoarsePlanarRegionsOff();
    const vtkIdType all = Remesh(mesher, cylinder)->GetNumberOfCells();
    mesher->CoarsePlanarRegionsOn();
    Surface patches = Remesh(mesher, cylinder);
    check.True(patches->GetNumberOfCells() < all, "fewer patches with coarse caps");
    double caps = 0.0;
    for (vtkIdType i = 0; i < patches->GetNumberOfCells(); ++i)
    {
      const Vector area = meshTest::GetAreaVector(patches, i);
      caps += std::abs(area[1]) > 0.999 * vtkMath::Norm(area.data()) ? std::abs(area[1]) : 0.0;
    }
    check.Equal(caps, 40.0 * 0.25 * std::sin(vtkMath::Pi() / 20.0), 1e-12, "area of the caps");
    check.True(meshTest::IsClosed(patches), "the cylinder with coarse caps is closed");
    const double angle = GetQuality(patches).SmallestAngle;
    check.True(angle > 15.0, "angles of coarse caps " + std::to_string(angle));
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestPatchMesherSizing(int argc, char* argv[])
{
  meshTest::Checker check;
  const std::vector<Case> cases = MakeCases(meshTest::GetDataFile(argc, argv, "bunny.ply"));
  TestShapes(cases, check);
  TestLengths(check);
  TestCurvature(check);
  TestGrading(check);
  TestNumber(cases, check);
  TestExactness(check);
  TestBorder(check);
  TestPlanarRegions(check);
  return check.GetExitCode();
}
