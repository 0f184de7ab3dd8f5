// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactorScenes.h"
#include "vtkDelaunay2D.h"
#include "vtkIntArray.h"
#include "vtkPLYReader.h"
#ifdef LIGHTTRANSPORT_HAS_MESHING
#include "vtkPatchMesher.h"
#include "vtkXMLPolyDataReader.h"
#endif

using namespace LightTransportTesting;

namespace ViewFactorBenchmark
{
namespace
{
/**
 * Points that are spread evenly over the unit square in no pattern (Roberts' additive recurrence
 * with the plastic number), so that Delaunay triangles of them are alike but nowhere regular.
 */
std::vector<std::array<double, 2>> SpreadPoints(int count)
{
  std::vector<std::array<double, 2>> points;
  constexpr double plastic = 1.32471795724474602596;
  for (int k = 1; k <= count; ++k)
  {
    points.push_back(
      { std::fmod(0.5 + k / plastic, 1.0), std::fmod(0.5 + k / (plastic * plastic), 1.0) });
  }
  return points;
}

//------------------------------------------------------------------------------
/// Triangles (as corners in the plane) of the convex hull of boundary and interior points.
std::vector<std::array<Point, 3>> Triangulate(const std::vector<std::array<double, 2>>& boundary,
  const std::vector<std::array<double, 2>>& interior)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto* part : { &boundary, &interior })
  {
    for (const auto& point : *part)
    {
      points->InsertNextPoint(point[0], point[1], 0.0);
    }
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  vtkNew<vtkDelaunay2D> delaunay;
  delaunay->SetInputData(data);
  delaunay->SetTolerance(0.0);
  delaunay->Update();
  vtkPolyData* mesh = delaunay->GetOutput();
  std::vector<std::array<Point, 3>> triangles(mesh->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    mesh->GetCellPoints(cell, ids);
    auto& corners = triangles[cell];
    for (int k = 0; k < 3; ++k)
    {
      mesh->GetPoint(ids->GetId(k), corners[k].data());
    }
    const Point &a = corners[0], &b = corners[1], &c = corners[2];
    if ((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]))
    {
      std::swap(corners[1], corners[2]);
    }
  }
  return triangles;
}

//------------------------------------------------------------------------------
/// The unit square cut into exactly `count` triangles (2 interior + boundary points - 2).
std::vector<std::array<Point, 3>> TriangulateSquare(int count)
{
  const int side = static_cast<int>(std::round(std::sqrt(count * std::sqrt(3.0) / 4.0)));
  std::vector<std::array<double, 2>> boundary;
  for (int k = 0; k < 4; ++k)
  {
    // An odd number of triangles takes an odd number of boundary points.
    const int segments = side + (k == 0 && count % 2 ? 1 : 0);
    for (int i = 0; i < segments; ++i)
    {
      const double t = static_cast<double>(i) / segments;
      const std::array<double, 2> sides[] = { { t, 0 }, { 1, t }, { 1 - t, 1 }, { 0, 1 - t } };
      boundary.push_back(sides[k]);
    }
  }
  auto interior = SpreadPoints((count + 2 - static_cast<int>(boundary.size())) / 2);
  const double margin = 0.5 / side;
  for (auto& point : interior)
  {
    point = { margin + (1 - 2 * margin) * point[0], margin + (1 - 2 * margin) * point[1] };
  }
  return Triangulate(boundary, interior);
}

//------------------------------------------------------------------------------
/// The polygon of points on the unit circle cut into exactly `count` triangles.
std::vector<std::array<Point, 3>> TriangulateDisc(int count)
{
  int corners = static_cast<int>(std::round(std::sqrt(count * vtkMath::Pi() * std::sqrt(3.0))));
  corners += (count - corners) % 2 ? 1 : 0;
  std::vector<std::array<double, 2>> boundary;
  for (int k = 0; k < corners; ++k)
  {
    const double angle = 2.0 * vtkMath::Pi() * k / corners;
    boundary.push_back({ std::cos(angle), std::sin(angle) });
  }
  auto interior = SpreadPoints((count + 2 - corners) / 2);
  for (auto& point : interior)
  {
    const double radius = (1.0 - vtkMath::Pi() / corners) * std::sqrt(point[0]);
    const double angle = 2.0 * vtkMath::Pi() * point[1];
    point = { radius * std::cos(angle), radius * std::sin(angle) };
  }
  return Triangulate(boundary, interior);
}

//------------------------------------------------------------------------------
/// Add triangles of the plane, placed by `place`, reversed if asked for.
void AddTriangles(Surface& surface, const std::vector<std::array<Point, 3>>& triangles,
  const std::function<Point(const Point&)>& place, bool reverse)
{
  for (const auto& corners : triangles)
  {
    const Point a = place(corners[0]), b = place(corners[1]), c = place(corners[2]);
    reverse ? surface.AddPolygon({ a, c, b }) : surface.AddPolygon({ a, b, c });
  }
}

//------------------------------------------------------------------------------
/// Two surfaces that face each other, of which nothing else is known.
Scene MakePair(const Surface& surface, vtkIdType first, const std::string& text, double exact)
{
  Scene scene;
  scene.Data = surface.Get();
  const vtkIdType cells = scene.Data->GetNumberOfCells();
  scene.Text =
    text + ", " + std::to_string(first) + " and " + std::to_string(cells - first) + " triangles";
  scene.Factors = { { "F12", { 0, first }, { first, cells }, exact } };
  return scene;
}

//------------------------------------------------------------------------------
Scene MakeParallelPlates(int count)
{
  const auto triangles = TriangulateSquare(count);
  Surface plates;
  AddTriangles(
    plates, triangles, [](const Point& p) { return p; }, false);
  AddTriangles(
    plates, triangles,
    [](const Point& p) {
      return Point{ 1 - p[0], p[1], 1 };
    },
    false);
  return MakePair(plates, static_cast<vtkIdType>(triangles.size()),
    "parallel unit plates at distance 1", 0.199824895698387);
}

//------------------------------------------------------------------------------
Scene MakePerpendicularPlates(int count)
{
  const auto triangles = TriangulateSquare(count);
  Surface plates;
  AddTriangles(
    plates, triangles, [](const Point& p) { return p; }, false);
  AddTriangles(
    plates, triangles,
    [](const Point& p) {
      return Point{ 0, p[0], p[1] };
    },
    false);
  return MakePair(plates, static_cast<vtkIdType>(triangles.size()),
    "perpendicular unit plates with a common edge", 0.200043776075403);
}

//------------------------------------------------------------------------------
Scene MakeDiscs(int count)
{
  const auto triangles = TriangulateDisc(count);
  Surface discs;
  AddTriangles(
    discs, triangles, [](const Point& p) { return p; }, false);
  AddTriangles(
    discs, triangles,
    [](const Point& p) {
      return Point{ p[0], p[1], 1 };
    },
    true);
  return MakePair(discs, static_cast<vtkIdType>(triangles.size()),
    "coaxial discs r = 1 at distance 1 (error: that of polygons for circles)", 0.381966011250105);
}

//------------------------------------------------------------------------------
Scene MakeSpheres(int levels)
{
  Surface spheres;
  AddSphere(spheres, 1.0, levels, false);
  AddSphere(spheres, 3.0, levels, true);
  Scene scene;
  scene.Data = spheres.Get();
  const vtkIdType cells = scene.Data->GetNumberOfCells();
  const Group inner{ 0, cells / 2 }, outer{ cells / 2, cells };
  scene.Text = "concentric spheres r = 1 and 3 of " + std::to_string(cells / 2) +
    " similar triangles each, " + std::to_string(cells) + " in all";
  scene.Closed = { 0, cells };
  scene.Factors = { { "F_io", inner, outer, 1.0 }, { "F_oi", outer, inner, 1.0 / 9.0 },
    { "F_oo", outer, outer, 8.0 / 9.0 } };
  return scene;
}

//------------------------------------------------------------------------------
Scene MakeCylinders(int refinement)
{
  Surface cylinders;
  AddPrism(cylinders, 0.125, 1.0, 20 * refinement, 16 * refinement, false, true);
  AddPrism(cylinders, 0.25, 1.0, 22 * refinement, 14 * refinement, true, true);
  Scene scene;
  scene.Data = cylinders.Get();
  const Group inner{ 0, 640 * refinement * refinement };
  const Group outer{ inner.End, scene.Data->GetNumberOfCells() };
  scene.Text = "concentric cylinders r = 0.125 and 0.25, length 1, ends open, " +
    std::to_string(inner.End) + " and " + std::to_string(outer.End - outer.Begin) +
    " triangles (error: mostly that of polygons for circles)";
  scene.Factors = { { "F12", inner, outer, 0.910868433008 },
    { "F21", outer, inner, 0.455434216504 }, { "F22", outer, outer, 0.405904210461 } };
  return scene;
}

//------------------------------------------------------------------------------
/// Out of the open ends of a tube: what leaves the inner cylinder reaches the tube or the sphere.
Scene MakeTube()
{
  Surface surface;
  AddPrism(surface, 0.125, 1.0, 20, 16, false, true);
  AddSphere(surface, 3.0, 2, true);
  AddPrism(surface, 0.25, 1.0, 22, 14, true, true);
  Scene scene;
  scene.Data = surface.Get();
  scene.Text = "cylinder r = 0.125 in a tube r = 0.25 in a sphere r = 3, 640, 616 and 320 "
               "triangles: F12 through the ends of the tube (error: mostly that of polygons for "
               "circles), rows of the cylinder";
  scene.Closed = { 0, 640 };
  scene.Factors = { { "F12", { 0, 640 }, { 640, 960 }, 0.089131566992 } };
  return scene;
}

//------------------------------------------------------------------------------
/// Four legs under a rectangle of the floor, up to `height`.
void AddLegs(Surface& surface, const Point& low, const Point& high, double width, double length)
{
  for (int k = 0; k < 4; ++k)
  {
    const double x = k % 2 ? high[0] - width : low[0];
    const double y = k / 2 ? high[1] - width : low[1];
    AddBox(surface, { x, y, low[2] }, { x + width, y + width, high[2] }, length, false);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> ReadPolygons(const std::string& file)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

//------------------------------------------------------------------------------
Scene MakeOpenScene(const std::string& name, vtkSmartPointer<vtkPolyData> data)
{
  Scene scene;
  scene.Data = data;
  scene.Text = name + ", " + std::to_string(data->GetNumberOfCells()) + " triangles";
  return scene;
}

//------------------------------------------------------------------------------
Scene MakeBunny()
{
  return MakeOpenScene("Stanford bunny", ReadPolygons(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply"));
}

#ifdef LIGHTTRANSPORT_HAS_MESHING
//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> Mesh(vtkPolyData* data, double length)
{
  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputData(data);
  mesher->SetTargetEdgeLength(length);
  mesher->Update();
  return mesher->GetOutput();
}

//------------------------------------------------------------------------------
Scene MakeDragon(const std::string& file, double length)
{
  return MakeOpenScene("Stanford dragon", Mesh(ReadPolygons(file), length));
}
#endif
} // end of anonymous namespace

//------------------------------------------------------------------------------
Scene MakeFurnishedRoom(double length)
{
  constexpr double gap = 0.005;
  Surface room;
  vtkNew<vtkIntArray> parts;
  parts->SetName("Part");
  // What was added since the last call is this part.
  const auto end = [&](RoomPart part)
  {
    const vtkIdType cells = room.Get()->GetNumberOfCells();
    while (parts->GetNumberOfTuples() < cells)
    {
      parts->InsertNextValue(part);
    }
  };
  const auto box = [&](const Point& low, const Point& high)
  { AddBox(room, low, high, length, false); };
  AddBox(room, { 0, 0, 0 }, { 5, 4, RoomHeight }, length, true);
  end(ROOM_WALLS);
  // A table with four chairs.
  box({ 1.6, 1.3, 0.72 }, { 3.2, 2.2, 0.75 });
  AddLegs(room, { 1.65, 1.35, gap }, { 3.15, 2.15, 0.72 - gap }, 0.06, length);
  for (int k = 0; k < 4; ++k)
  {
    const double x = k % 2 ? 2.55 : 1.85, y = k / 2 ? 2.3 : 0.8;
    const double back = k / 2 ? y + 0.37 : y;
    box({ x, y, 0.44 }, { x + 0.4, y + 0.4, 0.47 });
    box({ x, back, 0.47 + gap }, { x + 0.4, back + 0.03, 0.95 });
    AddLegs(room, { x, y, gap }, { x + 0.4, y + 0.4, 0.44 - gap }, 0.04, length);
  }
  end(ROOM_TABLE_AND_CHAIRS);
  // A shelf on the wall behind: two sides, a back and five boards.
  box({ 4.6, 0.5, gap }, { 4.98, 0.53, 2.0 });
  box({ 4.6, 2.0, gap }, { 4.98, 2.03, 2.0 });
  box({ 4.96, 0.53 + gap, gap }, { 4.98, 2.0 - gap, 2.0 });
  for (int k = 0; k < 5; ++k)
  {
    const double z = 0.1 + 0.45 * k;
    box({ 4.6, 0.53 + gap, z }, { 4.96 - gap, 2.0 - gap, z + 0.025 });
  }
  end(ROOM_SHELF);
  // A lamp over the table and one that stands in a corner.
  box({ 2.2, 1.55, 1.6 }, { 2.6, 1.95, 1.8 });
  end(ROOM_LAMP);
  box({ 2.39, 1.74, 1.8 + gap }, { 2.41, 1.76, RoomHeight - gap });
  box({ 0.3, 3.3, gap }, { 0.7, 3.7, 0.04 });
  box({ 0.48, 3.48, 0.04 + gap }, { 0.52, 3.52, 1.5 });
  box({ 0.3, 3.3, 1.5 + gap }, { 0.7, 3.7, 1.8 });
  end(ROOM_STANDING_LAMP);
  Scene scene;
  scene.Data = room.Get();
  scene.Data->GetCellData()->AddArray(parts);
  scene.Text = "furnished room, " + std::to_string(scene.Data->GetNumberOfCells()) + " rectangles";
  scene.Closed = { 0, scene.Data->GetNumberOfCells() };
  return scene;
}

#ifdef LIGHTTRANSPORT_HAS_MESHING
//------------------------------------------------------------------------------
Scene MakeCornellBox(double length)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(LIGHTTRANSPORT_DATA_DIRECTORY "/cornell_box.vtp");
  reader->Update();
  return MakeOpenScene("Cornell box", Mesh(reader->GetOutput(), length));
}
#endif

//------------------------------------------------------------------------------
std::vector<Case> GetCases(const std::string& dragon)
{
  const std::vector<double> coarse = { 1e-2, 1e-3, 1e-4 };
  const std::vector<double> fine = { 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8 };
  const std::vector<double> large = { 1e-3, 1e-4 };
  const auto spheres = [](int levels) { return [levels] { return MakeSpheres(levels); }; };
  const auto parallel = [](int count) { return [count] { return MakeParallelPlates(count); }; };
  const auto perpendicular = [](int count)
  { return [count] { return MakePerpendicularPlates(count); }; };
  std::vector<Case> cases = { { "spheres-640", QUICK, coarse, spheres(2) },
    { "spheres-2560", STANDARD, coarse, spheres(3) },
    { "spheres-10240", STANDARD, large, spheres(4) }, { "spheres-40960", ALL, large, spheres(5) },
    { "parallel-221", QUICK, fine, parallel(221) }, { "parallel-921", QUICK, fine, parallel(921) },
    { "parallel-3682", STANDARD, fine, parallel(3682) },
    { "parallel-10034", STANDARD, { 1e-5, 1e-7 }, parallel(10034) },
    { "perpendicular-221", QUICK, fine, perpendicular(221) },
    { "perpendicular-921", QUICK, fine, perpendicular(921) },
    { "perpendicular-3682", STANDARD, fine, perpendicular(3682) },
    { "perpendicular-10034", ALL, { 1e-5, 1e-7 }, perpendicular(10034) },
    { "discs-665", QUICK, { 1e-4, 1e-6 }, [] { return MakeDiscs(665); } },
    { "discs-2796", STANDARD, { 1e-4, 1e-6 }, [] { return MakeDiscs(2796); } },
    { "cylinders-1256", STANDARD, coarse, [] { return MakeCylinders(1); } },
    { "cylinders-5024", ALL, coarse, [] { return MakeCylinders(2); } },
    { "tube-1576", STANDARD, coarse, [] { return MakeTube(); } },
    { "bunny", STANDARD, coarse, [] { return MakeBunny(); } },
    { "room-2000", STANDARD, coarse, [] { return MakeFurnishedRoom(0.28); } },
    { "room-8000", ALL, coarse, [] { return MakeFurnishedRoom(0.12); } } };
#ifdef LIGHTTRANSPORT_HAS_MESHING
  cases.push_back({ "cornell-2000", STANDARD, coarse, [] { return MakeCornellBox(52.0); } });
  cases.push_back({ "cornell-8000", ALL, coarse, [] { return MakeCornellBox(26.0); } });
  if (!dragon.empty())
  {
    cases.push_back(
      { "dragon-9000", STANDARD, coarse, [dragon] { return MakeDragon(dragon, 0.009); } });
    cases.push_back(
      { "dragon-21000", ALL, coarse, [dragon] { return MakeDragon(dragon, 0.0034); } });
  }
#else
  (void)dragon;
#endif
  return cases;
}
} // namespace ViewFactorBenchmark
