// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The scenes of radiosity_peers.py, and plain rays in them.
 *
 * A scene is a file with the cell array "Reflectance" and one of emissions for each light: "lamp"
 * (a small one), "even" (1 everywhere) or "sun" (what a low sun makes a crater reflect). The
 * radiosity by plain rays is written as raw single precision, and told are the CPU seconds of
 * building the tree, casting and solving, and the bytes of the rows.
 */
#include "PlainRays.h"
#include "ViewFactorScenes.h"
#include "vtkDirectIrradiance.h"
#include "vtkLight.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdlib>
#include <ctime>
#include <fstream>

using namespace LightTransportTesting;
using namespace ViewFactorBenchmark;

namespace
{
constexpr const char* Usage =
  "usage: RadiosityPeersBenchmark scene NAME FILE.vtp\n"
  "       RadiosityPeersBenchmark rays FILE.vtp LIGHT SKY RAYS SEED RADIOSITY\n";

using Data = vtkSmartPointer<vtkPolyData>;
using IsLamp = std::function<bool(const Point& middle)>;

//------------------------------------------------------------------------------
/// "even", and "lamp" where there is one.
Data AddMaterials(const Data& scene, double reflectance, const IsLamp& isLamp)
{
  AddArray(scene, "Reflectance", { reflectance });
  AddArray(scene, "even", { 1.0 });
  if (!isLamp)
  {
    return scene;
  }
  vtkDoubleArray* lamp = AddArray(scene, "lamp", { 0.0 });
  for (vtkIdType cell = 0; cell < scene->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    scene->GetCellBounds(cell, bounds);
    const Point middle = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
      0.5 * (bounds[4] + bounds[5]) };
    lamp->SetValue(cell, isLamp(middle) ? 1.0 : 0.0);
  }
  return scene;
}

//------------------------------------------------------------------------------
/// Concentric ones; the lamp is a cap of the outer one, 2 % of all.
Data MakeSphereScene(const std::string& name)
{
  for (const Case& known : GetCases(""))
  {
    if (known.Name == name)
    {
      return AddMaterials(known.Make().Data, 0.7,
        [](const Point& middle) { return middle[2] > 2.85; });
    }
  }
  return nullptr;
}

#ifdef LIGHTTRANSPORT_HAS_MESHING
//------------------------------------------------------------------------------
/// All of one reflectance.
Data MakeCornellScene()
{
  const Data box = MakeCornellBox(45.0).Data;
  const vtkSmartPointer<vtkDataArray> given = box->GetCellData()->GetArray("Emission");
  box->GetCellData()->Initialize();
  AddMaterials(box, 0.7, nullptr);
  vtkDoubleArray* lamp = AddArray(box, "lamp", { 0.0 });
  for (vtkIdType cell = 0; cell < box->GetNumberOfCells(); ++cell)
  {
    lamp->SetValue(cell, given->GetComponent(cell, 0) > 0.0 ? 1.0 : 0.0);
  }
  return box;
}
#endif

//------------------------------------------------------------------------------
/// The lamp over the table shines.
Data MakeRoomScene(double length, double reflectance)
{
  return AddMaterials(MakeFurnishedRoom(length).Data, reflectance,
    [](const Point& middle)
    {
      return middle[0] > 2.19 && middle[0] < 2.61 && middle[1] > 1.54 && middle[1] < 1.96 &&
        middle[2] > 1.59 && middle[2] < 1.81;
    });
}

//------------------------------------------------------------------------------
/// 36 houses on a square, under the open sky; `cuts` per 10 m. A window of one of them is lit.
Data MakeCity(int cuts)
{
  constexpr int rows = 6;
  constexpr double wide = 10.0, storey = 2.5;
  const double step = wide / cuts;
  Surface city;
  for (int x = 0; x < 2 * rows; ++x)
  {
    for (int y = 0; y < 2 * rows; ++y)
    {
      const bool isHouse = x % 2 == 1 && y % 2 == 1;
      const int house = rows * (x / 2) + y / 2;
      const double height = isHouse ? storey * (2 + (7 * house) % 10) : 0.0;
      const Point low = { wide * x, wide * y, 0.0 };
      const Point high = { wide * (x + 1), wide * (y + 1), height };
      const Point along = { wide, 0, 0 }, across = { 0, wide, 0 }, up = { 0, 0, height };
      city.AddGrid({ low[0], low[1], height }, along, across, cuts, cuts);
      if (isHouse)
      {
        const int storeys = static_cast<int>(std::round(height / step));
        city.AddGrid(low, along, up, cuts, storeys);
        city.AddGrid({ low[0], high[1], 0.0 }, up, along, storeys, cuts);
        city.AddGrid(low, up, across, storeys, cuts);
        city.AddGrid({ high[0], low[1], 0.0 }, across, up, cuts, storeys);
      }
    }
  }
  return AddMaterials(city.Get(), 0.6,
    [](const Point& middle)
    {
      return middle[0] > 52.5 && middle[0] < 57.5 && middle[1] == 50.0 && middle[2] > 2.5 &&
        middle[2] < 5.0;
    });
}

//------------------------------------------------------------------------------
/// A bowl in a plain, half of the patches each, lit by a sun 10 degrees high.
Data MakeCrater()
{
  constexpr int rings = 20, sectors = 41;
  constexpr double depth = 0.4, reflectance = 0.3, elevation = 10.0;
  const auto at = [=](int ring, int sector)
  {
    const double angle = 2.0 * vtkMath::Pi() * (sector % sectors) / sectors;
    const double radius =
      ring <= rings ? static_cast<double>(ring) / rings : 1.0 + 2.0 * (ring - rings) / rings;
    const double height = ring < rings ? depth * (radius * radius - 1.0) : 0.0;
    return Point{ radius * std::cos(angle), radius * std::sin(angle), height };
  };
  Surface crater;
  for (int sector = 0; sector < sectors; ++sector)
  {
    crater.AddPolygon({ at(0, 0), at(1, sector), at(1, sector + 1) });
    for (int ring = 1; ring < 2 * rings; ++ring)
    {
      const Point a = at(ring, sector), b = at(ring + 1, sector), c = at(ring + 1, sector + 1),
                  d = at(ring, sector + 1);
      crater.AddPolygon({ a, b, c });
      crater.AddPolygon({ a, c, d });
    }
  }
  Data scene = crater.Get();
  vtkNew<vtkLight> sun;
  const double height = vtkMath::RadiansFromDegrees(elevation);
  sun->SetPosition(std::cos(height), 0.0, std::sin(height));
  vtkNew<vtkDirectIrradiance> irradiance;
  irradiance->AddLight(sun);
  irradiance->SetInputData(scene);
  irradiance->Update();
  vtkDataArray* direct =
    irradiance->GetPolyDataOutput()->GetCellData()->GetArray("DirectIrradiance");
  AddArray(scene, "Reflectance", { reflectance });
  vtkDoubleArray* reflected = AddArray(scene, "sun", { 0.0 });
  for (vtkIdType cell = 0; direct && cell < scene->GetNumberOfCells(); ++cell)
  {
    reflected->SetValue(cell, reflectance * direct->GetComponent(cell, 0));
  }
  return scene;
}

//------------------------------------------------------------------------------
/// Null where there is none of that name.
Data MakeScene(const std::string& name)
{
  const std::map<std::string, std::function<Data()>> makers = {
#ifdef LIGHTTRANSPORT_HAS_MESHING
    { "cornell-2000", [] { return MakeCornellScene(); } },
#endif
    { "room-3200", [] { return MakeRoomScene(0.214, 0.7); } },
    { "room-8000", [] { return MakeRoomScene(0.12, 0.7); } },
    { "white-room-2000", [] { return MakeRoomScene(0.28, 0.95); } },
    { "city-6000", [] { return MakeCity(4); } }, { "city-24000", [] { return MakeCity(8); } },
    { "city-96000", [] { return MakeCity(16); } }, { "city-1000000", [] { return MakeCity(52); } },
    { "crater-3200", [] { return MakeCrater(); } }
  };
  const auto maker = makers.find(name);
  return maker != makers.end() ? maker->second() : MakeSphereScene(name);
}

//------------------------------------------------------------------------------
bool WriteScene(const std::string& name, const std::string& file)
{
  const Data scene = MakeScene(name);
  if (!scene)
  {
    std::cerr << "There is no scene " << name << " in this build.\n";
    return false;
  }
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(scene);
  return writer->Write() == 1;
}

//------------------------------------------------------------------------------
PlainRays::Values GetSingle(vtkPolyData* scene, const std::string& name)
{
  vtkDataArray* array = scene->GetCellData()->GetArray(name.c_str());
  PlainRays::Values values(scene->GetNumberOfCells(), 0.0f);
  for (std::size_t cell = 0; array && cell < values.size(); ++cell)
  {
    values[cell] = static_cast<float>(array->GetComponent(static_cast<vtkIdType>(cell), 0));
  }
  return values;
}

//------------------------------------------------------------------------------
bool CastRays(char* arguments[])
{
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(arguments[0]);
  reader->Update();
  vtkPolyData* scene = reader->GetOutput();
  const auto emission = GetSingle(scene, arguments[1]);
  const auto reflectance = GetSingle(scene, "Reflectance");
  const auto sky = static_cast<float>(std::atof(arguments[2]));
  const auto rays = static_cast<std::uint32_t>(std::max(16, std::atoi(arguments[3]) / 16 * 16));
  const auto seed = static_cast<std::uint32_t>(std::atoi(arguments[4]));
  const std::clock_t begin = std::clock();
  PlainRays program(scene);
  const auto radiosity = program.Solve(rays, seed, emission, reflectance, sky);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::cout << seconds << " " << 8 * program.GetNumberOfEntries() << "\n";
  std::ofstream file(arguments[5], std::ios::binary);
  file.write(reinterpret_cast<const char*>(radiosity.data()),
    static_cast<std::streamsize>(radiosity.size() * sizeof(float)));
  return file.good();
}
} // end of anonymous namespace

//------------------------------------------------------------------------------
int main(int argc, char* argv[])
{
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "scene" && argc == 4)
  {
    return WriteScene(argv[2], argv[3]) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  if (command == "rays" && argc == 8)
  {
    return CastRays(argv + 2) ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  std::cerr << Usage;
  return EXIT_FAILURE;
}
