// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRadiosity and vtkViewFactors with links between clusters: what users see of them, against the
// matrix of all pairs.
#include "RadiosityTesting.h"
#include "vtkCallbackCommand.h"
#include "vtkPolygon.h"

#include <functional>

using namespace LightTransportTesting;

namespace
{
using Settings = std::function<void(vtkRadiosity*)>;

//------------------------------------------------------------------------------
/// A run of a filter, which is kept for others.
struct Solved
{
  std::string Messages;
  Vector Radiosity; ///< the bands of a patch side by side; empty after an error

  Solved(vtkRadiosity* filter, vtkPolyData* data) : Filter(filter)
  {
    vtkNew<MessageLog> observer;
    vtkNew<vtkTest::ErrorObserver> pipelineObserver;
    filter->AddObserver(vtkCommand::ErrorEvent, observer);
    filter->AddObserver(vtkCommand::WarningEvent, observer);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineObserver);
    filter->SetInputData(data);
    filter->Update();
    this->Messages = observer->GetAllButVerdict();
    vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray("Radiosity");
    this->Radiosity.resize(array ? array->GetNumberOfValues() : 0);
    for (vtkIdType k = 0; k < this->Radiosity.size(); ++k)
    {
      this->Radiosity[k] = array->GetVariantValue(k).ToDouble();
    }
    filter->RemoveAllObservers();
    filter->GetExecutive()->RemoveAllObservers();
  }

  double Get(const char* name) const { return GetSummary(this->Filter->GetPolyDataOutput(), name); }
  std::string GetText(const char* name) const
  {
    vtkAbstractArray* used =
      this->Filter->GetPolyDataOutput()->GetFieldData()->GetAbstractArray(name);
    return used ? std::string(used->GetVariantValue(0).ToString()) : "";
  }
  std::string GetLinkMethod() const { return this->GetText("LinkMethodUsed"); }

private:
  vtkSmartPointer<vtkRadiosity> Filter;
};

//------------------------------------------------------------------------------
/// With a filter of its own, on the CPU.
Solved Solve(
  vtkPolyData* data, int linkMethod, const Settings& settings = [](vtkRadiosity*) {})
{
  vtkNew<vtkRadiosity> filter;
  filter->SetDeviceToCPU();
  filter->SetTolerance(1e-8);
  filter->SetViewFactorTolerance(linkMethod == vtkRadiosity::LINK_METHOD_DENSE ? 1e-3 : 0.0);
  filter->SetLinkMethod(linkMethod);
  settings(filter);
  return { filter, data };
}

constexpr int Auto = vtkRadiosity::LINK_METHOD_AUTO;
constexpr int Dense = vtkRadiosity::LINK_METHOD_DENSE;
constexpr int Hierarchical = vtkRadiosity::LINK_METHOD_HIERARCHICAL;

//------------------------------------------------------------------------------
/// Area-weighted relative L2.
double Compare(vtkPolyData* data, const Vector& found, const Vector& expected)
{
  if (!Check(found.size() == expected.size() && found.size() > 0, "solutions to compare"))
  {
    return vtkMath::Nan();
  }
  const std::vector<double> areas = GetAreas(data);
  const auto bands = static_cast<std::size_t>(found.size()) / areas.size();
  double sum = 0.0, whole = 0.0;
  for (vtkIdType k = 0; k < found.size(); ++k)
  {
    const double area = areas[k / bands];
    sum += area * (found[k] - expected[k]) * (found[k] - expected[k]);
    whole += area * expected[k] * expected[k];
  }
  return std::sqrt(sum / whole);
}

//------------------------------------------------------------------------------
void CheckMessage(const Solved& run, const std::string& message)
{
  Check(run.Messages.find(message) != std::string::npos,
    "\"" + message + "\" in: \"" + run.Messages + "\"");
  Check(run.Radiosity.size() == 0, "no output with \"" + message + "\"");
}

//------------------------------------------------------------------------------
/// Two boxes, one through the other, in a room whose patch `lamp` emits.
vtkSmartPointer<vtkPolyData> MakeScene(double length, vtkIdType lamp)
{
  Surface room;
  AddBox(room, { 0, 0, 0 }, { 4, 3, 2.5 }, length, true);
  AddBox(room, { 1.0, 1.0, 0.4 }, { 2.5, 2.0, 0.9 }, length, false);
  AddBox(room, { 1.5, 0.7, 0.6 }, { 1.9, 2.4, 1.6 }, length, false);
  auto data = room.Get();
  AddArray(data, "Reflectance", { 0.5 });
  AddArray(data, "Emission", { 0.0 })->SetValue(lamp, 1.0);
  return data;
}

//------------------------------------------------------------------------------
void TestMethods()
{
  auto scene = MakeScene(0.6, 100);
  AddArray(scene, "Emission", { 1.0 })->SetValue(100, 20.0);
  const Solved dense = Solve(scene, Dense);
  Check(dense.GetLinkMethod() == "Dense" && Solve(scene, Auto).GetLinkMethod() == "Dense",
    "few patches are linked densely");
  Vector first;
  for (const int solver : { vtkRadiosity::SOLVER_CONJUGATE_GRADIENT, vtkRadiosity::SOLVER_CHEBYSHEV,
         vtkRadiosity::SOLVER_JACOBI, vtkRadiosity::SOLVER_SOUTHWELL })
  {
    const std::string what = "links between clusters, solver " + std::to_string(solver);
    const Solved run =
      Solve(scene, Hierarchical, [=](vtkRadiosity* filter) { filter->SetSolver(solver); });
    Check(run.Messages.empty() && run.GetLinkMethod() == "Hierarchical", what + run.Messages);
    Check(Compare(scene, run.Radiosity, dense.Radiosity) < 1e-2, what + " against the matrix");
    first = first.size() > 0 ? first : run.Radiosity;
    Check((run.Radiosity - first).cwiseAbs().maxCoeff() < 1e-6 * first.maxCoeff(),
      what + " against conjugate gradients");
    Check(run.Get("NumberOfLinks") > run.Get("NumberOfPatchLinks") &&
        run.Get("NumberOfPatchLinks") > 0.0 && run.Get("LinkError") > 0.0 &&
        run.Get("LinkError") <= 1e-2 && run.Get("LinkRaysCast") > 0.0 &&
        run.Get("PairsExamined") > run.Get("PairsBackFacing") + run.Get("NumberOfLinks") &&
        run.Get("DenseMatrixBytes") == dense.Get("DenseMatrixBytes") &&
        run.Get("MatrixBytes") >= 16.0 * run.Get("NumberOfLinks"),
      what + ": summaries");
  }
  const auto gaussSeidel = [](vtkRadiosity* filter) { filter->SetSolverToGaussSeidel(); };
  CheckMessage(Solve(scene, Hierarchical, gaussSeidel),
    "GaussSeidel needs a link for each pair of patches: set LinkMethod to Dense, or use");
  Check(Solve(scene, Auto, gaussSeidel).GetLinkMethod() == "Dense", "GaussSeidel gets a matrix");
}

//------------------------------------------------------------------------------
/// What is asked for decides, or is told of.
void TestWishes()
{
  auto scene = MakeScene(1.2, 20);
  const auto tolerate = [](double ofFactors, double ofLinks)
  {
    return [=](vtkRadiosity* filter)
    {
      filter->SetViewFactorTolerance(ofFactors);
      filter->SetLinkTolerance(ofLinks);
    };
  };
  const auto check = [&](int method, const Settings& settings, const std::string& explained,
                       const std::string& message)
  {
    const Solved run = Solve(scene, method, settings);
    Check(run.GetText("LinkMethodExplanation") == explained &&
        explained.find(run.GetLinkMethod() + ": ") == 0,
      explained + ", not " + run.GetText("LinkMethodExplanation"));
    Check(message.empty() ? run.Messages.empty() : run.Messages.find(message) != std::string::npos,
      explained + " with: " + run.Messages);
    Check(run.Radiosity.size() > 0, explained + ": a solution");
  };
  check(Auto, tolerate(1e-2, 0.0), "Dense: ViewFactorTolerance asks for it", "");
  check(Auto, tolerate(0.0, 1e-2), "Sampled: LinkTolerance asks for links that it decides on", "");
  check(Auto, tolerate(1e-2, 1e-2), "Dense: ViewFactorTolerance asks for it",
    "LinkTolerance has no effect on the links");
  check(Dense, tolerate(1e-2, 1e-2), "Dense: asked for",
    "set LinkMethod to Sampled or Hierarchical, or LinkTolerance to 0");
  for (const int method : { Hierarchical, static_cast<int>(vtkRadiosity::LINK_METHOD_SAMPLED) })
  {
    const std::string name = method == Hierarchical ? "Hierarchical" : "Sampled";
    check(method, tolerate(0.0, 1e-2), name + ": asked for", "");
    check(method, tolerate(1e-2, 1e-2), name + ": asked for",
      "ViewFactorTolerance has no effect on the links (" + name + ": asked for)");
  }
  check(
    Auto, [](vtkRadiosity* filter) { filter->RefineByBrightnessOn(); },
    "Hierarchical: RefineByBrightness asks for it", "");
  vtkNew<vtkViewFactors> factors;
  check(
    Auto,
    [&](vtkRadiosity* filter)
    {
      filter->SetViewFactors(factors);
      filter->SetViewFactorTolerance(1e-2);
    },
    "Dense: given by SetViewFactors", "set it in their vtkViewFactors");
}

//------------------------------------------------------------------------------
void TestGivenFactors()
{
  auto scene = MakeScene(1.2, 20);
  vtkNew<vtkViewFactors> factors;
  factors->SetTolerance(1e-2);
  const auto give = [&](vtkRadiosity* filter) { filter->SetViewFactors(factors); };
  CheckMessage(Solve(scene, Hierarchical, give), "LinkMethod of vtkViewFactors to Hierarchical");
  Check(Solve(scene, Auto, give).GetLinkMethod() == "Dense", "a given matrix decides");
  factors->HierarchicalOn();
  CheckMessage(Solve(scene, Dense, give), "LinkMethod of vtkViewFactors to Dense");
  Check(Solve(scene, Auto, give).GetLinkMethod() == "Hierarchical", "given links decide");
  CheckMessage(Solve(scene, Auto,
                 [&](vtkRadiosity* filter)
                 {
                   give(filter);
                   filter->SetSolverToGaussSeidel();
                 }),
    "GaussSeidel needs a link for each pair");
}

//------------------------------------------------------------------------------
// Nothing but one plane: large, and nothing to link.
void TestManyPatches()
{
  Surface plane;
  plane.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 91, 91);
  auto data = plane.Get();
  AddArray(data, "Reflectance", { 0.5 });
  AddArray(data, "Emission", { 3.0 });
  const Solved sampled = Solve(data, Auto);
  Check(sampled.GetLinkMethod() == "Sampled", "many patches are linked by rays");
  Check(sampled.Radiosity.size() > 8192 && (sampled.Radiosity.array() == 3.0).all(),
    "nothing is met");
  const Solved run =
    Solve(data, Auto, [](vtkRadiosity* filter) { filter->RefineByBrightnessOn(); });
  Check(run.GetLinkMethod() == "Hierarchical", "brightness refines links between clusters");
  Check((run.Radiosity.array() == 3.0).all(), "nothing is linked");
  Check(run.Get("NumberOfLinks") == 0.0 && run.Get("LinkError") == 0.0, "no links in a plane");
}

//------------------------------------------------------------------------------
// What is predicted to take less time.
void TestCosts()
{
  const auto check = [](Surface& surface, double accuracy, const std::string& explained)
  {
    auto data = surface.Get();
    AddArray(data, "Reflectance", { 0.5 });
    AddArray(data, "Emission", { 3.0 });
    const std::string found = Solve(data, Auto,
      [=](vtkRadiosity* filter) {
        filter->SetAccuracy(accuracy);
      }).GetText("LinkMethodExplanation");
    Check(found.find(explained) == 0, explained + ", not " + found);
  };
  const auto checkPlane = [&](int squares, double accuracy, const std::string& explained)
  {
    Surface plane;
    plane.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, squares, squares);
    check(plane, accuracy, explained);
  };
  checkPlane(30, 1e-2, "Dense: all pairs of few patches");
  checkPlane(60, 1e-2, "Dense: all pairs may take about 1 s, rays 1 s");
  checkPlane(91, 1e-4, "Sampled: all pairs would take much memory and time");
  // Blocks on a plain, which hide most of it from each other.
  Surface city;
  city.AddGrid({ 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, 60, 60);
  for (int block = 0; block < 16; ++block)
  {
    const double x = block % 4 + 0.2, y = block / 4 + 0.2;
    AddBox(city, { x, y, 1e-3 }, { x + 0.6, y + 0.6, 1.0 }, 0.2, false);
  }
  check(city, 1e-2, "Sampled: all pairs may take about ");
}

//------------------------------------------------------------------------------
void TestBrightness()
{
  auto room = MakeRoom(10);
  AddArray(room, "Reflectance", { 0.5 });
  AddArray(room, "Emission", { 0.0 })->SetValue(45, 1.0);
  const Solved dense = Solve(room, Dense);
  double coarseError = 0.0, coarseLinks = 0.0;
  for (const double tolerance : { 3e-2, 1e-2 })
  {
    const auto solve = [&](bool bright)
    {
      return Solve(room, Hierarchical,
        [=](vtkRadiosity* filter)
        {
          filter->SetLinkTolerance(tolerance);
          filter->EnforceClosureOn();
          filter->SetRefineByBrightness(bright);
        });
    };
    const Solved even = solve(false);
    const Solved bright = solve(true);
    const double evenError = Compare(room, even.Radiosity, dense.Radiosity);
    const double brightError = Compare(room, bright.Radiosity, dense.Radiosity);
    std::cout << room->GetNumberOfCells() << " patches, small lamp, " << tolerance << ": "
              << even.Get("NumberOfLinks") << " links, error of B " << evenError << ", estimate "
              << even.Get("LinkError") << "; by brightness " << bright.Get("NumberOfLinks")
              << " links, " << brightError << ", " << bright.Get("LinkError") << std::endl;
    const std::string what = " by brightness, tolerance " + std::to_string(tolerance);
    Check(bright.Get("NumberOfLinks") < 0.4 * even.Get("NumberOfLinks"), "links" + what);
    Check(brightError < 0.6 * tolerance && evenError < 0.6 * tolerance, "radiosity" + what);
    // At this tolerance against the one before.
    Check(tolerance == 3e-2 ||
        (brightError < 0.5 * coarseError && bright.Get("NumberOfLinks") < 0.85 * coarseLinks),
      "fewer links for the same error");
    coarseError = evenError;
    coarseLinks = even.Get("NumberOfLinks");
  }
}

//------------------------------------------------------------------------------
// A tiny lamp in a dark room: closing rows that are mostly dark must not spoil what the lamp gives.
void TestTinyLamp()
{
  Surface surface;
  AddBox(surface, { 0, 0, 0 }, { 1, 1, 1 }, 0.15, true);
  AddBox(surface, { 0.4, 0.4, 0.4 }, { 0.401, 0.401, 0.401 }, 0.001, false);
  auto room = surface.Get();
  AddArray(room, "Reflectance", { 0.5 });
  AddArray(room, "Emission", { 0.0 })->SetValue(room->GetNumberOfCells() - 1, 1.0);
  const auto getIrradiance = [&](int linkMethod, double tolerance)
  {
    vtkNew<vtkRadiosity> filter;
    filter->SetDeviceToCPU();
    filter->SetTolerance(1e-8);
    filter->SetLinkMethod(linkMethod);
    linkMethod == Dense ? filter->SetViewFactorTolerance(1e-5)
                        : filter->SetLinkTolerance(tolerance);
    filter->RefineByBrightnessOn();
    const Solved run(filter, room);
    vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray("Irradiance");
    Vector values(array ? array->GetNumberOfTuples() : 0);
    for (vtkIdType cell = 0; cell < values.size(); ++cell)
    {
      values[cell] = array->GetComponent(cell, 0);
    }
    return values;
  };
  const Vector exact = getIrradiance(Dense, 1e-2);
  for (const double tolerance : { 1e-2, 1e-3 })
  {
    const double error = Compare(room, getIrradiance(Hierarchical, tolerance), exact);
    Check(error < 8.0 * tolerance, "irradiance by a tiny lamp is off by " + std::to_string(error));
  }
}

//------------------------------------------------------------------------------
// Low hills, of which each patch sees little of a few others.
vtkSmartPointer<vtkPolyData> MakeHills(int cuts)
{
  const auto at = [=](int i, int j)
  {
    const double x = 6.0 * i / cuts, y = 6.0 * j / cuts;
    return Point{ x, y, 0.15 * std::sin(2.0 * x) * std::cos(1.7 * y) };
  };
  Surface hills;
  for (int i = 0; i < cuts; ++i)
  {
    for (int j = 0; j < cuts; ++j)
    {
      hills.AddPolygon({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      hills.AddPolygon({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return hills.Get();
}

//------------------------------------------------------------------------------
/// What a sun 10 degrees high makes them reflect, shadows left out.
void LightHills(vtkPolyData* hills)
{
  AddArray(hills, "Reflectance", { 0.3 });
  vtkDoubleArray* reflected = AddArray(hills, "Emission", { 0.0 });
  for (vtkIdType cell = 0; cell < hills->GetNumberOfCells(); ++cell)
  {
    double normal[3];
    vtkPolygon::ComputeNormal(hills->GetCell(cell)->GetPoints(), normal);
    const double height = vtkMath::RadiansFromDegrees(10.0);
    reflected->SetValue(cell,
      0.3 * std::max(0.0, std::cos(height) * normal[0] + std::sin(height) * normal[2]));
  }
}

//------------------------------------------------------------------------------
// What LinkError says is what the light that there is has of it, emission not counted, and more
// than was asked for is warned of.
void CheckLinkError(const std::string& name, vtkPolyData* data, const Vector& exact,
  double tolerance, bool isBright)
{
  const Solved links = Solve(data, Hierarchical,
    [=](vtkRadiosity* filter)
    {
      filter->SetLinkTolerance(tolerance);
      filter->SetRefineByBrightness(isBright);
    });
  Vector emission(exact.size());
  for (vtkIdType patch = 0; patch < emission.size(); ++patch)
  {
    emission[patch] = data->GetCellData()->GetArray("Emission")->GetComponent(patch, 0);
  }
  const double error = Compare(data, links.Radiosity - emission, exact - emission);
  const double told = links.Get("LinkError");
  const std::string what = name + (isBright ? ", by brightness, " : ", ") +
    std::to_string(tolerance) + ": error " + std::to_string(error) + ", told " +
    std::to_string(told);
  std::cout << what << std::endl;
  Check(told > 0.6 * error && told < 1.6 * error, what);
  const bool isTold =
    links.Messages.find("was not reached in this light: links between clusters leave B off by") !=
    std::string::npos;
  Check(isTold == (told > 1.2 * tolerance), "warning, " + what + links.Messages);
  Check(!isTold ||
      (links.Messages.find("switch RefineByBrightness on") == std::string::npos) == isBright,
    "remedy, " + what + links.Messages);
}

//------------------------------------------------------------------------------
void TestLinkError()
{
  auto room = MakeScene(0.4, 100);
  const Vector lit = Solve(room, Dense).Radiosity;
  CheckLinkError("small lamp", room, lit, 1e-1, false);
  CheckLinkError("small lamp", room, lit, 1e-2, false);
  CheckLinkError("small lamp", room, lit, 1e-2, true);
  auto hills = MakeHills(20);
  LightHills(hills);
  const Vector scattered = Solve(hills, Dense).Radiosity;
  CheckLinkError("low sun", hills, scattered, 1e-2, false);
  CheckLinkError("low sun", hills, scattered, 1e-3, false);
}

//------------------------------------------------------------------------------
void TestCache()
{
  auto scene = MakeScene(0.8, 12);
  vtkNew<vtkRadiosity> filter;
  filter->SetLinkMethodToHierarchical();
  const Solved first(filter, scene);
  const double seconds = first.Get("ViewFactorSeconds");
  const double links = first.Get("NumberOfLinks");
  const auto move = [&](vtkIdType lamp)
  {
    AddArray(scene, "Emission", { 0.0 })->SetValue(lamp, 1.0);
    scene->Modified();
    return Solved(filter, scene);
  };
  const Solved second = move(30);
  Check(second.Get("ViewFactorSeconds") == seconds, "links are kept for another emission");
  Check((second.Radiosity - first.Radiosity).cwiseAbs().maxCoeff() > 0.5, "another solution");
  filter->RefineByBrightnessOn();
  const double brightSeconds = move(50).Get("ViewFactorSeconds");
  Check(brightSeconds != seconds, "links by brightness are others");
  const Solved bright = move(12);
  Check(bright.Get("ViewFactorSeconds") != brightSeconds, "links by brightness are not kept");
  Check(bright.GetLinkMethod() == "Hierarchical", "links by brightness");
  filter->RefineByBrightnessOff();
  const Solved last = move(12);
  Check(last.Get("NumberOfLinks") == links && last.Radiosity == first.Radiosity,
    "coarse links do not stay");
  filter->SetLinkTolerance(0.1);
  filter->Update();
  Check(last.Get("NumberOfLinks") < links, "another tolerance, other links");
}

//------------------------------------------------------------------------------
void TestAbort()
{
  auto scene = MakeScene(0.3, 12);
  vtkNew<vtkRadiosity> filter;
  filter->SetInputData(scene);
  filter->SetLinkMethodToHierarchical();
  double last = 0.0;
  vtkNew<vtkCallbackCommand> stop;
  stop->SetClientData(&last);
  stop->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void*)
    {
      auto* radiosity = static_cast<vtkRadiosity*>(caller);
      // The executive ends every run, this one too, with a progress of 1.
      if (radiosity->GetProgress() < 1.0)
      {
        *static_cast<double*>(client) = radiosity->GetProgress();
        radiosity->SetAbortExecute(radiosity->GetProgress() > 0.1);
      }
    });
  filter->AddObserver(vtkCommand::ProgressEvent, stop);
  vtkNew<vtkTest::ErrorObserver> pipelineErrors;
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, pipelineErrors);
  filter->Update();
  Check(last > 0.1 && last < 0.15, "an abort stops at once, at " + std::to_string(last));
  Check(!filter->GetPolyDataOutput()->GetCellData()->HasArray("Radiosity"),
    "no output after an abort");
}

//------------------------------------------------------------------------------
void TestViewFactors()
{
  auto room = MakeRoom(7);
  vtkDoubleArray* groups = AddArray(room, "Group", { 0.0 });
  for (vtkIdType cell = 0; cell < room->GetNumberOfCells(); ++cell)
  {
    groups->SetValue(cell, static_cast<double>(cell / 49));
  }
  auto dense = ComputeViewFactors(room, 1e-4);
  vtkNew<vtkViewFactors> links;
  links->SetInputData(room);
  links->HierarchicalOn();
  links->Update();
  double worst = 0.0;
  vtkTable* table = links->GetGroupTable();
  Check(table->GetNumberOfRows() == 6 && table->GetNumberOfColumns() == 10, "table of groups");
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    for (vtkIdType column = 1; column < table->GetNumberOfColumns(); ++column)
    {
      worst = std::max(worst,
        std::abs(table->GetValue(row, column).ToDouble() -
          dense->GetGroupTable()->GetValue(row, column).ToDouble()));
    }
  }
  Check(worst < 2e-3, "groups are off by " + std::to_string(worst));
  double sum = 0.0, whole = 0.0;
  for (vtkIdType i = 0; i < room->GetNumberOfCells(); ++i)
  {
    for (vtkIdType j = 0; j < room->GetNumberOfCells(); ++j)
    {
      const double expected = dense->GetViewFactor(i, j);
      sum += std::pow(links->GetViewFactor(i, j) - expected, 2);
      whole += expected * expected;
    }
  }
  Check(std::sqrt(sum / whole) < 0.1,
    "single view factors are off by " + std::to_string(std::sqrt(sum / whole)));
  Check(links->GetViewFactor(0, 6 * 49) == 0.0 && links->GetViewFactor(-1, 0) == 0.0,
    "no such patch");

  vtkNew<vtkTest::ErrorObserver> observer;
  links->AddObserver(vtkCommand::ErrorEvent, observer);
  Check(!links->Save("links.vtlvf") &&
      observer->GetErrorMessage().find("Links between clusters cannot be saved: switch "
                                       "Hierarchical off and update") != std::string::npos,
    "links are not saved: " + observer->GetErrorMessage());
}

//------------------------------------------------------------------------------
void TestBackground()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 12, 12);
  plates.AddGrid({ 0, 0, 0.5 }, { 0, 1, 0 }, { 1, 0, 0 }, 12, 12);
  auto data = plates.Get();
  AddArray(data, "Reflectance", { 0.7 });
  AddArray(data, "Emission", { 0.0 });
  const auto shine = [](vtkRadiosity* filter) { filter->SetBackgroundRadiance(2.0); };
  const Solved dense = Solve(data, Dense, shine);
  const Solved links = Solve(data, Hierarchical, shine);
  const double error = Compare(data, links.Radiosity, dense.Radiosity);
  Check(error < 1e-2, "background between plates is off by " + std::to_string(error));
  const Solved bright = Solve(data, Hierarchical,
    [](vtkRadiosity* filter)
    {
      filter->SetBackgroundRadiance(2.0);
      filter->RefineByBrightnessOn();
    });
  const double brightError = Compare(data, bright.Radiosity, dense.Radiosity);
  Check(brightError < 1e-2, "and refined by brightness by " + std::to_string(brightError));
}

//------------------------------------------------------------------------------
void TestFewPatches()
{
  const auto make = [](bool facing, double height)
  {
    Surface surface;
    surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    if (height > 0.0)
    {
      surface.AddGrid({ 0, 0, height }, facing ? Point{ 0, 1, 0 } : Point{ 1, 0, 0 },
        facing ? Point{ 1, 0, 0 } : Point{ 0, 1, 0 }, 1, 1);
    }
    else if (facing)
    {
      surface.AddGrid({ 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
    }
    auto data = surface.Get();
    AddArray(data, "Reflectance", { 0.5 });
    AddArray(data, "Emission", { 1.0 });
    return Solve(data, Hierarchical);
  };
  const Solved one = make(false, 0.0);
  Check(one.Messages.empty() && one.Radiosity.size() == 1 && one.Radiosity[0] == 1.0 &&
      one.Get("NumberOfLinks") == 0.0,
    "one patch " + one.Messages);
  const Solved coplanar = make(true, 0.0);
  Check(coplanar.Messages.empty() && coplanar.Radiosity == Vector::Ones(2) &&
      coplanar.Get("NumberOfLinks") == 0.0,
    "two patches in one plane " + coplanar.Messages);
  const Solved back = make(false, 1.0);
  Check(back.Messages.empty() && back.Radiosity == Vector::Ones(2), "one behind the other");
  const Solved pair = make(true, 1.0);
  Check(pair.Get("NumberOfLinks") == 1.0 && pair.Get("NumberOfPatchLinks") == 1.0, "one link");
  for (const double radiosity : { pair.Radiosity[0], pair.Radiosity[1] })
  {
    CheckClose(radiosity, 1.0 / (1.0 - 0.5 * 0.199824895698387), 1e-4, "two patches that face");
  }
  vtkNew<vtkPolyData> nothing;
  const Solved empty = Solve(nothing, Hierarchical);
  CheckMessage(empty, "The input has no polygons: give a surface");
}

//------------------------------------------------------------------------------
void TestBands()
{
  auto scene = MakeScene(0.6, 100);
  AddArray(scene, "Reflectance", { 0.2, 0.5, 0.8, 0.1, 0.3 });
  AddArray(scene, "Emission", { 0.1, 0.2, 0.3, 1.0, 0.0 })
    ->SetTuple(100, std::array<double, 5>{ 30.0, 20.0, 10.0, 1.0, 5.0 }.data());
  const Solved dense = Solve(scene, Dense);
  const Solved links = Solve(scene, Hierarchical);
  const double error = Compare(scene, links.Radiosity, dense.Radiosity);
  Check(links.Radiosity.size() == 5 * scene->GetNumberOfCells(), "five bands");
  Check(error < 5e-3, "five bands are off by " + std::to_string(error));
}

//------------------------------------------------------------------------------
void TestFurnace()
{
  auto room = MakeRoom(8);
  for (const double reflectance : { 0.5, 0.999 })
  {
    AddArray(room, "Reflectance", { reflectance });
    AddArray(room, "Emission", { 1.0 - reflectance });
    const Solved run = Solve(room, Hierarchical,
      [](vtkRadiosity* filter)
      {
        filter->SetTolerance(1e-11);
        filter->EnforceClosureOn();
      });
    Check(run.Messages.empty(), "furnace: " + run.Messages);
    Check((run.Radiosity.array() - 1.0).abs().maxCoeff() < 1e-9,
      "furnace at " + std::to_string(reflectance));
  }
  // Links between clusters close rows whether asked to or not.
  const Solved open =
    Solve(room, Hierarchical, [](vtkRadiosity* filter) { filter->SetTolerance(1e-11); });
  Check(open.Messages.empty() && (open.Radiosity.array() - 1.0).abs().maxCoeff() < 1e-9,
    "furnace without EnforceClosure: " + open.Messages);
}
} // namespace

//------------------------------------------------------------------------------
int TestHierarchicalRadiosity(int, char*[])
{
  TestMethods();
  TestWishes();
  TestGivenFactors();
  TestManyPatches();
  TestCosts();
  TestBrightness();
  TestTinyLamp();
  TestLinkError();
  TestCache();
  TestAbort();
  TestViewFactors();
  TestBackground();
  TestFewPatches();
  TestBands();
  TestFurnace();
  return Result();
}
