// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// View factors where symmetry gives the answer, and what the filter tells about a scene; catalogue
// values are in TestViewFactorCatalogue.
#include "LightTransportTesting.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkViewFactors.h"

#include <algorithm>

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
  for (const double tolerance : { 1e-2, 1e-3, 1e-4, 1e-5 })
  {
    factors->SetTolerance(tolerance);
    factors->Update();
    // The upper plate sees no back face: what it misses is as well known as what it sees.
    const double error = GetCell(factors, "ViewFactorError", 1);
    Check(error > 0.0 && error <= tolerance, "the row keeps its tolerance");
    CheckClose(factors->GetViewFactor(1, 0), 0.5 * open, error / open, "half occluded pair");
  }
  Check(GetSummary(factors->GetPolyDataOutput(), "PairsPartlyVisible") >= 1.0,
    "partly visible pairs are counted");
}

//------------------------------------------------------------------------------
// A bowl of triangles whose rim lies in a plain of `width` times its radius; 1 for none.
vtkSmartPointer<vtkPolyData> MakeBowl(double width, double depth)
{
  constexpr int rings = 8, sectors = 17;
  const auto at = [=](int ring, int sector)
  {
    const double angle = 2.0 * vtkMath::Pi() * (sector % sectors) / sectors;
    const double radius = ring <= rings ? static_cast<double>(ring) / rings
                                        : 1.0 + (width - 1.0) * (ring - rings) / rings;
    const double height = ring < rings ? depth * (radius * radius - 1.0) : 0.0;
    return Point{ radius * std::cos(angle), radius * std::sin(angle), height };
  };
  Surface bowl;
  for (int sector = 0; sector < sectors; ++sector)
  {
    bowl.AddPolygon({ at(0, 0), at(1, sector), at(1, sector + 1) });
    for (int ring = 1; ring < (width > 1.0 ? 2 * rings : rings); ++ring)
    {
      const Point a = at(ring, sector), b = at(ring + 1, sector), c = at(ring + 1, sector + 1),
                  d = at(ring, sector + 1);
      bowl.AddPolygon({ a, b, c });
      bowl.AddPolygon({ a, c, d });
    }
  }
  return bowl.Get();
}

//------------------------------------------------------------------------------
// What can stand between nothing costs nothing: the plain around a bowl sees nothing, and the bowl
// is not looked at from points because of it. Sums of its rows are those of the bowl alone.
void TestPlainAroundBowl()
{
  for (const double depth : { 0.2, 1.5 })
  {
    const std::string what = ", depth " + std::to_string(depth);
    const auto bowl = Compute(MakeBowl(1.0, depth));
    const auto crater = Compute(MakeBowl(3.0, depth));
    const auto get = [](vtkViewFactors* factors, const char* name)
    { return GetSummary(factors->GetPolyDataOutput(), name); };
    CheckClose(get(crater, "PairsLookedAt"), 0.0, 0.0, "pairs looked at past the plain" + what);
    CheckClose(get(crater, "PairsUnobstructed"), get(bowl, "PairsUnobstructed"), 0.0,
      "pairs with nothing between them" + what);
    CheckClose(GetCell(crater, "ViewFactorSum", 0), GetCell(bowl, "ViewFactorSum", 0), Single,
      "sum of a row" + what);
  }
}

//------------------------------------------------------------------------------
// A wall hides what is behind it however finely it is cut: no pair is looked at from points.
void TestWalls()
{
  for (const int cuts : { 1, 4 })
  {
    const std::string what = ", cut into " + std::to_string(cuts);
    Surface plates;
    plates.AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 5, 5);
    plates.AddGrid({ 0, 0, 2 }, { 0, 1, 0 }, { 1, 0, 0 }, 5, 5);
    plates.AddGrid({ -1, -1, 1 }, { 3, 0, 0 }, { 0, 3, 0 }, cuts, cuts);
    const auto factors = Compute(plates.Get());
    vtkPolyData* output = factors->GetPolyDataOutput();
    CheckClose(GetSummary(output, "PairsHidden"), 625.0, 0.0, "pairs hidden by a wall" + what);
    CheckClose(GetSummary(output, "PairsLookedAt"), 0.0, 0.0, "pairs looked at" + what);
    CheckClose(GetCell(factors, "ViewFactorSum", 0), 0.0, 0.0, "what a hidden patch sees" + what);
  }
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
    // Nothing but the storage in single precision is left of it.
    Check(GetCell(factors, "ViewFactorError", i) < 6e-8 + 1e-11,
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
  const vtkIdType patches = factors->GetPolyDataOutput()->GetNumberOfCells();
  for (vtkIdType i = 0; i < patches; ++i)
  {
    double sum = 0.0;
    for (vtkIdType j = 0; j < patches; ++j)
    {
      sum += factors->GetViewFactor(i, j);
    }
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
  TestClosure();
  TestHalfOccluded();
  TestPlainAroundBowl();
  TestWalls();
  TestOpenings();
  TestSlanted();
  TestThinWall();
  TestHiddenStrip();
  TestEnforceClosure();
  return Result();
}
