// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Polygons of two sides: the same as a mesh with a flipped copy, without the copy.
#include "RadiosityTesting.h"
#include "RanksInThreads.h"
#include "vtkDataSetAttributes.h"
#include "vtkDirectIrradiance.h"
#include "vtkLight.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <cstdio>
#include <random>

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
double GetValue(vtkPolyData* data, const std::string& name, vtkIdType cell)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name.c_str());
  Check(array != nullptr, "cell array " + name);
  return array ? array->GetComponent(cell, 0) : vtkMath::Nan();
}

//------------------------------------------------------------------------------
/// A turn and a shift, and the type of points.
struct Pose
{
  std::string Name;
  Eigen::Matrix3d Turn = Eigen::Matrix3d::Identity();
  double Shift = 0.0;
  int Type = VTK_DOUBLE;
};

//------------------------------------------------------------------------------
std::vector<Pose> MakePoses()
{
  std::vector<Pose> poses{ { "" }, { "on a map", Eigen::Matrix3d::Identity(), 6e5 } };
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20; ++k)
  {
    const Eigen::Quaterniond turn(normal(random), normal(random), normal(random), normal(random));
    poses.push_back({ "in single precision, turn " + std::to_string(k),
      turn.normalized().toRotationMatrix(), 0.0, VTK_FLOAT });
  }
  return poses;
}

//------------------------------------------------------------------------------
void Move(vtkPolyData* data, const Pose& pose)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pose.Type);
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    const Eigen::Vector3d place = pose.Turn * Eigen::Vector3d(data->GetPoint(point));
    points->InsertNextPoint(place[0] + pose.Shift, place[1] - pose.Shift, place[2]);
  }
  data->SetPoints(points);
}

//------------------------------------------------------------------------------
// Three unit squares above each other, fronts up: what faces each other is front and back
// (Howell C-11).
void TestSheets()
{
  for (const Pose& pose : MakePoses())
  {
    Surface sheets;
    for (const double z : { 0.0, 1.0, 2.0 })
    {
      sheets.AddGrid({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    }
    auto data = sheets.Get();
    Move(data, pose);
    vtkNew<vtkViewFactors> factors;
    factors->SetInputData(data);
    factors->TwoSidedOn();
    factors->SetTolerance(1e-6);
    factors->Update();
    const double expected = 0.199824895698387;
    const double tolerance = pose.Type == VTK_FLOAT ? 2e-6 : 1e-6;
    for (const auto& [i, j] : { std::pair{ 0, 4 }, { 4, 0 }, { 1, 5 }, { 5, 1 } })
    {
      CheckClose(factors->GetViewFactor(i, j), expected, tolerance,
        "sheets " + pose.Name + ": " + std::to_string(i) + " to " + std::to_string(j));
    }
    for (const auto& [i, j] :
      { std::pair{ 0, 1 }, { 3, 4 }, { 0, 5 }, { 0, 3 }, { 1, 4 }, { 2, 4 } })
    {
      CheckClose(factors->GetViewFactor(i, j), 0.0, 1e-12, "sheets " + pose.Name + ": hidden");
    }
    CheckClose(factors->GetViewFactor(0, 6), 0.0, 0.0, "out of range");
    vtkPolyData* output = factors->GetPolyDataOutput();
    CheckClose(GetValue(output, "ViewFactorSum", 2), 0.0, 1e-12, "the uppermost front");
    CheckClose(GetValue(output, "ViewFactorSumBack", 2), expected, tolerance, "and its back");
    CheckClose(GetValue(output, "SkyFractionBack", 2), 1.0 - expected, 0.1, "its sky");
    CheckClose(GetValue(output, "SceneProblems", 1), 0.0, 0.0, "no problem");
    CheckClose(GetValue(output, "SceneProblemsBack", 1), 0.0, 0.0, "no problem behind");
  }
}

//------------------------------------------------------------------------------
// A box with two sheets inside that stand on its floor, an L and a warped quadrilateral; open where
// its lid would be.
vtkSmartPointer<vtkPolyData> MakeScene()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  surface.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1, 2);
  surface.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 1);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 1);
  surface.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 1, 2);
  surface.AddPolygon({ { 0.5, 0.2, 0 }, { 0.5, 0.8, 0 }, { 0.5, 0.8, 0.3 }, { 0.5, 0.5, 0.3 },
    { 0.5, 0.5, 0.6 }, { 0.5, 0.2, 0.6 } });
  surface.AddPolygon(
    { { 0.7, 0.3, 0.5 }, { 0.9, 0.3, 0.5 }, { 0.9, 0.6, 0.6 }, { 0.7, 0.6, 0.5 } });
  return surface.Get();
}

//------------------------------------------------------------------------------
// The value of an array at a face: what fronts and backs have in common tells nothing.
double GetMaterial(int array, vtkIdType cell, int side)
{
  const double value =
    std::fmod(0.37 * static_cast<double>(cell) + 0.21 * array + 0.45 * side, 1.0);
  return array == 0 ? (value > 0.7 ? value : 0.0) : 0.2 + 0.6 * value;
}

//------------------------------------------------------------------------------
void AddMaterials(vtkPolyData* data, bool isTwice)
{
  const char* const names[] = { "Emission", "Reflectance", "Group" };
  const vtkIdType polygons = data->GetNumberOfCells() / (isTwice ? 2 : 1);
  for (int array = 0; array < 3; ++array)
  {
    const auto get = [array](vtkIdType cell, int side) {
      return array == 2 ? static_cast<double>(cell % 2 + 2 * side) : GetMaterial(array, cell, side);
    };
    vtkDoubleArray* fronts = AddArray(data, names[array], { 0.0 });
    vtkDoubleArray* backs =
      isTwice ? fronts : AddArray(data, (std::string(names[array]) + "Back").c_str(), { 0.0 });
    for (vtkIdType cell = 0; cell < polygons; ++cell)
    {
      fronts->SetValue(cell, get(cell, 0));
      backs->SetValue(cell + (isTwice ? polygons : 0), get(cell, 1));
    }
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> AddCopy(vtkPolyData* data)
{
  auto twice = vtkSmartPointer<vtkPolyData>::New();
  twice->DeepCopy(data);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    std::reverse(ids->GetPointer(0), ids->GetPointer(0) + ids->GetNumberOfIds());
    twice->GetPolys()->InsertNextCell(ids);
  }
  return twice;
}

//------------------------------------------------------------------------------
void Solve(vtkDataObject* data, bool isTwoSided, int links, vtkRadiosity* radiosity)
{
  radiosity->SetInputDataObject(data);
  radiosity->SetTwoSided(isTwoSided);
  radiosity->SetTolerance(1e-12);
  radiosity->SetViewFactorTolerance(1e-4);
  radiosity->SetLinkMethod(links);
  radiosity->Update();
}

//------------------------------------------------------------------------------
void TestCopy(const Pose& pose, int links)
{
  auto data = MakeScene();
  Move(data, pose);
  auto copy = AddCopy(data);
  AddMaterials(data, false);
  AddMaterials(copy, true);
  vtkNew<vtkRadiosity> one;
  vtkNew<vtkRadiosity> other;
  Solve(data, true, links, one);
  Solve(copy, false, links, other);
  const vtkIdType polygons = data->GetNumberOfCells();
  // Rounding may cut the L in another way when it is seen from behind, which moves view factors
  // within their tolerance, and links between clusters, which follow the order of pieces, within
  // theirs.
  const bool isDense = links == vtkRadiosity::LINK_METHOD_DENSE;
  const double tolerance = isDense ? (pose.Type == VTK_FLOAT ? 1e-5 : 1e-9) : 1e-2;
  for (const std::string name : { "Radiosity", "Irradiance", "NetFlux", "SceneProblems" })
  {
    for (vtkIdType cell = 0; cell < polygons; ++cell)
    {
      CheckClose(GetValue(one->GetPolyDataOutput(), name, cell),
        GetValue(other->GetPolyDataOutput(), name, cell), tolerance,
        name + " of fronts " + pose.Name);
      CheckClose(GetValue(one->GetPolyDataOutput(), name + "Back", cell),
        GetValue(other->GetPolyDataOutput(), name, cell + polygons), tolerance,
        name + " of backs " + pose.Name);
    }
  }
}

//------------------------------------------------------------------------------
// Clusters of the quadtree of an atlas: fronts and backs are surfaces of their own.
void TestAtlas()
{
  auto data = MakeScene();
  AddMaterials(data, false);
  vtkNew<vtkDoubleArray> atlas;
  atlas->SetName("AtlasCoordinates");
  atlas->SetNumberOfComponents(2);
  for (vtkIdType point = 0; point < data->GetNumberOfPoints(); ++point)
  {
    const double* place = data->GetPoint(point);
    atlas->InsertNextTuple2(0.5 * (place[0] + place[2]), 0.5 * (place[1] + place[2]));
  }
  data->GetPointData()->AddArray(atlas);
  vtkNew<vtkRadiosity> dense;
  vtkNew<vtkRadiosity> clusters;
  clusters->SetClusterTreeToAtlas();
  clusters->SetLinkTolerance(1e-4);
  Solve(data, true, vtkRadiosity::LINK_METHOD_DENSE, dense);
  Solve(data, true, vtkRadiosity::LINK_METHOD_HIERARCHICAL, clusters);
  for (const char* name : { "Radiosity", "RadiosityBack" })
  {
    double difference = 0.0;
    double sum = 0.0;
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      const double expected = GetValue(dense->GetPolyDataOutput(), name, cell);
      difference += std::abs(GetValue(clusters->GetPolyDataOutput(), name, cell) - expected);
      sum += expected;
    }
    Check(difference <= 2e-2 * sum, std::string(name) + " by clusters of an atlas");
  }
}

//------------------------------------------------------------------------------
void TestCopyOfFactors()
{
  auto data = MakeScene();
  auto copy = AddCopy(data);
  AddMaterials(data, false);
  AddMaterials(copy, true);
  vtkNew<vtkViewFactors> one;
  one->SetInputData(data);
  one->TwoSidedOn();
  one->Update();
  auto other = ComputeViewFactors(copy, one->GetTolerance());
  for (vtkIdType i = 0; i < copy->GetNumberOfCells(); ++i)
  {
    for (vtkIdType j = 0; j < copy->GetNumberOfCells(); ++j)
    {
      CheckClose(one->GetViewFactor(i, j), other->GetViewFactor(i, j), 1e-6, "factors of a copy");
    }
  }
  vtkTable* groups = one->GetGroupTable();
  Check(groups->GetNumberOfRows() == 4, "groups of both sides");
  for (vtkIdType row = 0; row < groups->GetNumberOfRows(); ++row)
  {
    for (vtkIdType column = 1; column < groups->GetNumberOfColumns(); ++column)
    {
      CheckClose(groups->GetValue(row, column).ToDouble(),
        other->GetGroupTable()->GetValue(row, column).ToDouble(), 1e-6, "groups of a copy");
    }
  }
}

//------------------------------------------------------------------------------
// Saved view factors know of both sides, and do for no other scene.
void TestFile()
{
  auto data = MakeScene();
  vtkNew<vtkViewFactors> saving;
  saving->SetInputData(data);
  saving->TwoSidedOn();
  saving->Update();
  const char* const name = "TestTwoSided.factors";
  Check(saving->Save(name), "saved");
  for (const bool isTwoSided : { true, false })
  {
    vtkNew<vtkTest::ErrorObserver> observer;
    vtkNew<vtkTest::ErrorObserver> pipelineObserver;
    vtkNew<vtkViewFactors> loading;
    loading->AddObserver(vtkCommand::ErrorEvent, observer);
    loading->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
    loading->SetInputData(data);
    loading->SetTwoSided(isTwoSided);
    Check(loading->Load(name), "loaded");
    loading->Update();
    Check(observer->GetError() != isTwoSided, "for both sides, or an error");
    CheckClose(loading->GetViewFactor(0, 13), isTwoSided ? saving->GetViewFactor(0, 13) : 0.0, 0.0,
      "a factor from the file");
  }
  std::remove(name);
}

//------------------------------------------------------------------------------
// Two rooms' walls, a block each, and ranks of which one has no polygon.
void TestCompositeAndRanks()
{
  auto data = MakeScene();
  AddMaterials(data, false);
  vtkNew<vtkRadiosity> whole;
  Solve(data, true, vtkRadiosity::LINK_METHOD_DENSE, whole);
  const vtkIdType half = data->GetNumberOfCells() / 2;
  const auto hide = [&](vtkIdType first, vtkIdType last)
  {
    auto part = vtkSmartPointer<vtkPolyData>::New();
    part->DeepCopy(data);
    vtkNew<vtkUnsignedCharArray> ghosts;
    ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
    {
      const bool isMine = cell >= first && cell < last;
      ghosts->InsertNextValue(isMine ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    }
    part->GetCellData()->AddArray(ghosts);
    return part;
  };
  const auto compare = [&](vtkPolyData* output, vtkIdType first, vtkIdType last, const char* what)
  {
    for (const char* name : { "Irradiance", "IrradianceBack" })
    {
      for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
      {
        const bool isMine = cell >= first && cell < last;
        CheckClose(GetValue(output, name, cell),
          isMine ? GetValue(whole->GetPolyDataOutput(), name, cell) : 0.0, 1e-9, what);
      }
    }
  };
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, hide(0, half));
  blocks->SetBlock(1, hide(half, data->GetNumberOfCells()));
  vtkNew<vtkRadiosity> composite;
  Solve(blocks, true, vtkRadiosity::LINK_METHOD_DENSE, composite);
  auto* output = vtkMultiBlockDataSet::SafeDownCast(composite->GetOutputDataObject(0));
  compare(vtkPolyData::SafeDownCast(output->GetBlock(0)), 0, half, "first block");
  compare(vtkPolyData::SafeDownCast(output->GetBlock(1)), half, data->GetNumberOfCells(),
    "second block");
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      const vtkIdType first = rank == 0 ? 0 : half;
      const vtkIdType last = rank == 0 ? half : (rank == 1 ? half : data->GetNumberOfCells());
      vtkNew<vtkRadiosity> parallel;
      parallel->SetController(controller);
      Solve(hide(first, last), true, vtkRadiosity::LINK_METHOD_DENSE, parallel);
      compare(parallel->GetPolyDataOutput(), first, last, "three ranks");
    });
}

//------------------------------------------------------------------------------
// A sheet of two squares: one kind of emission on each front, another on both backs. Points have
// the values of their sides.
void TestPoints()
{
  Surface sheet;
  sheet.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 2, 1);
  auto data = sheet.Get();
  AddArray(data, "Reflectance", { 0.5 });
  AddArray(data, "Emission", { 1.0 })->SetValue(1, 3.0);
  AddArray(data, "EmissionBack", { 10.0 });
  for (const double angle : { 60.0, 180.0 })
  {
    vtkNew<vtkRadiosity> radiosity;
    radiosity->SetFeatureAngle(angle);
    Solve(data, true, vtkRadiosity::LINK_METHOD_AUTO, radiosity);
    vtkPolyData* output = radiosity->GetPolyDataOutput();
    vtkDataArray* fronts = output->GetPointData()->GetArray("Radiosity");
    vtkDataArray* backs = output->GetPointData()->GetArray("RadiosityBack");
    Check(output->GetNumberOfPoints() == 6 && fronts && backs, "points of a sheet");
    for (vtkIdType point = 0; fronts && backs && point < output->GetNumberOfPoints(); ++point)
    {
      CheckClose(fronts->GetComponent(point, 0), 1.0 + output->GetPoint(point)[0], 1e-12,
        "fronts at a point");
      CheckClose(backs->GetComponent(point, 0), 10.0, 1e-12, "backs at a point");
    }
  }
}

//------------------------------------------------------------------------------
// Two sheets of 1 K or so: each side radiates by itself, and has its own given flux.
void TestTemperatures()
{
  Surface sheet;
  sheet.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  auto data = sheet.Get();
  AddArray(data, "Emissivity", { 0.5 });
  AddArray(data, "EmissivityBack", { 0.25 });
  AddArray(data, "Temperature", { 300.0 });
  AddArray(data, "TemperatureBack", { 400.0 });
  const double sigma = 5.670374419e-8;
  vtkNew<vtkRadiosity> radiosity;
  Solve(data, true, vtkRadiosity::LINK_METHOD_AUTO, radiosity);
  vtkPolyData* output = radiosity->GetPolyDataOutput();
  CheckClose(GetValue(output, "NetFlux", 0), 0.5 * sigma * std::pow(300.0, 4), 1e-12, "front");
  CheckClose(GetValue(output, "NetFluxBack", 0), 0.25 * sigma * std::pow(400.0, 4), 1e-12, "back");
  CheckClose(GetSummary(output, "NetPower"),
    sigma * (0.5 * std::pow(300.0, 4) + 0.25 * std::pow(400.0, 4)), 1e-12, "power of both");
  AddArray(data, "BoundaryCondition", { 1.0 });
  AddArray(data, "PrescribedNetFlux", { 100.0 });
  radiosity->SetBackgroundTemperature(300.0);
  radiosity->SetInputData(data);
  data->Modified();
  radiosity->Update();
  output = radiosity->GetPolyDataOutput();
  for (const auto& [name, emissivity] :
    { std::pair{ "SurfaceTemperature", 0.5 }, { "SurfaceTemperatureBack", 0.25 } })
  {
    const double black = sigma * std::pow(300.0, 4) + 100.0 / emissivity;
    CheckClose(GetValue(output, name, 0), std::pow(black / sigma, 0.25), 1e-9, name);
  }
}

//------------------------------------------------------------------------------
void TestDirect()
{
  Surface sheet;
  sheet.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  sheet.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  auto data = sheet.Get();
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->SetPositional(false);
  light->SetPosition(0, 0, -1);
  light->SetFocalPoint(0, 0, 0);
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputData(data);
  direct->AddLight(light);
  direct->TwoSidedOn();
  direct->Update();
  vtkPolyData* output = direct->GetPolyDataOutput();
  CheckClose(GetValue(output, "DirectIrradianceBack", 0), 1.0, 1e-12, "light from below");
  CheckClose(GetValue(output, "DirectIrradianceBack", 1), 0.0, 1e-12, "shadow of the other sheet");
  CheckClose(GetValue(output, "DirectIrradiance", 0), 0.0, 1e-12, "the dark side");
  CheckClose(GetSummary(output, "DirectFlux"), 1.0, 1e-12, "flux");

  AddArray(output, "Reflectance", { 0.5 });
  vtkNew<vtkRadiosity> radiosity;
  Solve(output, true, vtkRadiosity::LINK_METHOD_AUTO, radiosity);
  CheckClose(GetValue(radiosity->GetPolyDataOutput(), "RadiosityBack", 0), 0.5, 1e-12,
    "and radiosity");
}

//------------------------------------------------------------------------------
void Expect(vtkRadiosity* radiosity, const std::string& text)
{
  vtkNew<vtkTest::ErrorObserver> observer;
  vtkNew<vtkTest::ErrorObserver> pipelineObserver;
  radiosity->AddObserver(vtkCommand::ErrorEvent, observer);
  radiosity->AddObserver(vtkCommand::WarningEvent, observer);
  radiosity->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
  radiosity->Update();
  const std::string message = observer->GetErrorMessage() + observer->GetWarningMessage();
  Check(message.find(text) != std::string::npos, "\"" + text + "\": " + message);
}

//------------------------------------------------------------------------------
void TestMessages()
{
  auto data = MakeScene();
  AddArray(data, "Reflectance", { 0.5 });
  AddArray(data, "Emission", { 1.0 });
  vtkNew<vtkRadiosity> radiosity;
  radiosity->SetInputData(data);
  radiosity->TwoSidedOn();
  Expect(radiosity, "Lamps shine from both sides");
  vtkNew<vtkViewFactors> factors;
  radiosity->SetViewFactors(factors);
  Expect(radiosity, "switch TwoSided of vtkViewFactors and vtkRadiosity");
  radiosity->SetViewFactors(nullptr);

  AddArray(data, "EmissionBack", { 1.0, 2.0 });
  data->Modified();
  Expect(radiosity, R"("EmissionBack" has 2 components where "Emission" has 1)");
  AddArray(data, "EmissionBack", { -1.0 });
  data->Modified();
  Expect(radiosity, "\"Emission\" is -1 at the back of polygon 0");
  AddArray(data, "EmissionBack", { 0.0 });
  AddArray(data, "DirectIrradiance", { 1.0 });
  data->Modified();
  Expect(radiosity, "No direct light falls on backs");
  data->GetCellData()->RemoveArray("Emission");
  data->Modified();
  Expect(radiosity, "no cell array \"Emission\", but one for the backs");
}
} // namespace

//------------------------------------------------------------------------------
int TestTwoSided(int, char*[])
{
  TestSheets();
  const std::vector<Pose> poses = MakePoses();
  for (std::size_t pose = 0; pose < 4; ++pose)
  {
    TestCopy(poses[pose], vtkRadiosity::LINK_METHOD_DENSE);
  }
  TestCopy(poses[0], vtkRadiosity::LINK_METHOD_HIERARCHICAL);
  TestCopyOfFactors();
  TestAtlas();
  TestFile();
  TestPoints();
  TestTemperatures();
  TestDirect();
  TestMessages();
  TestCompositeAndRanks();
  return Result();
}
