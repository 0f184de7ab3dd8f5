// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// vtkRadiosity with links from rays: the accuracy that it is asked for, and what it says of its own
// errors, against the matrix of all pairs.
#include "AccuracyTesting.h"

#include "vtkSMPTools.h"

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
/// The accuracy is reached, and it is true.
void TestAccuracy()
{
  for (const bool open : { false, true })
  {
    auto scene = MakeScene(0.7, open);
    const Vector right = Solved(scene, Dense).Get("Radiosity");
    for (const double accuracy : { 1e-1, 1e-2 })
    {
      const Solved run(scene, Sampled,
        [&](vtkRadiosity* filter) { filter->SetAccuracy(accuracy); });
      const double error = Compare(scene, run.Get("Radiosity"), right);
      const double reached = run.GetNumber("AccuracyReached");
      const std::string what = (open ? "open, " : "room, ") + std::to_string(accuracy) + ": said " +
        std::to_string(reached) + ", is " + std::to_string(error);
      Check(reached > 0.0 && reached <= accuracy, what);
      Check(error < 2.0 * reached && error > 0.3 * reached, what);
      Check(GetText(run.Filter->GetPolyDataOutput(), "LinkMethodUsed") == "Sampled", "method");
      const auto patches = static_cast<double>(right.size());
      Check(run.GetNumber("ExactRows") >= 1.0 ||
          run.GetNumber("RaysCast") > patches * run.GetNumber("RaysPerPatch"),
        "the lamp's row is exact, or it casts more rays than others");
      Check(run.GetNumber("RaysPerPatch") < (accuracy > 0.05 ? 64.0 : 1e4),
        "few rays where little is asked for");
      Check(run.Messages.empty(), "no messages: " + run.Messages);
    }
  }
}

//------------------------------------------------------------------------------
/// What is asked for is out of reach: as near as can be is no farther than where less is asked for.
void TestBeyondReach()
{
  Surface room;
  AddBox(room, { 0, 0, 0 }, { 3, 2, 2 }, 1.0, true);
  auto scene = room.Get();
  AddArray(scene, "Reflectance", { 0.5 });
  AddArray(scene, "Emission", { 0.0 })->SetValue(3, 1.0);
  const Vector right = Solved(scene, Dense).Get("Radiosity");
  std::vector<double> errors;
  for (const double accuracy : { 1e-2, 1e-5 })
  {
    const Solved run(scene, Sampled, [&](vtkRadiosity* filter) { filter->SetAccuracy(accuracy); });
    Check(run.GetNumber("ExactRows") >= 1.0,
      "the lamp has an exact row for an accuracy of " + std::to_string(accuracy));
    errors.push_back(run.GetNumber("AccuracyReached"));
    Check(Compare(scene, run.Get("Radiosity"), right) < 1e-2, "near what is right");
    Check(run.Messages.find("was not reached") == std::string::npos || accuracy < 1e-2,
      run.Messages);
  }
  Check(errors[1] < errors[0],
    "who asks for more gets no less: " + std::to_string(errors[1]) + " after " +
      std::to_string(errors[0]));
}

//------------------------------------------------------------------------------
/// Nine of ten patches are within two of their standard errors.
void TestErrors()
{
  auto scene = MakeScene(0.7);
  const Vector right = Solved(scene, Dense).Get("Irradiance");
  const Solved run(scene, Sampled,
    [](vtkRadiosity* filter)
    {
      filter->SetAccuracy(2e-2);
      filter->ComputeErrorsOn();
    });
  const Vector found = run.Get("Irradiance");
  const Vector errors = run.Get("IrradianceError");
  Check(run.Get("RadiosityError").size() == errors.size() &&
      run.Get("NetFluxError").size() == errors.size(),
    "errors of each patch");
  int one = 0, two = 0;
  for (Eigen::Index patch = 0; patch < errors.size(); ++patch)
  {
    const double off = std::abs(found[patch] - right[patch]);
    one += off <= errors[patch] ? 1 : 0;
    two += off <= 2.0 * errors[patch] ? 1 : 0;
  }
  const double patches = static_cast<double>(errors.size());
  Check(one > 0.5 * patches && one < 0.85 * patches,
    "within one: " + std::to_string(one / patches));
  Check(two > 0.85 * patches, "within two: " + std::to_string(two / patches));
}

//------------------------------------------------------------------------------
/// With the power of the number of rays that was measured, .62, as far as one scene tells.
void TestFall()
{
  for (const bool open : { false, true })
  {
    auto scene = MakeScene(0.7, open);
    vtkDataArray* emission = scene->GetCellData()->GetArray("Emission");
    for (vtkIdType patch = 0; patch < scene->GetNumberOfCells(); ++patch)
    {
      emission->SetComponent(patch, 0, patch % 3 == 0 ? 1.0 : 0.0);
    }
    const Vector right = Solved(scene, Dense).Get("Radiosity");
    const auto measure = [&](double tolerance, double& rays)
    {
      const Solved run(scene, Sampled,
        [&](vtkRadiosity* filter) { filter->SetLinkTolerance(tolerance); });
      rays = run.GetNumber("RaysPerPatch");
      return Compare(scene, run.Get("Radiosity"), right);
    };
    double few = 0.0, many = 0.0;
    const double first = measure(3.7e-2, few);
    const double last = measure(3e-3, many);
    const double power = std::log(first / last) / std::log(many / few);
    CheckClose(power, 0.62, 0.17, "power of the number of rays by which the error falls");
  }
}

//------------------------------------------------------------------------------
/// The same bits with any number of threads, errors too.
void TestThreads()
{
  auto scene = MakeScene(0.7);
  std::vector<Vector> results;
  for (const int threads : { 1, 2, 5 })
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
      [&]()
      {
        const Solved run(scene, Sampled,
          [](vtkRadiosity* filter)
          {
            filter->SetAccuracy(3e-2);
            filter->ComputeErrorsOn();
          });
        results.push_back(run.Get("Radiosity"));
        results.push_back(run.Get("RadiosityError"));
      });
  }
  for (std::size_t k = 2; k < results.size(); ++k)
  {
    Check(results[k] == results[k % 2], "the same bits with any number of threads");
  }
}

//------------------------------------------------------------------------------
/// The links are there for all solvers, and for one that was given them.
void TestSolvers()
{
  auto scene = MakeScene(0.5);
  const auto ask = [](vtkRadiosity* filter) { filter->SetLinkTolerance(0.1); };
  const Vector expected = Solved(scene, Sampled, ask).Get("Radiosity");
  for (const int solver : GetSolvers())
  {
    if (solver == vtkRadiosity::SOLVER_GAUSS_SEIDEL)
    {
      continue; // needs a matrix
    }
    const Solved run(scene, Sampled,
      [&](vtkRadiosity* filter)
      {
        ask(filter);
        filter->SetSolver(solver);
      });
    Check((run.Get("Radiosity") - expected).cwiseAbs().maxCoeff() < 1e-7,
      "solver " + std::to_string(solver) + " with sampled links: " + run.Messages);
  }
  vtkNew<vtkViewFactors> factors;
  factors->SetLinkMethodToSampled();
  factors->SetLinkTolerance(0.1);
  const Solved given(scene, vtkRadiosity::LINK_METHOD_AUTO,
    [&](vtkRadiosity* filter) { filter->SetViewFactors(factors); });
  Check((given.Get("Radiosity") - expected).cwiseAbs().maxCoeff() < 1e-7, "given links");
  Check(given.GetNumber("AccuracyReached") > 0.0, "errors of given links");
}

//------------------------------------------------------------------------------
/// Nothing reflects; all of it does, and light leaves by openings; even light; no light.
void TestExtremes()
{
  auto black = MakeScene(0.0);
  const Solved dark(black, Sampled);
  Check(dark.Get("Radiosity") == ToVector(GetValues(black->GetCellData()->GetArray("Emission"))),
    "black patches send what they emit");
  Check(dark.GetNumber("AccuracyReached") <= 1e-2, "the accuracy of H");

  auto white = MakeScene(1.0, true);
  const Solved bright(white, Sampled);
  const Vector areas = ToVector(GetAreas(white));
  const Vector radiosity = bright.Get("Radiosity");
  const Vector emission = ToVector(GetValues(white->GetCellData()->GetArray("Emission")));
  CheckClose(areas.dot(bright.Get("NetFlux")), areas.dot(emission), 1e-9,
    "what is emitted leaves patches that reflect all");
  Check(radiosity.minCoeff() >= 0.0, "no light below 0");

  auto even = MakeRoom(4);
  AddArray(even, "Reflectance", { 0.5 });
  AddArray(even, "Emission", { 1.0 });
  const Solved furnace(even, Sampled);
  CheckClose((furnace.Get("Radiosity").array() - 2.0).abs().maxCoeff(), 0.0, 1e-7,
    "even light in a closed room");
  CheckClose(furnace.GetNumber("RaysPerPatch"), 64.0, 0.0, "needs few rays");
  CheckClose(furnace.GetNumber("AccuracyReached"), 0.0, 1e-9, "and knows that it is exact");

  AddArray(even, "Emission", { 0.0 });
  const Solved none(even, Sampled);
  Check(none.Get("Radiosity").cwiseAbs().maxCoeff() == 0.0, "no light: " + none.Messages);

  Surface one;
  one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  auto single = one.Get();
  AddArray(single, "Reflectance", { 0.5 });
  AddArray(single, "Emission", { 1.0 });
  const Solved alone(single, Sampled);
  Check(alone.Get("Radiosity")[0] == 1.0, "one patch: " + alone.Messages);
}

//------------------------------------------------------------------------------
/// Temperatures are as well known as what arrives, where they are not given.
void TestTemperatures()
{
  auto room = MakeRoom(4);
  AddArray(room, "Emissivity", { 0.7 });
  vtkDoubleArray* temperature = AddArray(room, "Temperature", { 290.0 });
  vtkDoubleArray* condition = AddArray(room, "BoundaryCondition", { 0.0 });
  const vtkIdType patches = room->GetNumberOfCells();
  for (vtkIdType patch = 0; patch < patches / 6; ++patch)
  {
    temperature->SetValue(patch, 350.0);
    condition->SetValue(patches - 1 - patch, 1.0);
  }
  const Vector right = Solved(room, Dense).Get("SurfaceTemperature");
  const Solved run(room, Sampled,
    [](vtkRadiosity* filter)
    {
      filter->SetAccuracy(3e-2);
      filter->ComputeErrorsOn();
    });
  const Vector found = run.Get("SurfaceTemperature");
  const Vector errors = run.Get("SurfaceTemperatureError");
  const auto adiabatic = static_cast<Eigen::Index>(patches / 6);
  Check(errors.head(patches - adiabatic).cwiseAbs().maxCoeff() == 0.0 &&
      errors.tail(adiabatic).minCoeff() > 0.0,
    "errors of temperatures that are not given");
  const double worst =
    ((found - right).tail(adiabatic).array() / errors.tail(adiabatic).array()).abs().maxCoeff();
  Check(worst < 4.5, "temperatures within their errors: " + std::to_string(worst));
}

//------------------------------------------------------------------------------
/// Light of the sky alone.
void TestSky()
{
  auto scene = MakeScene(0.6, true);
  AddArray(scene, "Emission", { 0.0 });
  const auto sky = [](vtkRadiosity* filter) { filter->SetBackgroundRadiance(1.0); };
  const Vector right = Solved(scene, Dense, sky).Get("Radiosity");
  const Solved run(scene, Sampled, sky);
  const double error = Compare(scene, run.Get("Radiosity"), right);
  const double reached = run.GetNumber("AccuracyReached");
  Check(reached <= 1e-2 && error < 2.0 * reached && error > 0.3 * reached,
    "sky: said " + std::to_string(reached) + ", is " + std::to_string(error));
}

//------------------------------------------------------------------------------
/// Links that are kept serve other light, if they are good enough for it; what is missing is added.
void TestOtherLight()
{
  auto scene = MakeScene(0.7);
  auto* emission = vtkDoubleArray::SafeDownCast(scene->GetCellData()->GetArray("Emission"));
  const vtkIdType lamp = scene->GetNumberOfCells() - 1;
  const Solved run(scene, Sampled);
  vtkRadiosity* filter = run.Filter;
  const auto update = [&](const std::string& what)
  {
    emission->Modified();
    filter->Update();
    const double reached = run.GetNumber("AccuracyReached");
    const double error =
      Compare(scene, run.Get("Radiosity"), Solved(scene, Dense).Get("Radiosity"));
    Check(reached <= filter->GetAccuracy() && error < 2.0 * reached,
      what + ": said " + std::to_string(reached) + ", is " + std::to_string(error));
  };
  const Vector first = run.Get("Radiosity");
  const vtkIdType runs = filter->GetNumberOfLinkRuns();
  Check(runs > 1, "a first look and better ones");
  emission->SetValue(lamp, 3.0);
  update("a brighter lamp");
  CheckClose(filter->GetNumberOfLinkRuns(), runs, 0.0, "no links for a brighter lamp");
  Check((run.Get("Radiosity") - 3.0 * first).cwiseAbs().maxCoeff() < 1e-6, "all is brighter");

  filter->SetAccuracy(5e-2);
  emission->SetValue(lamp, 1.0);
  update("less is asked");
  CheckClose(filter->GetNumberOfLinkRuns(), runs, 0.0, "no links where less is asked for");
  Check((run.Get("Radiosity") - first).cwiseAbs().maxCoeff() < 1e-6, "as it was");
  filter->SetAccuracy(1e-2);

  const double rows = run.GetNumber("ExactRows");
  const double rays = run.GetNumber("RaysPerPatch");
  emission->SetValue(lamp, 0.0);
  emission->SetValue(0, 1.0);
  update("another lamp");
  const vtkIdType more = filter->GetNumberOfLinkRuns() - runs;
  Check(more >= 1 && more < runs, "what is missing: " + std::to_string(more) + " runs");
  Check(run.GetNumber("ExactRows") > rows && run.GetNumber("RaysPerPatch") >= rays,
    "what was there stays");
  emission->SetValue(lamp, 2.0);
  update("both");
  CheckClose(filter->GetNumberOfLinkRuns(), runs + more, 0.0, "no links for both");

  // What moves has links of its own.
  auto moved = MakeScene(0.7);
  moved->GetPoints()->SetPoint(0, -0.1, 0.0, 0.0);
  filter->SetInputData(moved);
  filter->Update();
  const Solved anew(moved, Sampled);
  Check(run.Get("Radiosity") == anew.Get("Radiosity"), "a scene that has moved");
  CheckClose(filter->GetNumberOfLinkRuns() - runs - more, anew.Filter->GetNumberOfLinkRuns(), 0.0,
    "all links of that");
}
} // namespace

//------------------------------------------------------------------------------
int TestSampledRadiosity(int, char*[])
{
  TestAccuracy();
  TestBeyondReach();
  TestErrors();
  TestFall();
  TestThreads();
  TestSolvers();
  TestExtremes();
  TestTemperatures();
  TestSky();
  TestOtherLight();
  return Result();
}
