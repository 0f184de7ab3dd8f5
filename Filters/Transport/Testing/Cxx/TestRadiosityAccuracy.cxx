// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What vtkRadiosity says of its own errors where links are a matrix or between clusters, against a
// finer matrix.
#include "AccuracyTesting.h"

#include "vtkSMPTools.h"

using namespace LightTransportTesting;

namespace
{
constexpr int Hierarchical = vtkRadiosity::LINK_METHOD_HIERARCHICAL;

/// A method and its tolerance.
struct Links
{
  int Method;
  double Tolerance;
};

//------------------------------------------------------------------------------
Settings Ask(const Links& links)
{
  return [links](vtkRadiosity* filter)
  {
    links.Method == Dense ? filter->SetViewFactorTolerance(links.Tolerance)
                          : filter->SetLinkTolerance(links.Tolerance);
    filter->ComputeErrorsOn();
  };
}

//------------------------------------------------------------------------------
Vector Solve(vtkPolyData* scene)
{
  return Solved(scene, Dense, Ask({ Dense, 1e-4 })).Get("Radiosity");
}

//------------------------------------------------------------------------------
/// A lamp, patches that all send, and the sky; closed and open; what is said is true within a
/// factor of two, and of the patches most are within one and nearly all within two of their errors.
void TestTruth()
{
  double one = 0.0, two = 0.0, patches = 0.0;
  for (const bool open : { false, true })
  {
    for (const bool even : { false, true })
    {
      auto scene = MakeScene(0.7, open);
      vtkDataArray* emission = scene->GetCellData()->GetArray("Emission");
      for (vtkIdType patch = 0; even && patch < scene->GetNumberOfCells(); ++patch)
      {
        emission->SetComponent(patch, 0, 0.2 + 0.8 * (patch % 7) / 6.0);
      }
      const Vector right = Solve(scene);
      for (const Links& links :
        { Links{ Dense, 1e-2 }, Links{ Hierarchical, 3e-2 }, Links{ Hierarchical, 1e-2 } })
      {
        const Solved run(scene, links.Method, Ask(links));
        const Vector found = run.Get("Radiosity");
        const double error = Compare(scene, found, right);
        const double told = run.GetNumber("AccuracyReached");
        // Less than this neither the reference tells, nor single precision.
        const bool isNone = error < 1e-5 && told < 1e-5;
        Check(isNone || (error < 2.0 * told && error > 0.5 * told),
          std::string(open ? "open, " : "closed, ") + (even ? "even, " : "lamp, ") +
            (links.Method == Dense ? "matrix " : "clusters ") + std::to_string(links.Tolerance) +
            ": said " + std::to_string(told) + ", is " + std::to_string(error));
        const Vector errors = run.Get("RadiosityError");
        one += static_cast<double>(((found - right).cwiseAbs().array() <= errors.array()).count());
        two +=
          static_cast<double>(((found - right).cwiseAbs().array() <= 2.0 * errors.array()).count());
        patches += static_cast<double>(errors.size());
        Check(run.Get("IrradianceError").size() == errors.size() &&
            run.Get("NetFluxError").size() == errors.size(),
          "errors of each patch");
      }
    }
  }
  Check(one > 0.55 * patches && one < 0.85 * patches,
    "within one: " + std::to_string(one / patches));
  Check(two > 0.88 * patches, "within two: " + std::to_string(two / patches));
}

//------------------------------------------------------------------------------
/// An unfinished solution is told as such.
void TestSolver()
{
  auto scene = MakeScene(0.9);
  const Vector right = Solve(scene);
  const Solved run(scene, Dense,
    [](vtkRadiosity* filter)
    {
      filter->SetSolverToJacobi();
      filter->SetMaximumNumberOfIterations(6);
    });
  // Relative to what has been found so far, as it is told.
  const double error = Compare(scene, right, run.Get("Radiosity"));
  const double told = run.GetNumber("AccuracyReached");
  Check(error > 1e-2, "far from the end: " + std::to_string(error));
  Check(error < 1.1 * told && error > 0.9 * told,
    "six iterations: said " + std::to_string(told) + ", is " + std::to_string(error));
}

//------------------------------------------------------------------------------
/// The same bits with any number of threads.
void TestThreads()
{
  auto scene = MakeScene(0.7);
  for (const Links& links : { Links{ Dense, 1e-2 }, Links{ Hierarchical, 3e-2 } })
  {
    std::vector<Vector> errors;
    for (const int threads : { 1, 3 })
    {
      vtkSMPTools::LocalScope(vtkSMPTools::Config(threads, "STDThread", false),
        [&]() { errors.push_back(Solved(scene, links.Method, Ask(links)).Get("RadiosityError")); });
    }
    Check(errors[0] == errors[1], "the same bits with any number of threads");
  }
}

//------------------------------------------------------------------------------
/// What is exact, next to nothing, or nothing at all.
void TestExtremes()
{
  auto even = MakeRoom(4);
  AddArray(even, "Reflectance", { 0.5 });
  AddArray(even, "Emission", { 1.0 });
  const Solved furnace(even, Dense, Ask({ Dense, 1e-2 }));
  Check(furnace.GetNumber("AccuracyReached") < 1e-5, "even light in a convex room");

  AddArray(even, "Emission", { 0.0 });
  const Solved none(even, Dense, Ask({ Dense, 1e-2 }));
  Check(none.GetNumber("AccuracyReached") == 0.0, "no light: " + none.Messages);

  auto black = MakeScene(0.0);
  const Solved dark(black, Hierarchical, Ask({ Hierarchical, 3e-2 }));
  const Vector right = Solved(black, Dense, Ask({ Dense, 1e-4 })).Get("Irradiance");
  const Vector areas = ToVector(GetAreas(black));
  const double error = std::sqrt(
    areas.dot((dark.Get("Irradiance") - right).cwiseAbs2()) / areas.dot(right.cwiseAbs2()));
  const double told = dark.GetNumber("AccuracyReached");
  Check(error < 2.0 * told && error > 0.5 * told,
    "of H: said " + std::to_string(told) + ", is " + std::to_string(error));

  Surface one;
  one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  auto single = one.Get();
  AddArray(single, "Reflectance", { 0.5 });
  AddArray(single, "Emission", { 1.0 });
  const Solved alone(single, Dense, Ask({ Dense, 1e-2 }));
  Check(alone.Get("RadiosityError")[0] == 0.0, "one patch: " + alone.Messages);
}

//------------------------------------------------------------------------------
/// Links that are given, of several bands, with a sky: one error for each band, the worst in all.
void TestBands()
{
  auto scene = MakeScene(0.6, true);
  const vtkIdType patches = scene->GetNumberOfCells();
  AddArray(scene, "Emission", { 0.0, 0.0 })->SetComponent(3, 1, 1.0);
  AddArray(scene, "Reflectance", { 0.6, 0.2 });
  vtkNew<vtkViewFactors> factors;
  factors->SetTolerance(1e-2);
  const auto sky = [&](vtkRadiosity* filter)
  {
    filter->SetBackgroundRadiance(1.0);
    filter->AddBackgroundRadiance(0.0);
    filter->SetViewFactors(factors);
    filter->ComputeErrorsOn();
  };
  const Solved run(scene, vtkRadiosity::LINK_METHOD_AUTO,
    [&](vtkRadiosity* filter)
    {
      filter->SetViewFactorTolerance(0.0);
      sky(filter);
    });
  const Vector errors = run.Get("RadiosityError");
  Check(errors.size() == 2 * patches && errors.minCoeff() >= 0.0 && errors.maxCoeff() > 0.0,
    "errors of two bands: " + run.Messages);
  Check(run.GetNumber("AccuracyReached") > 0.0, "and of all");
}
} // namespace

//------------------------------------------------------------------------------
int TestRadiosityAccuracy(int, char*[])
{
  TestTruth();
  TestSolver();
  TestThreads();
  TestExtremes();
  TestBands();
  return Result();
}
