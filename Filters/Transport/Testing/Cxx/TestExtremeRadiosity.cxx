// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes at the edge of what makes sense: extreme emissions, reflectances and areas, patches that
// cross or coincide, a room with a crack, hardly any patches.
#include "RadiosityTesting.h"

using namespace LightTransportTesting;

namespace
{
//------------------------------------------------------------------------------
void AddMaterial(vtkPolyData* data, double reflectance, double emission)
{
  AddArray(data, "Reflectance", { reflectance });
  AddArray(data, "Emission", { emission });
}

//------------------------------------------------------------------------------
void SetMaterial(vtkPolyData* data, vtkIdType cell, double reflectance, double emission)
{
  data->GetCellData()->GetArray("Reflectance")->SetComponent(cell, 0, reflectance);
  data->GetCellData()->GetArray("Emission")->SetComponent(cell, 0, emission);
}

//------------------------------------------------------------------------------
double CompareExactly(const Run& run, vtkPolyData* data, vtkViewFactors* factors)
{
  return (run.Radiosity - SolveExactly(data, factors)).lpNorm<Eigen::Infinity>();
}

//------------------------------------------------------------------------------
// Emissions of 1 and 1e12 in one room: the tolerance is that of the largest B, and everything is
// within the error bound. Where the dim part does not see the bright one it has its own digits.
void TestEmissions()
{
  auto room = MakeRoom(3);
  AddMaterial(room, 0.7, 0.0);
  SetMaterial(room, 7, 0.7, 1e12);
  SetMaterial(room, 20, 0.7, 1.0);
  auto factors = MakeFactors(room, 1e-8);
  for (const int solver : GetSolvers())
  {
    const Run run(room, factors, solver, 1e-8);
    const double error = CompareExactly(run, room, factors);
    Check(run.Messages.empty() && error <= run.ErrorBound &&
        run.ErrorBound <= 1e-8 * run.Radiosity.maxCoeff() * (1.0 + 1e-8),
      "emissions of 1 and 1e12 in one room, solver " + std::to_string(solver));
  }

  Surface pairs;
  for (const double z : { 0.0, 5.0 })
  {
    pairs.AddGrid({ 0, 0, z }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
    pairs.AddGrid({ 0, 0, z + 0.5 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  }
  auto data = pairs.Get();
  AddMaterial(data, 0.9, 0.0);
  SetMaterial(data, 0, 0.9, 1e12);
  SetMaterial(data, 8, 0.9, 1.0);
  factors = MakeFactors(data, 1e-8);
  const Run run(data, factors, vtkRadiosity::SOLVER_AUTO, 1e-13);
  const Vector exact = SolveExactly(data, factors);
  for (vtkIdType cell = 0; cell < 16; ++cell)
  {
    CheckClose(run.Radiosity[cell], exact[cell], 1e-6, "a dim pair of plates beside a bright one");
  }
}

//------------------------------------------------------------------------------
// Nothing is reflected: B = E, to the last bit.
void TestBlack()
{
  auto room = MakeRoom(2);
  AddMaterial(room, 0.0, 0.0);
  for (vtkIdType cell = 0; cell < 24; ++cell)
  {
    SetMaterial(room, cell, 0.0, 1.0 / (1.0 + static_cast<double>(cell)));
  }
  for (const int solver : GetSolvers())
  {
    const Run run(room, nullptr, solver, 1e-12);
    const std::string what = "a black room, solver " + std::to_string(solver);
    Check(run.Status == "Converged" && run.Iterations == 0, what);
    Check(solver != vtkRadiosity::SOLVER_AUTO || run.Explanation.find("Jacobi: ") == 0,
      what + " explains: " + run.Explanation);
    for (vtkIdType cell = 0; cell < 24; ++cell)
    {
      CheckClose(run.Radiosity[cell], 1.0 / (1.0 + static_cast<double>(cell)), 0.0, what);
    }
  }
}

//------------------------------------------------------------------------------
// Everything is reflected: solved where light can leave, refused where it cannot.
void TestMirrors()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 4, 4);
  plates.AddGrid({ 0, 0, 0.1 }, { 0, 1, 0 }, { 1, 0, 0 }, 4, 4);
  auto data = plates.Get();
  AddMaterial(data, 1.0, 0.0);
  SetMaterial(data, 5, 1.0, 1.0);
  auto factors = MakeFactors(data, 1e-8);
  for (const int solver : GetSolvers())
  {
    const Run run(data, factors, solver, 1e-9);
    const std::string what = "plates that reflect everything, solver " + std::to_string(solver);
    Check(run.Messages.empty() && run.Status == "Converged", what + ": " + run.Messages);
    Check(CompareExactly(run, data, factors) <= run.ErrorBound, what);
    // What is emitted leaves: all net flux is that of the lamp.
    for (vtkIdType cell = 0; cell < 32; ++cell)
    {
      CheckClose(run.NetFlux[cell], cell == 5 ? 1.0 : 0.0, 1e-12, what + ": net flux");
    }
  }
  for (const bool closed : { false, true })
  {
    auto room = MakeRoom(2);
    AddMaterial(room, 1.0, 1.0);
    const Run run(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-4, closed);
    Check(run.Messages.find("no unique solution: polygon ") != std::string::npos &&
        run.Messages.find("what is emitted there never leaves") != std::string::npos &&
        run.Radiosity.size() == 0,
      "a closed room that reflects everything is refused: " + run.Messages);
    // One patch that absorbs is enough.
    SetMaterial(room, 11, 0.0, 0.0);
    AddArray(room, "Emission", { 0.0 })->SetValue(11, 3.0);
    const Run solved(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-8, closed);
    CheckClose((solved.Radiosity.array() / 3.0 - 1.0).abs().maxCoeff(), 0.0, 1e-5,
      "a lamp among mirrors: " + solved.Messages);
  }
}

//------------------------------------------------------------------------------
// A room whose floor is cut ever finer towards a corner: areas from 0.8 to 1e-8.
void TestAreas()
{
  Surface surface;
  const std::vector<double> cuts = { 0.0, 1e-4, 1e-3, 1e-2, 0.1, 1.0 };
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
  {
    for (std::size_t j = 0; j + 1 < cuts.size(); ++j)
    {
      const double x = cuts[i], y = cuts[j];
      surface.AddGrid({ x, y, 0 }, { cuts[i + 1] - x, 0, 0 }, { 0, cuts[j + 1] - y, 0 }, 1, 1);
    }
  }
  surface.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  surface.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 2, 2);
  surface.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 2);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2);
  surface.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 2, 2);
  auto room = surface.Get();
  AddMaterial(room, 0.9, 0.1);
  auto factors = MakeFactors(room, 1e-6);
  for (const int solver : GetSolvers())
  {
    AddArray(room, "Emission", { 0.1 });
    const std::string what = "areas over 8 decades, solver " + std::to_string(solver);
    const Run furnace(room, factors, solver, 1e-8);
    Check(furnace.Status == "Converged", what);
    CheckClose((furnace.Radiosity.array() - 1.0).abs().maxCoeff(), 0.0, 1e-5, what + ": furnace");
    AddArray(room, "Emission", { 0.0 })->SetValue(0, 1.0);
    const Run lamp(room, factors, solver, 1e-8);
    Check(CompareExactly(lamp, room, factors) <= lamp.ErrorBound, what + ": the smallest emits");
  }
}

//------------------------------------------------------------------------------
// Two plates that cross in a room, seen from both sides: no row is above 1, and what is emitted is
// absorbed.
void TestCrossing()
{
  Surface surface;
  AddBox(surface, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, true);
  const Point plates[2][3] = { { { 0.2, 0.5, 0.2 }, { 0.6, 0, 0 }, { 0, 0, 0.6 } },
    { { 0.5, 0.2, 0.3 }, { 0, 0.6, 0 }, { 0.1, 0, 0.4 } } };
  for (const auto& plate : plates)
  {
    surface.AddGrid(plate[0], plate[1], plate[2], 1, 1);
    surface.AddGrid(plate[0], plate[2], plate[1], 1, 1);
  }
  auto room = surface.Get();
  AddMaterial(room, 0.8, 0.0);
  SetMaterial(room, 0, 0.8, 1.0);
  auto factors = MakeFactors(room, 1e-3);
  const std::vector<double> sums = GetCellValues(factors, "ViewFactorSum");
  const std::vector<double> errors = GetCellValues(factors, "ViewFactorError");
  for (std::size_t cell = 0; cell < sums.size(); ++cell)
  {
    Check(sums[cell] <= 1.0 + 2.0 * errors[cell] && sums[cell] >= 1.0 - 2.0 * errors[cell],
      "patches that cross: row " + std::to_string(cell) + " sums to " + std::to_string(sums[cell]));
  }
  const Run run(room, factors, vtkRadiosity::SOLVER_AUTO, 1e-8);
  Check(run.Messages.empty() && run.Status == "Converged", "patches that cross: " + run.Messages);
  const Vector areas = ToVector(GetAreas(room));
  CheckClose(0.2 * areas.dot(run.Irradiance), areas[0], 1e-2, "patches that cross: energy");
}

//------------------------------------------------------------------------------
// The floor is there twice: what lies on it exchanges nothing, and a warning says so.
void TestDuplicates()
{
  auto room = MakeRoom(2);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < 4; ++cell)
  {
    room->GetCellPoints(cell, corners);
    room->GetPolys()->InsertNextCell(corners);
  }
  room->DeleteCells();
  AddMaterial(room, 0.5, 0.5);
  const Run solved(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-8);
  Check(solved.Status == "Converged" &&
      solved.Messages.find("others of lower numbers that face the same way") != std::string::npos,
    "a floor that is there twice: " + solved.Messages);
  CheckClose((solved.Radiosity.head(24).array() - 1.0).abs().maxCoeff(), 0.0, 1e-6, "the room");
  CheckClose(solved.Radiosity.tail(4).cwiseAbs().maxCoeff(), 0.0, 0.0, "the second floor");
}

//------------------------------------------------------------------------------
// A rug that comes before the floor on which it lies covers it in part: solved with a warning that
// names a polygon while less than everything returns, refused beyond.
void TestOverlap()
{
  Surface surface;
  surface.AddGrid({ 0.05, 0.05, 0 }, { 0.9, 0, 0 }, { 0, 0.9, 0 }, 1, 1);
  AddBox(surface, { 0, 0, 0 }, { 1, 1, 1 }, 0.5, true);
  auto room = surface.Get();
  AddMaterial(room, 0.5, 0.5);
  const Run solved(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-8);
  Check(solved.Status == "Converged" &&
      solved.Messages.find("patches that it sees overlap or lie on each other") !=
        std::string::npos &&
      solved.Messages.find("What leaves polygon ") != std::string::npos,
    "a rug: " + solved.Messages);
  AddArray(room, "Reflectance", { 0.95 });
  const Run refused(room, nullptr, vtkRadiosity::SOLVER_AUTO, 1e-8);
  Check(refused.Messages.find("no unique solution: polygon ") != std::string::npos &&
      refused.Messages.find("Remove patches that overlap") != std::string::npos &&
      refused.Radiosity.size() == 0,
    "a rug, and a room that reflects more than all: " + refused.Messages);
}

//------------------------------------------------------------------------------
// A room with a crack of a millionth of its size along one edge of the ceiling: as good as closed.
// What is emitted is absorbed or leaves through the crack, all of it from a room of mirrors.
void TestCrack()
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  surface.AddGrid({ 1e-6, 0, 1 }, { 0, 1, 0 }, { 1.0 - 1e-6, 0, 0 }, 2, 2);
  surface.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 2, 2);
  surface.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 2);
  surface.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 2, 2);
  surface.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 2, 2);
  auto room = surface.Get();
  AddMaterial(room, 0.9, 0.1);
  auto factors = MakeFactors(room, 1e-8);
  const Vector areas = ToVector(GetAreas(room));
  const Run furnace(room, factors, vtkRadiosity::SOLVER_AUTO, 1e-10);
  Check(furnace.Messages.empty() && furnace.Status == "Converged",
    "a room with a crack: " + furnace.Messages);
  CheckClose((furnace.Radiosity.array() - 1.0).abs().maxCoeff(), 0.0, 2e-5, "a room with a crack");
  CheckClose(areas.dot(furnace.NetFlux), 0.0, 5e-6, "a room with a crack: what leaves");
  const Vector exact = SolveExactly(room, factors);
  CheckClose((furnace.Radiosity - exact).lpNorm<Eigen::Infinity>(), 0.0, 1e-10,
    "a room with a crack: LU");

  // The row sums, known to 6e-8, tell only roughly what leaves through a crack of 1e-6.
  AddArray(room, "Reflectance", { 1.0 });
  const Run mirrors(room, factors, vtkRadiosity::SOLVER_AUTO, 1e-2);
  Check(mirrors.Status == "Converged" &&
      mirrors.Messages.find("B may be wrong by ") != std::string::npos,
    "mirrors and a crack: " + mirrors.Messages);
  CheckClose(areas.dot(mirrors.NetFlux), 0.1 * areas.sum(), 1e-6,
    "mirrors and a crack: all leaves");
}

//------------------------------------------------------------------------------
// One patch sees nothing; two squares that face each other at a distance of their size have the
// view factor 0.19982489569838746.
void TestFewPatches()
{
  Surface one;
  one.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  auto patch = one.Get();
  AddMaterial(patch, 0.7, 2.0);
  Surface two;
  two.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  two.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  auto pair = two.Get();
  AddMaterial(pair, 0.7, 0.0);
  SetMaterial(pair, 0, 0.7, 2.0);
  const double f = 0.7 * 0.19982489569838746;
  for (const int solver : GetSolvers())
  {
    const Run alone(patch, nullptr, solver, 1e-10);
    Check(alone.Status == "Converged" && alone.Messages.empty(), "one patch converges");
    CheckClose(alone.Radiosity[0], 2.0, 0.0, "one patch");
    CheckClose(alone.NetFlux[0], 2.0, 0.0, "one patch sends all that it emits");
    const Run both(pair, nullptr, solver, 1e-10);
    CheckClose(both.Radiosity[0], 2.0 / (1.0 - f * f), 1e-7, "two patches, the one that emits");
    CheckClose(both.Radiosity[1], 2.0 * f / (1.0 - f * f), 1e-7, "two patches, the other");
  }
  const Run none(vtkSmartPointer<vtkPolyData>::New(), nullptr, vtkRadiosity::SOLVER_AUTO, 1e-4);
  Check(none.Messages.find("no polygons") != std::string::npos, "no patches: " + none.Messages);
}
} // namespace

//------------------------------------------------------------------------------
int TestExtremeRadiosity(int, char*[])
{
  TestEmissions();
  TestBlack();
  TestMirrors();
  TestAreas();
  TestCrossing();
  TestDuplicates();
  TestOverlap();
  TestCrack();
  TestFewPatches();
  return Result();
}
