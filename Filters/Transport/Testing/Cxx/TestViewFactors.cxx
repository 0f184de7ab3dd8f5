// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// View factors against catalogue values (Howell, A Catalog of Radiation Heat Transfer Configuration
// Factors: C-11, C-14, C-41) and against what symmetry gives exactly.
#include "LightTransportTesting.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkTriangle.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <sstream>

using namespace LightTransportTesting;

namespace
{
// The matrix is single precision: no factor can be better than this.
constexpr double Single = 2e-7;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkViewFactors> Compute(vtkPolyData* data, double tolerance = 1e-8)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetInputData(data);
  factors->SetTolerance(tolerance);
  factors->Update();
  return factors;
}

//------------------------------------------------------------------------------
double GetCell(vtkViewFactors* factors, const char* name, vtkIdType cell)
{
  vtkDataArray* array = factors->GetPolyDataOutput()->GetCellData()->GetArray(name);
  return Check(array && array->GetNumberOfComponents() == 1, std::string("array ") + name)
    ? array->GetComponent(cell, 0)
    : vtkMath::Nan();
}

//------------------------------------------------------------------------------
void TestParallelPlates()
{
  const double rows[][4] = { { 1, 1, 1, 0.199824895698387 }, { 1, 1, 0.1, 0.826994522397257 },
    { 1, 1, 0.01, 0.980416602925973 }, { 1, 1, 0.001, 0.99800563190758 },
    { 0.1, 10, 1, 0.046708353330323 }, { 1, 1, 10, 0.0031620568387576 },
    { 1, 1, 100, 3.18288667328292e-5 }, { 2, 1, 1, 0.285875384850715 },
    { 1, 10, 1, 0.386382489266135 }, { 0.1, 0.1, 0.05, 0.415253283576 } };
  for (const auto& row : rows)
  {
    const double a = row[0], b = row[1], c = row[2];
    Surface plates;
    plates.AddGrid({ 0, 0, 0 }, { a, 0, 0 }, { 0, b, 0 }, 1, 1);
    plates.AddGrid({ 0, 0, c }, { 0, b, 0 }, { a, 0, 0 }, 1, 1);
    auto factors = Compute(plates.Get());
    std::ostringstream what;
    what << "parallel plates " << a << " x " << b << ", gap " << c;
    CheckClose(factors->GetViewFactor(0, 1), row[3], Single, what.str());
    CheckClose(GetCell(factors, "ViewFactorSum", 0), row[3], Single, what.str() + " (sum)");
  }
}

//------------------------------------------------------------------------------
void TestPerpendicularPlates()
{
  const double rows[][4] = { { 1, 1, 1, 0.200043776075403 }, { 1, 2, 1, 0.116426301397681 },
    { 2, 1, 1, 0.232852602795362 }, { 0.1, 1, 1, 0.0432513694006859 },
    { 1, 0.1, 1, 0.432513694006859 }, { 0.01, 1, 1, 0.00489584926850668 },
    { 1, 0.01, 1, 0.489584926850668 }, { 10, 1, 1, 0.249209485790311 },
    { 1, 1, 10, 0.281887806787901 }, { 1, 1, 100, 0.291790067336922 } };
  for (const auto& row : rows)
  {
    const double h = row[0], w = row[1], l = row[2];
    // The second wall reaches as far below the floor as above it: what is below must not count.
    for (const double below : { 0.0, h })
    {
      Surface plates;
      plates.AddGrid({ 0, 0, 0 }, { w, 0, 0 }, { 0, l, 0 }, 1, 1);
      plates.AddGrid({ 0, 0, -below }, { 0, l, 0 }, { 0, 0, h + below }, 1, 1);
      auto factors = Compute(plates.Get());
      std::ostringstream what;
      what << "perpendicular plates h " << h << ", w " << w << ", l " << l << ", below " << below;
      CheckClose(factors->GetViewFactor(0, 1), row[3], Single, what.str());
    }
  }
}

//------------------------------------------------------------------------------
void AddDisc(Surface& surface, double radius, double height, int sectors, bool up)
{
  // As large as the disc it stands for.
  const double angle = 2.0 * vtkMath::Pi() / sectors;
  const double corner = radius * std::sqrt(angle / std::sin(angle));
  for (int k = 0; k < sectors; ++k)
  {
    const Point a{ corner * std::cos(k * angle), corner * std::sin(k * angle), height };
    const Point b{ corner * std::cos((k + 1) % sectors * angle),
      corner * std::sin((k + 1) % sectors * angle), height };
    const Point center{ 0, 0, height };
    up ? surface.AddPolygon({ center, a, b }) : surface.AddPolygon({ center, b, a });
  }
}

//------------------------------------------------------------------------------
void TestDiscs()
{
  const double rows[][4] = { { 1, 1, 1, 0.381966011250105 }, { 1, 2, 1, 0.76393202250021 },
    { 2, 1, 1, 0.190983005625053 }, { 1, 1, 3, 0.0916730868040161 },
    { 0.5, 1, 1, 0.468871125850725 } };
  for (const auto& row : rows)
  {
    constexpr int sectors = 96;
    Surface discs;
    AddDisc(discs, row[0], 0.0, sectors, true);
    AddDisc(discs, row[1], row[2], sectors, false);
    auto factors = Compute(discs.Get(), 1e-6);
    double sum = 0.0;
    for (int k = 0; k < sectors; ++k)
    {
      sum += GetCell(factors, "ViewFactorSum", k) / sectors;
    }
    std::ostringstream what;
    what << "coaxial discs " << row[0] << ", " << row[1] << ", distance " << row[2];
    // Polygons with 96 corners for the circles: the error of that falls with the fourth power here.
    CheckClose(sum, row[3], 2e-6, what.str());
  }
}

//------------------------------------------------------------------------------
// Row sums of closed scenes, exact reciprocity, and the error estimate.
void TestClosure()
{
  auto room = MakeRoom(5);
  for (const double tolerance : { 1e-3, 1e-5, 1e-8 })
  {
    auto factors = Compute(room, tolerance);
    double worst = 0.0;
    for (vtkIdType i = 0; i < room->GetNumberOfCells(); ++i)
    {
      const double error = std::abs(GetCell(factors, "ViewFactorSum", i) - 1.0);
      worst = std::max(worst, error);
      Check(GetCell(factors, "ViewFactorError", i) + Single >= error,
        "the estimate " + std::to_string(GetCell(factors, "ViewFactorError", i) * 1e6) +
          "e-6 covers the error " + std::to_string(error * 1e6) + "e-6");
      Check(GetCell(factors, "SkyFraction", i) == 0.0, "a closed room has no sky");
    }
    Check(worst <= tolerance + Single,
      "rows of a room sum to 1 within " + std::to_string(tolerance));
    Check(GetSummary(factors->GetPolyDataOutput(), "RaysCast") == 0.0,
      "a convex room needs no ray");
    CheckClose(factors->GetViewFactor(0, 30), factors->GetViewFactor(30, 0), 1e-14, "reciprocity");
    Check(factors->GetViewFactor(0, 1) == 0.0, "coplanar patches do not see each other");
    Check(factors->GetViewFactor(0, 150) == 0.0, "out of range is 0");
  }
}

//------------------------------------------------------------------------------
// Aligned unit plates at distance 2; a screen half way covers x < 0.5. Point x on the one and x' on
// the other see each other where x + x' > 1: by symmetry that is half the exchange, which no ray
// between centres can tell.
void TestHalfOccluded()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  plates.AddGrid({ 0, 0, 2 }, { 0, 1, 0 }, { 1, 0, 0 }, 1, 1);
  const double open = Compute(plates.Get())->GetViewFactor(0, 1);
  plates.AddGrid({ -4, -4, 1 }, { 4.5, 0, 0 }, { 0, 9, 0 }, 1, 1);
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(plates.Get());
  for (const auto& setting :
    std::map<int, double>{ { 256, 0.03 }, { 4096, 0.006 }, { 65536, 2e-3 } })
  {
    factors->SetMaximumNumberOfRays(setting.first);
    factors->Update();
    CheckClose(factors->GetViewFactor(0, 1), 0.5 * open, setting.second, "half occluded pair");
    const double error = GetCell(factors, "ViewFactorError", 0);
    Check(error > 0.0 && error < 0.1 * open, "the error estimate knows of the sampling");
  }
  Check(GetSummary(factors->GetPolyDataOutput(), "PairsPartlyVisible") >= 1.0,
    "partly visible pairs are counted");
}

//------------------------------------------------------------------------------
// Concentric spheres with similar triangulations: F from the inner to the outer one is 1, back 1/9,
// and 8/9 among the outer.
void TestConcentricSpheres()
{
  Surface spheres;
  AddSphere(spheres, 1.0, 2, false);
  AddSphere(spheres, 3.0, 2, true);
  auto data = spheres.Get();
  auto factors = Compute(data, 1e-4);
  constexpr int cells = 320;
  double inner = 0.0, back = 0.0, outer = 0.0, areaIn = 0.0, areaOut = 0.0, square = 0.0;
  const auto getArea = [&](vtkIdType cell)
  { return vtkTriangle::SafeDownCast(data->GetCell(cell))->ComputeArea(); };
  for (int i = 0; i < cells; ++i)
  {
    const double in = getArea(i);
    const double out = getArea(cells + i);
    areaIn += in;
    areaOut += out;
    for (int j = 0; j < cells; ++j)
    {
      inner += in * factors->GetViewFactor(i, cells + j);
      back += out * factors->GetViewFactor(cells + i, j);
      outer += out * factors->GetViewFactor(cells + i, cells + j);
      Check(factors->GetViewFactor(i, j) == 0.0, "a convex body does not see itself");
    }
    square += std::pow(GetCell(factors, "ViewFactorSum", cells + i) - 1.0, 2) / cells;
  }
  CheckClose(inner / areaIn, 1.0, 1e-4, "inner to outer sphere");
  CheckClose(back / areaOut, 1.0 / 9.0, 1e-4, "outer to inner sphere");
  CheckClose(outer / areaOut, 8.0 / 9.0, 2e-3, "outer sphere to itself, past the inner one");
  Check(std::sqrt(square) < 5e-3,
    "row sums of the outer sphere, root mean square " + std::to_string(std::sqrt(square)));
}

//------------------------------------------------------------------------------
void TestOpenings()
{
  // An open box: a room without its ceiling. The floor misses exactly what the ceiling would take.
  Surface box;
  box.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  box.AddGrid({ 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, 1, 1);
  box.AddGrid({ 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 1, 1);
  box.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 1, 1);
  box.AddGrid({ 1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 }, 1, 1);
  auto open = Compute(box.Get());
  CheckClose(GetCell(open, "SkyFraction", 0), 0.199824895698387, 1e-6, "sky over the floor");
  Check(GetCell(open, "BackFaceFraction", 0) == 0.0, "no back face");
  // A lid that faces away takes the same part as a back face.
  box.AddGrid({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  auto closed = Compute(box.Get());
  CheckClose(GetCell(closed, "BackFaceFraction", 0), 0.199824895698387, 1e-6,
    "back face over the floor");
  Check(GetCell(closed, "SkyFraction", 0) == 0.0, "no sky under a lid");
}

//------------------------------------------------------------------------------
// Neither the unit nor the place of a scene changes a factor.
void TestInvariance()
{
  const auto make = [](double scale, double shift)
  {
    Surface scene;
    const auto at = [&](double x, double y, double z) {
      return Point{ scale * (x + shift), scale * (y + shift), scale * (z + shift) };
    };
    scene.AddPolygon({ at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0) });
    scene.AddPolygon({ at(0, 0, 0), at(0, 1, 0), at(0, 1, 1) });
    scene.AddPolygon({ at(0.25, 0.25, 1), at(0.25, 0.75, 1), at(0.75, 0.5, 1) });
    scene.AddPolygon({ at(0.375, 0.375, 0.5), at(0.625, 0.375, 0.5), at(0.5, 0.625, 0.5) });
    return Compute(scene.Get(), 1e-6);
  };
  auto reference = make(1.0, 0.0);
  const double settings[][2] = { { 1e-9, 0 }, { 1e-3, 0 }, { 1e9, 0 }, { 1.0, 1024.0 },
    { 1e6, -64.0 } };
  for (const auto& setting : settings)
  {
    auto factors = make(setting[0], setting[1]);
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < 4; ++j)
      {
        CheckClose(factors->GetViewFactor(i, j), reference->GetViewFactor(i, j), 1e-6,
          "another unit or place");
      }
    }
  }
}

//------------------------------------------------------------------------------
// A room that no axis is parallel to: edges that touch along a line that is only known to rounding
// still converge.
void TestSlanted()
{
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(37.0, 0.3, 0.5, 0.8);
  vtkNew<vtkTransformPolyDataFilter> slanted;
  slanted->SetInputData(MakeRoom(2));
  slanted->SetTransform(turn);
  slanted->Update();
  auto factors = Compute(slanted->GetOutput(), 1e-12);
  for (vtkIdType i = 0; i < 24; ++i)
  {
    CheckClose(GetCell(factors, "ViewFactorSum", i), 1.0, Single, "row of a slanted room");
    Check(GetCell(factors, "ViewFactorError", i) < 1e-11,
      "error estimate of a slanted room: " +
        std::to_string(GetCell(factors, "ViewFactorError", i)));
  }
}

//------------------------------------------------------------------------------
// A plate whose flipped copy makes it a thin wall sees what it sees without, and so does the copy.
void TestThinWall()
{
  Surface plates;
  plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  plates.AddGrid({ 0, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  plates.AddGrid({ 0, 0, -1 }, { 1, 0, 0 }, { 0, 1, 0 }, 2, 2);
  plates.AddGrid({ 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 2, 2);
  auto factors = Compute(plates.Get(), 1e-6);
  for (int side = 0; side < 4; ++side)
  {
    double sum = 0.0;
    double sky = 0.0;
    for (int cell = 4 * side; cell < 4 * side + 4; ++cell)
    {
      sum += 0.25 * GetCell(factors, "ViewFactorSum", cell);
      sky += 0.25 * GetCell(factors, "SkyFraction", cell);
    }
    CheckClose(sum, 0.199824895698387, 1e-6, "thin wall, side " + std::to_string(side));
    CheckClose(sky, 1.0 - 0.199824895698387, 1e-6, "sky beside a thin wall");
  }
}

//------------------------------------------------------------------------------
// Of a wall only the strip above the floor's plane is in sight, and a screen hides it: rays that
// start or end below the horizon would tell nothing.
void TestHiddenStrip()
{
  Surface scene;
  scene.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1, 1);
  scene.AddGrid({ 1.5, 0, -20 }, { 0, 0, 20.1 }, { 0, 1, 0 }, 1, 1);
  const double open = Compute(scene.Get())->GetViewFactor(0, 1);
  Check(open > 1e-4 && open < 1e-2, "the strip is small: " + std::to_string(open));
  scene.AddGrid({ 1.2, -9, -1 }, { 0, 19, 0 }, { 0, 0, 9 }, 1, 1);
  Check(Compute(scene.Get(), 1e-4)->GetViewFactor(0, 1) == 0.0, "a hidden strip");
}

//------------------------------------------------------------------------------
void TestEnforceClosure()
{
  Surface sphere;
  AddSphere(sphere, 1.0, 2, true);
  AddSphere(sphere, 0.4, 1, false);
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(sphere.Get());
  factors->SetTolerance(1e-2);
  factors->EnforceClosureOn();
  factors->Update();
  for (const double sum : factors->GetRowSums())
  {
    CheckClose(sum, 1.0, 1e-6, "closed row");
  }
  const double change = GetSummary(factors->GetPolyDataOutput(), "ClosureChange");
  Check(change > 0.0 && change < 0.05, "closure says how far it went");
  Check(std::abs(GetCell(factors, "ViewFactorSum", 3) - 1.0) > 1e-6, "the raw sums stay visible");
}
} // namespace

//------------------------------------------------------------------------------
int TestViewFactors(int, char*[])
{
  TestParallelPlates();
  TestPerpendicularPlates();
  TestDiscs();
  TestClosure();
  TestHalfOccluded();
  TestConcentricSpheres();
  TestOpenings();
  TestInvariance();
  TestSlanted();
  TestThinWall();
  TestHiddenStrip();
  TestEnforceClosure();
  return Result();
}
