// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// The Cornell box of the Data folder against the published measurements, as it is and remeshed.
#include "MeshTestTools.h"

#include "vtkXMLPolyDataReader.h"

namespace
{
enum Regions
{
  FLOOR,
  CEILING,
  BACK,
  LEFT,
  RIGHT,
  LAMP,
  SHORT_BLOCK,
  TALL_BLOCK,
  NUMBER_OF_REGIONS
};

//------------------------------------------------------------------------------
// Area of a polygon in the plane.
double GetPlaneArea(const std::vector<std::array<double, 2>>& p)
{
  double area = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const auto& q = p[(i + 1) % p.size()];
    area += 0.5 * (p[i][0] * q[1] - p[i][1] * q[0]);
  }
  return std::abs(area);
}

//------------------------------------------------------------------------------
double GetPerimeter(const std::vector<std::array<double, 2>>& p)
{
  double length = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const auto& q = p[(i + 1) % p.size()];
    length += std::hypot(q[0] - p[i][0], q[1] - p[i][1]);
  }
  return length;
}

//------------------------------------------------------------------------------
std::array<double, NUMBER_OF_REGIONS> GetPublishedAreas()
{
  const double height = 548.8;
  const double depth = 559.2;
  const std::vector<std::array<double, 2>> shortTop = { { 130, 65 }, { 82, 225 }, { 240, 272 },
    { 290, 114 } };
  const std::vector<std::array<double, 2>> tallTop = { { 423, 247 }, { 265, 296 }, { 314, 456 },
    { 472, 406 } };
  const double lamp = 130.0 * 105.0;
  std::array<double, NUMBER_OF_REGIONS> areas;
  areas[FLOOR] = 0.5 * (552.8 + 549.6) * depth - GetPlaneArea(shortTop) - GetPlaneArea(tallTop);
  areas[CEILING] = 556.0 * depth - lamp;
  areas[BACK] = 0.5 * (549.6 + 556.0) * height;
  // The two triangles of a wall whose corners do not lie in one plane.
  areas[LEFT] = 306904.51438644;
  areas[RIGHT] = height * depth;
  areas[LAMP] = lamp;
  areas[SHORT_BLOCK] = GetPlaneArea(shortTop) + 165.0 * GetPerimeter(shortTop);
  areas[TALL_BLOCK] = GetPlaneArea(tallTop) + 330.0 * GetPerimeter(tallTop);
  return areas;
}

//------------------------------------------------------------------------------
void CheckShape(vtkPolyData* box, double leftTolerance, meshTest::Checker& check)
{
  const auto published = GetPublishedAreas();
  std::map<int, double> areas = meshTest::GetAreas(box, "Region");
  check.Equal(areas.size(), NUMBER_OF_REGIONS, 0, "number of regions");
  for (int i = 0; i < NUMBER_OF_REGIONS; ++i)
  {
    const double tolerance = i == LEFT ? leftTolerance : 1e-12;
    check.Equal(areas[i] / published[i], 1.0, tolerance, "area of region " + std::to_string(i));
  }

  const meshTest::Edges edges = meshTest::GetEdges(box);
  check.Equal(edges.Bad, 0, 0, "bad edges");
  double length = 0.0;
  for (const auto& edge : edges.Borders)
  {
    const meshTest::Vector p = meshTest::GetPoint(box, edge.first);
    const meshTest::Vector q = meshTest::GetPoint(box, edge.second);
    check.True(p[2] == 0.0 && q[2] == 0.0, "open only at the front");
    length += std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), q.data()));
  }
  check.Equal(length, 552.8 + 556.0 + 548.8 + std::hypot(3.2, 548.8), 1e-9, "rim of the opening");

  // Mean normals: into the room, and up from the blocks (their sides cancel).
  const std::array<meshTest::Vector, NUMBER_OF_REGIONS> directions = { { { 0, 1, 0 }, { 0, -1, 0 },
    { 0, 0, -1 }, { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 1, 0 } } };
  std::array<double, NUMBER_OF_REGIONS> along{};
  vtkDataArray* regions = box->GetCellData()->GetArray("Region");
  for (vtkIdType i = 0; i < box->GetNumberOfCells(); ++i)
  {
    const int region = static_cast<int>(regions->GetTuple1(i));
    along[region] +=
      vtkMath::Dot(meshTest::GetAreaVector(box, i).data(), directions[region].data());
  }
  for (int i = FLOOR; i <= LAMP; ++i)
  {
    check.Equal(along[i] / published[i], 1.0, 1e-4, "direction of region " + std::to_string(i));
  }
  check.Equal(along[SHORT_BLOCK], 27633.0, 1e-6, "top of the short block");
  check.Equal(along[TALL_BLOCK], 27626.5, 1e-6, "top of the tall block");
}

//------------------------------------------------------------------------------
// No point lies within a side of another patch: the surface would have cracks there.
void CheckNoTJunction(vtkPolyData* box, meshTest::Checker& check)
{
  for (vtkIdType cell = 0; cell < box->GetNumberOfCells(); ++cell)
  {
    vtkIdType size;
    const vtkIdType* ids;
    box->GetCellPoints(cell, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      const meshTest::Vector p = meshTest::GetPoint(box, ids[i]);
      const meshTest::Vector q = meshTest::GetPoint(box, ids[(i + 1) % size]);
      const double length = std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), q.data()));
      for (vtkIdType j = 0; j < box->GetNumberOfPoints(); ++j)
      {
        const meshTest::Vector r = meshTest::GetPoint(box, j);
        const double detour = std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), r.data())) +
          std::sqrt(vtkMath::Distance2BetweenPoints(q.data(), r.data())) - length;
        if (j != ids[i] && j != ids[(i + 1) % size] && detour < 1e-9)
        {
          check.True(false, "point " + std::to_string(j) + " lies on a side of a patch");
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void CheckMaterials(vtkPolyData* box, meshTest::Checker& check)
{
  vtkDataArray* regions = box->GetCellData()->GetArray("Region");
  vtkDataArray* emission = box->GetCellData()->GetArray("Emission");
  vtkDataArray* reflectance = box->GetCellData()->GetArray("Reflectance");
  check.True(emission && emission->GetNumberOfComponents() == 3, "Emission");
  check.True(reflectance && reflectance->GetNumberOfComponents() == 3, "Reflectance");
  if (!emission || !reflectance)
  {
    return;
  }
  const meshTest::Vector white{ 0.73374, 0.73566, 0.70592 };
  const meshTest::Vector red{ 0.58054, 0.08778, 0.0566 };
  const meshTest::Vector green{ 0.13186, 0.34834, 0.11746 };
  const meshTest::Vector lamp{ 0.78, 0.78, 0.78 };
  for (vtkIdType i = 0; i < box->GetNumberOfCells(); ++i)
  {
    const int region = static_cast<int>(regions->GetTuple1(i));
    const meshTest::Vector paint =
      region == LEFT ? red : (region == RIGHT ? green : (region == LAMP ? lamp : white));
    // The lamp's spectrum is linear between 0, 8, 15.6 and 18.4.
    const meshTest::Vector light =
      region == LAMP ? meshTest::Vector{ 17.0, 11.8, 4.0 } : meshTest::Vector{ 0.0, 0.0, 0.0 };
    for (int j = 0; j < 3; ++j)
    {
      check.Equal(reflectance->GetComponent(i, j), paint[j], 1e-9, "reflectance");
      check.Equal(emission->GetComponent(i, j), light[j], 1e-9, "emission");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestCornellBox(int argc, char* argv[])
{
  meshTest::Checker check;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(meshTest::GetDataFile(argc, argv, "cornell_box.vtp").c_str());
  reader->Update();
  CheckShape(reader->GetOutput(), 1e-12, check);
  CheckNoTJunction(reader->GetOutput(), check);
  CheckMaterials(reader->GetOutput(), check);

  vtkNew<vtkPatchMesher> mesher;
  mesher->SetInputConnection(reader->GetOutputPort());
  mesher->SetTargetEdgeLength(46.0);
  mesher->SetRepair(false);
  mesher->Update();
  vtkPolyData* patches = mesher->GetOutput();
  std::cout << patches->GetNumberOfCells() << " patches\n";
  check.True(patches->GetNumberOfCells() >= 1800 && patches->GetNumberOfCells() <= 2200,
    "about 2,000 patches");
  CheckShape(patches, 1e-5, check);
  CheckNoTJunction(patches, check);
  CheckMaterials(patches, check);
  return check.GetExitCode();
}
