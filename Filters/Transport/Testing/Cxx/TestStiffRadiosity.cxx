// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Reflectances next to 1 in closed rooms, and plates with next to nothing between them: solved, or
// refused with the place and the remedy.
#include "RadiosityTesting.h"

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
// A room with a box that floats in it.
vtkSmartPointer<vtkPolyData> MakeFurnishedRoom()
{
  Surface room;
  AddBox(room, { 0, 0, 0 }, { 3, 3, 3 }, 1.0, true);
  AddBox(room, { 1.1, 0.9, 0.8 }, { 2.1, 1.8, 1.6 }, 0.6, false);
  return room.Get();
}

//------------------------------------------------------------------------------
// E = 1 - rho gives B = 1; one emitter agrees with an LU decomposition of the same view factors.
void TestClosed(vtkPolyData* data, double viewFactorTolerance, const std::string& name)
{
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(data);
  factors->SetTolerance(viewFactorTolerance);
  factors->EnforceClosureOn();
  factors->Update();
  for (const double rho : { 0.999, 0.999999 })
  {
    const std::string what = name + " at " + std::to_string(rho);
    AddArray(data, "Reflectance", { rho });
    AddArray(data, "Emission", { 1.0 - rho });
    for (const int solver : { vtkRadiosity::SOLVER_AUTO, vtkRadiosity::SOLVER_SOUTHWELL,
           vtkRadiosity::SOLVER_CONJUGATE_GRADIENT })
    {
      Run furnace(data, factors, solver, 1e-7);
      Check(furnace.Messages.empty(), what + ": furnace, " + furnace.Messages);
      CheckClose((furnace.Radiosity.array() - 1.0).abs().maxCoeff(), 0.0, 1e-6, what + ": furnace");
    }
    AddArray(data, "Emission", { 0.0 })->SetValue(3, 1.0);
    Run lamp(data, factors, vtkRadiosity::SOLVER_AUTO, 1e-8);
    const Vector exact = SolveExactly(data, factors);
    Check(lamp.Messages.empty() && lamp.Status == "Converged", what + ": lamp, " + lamp.Messages);
    CheckClose((lamp.Radiosity - exact).lpNorm<Eigen::Infinity>() / exact.maxCoeff(), 0.0, 1e-7,
      what + ": one patch emits");
    // All that is emitted is absorbed.
    const Vector areas = ToVector(GetAreas(data));
    CheckClose((1.0 - rho) * areas.dot(lamp.Irradiance), areas[3], 1e-7, what + ": energy");
  }
}

//------------------------------------------------------------------------------
// Without closure the errors of view factors decide what is in a room that keeps 0.999999 of its
// light: refused where they leave nothing, else a warning tells how much.
void TestDiagnosis()
{
  auto room = MakeFurnishedRoom();
  AddArray(room, "Reflectance", { 0.999999 });
  AddArray(room, "Emission", { 1e-6 });
  const Run refused(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-4);
  for (const char* part : { "no unique solution", "polygon ", "0.999999", "EnforceClosure" })
  {
    Check(refused.Messages.find(part) != std::string::npos,
      std::string("\"") + part + "\" in \"" + refused.Messages + "\"");
  }
  Check(refused.Radiosity.size() == 0, "no output");

  auto cube = MakeRoom(4);
  AddArray(cube, "Reflectance", { 0.999999 });
  AddArray(cube, "Emission", { 1e-6 });
  auto factors = MakeFactors(cube, 1e-4);
  const Run doubtful(cube, factors, vtkRadiosity::SOLVER_AUTO, 1e-4);
  const std::size_t place = doubtful.Messages.find("B may be wrong by ");
  const double percent =
    place == std::string::npos ? 0.0 : std::atof(doubtful.Messages.c_str() + place + 18);
  Check(percent >= 10.0 && percent < 100.0 && doubtful.Radiosity.size() == 96,
    "view factors that are hardly good enough: " + doubtful.Messages);
  const double error = (doubtful.Radiosity.array() - 1.0).abs().maxCoeff();
  Check(error > 1e-6 && error < percent / 100.0, "as wrong as announced: " + std::to_string(error));
}

//------------------------------------------------------------------------------
// Two unit plates, one of which emits. Where the gap is small beside a patch those in the middle
// are as between infinite plates: B = 1 / (1 - rho^2) and rho / (1 - rho^2).
void TestPlates(double gap, double rho)
{
  const std::string what =
    "plates with a gap of " + std::to_string(gap * 1e6) + "e-6 at " + std::to_string(rho);
  constexpr int n = 8;
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  plates.AddGrid({ 0, 0, gap }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  auto data = plates.Get();
  AddArray(data, "Reflectance", { rho });
  vtkDoubleArray* emission = AddArray(data, "Emission", { 0.0 });
  for (vtkIdType cell = 0; cell < n * n; ++cell)
  {
    emission->SetValue(cell, 1.0);
  }
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(data);
  factors->SetTolerance(1e-9);
  const Run run(data, factors, vtkRadiosity::SOLVER_CONJUGATE_GRADIENT, 1e-9);
  Check(run.Messages.empty() && run.Status == "Converged", what + ": " + run.Messages);
  const Vector exact = SolveExactly(data, factors);
  CheckClose((run.Radiosity - exact).lpNorm<Eigen::Infinity>() / exact.maxCoeff(), 0.0, 1e-9, what);
  Check(run.Iterations <= 45, what + ": iterations " + std::to_string(run.Iterations));
  // What is lost at the rims reaches the middle where light is reflected often enough.
  const double reach = gap * n / (1.0 - rho);
  if (reach < 0.05)
  {
    const vtkIdType middle = n / 2 * n + n / 2;
    CheckClose(run.Radiosity[middle], 1.0 / (1.0 - rho * rho), reach, what + ": emitting side");
    CheckClose(run.Radiosity[n * n + middle], rho / (1.0 - rho * rho), reach,
      what + ": other side");
  }
}

//------------------------------------------------------------------------------
// Iterations of conjugate gradients until the residual is 1e-6 of the emission.
void TestIterations()
{
  auto cube = MakeRoom(8);
  AddArray(cube, "Reflectance", { 0.999 });
  vtkDoubleArray* emission = AddArray(cube, "Emission", { 0.0 });
  for (vtkIdType cell = 0; cell < 64; ++cell)
  {
    emission->SetValue(cell, 1.0);
  }
  const Run closed(cube, nullptr, vtkRadiosity::SOLVER_CONJUGATE_GRADIENT, 1e-8, true);
  Check(closed.CountIterations(1e-6) <= 15, "closed cube at 0.999");
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 14, 14);
  surface.AddGrid({ 0, 0, 0.02 }, { 0, 1, 0 }, { 1, 0, 0 }, 14, 14);
  auto plates = surface.Get();
  AddArray(plates, "Reflectance", { 0.999 });
  emission = AddArray(plates, "Emission", { 0.0 });
  for (vtkIdType cell = 0; cell < 196; ++cell)
  {
    emission->SetValue(cell, 1.0);
  }
  const Run open(plates, nullptr, vtkRadiosity::SOLVER_CONJUGATE_GRADIENT, 1e-8);
  Check(open.CountIterations(1e-6) <= 45, "plates with a gap of 0.02 at 0.999");
}

//------------------------------------------------------------------------------
// Links between clusters whose rows are closed keep the light as well as a matrix does.
void TestHierarchical()
{
  auto room = MakeRoom(8);
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(room);
  factors->HierarchicalOn();
  factors->EnforceClosureOn();
  factors->Update();
  for (const double rho : { 0.999, 0.999999 })
  {
    AddArray(room, "Reflectance", { rho });
    for (const int solver : { vtkRadiosity::SOLVER_SOUTHWELL, vtkRadiosity::SOLVER_CHEBYSHEV,
           vtkRadiosity::SOLVER_CONJUGATE_GRADIENT })
    {
      if (rho > 0.9999 && solver == vtkRadiosity::SOLVER_CHEBYSHEV)
      {
        continue;
      }
      const std::string what =
        "links between clusters at " + std::to_string(rho) + ", solver " + std::to_string(solver);
      AddArray(room, "Emission", { 1.0 - rho });
      const Run furnace(room, factors, solver, 1e-7);
      Check(furnace.Messages.empty() && furnace.Status == "Converged", what + furnace.Messages);
      CheckClose((furnace.Radiosity.array() - 1.0).abs().maxCoeff(), 0.0, 1e-6, what + ": furnace");
      AddArray(room, "Emission", { 0.0 })->SetValue(3, 1.0);
      const Run lamp(room, factors, solver, 1e-8);
      const Vector exact = SolveExactly(room, factors);
      CheckClose((lamp.Radiosity - exact).lpNorm<Eigen::Infinity>() / exact.maxCoeff(), 0.0, 1e-7,
        what + ": one patch emits");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestStiffRadiosity(int, char*[])
{
  TestClosed(MakeRoom(4), 1e-6, "cube");
  TestClosed(MakeFurnishedRoom(), 1e-4, "furnished room");
  TestDiagnosis();
  for (const double gap : { 1e-2, 1e-4, 1e-6 })
  {
    for (const double rho : { 0.9, 0.999 })
    {
      TestPlates(gap, rho);
    }
  }
  TestIterations();
  TestHierarchical();
  return Result();
}
