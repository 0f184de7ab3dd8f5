// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Sheets, shared walls and sheets on a common edge, wherever and in whatever units they are given:
// closed forms, or brute force where there is none, in single and double precision, in many
// orientations, at map coordinates, in units from 1e-6 to 1e6.
#include "BruteForce.h"
#include "RandomScenes.h"
#include "ViewFactorProof.h"
#include "vtkDirectIrradiance.h"
#include "vtkLight.h"
#include "vtkRadiosity.h"

using namespace LightTransportTesting;

namespace
{
const double Parallel = 0.19982489569838746; // unit squares at distance 1
const Corners Floor = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };

//------------------------------------------------------------------------------
Corners Reversed(const Corners& polygon)
{
  return Corners(polygon.rbegin(), polygon.rend());
}

//------------------------------------------------------------------------------
Corners Moved(Corners polygon, const Vector& by)
{
  for (Vector& corner : polygon)
  {
    corner += by;
  }
  return polygon;
}

//------------------------------------------------------------------------------
/// A parallelogram in n x m; its front is where u x v points.
void AddGrid(std::vector<Corners>& polygons, const Vector& origin, const Vector& u, const Vector& v,
  int n, int m)
{
  const auto at = [&](int i, int j)
  { return Vector(origin + u * (static_cast<double>(i) / n) + v * (static_cast<double>(j) / m)); };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      polygons.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
}

//------------------------------------------------------------------------------
/// A box seen from inside, each face in n x n, or in n x n pairs of triangles.
void AddRoom(std::vector<Corners>& polygons, const Vector& low, const Vector& high, int n,
  bool triangles)
{
  const Vector x(high.x() - low.x(), 0, 0), y(0, high.y() - low.y(), 0),
    z(0, 0, high.z() - low.z());
  std::vector<Corners> faces;
  AddGrid(faces, low, x, y, n, n);
  AddGrid(faces, low + z, y, x, n, n);
  AddGrid(faces, low, z, x, n, n);
  AddGrid(faces, low + y, x, z, n, n);
  AddGrid(faces, low, y, z, n, n);
  AddGrid(faces, low + x, z, y, n, n);
  for (const Corners& face : faces)
  {
    if (triangles)
    {
      polygons.push_back({ face[0], face[1], face[2] });
      polygons.push_back({ face[0], face[2], face[3] });
    }
    else
    {
      polygons.push_back(face);
    }
  }
}

//------------------------------------------------------------------------------
/// Each way of giving coordinates in a number of orientations, the first of which is none.
std::vector<Placement> MakePlacements(int turns)
{
  std::vector<Placement> placements;
  for (int turn = 0; turn < turns; ++turn)
  {
    Placement placement;
    if (turn > 0)
    {
      placement.Turn = Random(MixBits(turn)).Rotation();
    }
    const auto add = [&](const std::string& name, bool single, double scale, const Vector& offset)
    {
      placement.Name = name + ", orientation " + std::to_string(turn);
      placement.Single = single;
      placement.Scale = scale;
      placement.Offset = offset;
      placements.push_back(placement);
    };
    add("double", false, 1.0, Vector::Zero());
    add("double, small", false, 1e-6, Vector::Zero());
    add("double, large", false, 1e6, Vector::Zero());
    add("double, at map coordinates", false, 1.0, { 615850.0, 5846925.0, 758.0 });
    add("float", true, 1.0, Vector::Zero());
    add("float, small", true, 1e-6, Vector::Zero());
    add("float, large", true, 1e6, Vector::Zero());
    add("float, 30 off", true, 1.0, { 30.0, 15.0, 5.0 });
    // As wide as a town, at map coordinates: the spacing there is 0.5.
    add("float, at map coordinates", true, 1e4, { 615850.0, 5846925.0, 758.0 });
  }
  return placements;
}

//------------------------------------------------------------------------------
/// What coordinates lost, where polygons are as wide as 1.
double GetLoss(const std::vector<Corners>& polygons, const Placement& placement)
{
  return BruteForce::GetWorth(polygons, placement.Single) / placement.Scale;
}

//------------------------------------------------------------------------------
double GetLinkSum(const std::vector<Corners>& polygons, bool single, vtkIdType row)
{
  vtkNew<vtkViewFactors> factors;
  factors->SetInputData(MakeData(polygons, single));
  factors->HierarchicalOn();
  factors->Update();
  return GetCellValues(factors, "ViewFactorSum")[row];
}

//------------------------------------------------------------------------------
// Two sheets opposite each other: the closed form, whatever the mesh of their far sides.
void TestTwoSided()
{
  const Corners ceiling = Reversed(Moved(Floor, { 0, 0, 1 }));
  std::vector<Corners> alike = { Floor, ceiling, Reversed(Floor), Reversed(ceiling) };
  std::vector<Corners> divided = { Floor, ceiling };
  AddGrid(divided, { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3);
  divided.push_back({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 } });
  divided.push_back({ { 0, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } });
  for (const Placement& placement : MakePlacements(20))
  {
    for (const auto& sheets : { alike, divided })
    {
      const std::string what =
        (sheets.size() == 4 ? "sheet, " : "sheet with another far side, ") + placement.Name;
      const auto polygons = Place(sheets, placement);
      const FactorTable table = MakeFactorTable(polygons, placement.Single, 1e-3);
      const double allowed = 1e-6 + GetLoss(polygons, placement);
      CheckClose(table.Get(0, 1) - Parallel, 0.0, allowed + table.Errors[0], what);
      CheckClose(table.Sky[0] - 1.0 + Parallel, 0.0, allowed + table.Errors[0], "sky, " + what);
      Check(table.Back[0] <= allowed + table.Errors[0], "no back is seen, " + what);
      for (std::size_t far = 2; far < sheets.size(); ++far)
      {
        Check(table.Sums[far] <= allowed, "far sides see nothing, " + what);
      }
    }
    const auto polygons = Place(alike, placement);
    CheckClose(GetLinkSum(polygons, placement.Single, 0) - Parallel, 0.0, 1e-2,
      "links of a sheet, " + placement.Name);
  }
}

//------------------------------------------------------------------------------
// A convex room has no occluders, however its coordinates are given.
void TestConvexRoom()
{
  std::vector<Corners> room;
  AddRoom(room, Vector::Zero(), { 5, 4, 3 }, 3, true);
  Placement placement;
  placement.Turn = Random(MixBits(1)).Rotation();
  const auto test = [&](const std::string& name, bool single, double scale, const Vector& offset)
  {
    placement.Single = single;
    placement.Scale = scale;
    placement.Offset = offset;
    const auto factors = ComputeViewFactors(MakeData(Place(room, placement), single), 1e-4);
    vtkDataObject* output = factors->GetOutputDataObject(0);
    Check(GetSummary(output, "PairsPartlyVisible") == 0.0, "no pair is partly visible, " + name);
    Check(GetSummary(output, "PairsUnobstructed") == GetSummary(output, "PairsFacing"),
      "nothing stands between any pair, " + name);
    const auto sums = GetCellValues(factors, "ViewFactorSum");
    const auto errors = GetCellValues(factors, "ViewFactorError");
    const double loss = GetLoss(Place(room, placement), placement);
    for (std::size_t row = 0; row < sums.size(); ++row)
    {
      CheckClose(sums[row], 1.0, errors[row] + 1e-6 + 10.0 * loss, "row of a room, " + name);
    }
  };
  test("double", false, 1.0, Vector::Zero());
  test("double at map coordinates", false, 1.0, { 615850.0, 5846925.0, 758.0 });
  test("float", true, 1.0, Vector::Zero());
  test("float, 30 off", true, 1.0, { 30.0, 15.0, 5.0 });
  test("float, 100 off", true, 1.0, { 100.0, 50.0, 20.0 });
  test("float, a town at map coordinates", true, 1e4, { 615850.0, 5846925.0, 758.0 });
}

//------------------------------------------------------------------------------
// The far side of a sheet throws no shadow on the lit one: a point light of intensity 1 at distance
// 1 over the middle gives the solid angle of the square.
void TestDirectLight()
{
  const double right = 4.0 * std::asin(0.25 / 1.25);
  std::vector<Corners> quarters = { Floor };
  AddGrid(quarters, { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 3, 3);
  const std::vector<Corners> triangles = { Floor, { { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 } },
    { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } } };
  for (const Placement& placement : MakePlacements(10))
  {
    const Vector position =
      placement.Scale * (placement.Turn * Vector(0.5, 0.5, 1.0)) + placement.Offset;
    for (const auto& sheet : { quarters, triangles })
    {
      vtkNew<vtkLight> light;
      light->SetLightTypeToSceneLight();
      light->SetPositional(true);
      light->SetConeAngle(180.0);
      light->SetPosition(position.x(), position.y(), position.z());
      light->SetAttenuationValues(0.0, 0.0, 1.0 / (placement.Scale * placement.Scale));
      vtkNew<vtkDirectIrradiance> direct;
      direct->SetInputData(MakeData(Place(sheet, placement), placement.Single));
      direct->AddLight(light);
      direct->Update();
      vtkDataArray* array =
        direct->GetPolyDataOutput()->GetCellData()->GetArray("DirectIrradiance");
      const double value = array ? array->GetComponent(0, 0) : vtkMath::Nan();
      CheckClose(value - right, 0.0, 0.02, "light on a sheet, " + placement.Name);
    }
  }
}

//------------------------------------------------------------------------------
/// F of a kerb to a floor past a sheet on their common edge.
struct Kerb
{
  double Height;
  double Begin, End; ///< of the sheet along the edge
  double Length;     ///< of the sheet away from it
  double Factor;
};

//------------------------------------------------------------------------------
// In single precision the right value is that of the rounded corners, while that means something.
void CheckOnEdge(const std::vector<Corners>& scene, double right, double narrowest,
  const std::string& what)
{
  for (const Placement& placement : MakePlacements(2))
  {
    const auto polygons = Place(scene, placement);
    const double loss = GetLoss(polygons, placement) / narrowest;
    if (loss > 0.01)
    {
      continue;
    }
    const FactorTable table = MakeFactorTable(polygons, placement.Single, 1e-3);
    double expected = right;
    if (placement.Single)
    {
      const BruteForce force(polygons, BruteForce::GetWorth(polygons, true));
      expected = force.Count(1, 2e-5).Shares[0];
    }
    CheckClose(table.Get(1, 0) - expected, 0.0, 3e-4 + 2.0 * loss + table.Errors[1],
      what + ", " + placement.Name);
    Check(table.Errors[1] < 0.02,
      "estimate of a kerb's row, " + what + ", " + placement.Name + ": " +
        std::to_string(table.Errors[1]));
  }
}

//------------------------------------------------------------------------------
// A kerb and a floor with a sheet in the corner between them, at 45 degrees. Right: BruteForce with
// 64 seeds of 65,536 half-planes each, standard error 2e-5 at most.
void TestOnOneEdge()
{
  const Kerb kerbs[] = { { 1.0, 0.0, 1.0, 0.3, 0.056962 }, { 0.1, 0.0, 1.0, 0.005, 0.397776 },
    { 0.1, 0.0, 0.5, 0.002, 0.425507 }, { 0.01, 0.0, 1.0, 0.003, 0.292397 },
    { 0.01, 0.0, 0.5, 0.003, 0.390985 }, { 0.01, 0.0, 1.0, 0.0005, 0.454593 } };
  for (const Kerb& kerb : kerbs)
  {
    const double side = kerb.Length * std::sqrt(0.5);
    const Corners sheet = { { 0, kerb.Begin, 0 }, { 0, kerb.End, 0 }, { side, kerb.End, side },
      { side, kerb.Begin, side } };
    const Corners wall = { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, kerb.Height }, { 0, 0, kerb.Height } };
    CheckOnEdge({ Floor, wall, sheet, Reversed(sheet) }, kerb.Factor, kerb.Length,
      "kerb of height " + std::to_string(kerb.Height) + ", sheet of " +
        std::to_string(kerb.Length));
  }
  const Corners tip = { { 0, 0, 0 }, { 0, 0.4857757702236216, 0 },
    { 0.50407037, 0.21521229, 0.09974063 } };
  CheckOnEdge({ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } },
                { { 0, 0, 0 }, { 0, 1, 0 },
                  { 0.005296108083468308, 0.1630568324215289, 0.01162107827865328 } },
                tip, Reversed(tip) },
    0.225041, 0.0128, "sliver");
}

//------------------------------------------------------------------------------
// Two rooms of one temperature each exchange nothing, however their party wall is meshed.
void TestPartyWall()
{
  std::vector<Corners> rooms;
  AddRoom(rooms, Vector::Zero(), { 4, 3, 2.5 }, 1, false);
  const std::size_t first = rooms.size();
  AddRoom(rooms, { 4, 0, 0 }, { 7, 3, 2.5 }, 3, true);
  for (const Placement& placement : MakePlacements(3))
  {
    const auto data = MakeData(Place(rooms, placement), placement.Single);
    vtkDoubleArray* temperature = AddArray(data, "Temperature", { 300.0 });
    for (std::size_t cell = first; cell < rooms.size(); ++cell)
    {
      temperature->SetValue(static_cast<vtkIdType>(cell), 400.0);
    }
    AddArray(data, "Emissivity", { 0.9 });
    vtkNew<vtkRadiosity> radiosity;
    radiosity->SetInputData(data);
    radiosity->SetViewFactorTolerance(1e-4);
    radiosity->Update();
    vtkDataArray* net = radiosity->GetPolyDataOutput()->GetCellData()->GetArray("NetFlux");
    double largest = net ? 0.0 : vtkMath::Nan();
    for (vtkIdType cell = 0; net && cell < net->GetNumberOfTuples(); ++cell)
    {
      largest = std::max(largest, std::abs(net->GetComponent(cell, 0)));
    }
    // Of 1451 W/m2 that 400 K emit.
    const double allowed = 1.0 + 1451.0 * 10.0 * GetLoss(Place(rooms, placement), placement);
    Check(largest <= allowed,
      "net flux of a room at one temperature, " + placement.Name + ": " + std::to_string(largest) +
        " W/m2");
  }
}

//------------------------------------------------------------------------------
// Plates 1e-10 apart are not in one place in double precision: the middle one hides.
void TestNearPlates()
{
  const double gap = 1e-10;
  const Corners middle = Moved(Floor, { 0, 0, gap });
  const std::vector<Corners> plates = { Floor, Reversed(Moved(Floor, { 0, 0, 2.0 * gap })),
    Reversed(middle), middle };
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    Placement placement;
    placement.Scale = scale;
    const FactorTable table = MakeFactorTable(Place(plates, placement), false, 1e-3);
    const std::string what = "plates a gap apart, scale " + std::to_string(scale);
    CheckClose(table.Get(0, 2), 1.0, 1e-6 + table.Errors[0], what);
    CheckClose(table.Get(3, 1), 1.0, 1e-6 + table.Errors[3], what);
    CheckClose(table.Get(0, 1), 0.0, 1e-6 + table.Errors[0], "hidden by the middle one, " + what);
  }
}

//------------------------------------------------------------------------------
// Of surfaces in one place that face the same way the first exchanges, the others do not, even
// where they are meshed in another way.
void TestTwice()
{
  const Corners ceiling = Reversed(Moved(Floor, { 0, 0, 1 }));
  const std::vector<Corners> scene = { Floor, ceiling, ceiling,
    { ceiling[0], ceiling[1], ceiling[2] }, { ceiling[0], ceiling[2], ceiling[3] } };
  for (const Placement& placement : MakePlacements(3))
  {
    const std::string what = "surfaces that are there twice, " + placement.Name;
    const auto polygons = Place(scene, placement);
    const FactorTable table = MakeFactorTable(polygons, placement.Single, 1e-3);
    const double allowed = 1e-6 + GetLoss(polygons, placement) + table.Errors[0];
    CheckClose(table.Get(0, 1) - Parallel, 0.0, allowed, what);
    CheckClose(table.Get(1, 0) - Parallel, 0.0, allowed, what);
    for (std::size_t copy = 2; copy < scene.size(); ++copy)
    {
      Check(table.Get(0, copy) == 0.0 && table.Sums[copy] == 0.0, what + ": a copy exchanges");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSurfacesInOnePlace(int, char*[])
{
  TestTwoSided();
  TestConvexRoom();
  TestDirectLight();
  TestOnOneEdge();
  TestPartyWall();
  TestNearPlates();
  TestTwice();
  return Result();
}
