// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Several lights on one body as components of one array of vtkSubsurfaceScattering: each comes out
// as if it were alone, by all links, of surfaces and texels, on one rank and several.
#include "LightTransportTesting.h"
#include "MessageLog.h"
#include "RanksInThreads.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace LightTransportTesting;

namespace
{
constexpr int Bands = 3;
constexpr const char* Irradiance = "Irradiance";
using Scattering = vtkSubsurfaceScattering;
using Values = std::vector<double>;

//------------------------------------------------------------------------------
/// Of light `light`, differently in each band.
double GetLight(vtkIdType patch, int light, int band)
{
  return 1.0 + std::sin(0.37 * static_cast<double>(patch) * (light + 1) + band);
}

//------------------------------------------------------------------------------
/// Lights [first, last).
void SetLights(vtkDataSetAttributes* data, vtkIdType patches, int first, int last)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(Irradiance);
  array->SetNumberOfComponents((last - first) * Bands);
  array->SetNumberOfTuples(patches);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    for (int light = first; light < last; ++light)
    {
      for (int band = 0; band < Bands; ++band)
      {
        array->SetComponent(patch, (light - first) * Bands + band, GetLight(patch, light, band));
      }
    }
  }
  data->AddArray(array);
}

//------------------------------------------------------------------------------
vtkSmartPointer<Scattering> MakeFilter(vtkDataObject* data, int method)
{
  auto filter = vtkSmartPointer<Scattering>::New();
  filter->SetInputDataObject(data);
  filter->SetMaterialToMarble();
  filter->SetMillimetersPerUnit(3.0);
  filter->SetDeviceToCPU();
  filter->SetLinkMethod(method);
  return filter;
}

//------------------------------------------------------------------------------
/// Components of `count` lights from light `first` on.
Values GetComponents(vtkDataArray* array, int first, int count)
{
  Values values;
  Check(array && array->GetNumberOfComponents() >= Bands * (first + count), "there are components");
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    for (int component = first * Bands; component < (first + count) * Bands; ++component)
    {
      values.push_back(array->GetComponent(k, component));
    }
  }
  return values;
}

//------------------------------------------------------------------------------
void CheckSame(const Values& found, const Values& expected, double tolerance,
  const std::string& what)
{
  double worst = found.size() == expected.size() && !found.empty() ? 0.0 : HUGE_VAL;
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(found.size(), expected.size()); ++k)
  {
    worst = std::max(worst, std::abs(found[k] - expected[k]));
    largest = std::max(largest, std::abs(expected[k]));
  }
  Check(worst <= tolerance * largest, what + " is off by " + std::to_string(worst / largest));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> MakeBody()
{
  Surface surface;
  AddSphere(surface, 1.0, 2, false);
  return surface.Get();
}

//------------------------------------------------------------------------------
/// `filter` with `lights` at once against each of them alone. Links from clusters are summed in the
/// same order, so that not a bit differs.
void TestLights(Scattering* filter, vtkPolyData* body, int lights, double tolerance,
  const std::string& name)
{
  SetLights(body->GetCellData(), body->GetNumberOfCells(), 0, lights);
  filter->SetInputData(body);
  filter->Update();
  vtkNew<vtkPolyData> all;
  all->DeepCopy(filter->GetPolyDataOutput());
  for (int light = 0; light < lights; ++light)
  {
    vtkNew<vtkPolyData> alone;
    alone->ShallowCopy(body);
    SetLights(alone->GetCellData(), body->GetNumberOfCells(), light, light + 1);
    filter->SetInputData(alone);
    filter->Update();
    vtkPolyData* one = filter->GetPolyDataOutput();
    const std::string what =
      name + ", light " + std::to_string(light) + " of " + std::to_string(lights) + ": ";
    const auto check = [&](vtkDataArray* found, vtkDataArray* expected, const std::string& array)
    {
      Check(found && found->GetNumberOfComponents() == lights * Bands, what + array + " is of all");
      CheckSame(GetComponents(found, light, 1), GetComponents(expected, 0, 1), tolerance,
        what + array);
    };
    for (const char* array : { "ScatteredIrradiance", "ScatteredIrradianceError" })
    {
      if (one->GetCellData()->HasArray(array))
      {
        check(all->GetCellData()->GetArray(array), one->GetCellData()->GetArray(array), array);
        check(all->GetPointData()->GetArray(array), one->GetPointData()->GetArray(array), array);
      }
    }
    for (const char* array : { "EnteringFlux", "LeavingFlux", "LinksThroughAir" })
    {
      if (one->GetFieldData()->HasArray(array))
      {
        check(all->GetFieldData()->GetArray(array), one->GetFieldData()->GetArray(array), array);
      }
    }
    Check(GetSummary(one, "LinksReused") == 1.0, what + "links are kept");
  }
}

//------------------------------------------------------------------------------
void TestMethods()
{
  auto body = MakeBody();
  for (const int lights : { 2, 3, 5, 11 })
  {
    auto uniform = MakeFilter(body, Scattering::LINK_METHOD_UNIFORM);
    TestLights(uniform, body, lights, 0.0, "uniform");
    auto adaptive = MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE);
    TestLights(adaptive, body, lights, 0.0, "adaptive");
    auto compressed = MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE);
    compressed->CompressLinksOn();
    compressed->SetCompressionTolerance(0.01);
    TestLights(compressed, body, lights, 0.0, "compressed");
  }
  auto pairs = MakeFilter(body, Scattering::LINK_METHOD_DENSE);
  TestLights(pairs, body, 11, 1e-14, "pairs");
  auto photons = MakeFilter(body, Scattering::LINK_METHOD_DENSE);
  photons->SetModelToMonteCarlo();
  photons->SetNumberOfPhotons(2000);
  TestLights(photons, body, 5, 1e-13, "photons");
}

//------------------------------------------------------------------------------
/// One component is the same in all bands; what belongs to no light is refused, and so are photons
/// of several.
void TestComponents()
{
  auto body = MakeBody();
  const auto expect = [&](Scattering* filter, int components, const std::string& part)
  {
    AddArray(body, Irradiance, Values(components, 1.0));
    vtkNew<MessageLog> errors;
    filter->AddObserver(vtkCommand::ErrorEvent, errors);
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, vtkNew<MessageLog>());
    filter->Update();
    Check(errors->GetAll().find(part) != std::string::npos,
      std::to_string(components) + " components: " + errors->GetAll());
  };
  for (const int components : { 2, 4, 7 })
  {
    expect(MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE), components,
      "or 3 for each of several lights");
  }
  auto photons = MakeFilter(body, Scattering::LINK_METHOD_AUTO);
  photons->SetModelToMonteCarlo();
  expect(photons, 6, "set LinkMethod to Dense");
}

//------------------------------------------------------------------------------
/// A flat sheet of texels.
vtkSmartPointer<vtkImageData> MakeTexels(int side)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(side, side, 1);
  const auto add = [&](vtkDataArray* array, const char* name, int components)
  {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(image->GetNumberOfPoints());
    array->Fill(0.0);
    image->GetPointData()->AddArray(array);
  };
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkDoubleArray> normals;
  vtkNew<vtkDoubleArray> areas;
  vtkNew<vtkIntArray> charts;
  add(positions, "Position", 3);
  add(normals, "Normal", 3);
  add(areas, "Area", 1);
  add(charts, "ChartId", 1);
  for (vtkIdType texel = 0; texel < image->GetNumberOfPoints(); ++texel)
  {
    positions->SetTuple3(texel, static_cast<double>(texel % side),
      static_cast<double>(texel / side), 0.0);
    normals->SetComponent(texel, 2, 1.0);
    areas->SetValue(texel, 1.0);
  }
  return image;
}

//------------------------------------------------------------------------------
void TestTexels()
{
  auto image = MakeTexels(12);
  const auto scatter = [&](int first, int last)
  {
    SetLights(image->GetPointData(), image->GetNumberOfPoints(), first, last);
    auto filter = MakeFilter(image, Scattering::LINK_METHOD_UNIFORM);
    filter->Update();
    return GetComponents(
      filter->GetImageDataOutput()->GetPointData()->GetArray("ScatteredIrradiance"), 0,
      last - first);
  };
  const Values both = scatter(0, 2);
  const Values first = scatter(0, 1);
  const Values second = scatter(1, 2);
  Values expected;
  for (std::size_t k = 0; k < first.size(); k += Bands)
  {
    expected.insert(expected.end(), &first[k], &first[k] + Bands);
    expected.insert(expected.end(), &second[k], &second[k] + Bands);
  }
  CheckSame(both, expected, 0.0, "texels in two lights");
}

//------------------------------------------------------------------------------
/// As one body, in two blocks and on three ranks, one of them empty. Last: ranks make vtkSMPTools
/// sequential.
void TestParts()
{
  constexpr int lights = 3;
  auto body = MakeBody();
  const vtkIdType cells = body->GetNumberOfCells();
  SetLights(body->GetCellData(), cells, 0, lights);
  auto whole = MakeFilter(body, Scattering::LINK_METHOD_ADAPTIVE);
  whole->Update();
  const Values leaving =
    GetComponents(whole->GetPolyDataOutput()->GetFieldData()->GetArray("LeavingFlux"), 0, lights);
  const auto makePart = [&](bool isFirst, bool isEmpty)
  {
    auto part = vtkSmartPointer<vtkPolyData>::New();
    part->DeepCopy(body);
    part->BuildLinks();
    for (vtkIdType cell = 0; cell < cells; ++cell)
    {
      if (isEmpty || (cell < cells / 3) != isFirst)
      {
        part->DeleteCell(cell);
      }
    }
    part->RemoveDeletedCells();
    return part;
  };
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, makePart(true, false));
  blocks->SetBlock(1, makePart(false, false));
  auto ofBlocks = MakeFilter(blocks, Scattering::LINK_METHOD_ADAPTIVE);
  ofBlocks->Update();
  CheckSame(GetComponents(ofBlocks->GetOutputDataObject(0)->GetFieldData()->GetArray("LeavingFlux"),
              0, lights),
    leaving, 1e-12, "light of two blocks");
  RunRanks(3,
    [&](vtkMultiProcessController* controller, int rank)
    {
      auto filter = MakeFilter(makePart(rank == 0, rank == 2), Scattering::LINK_METHOD_ADAPTIVE);
      filter->SetController(controller);
      filter->Update();
      CheckSame(GetComponents(filter->GetPolyDataOutput()->GetFieldData()->GetArray("LeavingFlux"),
                  0, lights),
        leaving, 1e-12, "light of three ranks");
    });
}
} // namespace

//------------------------------------------------------------------------------
int TestManyLights(int, char*[])
{
  TestMethods();
  TestComponents();
  TestTexels();
  TestParts();
  return Result();
}
