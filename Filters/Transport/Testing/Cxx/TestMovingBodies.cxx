// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Bodies that move: what links keep, against links that are new and against all pairs of patches.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "vtkCallbackCommand.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkSubsurfaceScattering.h"

#ifdef TEST_WITH_MESHING
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#endif

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

using namespace LightTransport;
using namespace LightTransportTesting;

namespace
{
constexpr int Bands = 3;
using Scattering = vtkSubsurfaceScattering;
using Movement = std::function<Point(const Point&)>;

//------------------------------------------------------------------------------
// A ball and a smaller one, at a distance: 1,360 triangles, or 400.
vtkSmartPointer<vtkPolyData> MakeBody(double distance = 1.2, int levels = 3)
{
  Surface surface;
  AddSphere(surface, 1.0, levels, false);
  Surface ball;
  AddSphere(ball, 0.3, 1, false);
  vtkSmartPointer<vtkPolyData> other = ball.Get();
  for (vtkIdType cell = 0; cell < other->GetNumberOfCells(); ++cell)
  {
    std::vector<Point> corners;
    for (vtkIdType k = 0; k < other->GetCell(cell)->GetNumberOfPoints(); ++k)
    {
      Point point;
      other->GetPoint(other->GetCell(cell)->GetPointId(k), point.data());
      corners.push_back({ point[0] + distance, point[1] + 0.1, point[2] });
    }
    surface.AddPolygon(corners);
  }
  vtkSmartPointer<vtkPolyData> body = surface.Get();
  std::vector<double> light;
  for (vtkIdType cell = 0; cell < body->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    body->GetCell(cell)->GetBounds(bounds);
    light.push_back(std::max(0.0, 0.3 + bounds[4] + 0.2 * bounds[0]));
  }
  vtkDoubleArray* array = AddArray(body, "TransmittedIrradiance", { 0.0 });
  std::copy(light.begin(), light.end(), array->GetPointer(0));
  return body;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Move(vtkPolyData* body, const Movement& to, bool isSingle = false)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(isSingle ? VTK_FLOAT : VTK_DOUBLE);
  for (vtkIdType k = 0; k < body->GetNumberOfPoints(); ++k)
  {
    Point point;
    body->GetPoint(k, point.data());
    points->InsertNextPoint(to(point).data());
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(body);
  moved->SetPoints(points);
  return moved;
}

//------------------------------------------------------------------------------
Movement Twist(double radians)
{
  return [radians](const Point& p)
  {
    const double angle = radians * p[2];
    return Point{ std::cos(angle) * p[0] - std::sin(angle) * p[1],
      std::sin(angle) * p[0] + std::cos(angle) * p[1], p[2] };
  };
}

//------------------------------------------------------------------------------
Point Stay(const Point& p)
{
  return p;
}

//------------------------------------------------------------------------------
vtkSmartPointer<Scattering> MakeFilter(int method)
{
  auto filter = vtkSmartPointer<Scattering>::New();
  filter->SetMaterialToMarble();
  filter->SetMillimetersPerUnit(12.0);
  filter->SetIncidenceToTransmitted();
  filter->SetLinkMethod(method);
  filter->SetDeviceToCPU();
  return filter;
}

//------------------------------------------------------------------------------
std::vector<double> Run(Scattering* filter, vtkPolyData* data)
{
  filter->SetInputData(data);
  filter->Update();
  return GetValues(filter->GetPolyDataOutput()->GetCellData()->GetArray("ScatteredIrradiance"));
}

//------------------------------------------------------------------------------
double GetField(Scattering* filter, const char* name)
{
  return GetSummary(filter->GetOutputDataObject(0), name);
}

//------------------------------------------------------------------------------
// The same polygons of the same points are arranged alike wherever they are, and no others.
void TestArrangement(vtkPolyData* body)
{
  const auto build = [](vtkDataObject* data, const std::shared_ptr<const PatchArrangement>& kept)
  {
    PatchScene scene;
    CheckDone(scene.Build(data, Ranks(), PatchScene::Order::Surface, 1, false, kept), "scene");
    return scene;
  };
  const PatchScene rest = build(body, nullptr);
  auto twisted = Move(body, Twist(1.0));
  const PatchScene fresh = build(twisted, nullptr);
  const PatchScene kept = build(twisted, rest.GetArrangement());
  Check(rest.GetArrangement() && kept.GetArrangement() == rest.GetArrangement(),
    "an arrangement is kept");
  const auto keeps = [&](vtkDataObject* data)
  { return build(data, rest.GetArrangement()).GetArrangement() == rest.GetArrangement(); };
  Check(kept.GetFingerprint() != fresh.GetFingerprint() &&
      kept.GetFingerprint() != rest.GetFingerprint(),
    "another order and other places are other scenes");
  Check(build(body, rest.GetArrangement()).GetFingerprint() == rest.GetFingerprint(),
    "the same order and places are the same scene");
  bool areAlike = kept.GetTree().GetNodes().size() == rest.GetTree().GetNodes().size();
  double area = 0.0;
  for (std::size_t node = 0; areAlike && node < kept.GetTree().GetNodes().size(); ++node)
  {
    const PatchTree::Node& a = kept.GetTree().GetNodes()[node];
    const PatchTree::Node& b = rest.GetTree().GetNodes()[node];
    areAlike = a.First == b.First && a.Last == b.Last && a.Left == b.Left && a.Parent == b.Parent;
  }
  for (vtkIdType patch = 0; patch < kept.GetNumberOfPatches(); ++patch)
  {
    areAlike = areAlike && kept.GetPolygon(patch) == rest.GetPolygon(patch);
    area += kept.GetAreas()[patch];
  }
  Check(areAlike, "patches and clusters are the same ones");
  CheckClose(kept.GetTree().GetNode(0).Area, area, 1e-12,
    "clusters are those of where patches are");

  vtkNew<vtkPolyData> turned;
  turned->DeepCopy(body);
  turned->ReverseCell(5);
  Check(!keeps(turned), "another polygon");
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, vtkNew<vtkPolyData>());
  blocks->SetBlock(1, body);
  Check(!keeps(blocks), "another block");
  // A polygon that has no area any more.
  Point corner;
  body->GetPoint(body->GetCell(7)->GetPointId(1), corner.data());
  auto pinched = Move(body,
    [&](const Point& p)
    {
      Point other;
      body->GetPoint(body->GetCell(7)->GetPointId(0), other.data());
      return p == corner ? other : p;
    });
  Check(!keeps(pinched), "other patches of the same polygons");
}

//------------------------------------------------------------------------------
// Moved, turned and scaled with its unit all links are kept, and nothing changes.
void TestRigid(vtkPolyData* body, int method, bool isCompressed)
{
  auto filter = MakeFilter(method);
  filter->SetCompressLinks(isCompressed);
  const std::vector<double> rest = Run(filter, body);
  const double error = GetField(filter, "LinkError");
  Check(GetField(filter, "LinksReused") == 0.0, "links are new");
  for (const double far : { 0.0, 6e5 })
  {
    const auto move = [far](const Point& p) {
      return Point{ 0.6 * p[0] - 0.8 * p[1] + far, 0.8 * p[0] + 0.6 * p[1] - 10.0 * far, p[2] };
    };
    const std::vector<double> moved = Run(filter, Move(body, move));
    // Codes are whole numbers.
    const double change = CompareBands(moved, rest);
    Check(GetField(filter, "LinksReused") == 1.0, "a rigid movement keeps all links");
    Check(change < (isCompressed ? 1e-3 : 1e-7), "and changes nothing: " + std::to_string(change));
    CheckClose(GetField(filter, "LinkError"), error, 1e-3, "nor what is told of errors");
  }
  const std::vector<double> back = Run(filter, body);
  Check(back == rest, "a body that comes back has its links back");
}

//------------------------------------------------------------------------------
// A twist, frame by frame: the error against all pairs is at most 1.2 times that of new links.
void TestTwist(vtkPolyData* body)
{
  struct Links
  {
    int Method;
    double Tolerance;
    int Number;
    bool AreCompressed;
    vtkSmartPointer<Scattering> Kept;
    std::vector<double> Rest;
    double Reused;
  };
  Links all[] = { { Scattering::LINK_METHOD_ADAPTIVE, 1e-2, 1000, false, nullptr, {}, 0.0 },
    { Scattering::LINK_METHOD_ADAPTIVE, 1e-3, 64, true, nullptr, {}, 0.0 },
    { Scattering::LINK_METHOD_UNIFORM, 0.0, 64, false, nullptr, {}, 0.0 } };
  const auto make = [](const Links& links)
  {
    auto filter = MakeFilter(links.Method);
    filter->SetNumberOfLinks(links.Number);
    filter->SetLinkTolerance(links.Tolerance);
    filter->SetCompressLinks(links.AreCompressed);
    return filter;
  };
  for (Links& links : all)
  {
    links.Kept = make(links);
    links.Rest = Run(links.Kept, body);
  }
  constexpr int frames = 3;
  for (int frame = 1; frame <= frames; ++frame)
  {
    auto moved = Move(body, Twist(0.15 * frame), true);
    const std::vector<double> pairs = Run(MakeFilter(Scattering::LINK_METHOD_DENSE), moved);
    for (Links& links : all)
    {
      const std::string what =
        " of method " + std::to_string(links.Method) + " in frame " + std::to_string(frame);
      auto fresh = make(links);
      const double expected = CompareBands(Run(fresh, moved), pairs);
      const double error = CompareBands(Run(links.Kept, moved), pairs);
      const auto get = [&](const char* name) { return GetField(links.Kept, name); };
      std::cout << "errors" << what << ": " << error << ", of new links " << expected << ", reused "
                << get("LinksReused") << std::endl;
      Check(error <= 1.2 * expected, "errors" + what);
      Check(get("LinkError") <= 1.2 * GetField(fresh, "LinkError"), "what is told" + what);
      Check(get("LinksPerReceiver") <= 1.2 * GetField(fresh, "LinksPerReceiver"), "links" + what);
      Check(links.Method != Scattering::LINK_METHOD_ADAPTIVE ||
          get("LinksPerReceiver") <= links.Number,
        "links that are allowed" + what);
      links.Reused += get("LinksReused") / frames;
    }
  }
  for (Links& links : all)
  {
    Check(links.Reused > 0.9, "links are kept: " + std::to_string(links.Reused));
    Check(Run(links.Kept, body) == links.Rest, "and are as they were where they were chosen");
  }
}

//------------------------------------------------------------------------------
// What was left out because it was far away is not when it comes near.
void TestMeeting()
{
  auto far = MakeBody(40.0, 2);
  const auto approach = [](const Point& p) {
    return p[0] > 20.0 ? Point{ p[0] - 38.72, p[1], p[2] } : p;
  };
  for (const int method : { Scattering::LINK_METHOD_UNIFORM, Scattering::LINK_METHOD_ADAPTIVE })
  {
    auto filter = MakeFilter(method);
    filter->SetNumberOfLinks(1000);
    Run(filter, far);
    Check(GetField(filter, "LinksLeftOut") > 0.0, "a body far away is left out");
    auto near = Move(far, approach);
    const std::vector<double> all = Run(MakeFilter(Scattering::LINK_METHOD_DENSE), near);
    auto fresh = MakeFilter(method);
    fresh->SetNumberOfLinks(1000);
    const double expected = CompareBands(Run(fresh, near), all);
    const double error = CompareBands(Run(filter, near), all);
    Check(error <= std::max(1.2 * expected, 1e-2),
      "what comes near is linked: " + std::to_string(error));
  }
}

//------------------------------------------------------------------------------
// To the bit what a new filter gives: where nothing can be kept, and where nothing is to be.
void TestFresh(vtkPolyData* body)
{
  auto moved = Move(body, Twist(0.3));
  const std::vector<double> expected = Run(MakeFilter(Scattering::LINK_METHOD_ADAPTIVE), moved);
  auto filter = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  filter->ReuseLinksOff();
  Run(filter, body);
  Check(Run(filter, moved) == expected && GetField(filter, "LinksReused") == 0.0,
    "links are not kept where they are not to be");
  filter->ReuseLinksOn();
  Run(filter, body);
  Run(filter, moved);
  Check(GetField(filter, "LinksReused") > 0.0, "and are where they are");
  filter->SetNumberOfLinks(65);
  Run(filter, moved);
  Check(GetField(filter, "LinksReused") == 0.0, "another property makes them anew");

  // The same number of patches, anywhere else.
  auto wild = Move(body, Twist(3.0));
  Run(filter, body);
  const std::vector<double> found = Run(filter, wild);
  auto other = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  other->SetNumberOfLinks(65);
  Check(GetField(filter, "LinksReused") == 0.0 && found == Run(other, wild),
    "a choice that does not hold is none");

  auto dense = MakeFilter(Scattering::LINK_METHOD_DENSE);
  Run(dense, body);
  const std::vector<double> pairs = Run(dense, moved);
  Check(GetField(dense, "LinksReused") == 0.0 &&
      CompareBands(pairs, Run(MakeFilter(Scattering::LINK_METHOD_DENSE), moved)) < 1e-12,
    "all pairs are new");
}

//------------------------------------------------------------------------------
// One patch, and none; blocks are one body.
void TestFew(vtkPolyData* body)
{
  Surface one;
  one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  auto triangle = one.Get();
  AddArray(triangle, "TransmittedIrradiance", { 1.0 });
  auto filter = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  Run(filter, triangle);
  auto wider = Move(triangle, [](const Point& p) { return Point{ 2.0 * p[0], p[1], p[2] }; });
  Check(CompareBands(Run(filter, wider), Run(MakeFilter(Scattering::LINK_METHOD_DENSE), wider)) <
      1e-6,
    "one patch that moves");
  vtkNew<MessageLog> errors;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, vtkNew<MessageLog>());
  filter->SetInputData(vtkNew<vtkPolyData>());
  filter->Update();
  Check(!errors->GetAll().empty(), "no patch is an error");
  Check(!Run(filter, body).empty() && GetField(filter, "LinksReused") == 0.0, "and then a body");

  const auto gather = [&](const Movement& to)
  {
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    blocks->SetBlock(0, Move(body, to));
    blocks->SetBlock(1, Move(body, [&](const Point& p) { return to({ p[0], p[1] + 2.1, p[2] }); }));
    return blocks;
  };
  filter->SetInputDataObject(gather(Stay));
  filter->Update();
  filter->SetInputDataObject(gather(Twist(0.1)));
  filter->Update();
  Check(GetField(filter, "LinksReused") > 0.8, "links of blocks are kept");
  const double leaving = GetField(filter, "LeavingFlux");
  auto fresh = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  fresh->SetInputDataObject(gather(Twist(0.1)));
  fresh->Update();
  CheckClose(leaving, GetField(fresh, "LeavingFlux"), 1e-3, "blocks that move");
}

//------------------------------------------------------------------------------
// Stopped in the midst, the next run is a new one.
void TestAbort(vtkPolyData* body)
{
  auto filter = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  Run(filter, body);
  auto moved = Move(body, Twist(0.2));
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->SetInputData(moved);
  filter->Update();
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0);
  filter->Modified();
  const std::vector<double> after = Run(filter, moved);
  Check(GetField(filter, "LinksReused") == 0.0 &&
      after == Run(MakeFilter(Scattering::LINK_METHOD_ADAPTIVE), moved),
    "an abort keeps no links");
}

#ifdef TEST_WITH_MESHING
//------------------------------------------------------------------------------
// The atlas is made once, at rest: points that move afterwards keep their places in it, and texels
// their links.
void TestTexels()
{
  Surface sphere;
  AddSphere(sphere, 1.0, 2, false);
  vtkNew<vtkSurfaceAtlas> atlas;
  atlas->SetInputData(sphere.Get());
  atlas->SetResolution(32);
  atlas->TexelMapsOff();
  atlas->Update();
  vtkSmartPointer<vtkPolyData> surface = atlas->GetOutput();
  auto* light = AddArray(surface, "TransmittedIrradiance", { 0.0 });
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    surface->GetCell(cell)->GetBounds(bounds);
    light->SetValue(cell, std::max(bounds[0] + bounds[1], 0.0));
  }
  const auto toTexels = [](vtkPolyData* data)
  {
    vtkNew<vtkSurfaceToAtlas> filter;
    filter->SetInputData(data);
    filter->SetResolution(32);
    filter->Update();
    return vtkSmartPointer<vtkImageData>(filter->GetOutput());
  };
  const auto run = [](Scattering* filter, vtkImageData* image)
  {
    filter->SetInputData(image);
    filter->Update();
    return GetValues(filter->GetImageDataOutput()->GetPointData()->GetArray("ScatteredIrradiance"));
  };
  auto filter = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  run(filter, toTexels(surface));
  auto texels = toTexels(Move(surface, Twist(0.2)));
  const std::vector<double> all = run(MakeFilter(Scattering::LINK_METHOD_DENSE), texels);
  const double expected =
    CompareBands(run(MakeFilter(Scattering::LINK_METHOD_ADAPTIVE), texels), all);
  const double error = CompareBands(run(filter, texels), all);
  Check(GetField(filter, "LinksReused") > 0.8, "texels keep their links");
  Check(error <= 1.2 * expected, "and are as good: " + std::to_string(error / expected));
  const auto first =
    std::find_if(all.begin(), all.end(), [](double value) { return value > 0.0; }) - all.begin();
  texels->GetPointData()->GetArray("ChartId")->SetComponent(first / Bands, 0, -1.0);
  texels->GetPointData()->GetArray("ChartId")->Modified();
  run(filter, texels);
  Check(GetField(filter, "LinksReused") == 0.0, "other texels have other links");
}
#endif

//------------------------------------------------------------------------------
// Last: ranks make vtkSMPTools sequential.
void TestRanks(vtkPolyData* body)
{
  auto whole = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
  auto moved = Move(body, Twist(0.3));
  Run(whole, body);
  Run(whole, moved);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto filter = MakeFilter(Scattering::LINK_METHOD_ADAPTIVE);
      filter->SetController(controller);
      for (vtkPolyData* data : { body, moved.Get() })
      {
        vtkNew<vtkPolyData> part;
        part->DeepCopy(data);
        part->BuildLinks();
        for (vtkIdType cell = 0; cell < part->GetNumberOfCells(); ++cell)
        {
          if (rank != (cell < 250 ? 0 : 1))
          {
            part->DeleteCell(cell);
          }
        }
        part->RemoveDeletedCells();
        filter->SetInputData(part);
        filter->Update();
      }
      for (const char* name : { "NumberOfLinks", "LinkError", "LinksReused" })
      {
        CheckClose(GetField(filter, name), GetField(whole, name), 1e-12, name);
      }
      CheckClose(GetField(filter, "LeavingFlux"), GetField(whole, "LeavingFlux"), 1e-9, "leaving");
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestMovingBodies(int, char*[])
{
  auto body = MakeBody();
  auto small = MakeBody(1.2, 2);
  TestArrangement(small);
  for (const bool isCompressed : { false, true })
  {
    TestRigid(small, Scattering::LINK_METHOD_ADAPTIVE, isCompressed);
  }
  TestRigid(small, Scattering::LINK_METHOD_UNIFORM, false);
  TestTwist(body);
  TestMeeting();
  TestFresh(small);
  TestFew(small);
  TestAbort(small);
#ifdef TEST_WITH_MESHING
  TestTexels();
#endif
  TestRanks(small);
  return Result();
}
