// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What patches see of the sky and of back faces, against closed forms: plates (Howell, A Catalog of
// Radiation Heat Transfer Configuration Factors, C-11 and C-14), a cube without a lid, a canyon, a
// roof seen from behind. Dense and by clusters, in both precisions, closed and as computed.
#include "Geometry/SceneRayCaster.h"
#include "Links/Links.h"
#include "OutcomeTesting.h"
#include "RanksInThreads.h"
#include "Scene/PatchScene.h"
#include "ViewFactorTesting.h"
#include "ViewFactors/Openings.h"
#include "ViewFactors/PatchOutlook.h"
#include "ViewFactors/ViewFactorStore.h"
#include "vtkRadiosity.h"

#include <algorithm>
#include <numeric>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
// Unit squares, opposite at distance 1 and with an edge in common.
constexpr double Opposite = 0.199824895698387;
constexpr double Beside = 0.200043776075403;
// Bits of the coordinates.
constexpr int Single = 32;
constexpr int Double = 64;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> WithPrecision(vtkPolyData* data, int bits)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  vtkNew<vtkPoints> points;
  points->SetDataType(bits == Single ? VTK_FLOAT : VTK_DOUBLE);
  points->DeepCopy(data->GetPoints());
  copy->SetPoints(points);
  return copy;
}

//------------------------------------------------------------------------------
struct Shares
{
  std::vector<double> Areas, Sums, Errors, Sky, Back;
  vtkSmartPointer<vtkViewFactors> Factors;

  Shares(vtkPolyData* data, double tolerance, bool hierarchical = false, bool closed = false)
    : Areas(GetAreas(data)), Factors(vtkSmartPointer<vtkViewFactors>::New())
  {
    this->Factors->SetInputData(data);
    this->Factors->SetTolerance(tolerance);
    this->Factors->SetLinkTolerance(tolerance);
    this->Factors->SetHierarchical(hierarchical);
    this->Factors->SetEnforceClosure(closed);
    this->Factors->Update();
    this->Sums = GetCellValues(this->Factors, "ViewFactorSum");
    this->Errors = GetCellValues(this->Factors, "ViewFactorError");
    this->Sky = GetCellValues(this->Factors, "SkyFraction");
    this->Back = GetCellValues(this->Factors, "BackFaceFraction");
  }

  std::size_t GetNumberOfRows() const { return this->Sums.size(); }

  double GetApplied(std::size_t row) const
  {
    double sum = 0.0;
    for (std::size_t j = 0; j < this->GetNumberOfRows(); ++j)
    {
      sum += this->Factors->GetViewFactor(static_cast<vtkIdType>(row), static_cast<vtkIdType>(j));
    }
    return sum;
  }

  double GetMean(const std::vector<double>& values, const Group& rows) const
  {
    double sum = 0.0, area = 0.0;
    for (vtkIdType row = rows.Begin; row < rows.End; ++row)
    {
      sum += this->Areas[row] * values[row];
      area += this->Areas[row];
    }
    return sum / area;
  }
};

//------------------------------------------------------------------------------
/// All rows make 1: as far as ViewFactorError says where they are as computed, to rounding where
/// they are closed.
void CheckWhole(const Shares& result, bool closed, const std::string& what)
{
  double worst = 0.0, least = 0.0;
  for (std::size_t row = 0; row < result.GetNumberOfRows(); ++row)
  {
    const double sum =
      (closed ? result.GetApplied(row) : result.Sums[row]) + result.Sky[row] + result.Back[row];
    worst = std::max(worst, std::abs(1.0 - sum) - (closed ? 1e-6 : result.Errors[row]));
    least = std::min({ least, result.Sky[row], result.Back[row] });
  }
  Check(worst <= 1e-15, what + ": rows make 1, but for " + std::to_string(worst));
  Check(least >= 0.0, what + ": no share is negative");
}

//------------------------------------------------------------------------------
/// A group's mean sky and back faces, with exact values.
void CheckShares(const Shares& result, const Group& rows, double sky, double back, double error,
  const std::string& what)
{
  CheckClose(result.GetMean(result.Sky, rows) - sky, 0.0, error, what + ": sky");
  CheckClose(result.GetMean(result.Back, rows) - back, 0.0, error, what + ": back faces");
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakePlates(int n)
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  plates.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, n, n);
  return plates.Get();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeCubeWithoutLid(int n)
{
  Surface cube;
  cube.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  cube.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, n, n);
  cube.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, n, n);
  cube.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, n, n);
  cube.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, n, n);
  return cube.Get();
}

//------------------------------------------------------------------------------
// Over a floor a one-sided roof that faces up: the floor sees its back.
vtkSmartPointer<vtkPolyData> MakeRoof(int n)
{
  Surface surface;
  surface.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  surface.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, n, n);
  return surface.Get();
}

//------------------------------------------------------------------------------
// A trench of width and depth 1, longer by far than wide: crossed strings.
vtkSmartPointer<vtkPolyData> MakeTrench(int n)
{
  Surface trench;
  const double half = 5e3;
  trench.AddGrid({ 0, -half, 0 }, { 1, 0, 0 }, { 0, 2 * half, 0 }, n, 3);
  trench.AddGrid({ 0, -half, 0 }, { 0, 2 * half, 0 }, { 0, 0, 1 }, 3, n);
  trench.AddGrid({ 1, -half, 0 }, { 0, 0, 1 }, { 0, 2 * half, 0 }, n, 3);
  return trench.Get();
}

//------------------------------------------------------------------------------
void TestShares(int bits, bool hierarchical, double tolerance)
{
  const std::string kind = std::string(hierarchical ? "clusters" : "dense") + ", " +
    std::to_string(bits) + " bits, " + std::to_string(tolerance) + ", ";
  const bool closed = hierarchical;
  // Means over many patches are more exact than each of them.
  const double error = hierarchical ? tolerance : 0.5 * tolerance;
  const auto compute = [&](vtkPolyData* data)
  { return Shares(WithPrecision(data, bits), tolerance, hierarchical); };

  const Shares plates = compute(MakePlates(4));
  CheckWhole(plates, closed, kind + "plates");
  CheckShares(plates, { 0, 32 }, 1.0 - Opposite, 0.0, error, kind + "plates");

  const Shares cube = compute(MakeCubeWithoutLid(4));
  CheckWhole(cube, closed, kind + "cube");
  CheckShares(cube, { 0, 16 }, Opposite, 0.0, error, kind + "floor of the cube");
  CheckShares(cube, { 16, 80 }, Beside, 0.0, error, kind + "walls of the cube");

  const Shares roof = compute(MakeRoof(4));
  CheckWhole(roof, closed, kind + "roof");
  CheckShares(roof, { 0, 16 }, 1.0 - Opposite, Opposite, error, kind + "floor under the roof");
  CheckShares(roof, { 16, 32 }, 1.0, 0.0, 1e-12, kind + "on the roof");

  const Shares trench = compute(MakeTrench(6));
  CheckWhole(trench, closed, kind + "trench");
  CheckShares(trench, { 0, 18 }, std::sqrt(2.0) - 1.0, 0.0, error + 1e-3, kind + "trench, floor");
  CheckShares(trench, { 18, 54 }, 1.0 - std::sqrt(0.5), 0.0, error + 1e-3, kind + "trench, walls");
}

//------------------------------------------------------------------------------
// A patch alone, and the floor of a box whose fronts are outside.
void TestExtremes()
{
  for (const int bits : { Single, Double })
  {
    for (const bool hierarchical : { false, true })
    {
      Surface one;
      one.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0.3, 0.7, 0 } });
      const Shares alone(WithPrecision(one.Get(), bits), 1e-3, hierarchical);
      Check(alone.Sky[0] == 1.0 && alone.Back[0] == 0.0 && alone.Sums[0] == 0.0, "one patch alone");

      Surface inverse;
      inverse.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
      AddBox(inverse, { 0, 0, 0 }, { 1, 1, 1 }, 1.0, false);
      const Shares inside(WithPrecision(inverse.Get(), bits), 1e-3, hierarchical);
      for (int row = 0; row < 4; ++row)
      {
        CheckClose(inside.Back[row], 1.0, 1e-12, "nothing but back faces");
        Check(inside.Sky[row] == 0.0, "no sky behind back faces");
      }
    }
  }
}

//------------------------------------------------------------------------------
// Aligned rectangles a x b at distance 1 (C-11).
double GetAligned(double a, double b)
{
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  return 2.0 / (vtkMath::Pi() * a * b) *
    (std::log(p * q / std::sqrt(1.0 + a * a + b * b)) + a * q * std::atan(a / q) +
      b * p * std::atan(b / p) - a * std::atan(a) - b * std::atan(b));
}

//------------------------------------------------------------------------------
// The errors that are told cover those that are made, for the back faces that a hundred floors see
// of roofs over them, in all rows but one; and they are about what was asked for. The pairs stand
// too far apart to see each other.
void TestErrorsOfRows(double tolerance, double largestError)
{
  Surface surface;
  std::vector<double> exact;
  for (int k = 1; k <= 10; ++k)
  {
    for (int l = 1; l <= 10; ++l)
    {
      const double a = 0.37 * k, b = 0.53 * l;
      surface.AddGrid({ 1e3 * k, 1e3 * l, 0 }, { a, 0, 0 }, { 0, b, 0 }, 1, 1);
      surface.AddGrid({ 1e3 * k, 1e3 * l, 1 }, { a, 0, 0 }, { 0, b, 0 }, 1, 1);
      exact.push_back(GetAligned(a, b));
    }
  }
  const Shares result(surface.Get(), tolerance);
  int uncovered = 0;
  double largest = 0.0;
  for (std::size_t pair = 0; pair < exact.size(); ++pair)
  {
    const double error = result.Errors[2 * pair];
    uncovered += std::abs(result.Back[2 * pair] - exact[pair]) > error ? 1 : 0;
    largest = std::max(largest, error);
  }
  Check(uncovered <= 1, std::to_string(uncovered) + " errors are larger than they are said to be");
  Check(largest <= largestError && largest >= 0.1 * tolerance,
    "errors of about what was asked for: " + std::to_string(largest));
}

//------------------------------------------------------------------------------
// Deviations of rays are what the shares differ from the right one, on the average over many sets.
void TestDeviations()
{
  PatchScene scene;
  CheckDone(scene.Build(MakeRoof(12), Ranks()), "scene");
  SceneRayCaster caster;
  CheckDone(caster.Build(scene), "caster");
  // All patches of the floor together see of the roof what one patch does.
  for (const int doublings : { 0, 3, 5 })
  {
    double open = 0.0, sky = 0.0, variance = 0.0;
    int floor = 0;
    for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
    {
      if (scene.GetCentroid(patch).z() > 0.0)
      {
        continue;
      }
      PatchOutlook::Hits hits(scene.GetNumberOfPatches());
      PatchOutlook outlook(scene, caster, patch, hits);
      for (int k = 0; k < doublings; ++k)
      {
        outlook.CastMore();
      }
      Check(outlook.GetNumberOfRays() == PatchOutlook::FirstRays << doublings, "number of rays");
      open += outlook.GetOpen().Value;
      sky += outlook.GetSky().Value;
      variance += std::pow(outlook.GetSky().Deviation, 2);
      ++floor;
    }
    Check(floor == 144 && open == 144.0, "all that a floor sees under a roof is open");
    const double deviation = std::sqrt(variance) / floor;
    const double error = std::abs(sky / floor - (1.0 - Opposite));
    Check(error <= 3.0 * deviation,
      "error of a mean " + std::to_string(error) + ", deviation " + std::to_string(deviation));
  }
}

//------------------------------------------------------------------------------
ViewFactorSettings MakeSettings(bool hierarchical)
{
  return { 1e-2, false, hierarchical ? LinkMethod::Hierarchical : LinkMethod::Dense, 1e-2 };
}

//------------------------------------------------------------------------------
// Who is seen from where: a roof from behind alone, the floor by nobody.
void TestHits()
{
  PatchScene scene;
  CheckDone(scene.Build(MakeRoof(3), Ranks()), "scene");
  for (const bool hierarchical : { false, true })
  {
    ViewFactorStore store;
    CheckDone(store.Update(scene, MakeSettings(hierarchical), {}, Ranks(), Monitor()), "links");
    const Links& links = store.GetLinks();
    const double fronts = std::accumulate(links.FrontHits.begin(), links.FrontHits.end(), 0.0);
    double onRoof = 0.0, onFloor = 0.0;
    for (vtkIdType patch = 0; patch < 18; ++patch)
    {
      (scene.GetCentroid(patch).z() > 0.0 ? onRoof : onFloor) += links.BackHits[patch];
      Check(links.BackHits[patch] == std::floor(links.BackHits[patch]), "whole numbers of rays");
    }
    Check(fronts == 0.0 && onFloor == 0.0 && onRoof > 9 * 10, "a roof is met from behind");
  }
}

//------------------------------------------------------------------------------
// Ranks share the rays; what comes out is the same to the last bit.
void TestRanks(bool hierarchical)
{
  vtkSmartPointer<vtkPolyData> data = MakeRoof(12);
  PatchScene scene;
  CheckDone(scene.Build(data, Ranks()), "scene");
  ViewFactorStore whole;
  CheckDone(whole.Update(scene, MakeSettings(hierarchical), {}, Ranks(), Monitor()), "links");
  std::vector<Links> found(3);
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      const Ranks ranks(controller);
      PatchScene mine;
      vtkNew<vtkPolyData> nothing;
      CheckDone(mine.Build(rank == 0 ? data.Get() : nothing.Get(), ranks), "scene of a rank");
      ViewFactorStore store;
      CheckDone(store.Update(mine, MakeSettings(hierarchical), {}, ranks, Monitor()),
        "links of a rank");
      found[rank] = store.GetLinks();
    });
  const Links& expected = whole.GetLinks();
  for (const Links& links : found)
  {
    Check(links.FrontHits == expected.FrontHits && links.BackHits == expected.BackHits &&
        links.GetSummary("RaysCast") == expected.GetSummary("RaysCast"),
      "rays of three ranks");
    for (std::size_t row = 0; row < expected.RowSums.size(); ++row)
    {
      CheckClose(links.SkyFractions[row] - expected.SkyFractions[row], 0.0, 1e-7, "sky on ranks");
      CheckClose(links.BackFaceFractions[row] - expected.BackFaceFractions[row], 0.0, 1e-7,
        "back faces on ranks");
    }
  }
}

//------------------------------------------------------------------------------
// The second law: black walls as warm as what is behind the opening exchange nothing with it.
void TestEquilibrium()
{
  auto cube = MakeCubeWithoutLid(8);
  AddArray(cube, "Temperature", { 300.0 });
  AddArray(cube, "Emissivity", { 1.0 });
  const double black = 5.670374419e-8 * std::pow(300.0, 4);
  const auto getNetFlux = [&](int method, bool closed, double tolerance)
  {
    vtkNew<vtkRadiosity> radiosity;
    radiosity->SetInputData(cube);
    radiosity->SetLinkMethod(method);
    method == vtkRadiosity::LINK_METHOD_DENSE ? radiosity->SetViewFactorTolerance(tolerance)
                                              : radiosity->SetLinkTolerance(tolerance);
    radiosity->SetEnforceClosure(closed);
    radiosity->SetBackgroundTemperature(300.0);
    radiosity->Update();
    vtkDataArray* net = vtkPolyData::SafeDownCast(radiosity->GetOutputDataObject(0))
                          ->GetCellData()
                          ->GetArray("NetFlux");
    double largest = net ? 0.0 : 1e30;
    for (vtkIdType cell = 0; net && cell < net->GetNumberOfTuples(); ++cell)
    {
      largest = std::max(largest, std::abs(net->GetComponent(cell, 0)) / black);
    }
    return largest;
  };
  for (const double tolerance : { 1e-1, 1e-2, 1e-3 })
  {
    const std::string what = ", tolerance " + std::to_string(tolerance);
    Check(getNetFlux(vtkRadiosity::LINK_METHOD_DENSE, false, tolerance) <= 1e-2 * tolerance,
      "equilibrium, dense" + what);
    Check(getNetFlux(vtkRadiosity::LINK_METHOD_DENSE, true, tolerance) <= 1e-14,
      "equilibrium, dense and closed" + what);
    Check(getNetFlux(vtkRadiosity::LINK_METHOD_HIERARCHICAL, false, tolerance) <= 1e-12,
      "equilibrium, clusters" + what);
  }
}

//------------------------------------------------------------------------------
void TestEnforcedClosure()
{
  for (const int bits : { Single, Double })
  {
    const Shares cube(WithPrecision(MakeCubeWithoutLid(3), bits), 1e-3, false, true);
    CheckWhole(cube, true, "closed cube");
    CheckShares(cube, { 0, 9 }, Opposite, 0.0, 1e-4, "closed cube");
    const Shares roof(WithPrecision(MakeRoof(3), bits), 1e-3, false, true);
    CheckWhole(roof, true, "closed roof");
    CheckShares(roof, { 0, 9 }, 1.0 - Opposite, Opposite, 1e-3, "closed roof");
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestOpenings(int, char*[])
{
  for (const int bits : { Single, Double })
  {
    for (const double tolerance : { 1e-2, 1e-3 })
    {
      TestShares(bits, false, tolerance);
    }
    TestShares(bits, true, 1e-2);
  }
  TestExtremes();
  TestErrorsOfRows(1e-2, 1e-2);
  TestErrorsOfRows(2e-3, 5e-3);
  TestDeviations();
  TestHits();
  TestRanks(false);
  TestRanks(true);
  TestEquilibrium();
  TestEnforcedClosure();
  return Result();
}
