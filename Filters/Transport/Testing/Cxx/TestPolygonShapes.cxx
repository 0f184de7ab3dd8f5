// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Filters on polygons of any shape: each is one patch to users, whatever the scene cuts it into.
#include "RadiosityTesting.h"
#include "RanksInThreads.h"
#include "vtkDataSetAttributes.h"
#include "vtkDirectIrradiance.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkUnsignedCharArray.h"

using namespace LightTransportTesting;

namespace
{
/// A scene and what holds for it in closed form.
struct Case
{
  std::string Name;
  std::vector<std::vector<Point>> Polygons;
  double Factor; // from polygon 0 to polygon 1
  double Tolerance;
};

//------------------------------------------------------------------------------
// In the plane z = 0, or turned to face it from the height z.
std::vector<Point> Place(const std::vector<std::array<double, 2>>& corners, double z)
{
  std::vector<Point> places;
  for (const auto& corner : corners)
  {
    places.push_back({ corner[0], corner[1], z });
  }
  if (z > 0.0)
  {
    std::reverse(places.begin(), places.end());
  }
  return places;
}

//------------------------------------------------------------------------------
// Exchange A F of two parallel rectangles [x0, x1] x [y0, y1] at a distance (Howell C-13):
// four-fold differences of a function of the offsets between edges.
double GetExchange(const std::array<double, 4>& a, const std::array<double, 4>& b, double distance)
{
  const auto get = [distance](double x, double y)
  {
    const double u = std::sqrt(x * x + distance * distance);
    const double v = std::sqrt(y * y + distance * distance);
    return (y * u * std::atan(y / u) + x * v * std::atan(x / v) -
             0.5 * distance * distance * std::log(x * x + y * y + distance * distance)) /
      (2.0 * vtkMath::Pi());
  };
  double sum = 0.0;
  for (int k = 0; k < 16; ++k)
  {
    const double sign = (k % 2 + k / 2 % 2 + k / 4 % 2 + k / 8 % 2) % 2 == 0 ? 1.0 : -1.0;
    sum += sign * get(a[k % 2] - b[k / 2 % 2], a[2 + k / 4 % 2] - b[2 + k / 8 % 2]);
  }
  return sum;
}

//------------------------------------------------------------------------------
Case MakeFloor()
{
  const std::array<double, 4> parts[2] = { { 0, 2, 0, 1 }, { 0, 1, 1, 2 } };
  double exchange = 0.0;
  for (const auto& part : parts)
  {
    exchange += GetExchange(part, { 0, 2, 0, 2 }, 1.0);
  }
  return { "an L",
    { Place({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }, 0),
      Place({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 } }, 1) },
    exchange / 3.0, 1e-6 };
}

//------------------------------------------------------------------------------
Case MakeFrame()
{
  const std::array<double, 4> outer{ 0, 3, 0, 3 }, hole{ 1, 2, 1, 2 }, other{ 0, 3, 0, 3 };
  return { "a frame",
    { Place({ { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 }, { 0, 0 }, { 1, 1 }, { 1, 2 }, { 2, 2 },
              { 2, 1 }, { 1, 1 } },
        0),
      Place({ { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } }, 0.5) },
    (GetExchange(outer, other, 0.5) - GetExchange(hole, other, 0.5)) / 8.0, 1e-6 };
}

//------------------------------------------------------------------------------
// Howell C-41 with radii 1 and distance 1; regular polygons of the area of the discs.
Case MakeDiscs()
{
  constexpr int corners = 64;
  const double radius =
    std::sqrt(2.0 * vtkMath::Pi() / (corners * std::sin(2.0 * vtkMath::Pi() / corners)));
  std::vector<std::array<double, 2>> disc;
  for (int k = 0; k < corners; ++k)
  {
    const double angle = 2.0 * vtkMath::Pi() * k / corners;
    disc.push_back({ radius * std::cos(angle), radius * std::sin(angle) });
  }
  return { "discs", { Place(disc, 0), Place(disc, 1) }, 0.381966011250105, 1e-5 };
}

//------------------------------------------------------------------------------
// Turned so that no axis is special, and moved.
Point Move(const Point& point, double offset)
{
  const double x = point[0], y = point[1], z = point[2];
  return { (2 * x + y + 2 * z) / 3 + offset, (-2 * x + 2 * y + z) / 3 + offset,
    (-x - 2 * y + 2 * z) / 3 };
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Make(const std::vector<std::vector<Point>>& polygons, double offset,
  int type)
{
  Surface surface;
  for (std::vector<Point> polygon : polygons)
  {
    std::transform(polygon.begin(), polygon.end(), polygon.begin(),
      [offset](const Point& point) { return Move(point, offset); });
    surface.AddPolygon(polygon);
  }
  auto data = surface.Get();
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  points->DeepCopy(data->GetPoints());
  data->SetPoints(points);
  return data;
}

//------------------------------------------------------------------------------
double GetValue(vtkPolyData* data, const char* name, vtkIdType cell)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  Check(array != nullptr, std::string("cell array ") + name);
  return array ? array->GetComponent(cell, 0) : vtkMath::Nan();
}

//------------------------------------------------------------------------------
// One polygon after another in a block of its own.
vtkSmartPointer<vtkMultiBlockDataSet> Divide(vtkPolyData* data)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    vtkNew<vtkPolyData> block;
    vtkNew<vtkCellArray> polygons;
    data->GetCellPoints(cell, ids);
    polygons->InsertNextCell(ids);
    block->SetPoints(data->GetPoints());
    block->SetPolys(polygons);
    blocks->SetBlock(static_cast<unsigned int>(cell), block);
  }
  return blocks;
}

//------------------------------------------------------------------------------
void TestClosedForms()
{
  struct Kind
  {
    const char* Name;
    double Offset;
    int Type;
    double Tolerance;
  };
  const Kind kinds[] = { { "", 0.0, VTK_DOUBLE, 0.0 },
    { " in single precision", 0.0, VTK_FLOAT, 2e-6 }, { " on a map", 6e5, VTK_DOUBLE, 1e-8 } };
  for (const Case& shape : { MakeFloor(), MakeFrame(), MakeDiscs() })
  {
    for (const Kind& kind : kinds)
    {
      const std::string what = shape.Name + kind.Name;
      auto data = Make(shape.Polygons, kind.Offset, kind.Type);
      auto factors = ComputeViewFactors(data, 1e-7);
      CheckClose(factors->GetViewFactor(0, 1), shape.Factor, shape.Tolerance + kind.Tolerance,
        what);
      CheckClose(factors->GetViewFactor(0, 0), 0.0, 1e-12, what + ": itself");
      CheckClose(GetValue(factors->GetPolyDataOutput(), "ViewFactorSum", 0), shape.Factor,
        shape.Tolerance + kind.Tolerance, what + ": sum");
      CheckClose(GetValue(factors->GetPolyDataOutput(), "SceneProblems", 0), 0.0, 0.0, what);
    }
    vtkNew<vtkViewFactors> composite;
    composite->SetInputData(Divide(Make(shape.Polygons, 0.0, VTK_DOUBLE)));
    composite->SetTolerance(1e-7);
    composite->Update();
    CheckClose(composite->GetViewFactor(0, 1), shape.Factor, shape.Tolerance, "composite");
    CheckClose(composite->GetGroupTable()->GetValue(0, 3).ToDouble(), shape.Factor, shape.Tolerance,
      "composite: groups");
  }
}

//------------------------------------------------------------------------------
// The unit cube seen from inside; the floor is an L and the square that it lacks, or in `parts`
// rectangles that are no larger than patches may be.
vtkSmartPointer<vtkPolyData> MakeBox(bool inParts)
{
  Surface room;
  if (inParts)
  {
    room.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0.5, 0 }, { 0.5, 0.5, 0 } });
    room.AddPolygon({ { 0, 0, 0 }, { 0.5, 0.5, 0 }, { 0.5, 1, 0 }, { 0, 1, 0 } });
  }
  else
  {
    room.AddPolygon(
      { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0.5, 0 }, { 0.5, 0.5, 0 }, { 0.5, 1, 0 }, { 0, 1, 0 } });
  }
  room.AddPolygon({ { 0.5, 0.5, 0 }, { 1, 0.5, 0 }, { 1, 1, 0 }, { 0.5, 1, 0 } });
  room.AddPolygon({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } });
  room.AddPolygon({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 0, 0 } });
  room.AddPolygon({ { 0, 1, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 1, 1 } });
  room.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } });
  room.AddPolygon({ { 1, 0, 0 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 1, 0 } });
  return room.Get();
}

//------------------------------------------------------------------------------
void AddMaterials(vtkPolyData* data)
{
  AddArray(data, "Emissivity", { 0.5 });
  vtkDoubleArray* temperature = AddArray(data, "Temperature", { 300.0 });
  const vtkIdType ceiling = data->GetNumberOfCells() - 5;
  temperature->SetValue(ceiling, 900.0);
  AddArray(data, "BoundaryCondition", { 0.0 })->SetValue(0, 1.0);
  AddArray(data, "PrescribedNetFlux", { 0.0 })->SetValue(0, 100.0);
  if (ceiling > 2)
  {
    data->GetCellData()->GetArray("BoundaryCondition")->SetComponent(1, 0, 1.0);
    data->GetCellData()->GetArray("PrescribedNetFlux")->SetComponent(1, 0, 100.0);
  }
}

//------------------------------------------------------------------------------
void Solve(vtkDataObject* data, vtkRadiosity* radiosity, int linkMethod)
{
  radiosity->SetInputDataObject(data);
  radiosity->SetTolerance(1e-10);
  radiosity->SetLinkMethod(linkMethod);
  linkMethod == vtkRadiosity::LINK_METHOD_HIERARCHICAL ? radiosity->SetLinkTolerance(1e-4)
                                                       : radiosity->SetViewFactorTolerance(1e-6);
  radiosity->Update();
}

//------------------------------------------------------------------------------
// The parts are the pieces that the floor is cut into: all values follow from theirs.
void TestMeans(int linkMethod)
{
  auto whole = MakeBox(false);
  auto parts = MakeBox(true);
  AddMaterials(whole);
  AddMaterials(parts);
  vtkNew<vtkRadiosity> one, other;
  Solve(whole, one, linkMethod);
  Solve(parts, other, linkMethod);
  const auto get = [](vtkRadiosity* filter, const char* name, vtkIdType cell)
  { return GetValue(filter->GetPolyDataOutput(), name, cell); };
  for (const char* name : { "Radiosity", "Irradiance", "NetFlux" })
  {
    CheckClose(get(one, name, 0), 0.5 * (get(other, name, 0) + get(other, name, 1)), 1e-9,
      std::string(name) + " of the floor");
    for (vtkIdType cell = 1; cell < whole->GetNumberOfCells(); ++cell)
    {
      CheckClose(get(one, name, cell), get(other, name, cell + 1), 1e-9, name);
    }
  }
  // q = emissivity (sigma T^4 - H)
  const double black = get(one, "Irradiance", 0) + 100.0 / 0.5;
  CheckClose(get(one, "SurfaceTemperature", 0), std::pow(black / 5.670374419e-8, 0.25), 1e-12,
    "temperature of the floor");
  CheckClose(get(one, "NetFlux", 0), 100.0, 1e-9, "given net flux");
  // The corner in the dent has the value of its faces: 3 / 4 and 1 / 4 of the floor's area.
  vtkPolyData* output = one->GetPolyDataOutput();
  double floor = vtkMath::Nan();
  for (vtkIdType point = 0; point < output->GetNumberOfPoints(); ++point)
  {
    const double* place = output->GetPoint(point);
    if (place[0] == 0.5 && place[1] == 0.5 && place[2] == 0.0)
    {
      floor = output->GetPointData()->GetArray("Irradiance")->GetComponent(point, 0);
      break;
    }
  }
  CheckClose(floor, get(one, "Irradiance", 0), 1e-12, "a point between two materials");
}

//------------------------------------------------------------------------------
void TestRanks()
{
  auto whole = MakeBox(false);
  AddMaterials(whole);
  vtkNew<vtkRadiosity> serial;
  Solve(whole, serial, vtkRadiosity::LINK_METHOD_DENSE);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      // The second rank has the floor and no other polygon.
      vtkNew<vtkPolyData> mine;
      mine->DeepCopy(whole);
      vtkNew<vtkUnsignedCharArray> ghosts;
      ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
      for (vtkIdType cell = 0; cell < whole->GetNumberOfCells(); ++cell)
      {
        const bool isMine = cell == 0 ? rank == 1 : rank == (cell < 4 ? 0 : 2);
        ghosts->InsertNextValue(isMine ? 0 : vtkDataSetAttributes::DUPLICATECELL);
      }
      mine->GetCellData()->AddArray(ghosts);
      vtkNew<vtkRadiosity> parallel;
      parallel->SetController(controller);
      Solve(mine, parallel, vtkRadiosity::LINK_METHOD_DENSE);
      for (vtkIdType cell = 0; cell < whole->GetNumberOfCells(); ++cell)
      {
        const bool isMine = ghosts->GetValue(cell) == 0;
        CheckClose(GetValue(parallel->GetPolyDataOutput(), "Irradiance", cell),
          isMine ? GetValue(serial->GetPolyDataOutput(), "Irradiance", cell) : 0.0, 1e-9,
          "three ranks");
      }
    });
}

//------------------------------------------------------------------------------
// A quadrilateral that is not plane is its two triangles.
void TestWarped()
{
  const std::vector<Point> warped{ { 0, 0, 0 }, { 1, 0, 0 }, { 0.9, 0.9, 0.2 }, { 0, 1, 0 } };
  const std::vector<Point> lid{ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } };
  auto whole = Make({ warped, lid }, 0.0, VTK_DOUBLE);
  auto parts =
    Make({ { warped[0], warped[1], warped[2] }, { warped[2], warped[3], warped[0] }, lid }, 0.0,
      VTK_DOUBLE);
  vtkNew<vtkTest::ErrorObserver> observer;
  auto one = vtkSmartPointer<vtkViewFactors>::New();
  one->AddObserver(vtkCommand::WarningEvent, observer);
  one->SetInputData(whole);
  one->SetTolerance(1e-6);
  one->Update();
  Check(observer->GetWarningMessage().find("1 polygon (0) not plane") != std::string::npos,
    "a warning: " + observer->GetWarningMessage());
  auto other = ComputeViewFactors(parts, 1e-6);
  const std::vector<double> areas = GetAreas(parts);
  const double expected = GetGroupFactor(other, areas, { 0, 2 }, { 2, 3 });
  CheckClose(one->GetViewFactor(0, 1), expected, 1e-9, "a warped quadrilateral");
  CheckClose(one->GetViewFactor(0, 0), GetGroupFactor(other, areas, { 0, 2 }, { 0, 2 }), 1e-9,
    "which sees itself");
  CheckClose(one->GetViewFactor(1, 0), other->GetViewFactor(2, 0) + other->GetViewFactor(2, 1),
    1e-9, "from the other side");
  CheckClose(GetValue(one->GetPolyDataOutput(), "SceneProblems", 0), 32.0, 0.0, "is flagged");
  CheckClose(GetValue(one->GetPolyDataOutput(), "SceneProblems", 1), 0.0, 0.0, "alone");
}

//------------------------------------------------------------------------------
// Polygons without area among others: all else is as it was.
void TestDegenerate()
{
  auto good = MakeBox(false);
  auto data = MakeBox(false);
  AddMaterials(good);
  data->GetPolys()->InsertNextCell({ 0, 1, 0 });
  data->GetPolys()->InsertNextCell({ 2, 3 });
  data->GetPolys()->InsertNextCell({ 4 });
  // A bow tie.
  data->GetPolys()->InsertNextCell({ 0, 6, 1, 5 });
  AddArray(data, "Emissivity", { 0.5 });
  AddArray(data, "Temperature", { 300.0 })->SetValue(2, 900.0);
  AddArray(data, "BoundaryCondition", { 0.0 })->SetValue(0, 1.0);
  AddArray(data, "PrescribedNetFlux", { 0.0 })->SetValue(0, 100.0);
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkRadiosity> one, other;
  one->AddObserver(vtkCommand::WarningEvent, observer);
  Solve(data, one, vtkRadiosity::LINK_METHOD_AUTO);
  Solve(good, other, vtkRadiosity::LINK_METHOD_AUTO);
  const vtkIdType count = good->GetNumberOfCells();
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    const double expected =
      cell < count ? GetValue(other->GetPolyDataOutput(), "Irradiance", cell) : 0.0;
    CheckClose(GetValue(one->GetPolyDataOutput(), "Irradiance", cell), expected, 1e-12,
      "polygons without area change nothing");
    CheckClose(GetValue(one->GetPolyDataOutput(), "SceneProblems", cell), cell < count ? 0.0 : 8.0,
      0.0, "and are flagged");
  }
  CheckClose(GetValue(one->GetPolyDataOutput(), "SurfaceTemperature", count), 0.0, 0.0,
    "temperature of one without area");
  Check(observer->GetWarning(), "and warned of");
}

//------------------------------------------------------------------------------
// Light from above falls on all of a floor alike, whatever it is cut into.
void TestOtherFilters()
{
  auto data = Make(MakeFrame().Polygons, 0.0, VTK_DOUBLE);
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPositional(false);
  const Point up = Move({ 0, 0, 1 }, 0.0);
  light->SetPosition(up.data());
  light->SetFocalPoint(0, 0, 0);
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(data);
  direct->SetShadows(false);
  direct->AddLight(light);
  direct->Update();
  CheckClose(GetValue(direct->GetPolyDataOutput(), "DirectIrradiance", 0), 1.0, 1e-12,
    "light from above on a frame");
  CheckClose(GetValue(direct->GetPolyDataOutput(), "DirectIrradiance", 1), 0.0, 1e-12,
    "and not on the back of the other");
  CheckClose(GetSummary(direct->GetOutputDataObject(0), "DirectFlux"), 8.0, 1e-12,
    "flux on a frame");

  auto body = MakeBox(false);
  AddArray(body, "Irradiance", { 1.0 });
  vtkNew<vtkSubsurfaceScattering> scattering;
  scattering->SetInputData(body);
  scattering->Update();
  vtkDataObject* output = scattering->GetOutputDataObject(0);
  const std::vector<double> areas = GetAreas(body);
  double leaving = 0.0;
  for (vtkIdType cell = 0; cell < body->GetNumberOfCells(); ++cell)
  {
    leaving += (cell == 0 ? 0.75 : areas[cell]) *
      GetValue(scattering->GetPolyDataOutput(), "ScatteredIrradiance", cell);
  }
  CheckClose(leaving, GetSummary(output, "LeavingFlux"), 1e-12, "scattered light of a body");
}
} // namespace

//------------------------------------------------------------------------------
int TestPolygonShapes(int, char*[])
{
  TestClosedForms();
  TestMeans(vtkRadiosity::LINK_METHOD_DENSE);
  TestMeans(vtkRadiosity::LINK_METHOD_HIERARCHICAL);
  TestWarped();
  TestDegenerate();
  TestOtherFilters();
  TestRanks();
  return Result();
}
