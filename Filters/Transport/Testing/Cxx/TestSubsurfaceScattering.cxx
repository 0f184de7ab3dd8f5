// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Spheres in uniform light against their exact value, and the properties of the filter.
#include "LightTransportTesting.h"
#include "Scattering/DipoleProfile.h"
#include "Scattering/ScatteringModels.h"
#include "vtkDirectIrradiance.h"
#include "vtkLight.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkSMPTools.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTable.h"
#include "vtkTestErrorObserver.h"

#include <algorithm>

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
constexpr double Scattering[3] = { 0.99, 0.9, 0.5 };
constexpr double Absorption[3] = { 0.01, 0.1, 0.5 };

//------------------------------------------------------------------------------
double GetArea(vtkPolyData* data, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  data->GetCellPoints(cell, ids);
  double sum[3] = {};
  for (vtkIdType k = 2; k < ids->GetNumberOfIds(); ++k)
  {
    double a[3], b[3], c[3], cross[3];
    data->GetPoint(ids->GetId(0), a);
    data->GetPoint(ids->GetId(k - 1), b);
    data->GetPoint(ids->GetId(k), c);
    vtkMath::Subtract(b, a, b);
    vtkMath::Subtract(c, a, c);
    vtkMath::Cross(b, c, cross);
    vtkMath::Add(sum, cross, sum);
  }
  return 0.5 * vtkMath::Norm(sum);
}

//------------------------------------------------------------------------------
/// A sphere of flat patches with the area of the round one of radius 1.
vtkSmartPointer<vtkPolyData> MakeSphere(int levels)
{
  Surface rough;
  AddSphere(rough, 1.0, levels, false);
  auto data = rough.Get();
  double area = 0.0;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    area += GetArea(data, cell);
  }
  Surface sphere;
  AddSphere(sphere, std::sqrt(4.0 * vtkMath::Pi() / area), levels, false);
  data = sphere.Get();
  AddArray(data, "TransmittedIrradiance", { 1.0 });
  return data;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkSubsurfaceScattering> MakeFilter(vtkPolyData* data)
{
  auto filter = vtkSmartPointer<vtkSubsurfaceScattering>::New();
  filter->SetInputData(data);
  filter->SetScatteringCoefficient(Scattering);
  filter->SetAbsorptionCoefficient(Absorption);
  filter->SetIncidenceToTransmitted();
  filter->SetModelToDipole();
  filter->SetDeviceToCPU();
  return filter;
}

//------------------------------------------------------------------------------
vtkDataArray* GetScattered(vtkSubsurfaceScattering* filter)
{
  filter->Update();
  vtkDataArray* array = filter->GetPolyDataOutput()->GetCellData()->GetArray("ScatteredIrradiance");
  Check(array && array->GetNumberOfComponents() == 3, "ScatteredIrradiance on cells");
  return array;
}

//------------------------------------------------------------------------------
/// Area-weighted mean over the surface of what the filter gives in a band.
double GetMean(vtkSubsurfaceScattering* filter, int band)
{
  vtkDataArray* array = GetScattered(filter);
  vtkPolyData* output = filter->GetPolyDataOutput();
  double sum = 0.0;
  double total = 0.0;
  for (vtkIdType cell = 0; array && cell < output->GetNumberOfCells(); ++cell)
  {
    const double area = GetArea(output, cell);
    sum += area * array->GetComponent(cell, band);
    total += area;
  }
  return sum / total;
}

//------------------------------------------------------------------------------
/// On a sphere the area between two distances from a point grows as in the plane, so uniform light
/// 1 gives exactly the profile's total less its tail beyond the diameter.
double GetExact(int band, double radius, int model = vtkSubsurfaceScattering::MODEL_DIPOLE)
{
  const auto profile =
    ScatteringModels::Find(model)->MakeProfile({ Scattering[band], Absorption[band], 1.3 }, {});
  return profile->GetTotal() - profile->GetTail(2.0 * radius);
}

//------------------------------------------------------------------------------
void TestSphere(double radius, int levels, double linkTolerance)
{
  auto filter = MakeFilter(MakeSphere(levels));
  filter->SetMillimetersPerUnit(radius);
  filter->SetLinkMethodToDense(); // which bounds the error
  filter->SetLinkTolerance(linkTolerance);
  for (int band = 0; band < 3; ++band)
  {
    const double exact = GetExact(band, radius);
    const std::string what =
      "sphere of radius " + std::to_string(radius) + ", band " + std::to_string(band);
    CheckClose(GetMean(filter, band), exact, 1e-3, what);
    double range[2];
    GetScattered(filter)->GetRange(range, band);
    CheckClose(range[0], exact, 2e-3, what + " smallest");
    CheckClose(range[1], exact, 2e-3, what + " largest");
  }
  Check(GetSummary(filter->GetOutput(), "LinkErrorBound") <= linkTolerance,
    "error bound within the tolerance");
}

//------------------------------------------------------------------------------
/// Flat patches err with the square of their size, which extrapolation removes: what is left is the
/// error of the links.
void TestExtrapolatedSphere(double radius, int model = vtkSubsurfaceScattering::MODEL_DIPOLE)
{
  auto coarse = MakeFilter(MakeSphere(2));
  auto fine = MakeFilter(MakeSphere(3));
  coarse->SetModel(model);
  fine->SetModel(model);
  coarse->SetMillimetersPerUnit(radius);
  fine->SetMillimetersPerUnit(radius);
  for (int band = 0; band < 3; ++band)
  {
    const double value = (4.0 * GetMean(fine, band) - GetMean(coarse, band)) / 3.0;
    CheckClose(value, GetExact(band, radius, model), 1e-3,
      "extrapolated sphere of radius " + std::to_string(radius) + ", band " + std::to_string(band) +
        ", model " + std::to_string(model));
  }
}

//------------------------------------------------------------------------------
double GetLargestDifference(vtkDataArray* a, vtkDataArray* b, double factor = 1.0)
{
  double largest = 0.0;
  double scale = 0.0;
  for (vtkIdType k = 0; k < a->GetNumberOfTuples(); ++k)
  {
    for (int band = 0; band < 3; ++band)
    {
      const double value = factor * b->GetComponent(k, band);
      largest = std::max(largest, std::abs(a->GetComponent(k, band) - value));
      scale = std::max(scale, std::abs(value));
    }
  }
  return largest / scale;
}

//------------------------------------------------------------------------------
void TestMaterials()
{
  auto sphere = MakeSphere(2);
  auto preset = MakeFilter(sphere);
  preset->SetMaterialToMarble();
  preset->SetMillimetersPerUnit(3.0);
  auto custom = MakeFilter(sphere);
  custom->SetScatteringCoefficient(2.19, 2.62, 3.0);
  custom->SetAbsorptionCoefficient(0.0021, 0.0041, 0.0071);
  custom->SetRefractiveIndex(1.5);
  custom->SetMillimetersPerUnit(3.0);
  Check(GetLargestDifference(GetScattered(preset), GetScattered(custom)) == 0.0,
    "a preset gives what its coefficients give");
  custom->SetRefractiveIndex(1.3);
  Check(GetLargestDifference(GetScattered(preset), GetScattered(custom)) > 0.01,
    "the refractive index matters");
}

//------------------------------------------------------------------------------
void TestIncidence()
{
  auto sphere = MakeSphere(1);
  AddArray(sphere, "Irradiance", { 1.0, 2.0, 0.0 });
  AddArray(sphere, "Mine", { 1.0, 2.0, 0.0 });
  auto transmitted = MakeFilter(sphere);
  transmitted->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Mine");
  auto diffuse = MakeFilter(sphere);
  diffuse->SetIncidenceToDiffuse();
  const double external = 0.061132;
  CheckClose(GetLargestDifference(GetScattered(diffuse), GetScattered(transmitted), 1.0 - external),
    0.0, 1e-6, "diffuse light loses the mean external reflectance");
  double range[2];
  GetScattered(diffuse)->GetRange(range, 2);
  Check(range[0] == 0.0 && range[1] == 0.0, "no light, no scattering");
  vtkPolyData* output = diffuse->GetPolyDataOutput();
  for (const char* name : { "Irradiance", "TransmittedIrradiance", "Mine" })
  {
    Check(output->GetCellData()->HasArray(name), std::string("kept ") + name);
  }
  vtkDataArray* points = output->GetPointData()->GetArray("ScatteredIrradiance");
  Check(points && points->GetNumberOfComponents() == 3 &&
      points->GetNumberOfTuples() == output->GetNumberOfPoints(),
    "ScatteredIrradiance on points");
}

//------------------------------------------------------------------------------
/// The same body in other units, in quadrilaterals, and with links made anew or kept.
void TestInvariance()
{
  Surface small, large, triangles;
  const auto addBox = [](Surface& surface, double s, int cuts)
  {
    surface.AddGrid({ 0, 0, 0 }, { 0, s, 0 }, { s, 0, 0 }, cuts, cuts);
    surface.AddGrid({ 0, 0, s }, { s, 0, 0 }, { 0, s, 0 }, cuts, cuts);
    surface.AddGrid({ 0, 0, 0 }, { s, 0, 0 }, { 0, 0, s }, cuts, cuts);
    surface.AddGrid({ 0, s, 0 }, { 0, 0, s }, { s, 0, 0 }, cuts, cuts);
    surface.AddGrid({ 0, 0, 0 }, { 0, 0, s }, { 0, s, 0 }, cuts, cuts);
    surface.AddGrid({ s, 0, 0 }, { 0, s, 0 }, { 0, 0, s }, cuts, cuts);
  };
  addBox(small, 1.0, 4);
  addBox(large, 1000.0, 4);
  auto smallData = small.Get();
  auto largeData = large.Get();
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < smallData->GetNumberOfCells(); ++cell)
  {
    smallData->GetCellPoints(cell, ids);
    Point corners[4];
    for (int k = 0; k < 4; ++k)
    {
      smallData->GetPoint(ids->GetId(k), corners[k].data());
    }
    triangles.AddPolygon({ corners[1], corners[2], corners[3] });
    triangles.AddPolygon({ corners[1], corners[3], corners[0] });
  }
  auto triangleData = triangles.Get();
  for (vtkPolyData* data : { smallData.Get(), largeData.Get(), triangleData.Get() })
  {
    // Light on the first face only.
    vtkDoubleArray* light = AddArray(data, "TransmittedIrradiance", { 0.0 });
    for (vtkIdType cell = 0; cell < data->GetNumberOfCells() / 6; ++cell)
    {
      light->SetValue(cell, 1.0);
    }
  }
  auto first = MakeFilter(smallData);
  first->SetMillimetersPerUnit(20.0);
  auto second = MakeFilter(largeData);
  second->SetMillimetersPerUnit(0.02);
  CheckClose(GetLargestDifference(GetScattered(first), GetScattered(second)), 0.0, 1e-6,
    "only the size in millimetres counts");

  auto third = MakeFilter(triangleData);
  third->SetMillimetersPerUnit(20.0);
  vtkDataArray* quads = GetScattered(first);
  vtkDataArray* halves = GetScattered(third);
  double largest = 0.0;
  for (vtkIdType cell = 0; cell < quads->GetNumberOfTuples(); ++cell)
  {
    const double mean =
      0.5 * (halves->GetComponent(2 * cell, 0) + halves->GetComponent(2 * cell + 1, 0));
    largest = std::max(largest, std::abs(mean - quads->GetComponent(cell, 0)));
  }
  CheckClose(largest, 0.0, 2e-4, "a quadrilateral is its two triangles");

  const double seconds = GetSummary(first->GetOutput(), "LinkSeconds");
  vtkDoubleArray* light = AddArray(smallData, "TransmittedIrradiance", { 0.0 });
  for (vtkIdType cell = 0; cell < smallData->GetNumberOfCells() / 6; ++cell)
  {
    light->SetValue(cell, 2.0);
  }
  smallData->Modified();
  vtkNew<vtkDoubleArray> before;
  before->DeepCopy(quads);
  CheckClose(GetLargestDifference(GetScattered(first), before, 2.0), 0.0, 1e-6, "twice the light");
  Check(GetSummary(first->GetOutput(), "LinkSeconds") == seconds, "links are kept");
  first->SetRefractiveIndex(1.4);
  Check(GetLargestDifference(GetScattered(first), before, 2.0) > 1e-3, "links are made anew");
  first->SetModelToChristensenBurley();
  before->DeepCopy(GetScattered(first));
  first->SetBurleyFitToSearchlight();
  Check(GetLargestDifference(GetScattered(first), before) > 1e-3, "so they are for another fit");
}

//------------------------------------------------------------------------------
void TestThreads()
{
  auto sphere = MakeSphere(2);
  vtkNew<vtkDoubleArray> first;
  for (const int threads : { 1, 3 })
  {
    auto filter = MakeFilter(sphere);
    vtkSMPTools::Config config(threads);
    vtkSMPTools::LocalScope(config, [&]() { filter->Update(); });
    if (threads == 1)
    {
      first->DeepCopy(GetScattered(filter));
    }
    CheckClose(GetLargestDifference(GetScattered(filter), first), 0.0, 1e-12,
      "the same with " + std::to_string(threads) + " threads");
  }
}

//------------------------------------------------------------------------------
void TestSummaries()
{
  auto filter = MakeFilter(MakeSphere(1));
  filter->SetMillimetersPerUnit(5.0);
  filter->Update();
  vtkPolyData* output = filter->GetPolyDataOutput();
  const double links = GetSummary(output, "NumberOfLinks");
  CheckClose(links + GetSummary(output, "LinksLeftOut"), 80.0 * 79.0 / 2.0, 0.0, "all pairs");
  CheckClose(GetSummary(output, "EnteringFlux"), 4.0 * vtkMath::Pi(), 1e-9, "entering flux");
  const double leaving = GetSummary(output, "LeavingFlux");
  CheckClose(leaving, 4.0 * vtkMath::Pi() * GetMean(filter, 0), 1e-9, "leaving flux");
  Check(leaving < GetSummary(output, "EnteringFlux"), "no more leaves than enters");
  Check(output->GetFieldData()->HasArray("DeviceUsed") &&
      output->GetFieldData()->HasArray("DeviceExplanation"),
    "device in field data");
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  Check(table && table->GetNumberOfRows() == 1, "a table with one row");
  for (const char* name : { "Links", "LinksLeftOut", "LinkSeconds", "ApplySeconds", "ErrorBound" })
  {
    Check(table && table->GetColumnByName(name), std::string("column ") + name);
  }
  Check(table && table->GetValueByName(0, "Links").ToDouble() == links, "links in the table");
}

//------------------------------------------------------------------------------
/// A slab of 2 x 2 x 0.1, and one side of it alone.
void TestThickness()
{
  Surface slab, sheet;
  slab.AddGrid({ 0, 0, 0 }, { 0, 2, 0 }, { 2, 0, 0 }, 4, 4);
  slab.AddGrid({ 0, 0, 0.1 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  sheet.AddGrid({ 0, 0, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 4, 4);
  for (const bool closed : { true, false })
  {
    auto data = (closed ? slab : sheet).Get();
    AddArray(data, "TransmittedIrradiance", { 1.0 });
    auto filter = MakeFilter(data);
    vtkNew<vtkTest::ErrorObserver> messages;
    filter->AddObserver(vtkCommand::WarningEvent, messages);
    filter->SetMillimetersPerUnit(100.0);
    filter->Update();
    vtkPolyData* output = filter->GetPolyDataOutput();
    Check(!output->GetCellData()->HasArray("Thickness") && !messages->GetWarning(),
      "no thickness unless asked for");
    filter->ComputeThicknessOn();
    filter->Update();
    vtkDataArray* thickness = output->GetCellData()->GetArray("Thickness");
    vtkDataArray* lengths = output->GetCellData()->GetArray("DiffusionThickness");
    const double expected = closed ? 10.0 : 200.0 * std::sqrt(2.0);
    for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
    {
      CheckClose(thickness->GetComponent(cell, 0), expected, 1e-6, "thickness");
      for (int band = 0; band < 3; ++band)
      {
        CheckClose(lengths->GetComponent(cell, band), expected * std::sqrt(3.0 * Absorption[band]),
          1e-6, "thickness in diffusion lengths");
      }
    }
    // Band 0 has a diffusion length of 5.8 mm.
    vtkDataArray* thin = output->GetFieldData()->GetArray("ThinShare");
    Check(thin && thin->GetComponent(0, 0) == (closed ? 1.0 : 0.0) &&
        thin->GetComponent(0, 1) == 0.0 && thin->GetComponent(0, 2) == 0.0,
      "share of what is thin");
    Check((messages->GetWarningMessage().find("100 % of the surface") != std::string::npos) ==
        closed,
      "a warning where it is thin");
  }
}

//------------------------------------------------------------------------------
/// Marble lit from one side and from the other: most of the light comes back out, and some of it on
/// the dark side.
void TestBunny(const char* fileName)
{
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName(fileName);
  vtkNew<vtkDirectIrradiance> direct;
  direct->SetInputConnection(reader->GetOutputPort());
  direct->SetRefractiveIndex(1.5);
  vtkNew<vtkLight> light;
  direct->AddLight(light);
  vtkNew<vtkSubsurfaceScattering> scattering;
  scattering->SetInputConnection(direct->GetOutputPort());
  scattering->SetMaterialToMarble();
  scattering->SetModelToDipole();
  scattering->SetMillimetersPerUnit(10.0);
  scattering->SetIncidenceToTransmitted();
  scattering->SetLinkTolerance(1e-3);
  scattering->SetDeviceToCPU();
  for (const double side : { 1.0, -1.0 })
  {
    light->SetPosition(0.0, 0.0, side);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    vtkDataArray* scattered = GetScattered(scattering);
    vtkPolyData* output = scattering->GetPolyDataOutput();
    vtkDataArray* incident = output->GetCellData()->GetArray("DirectIrradiance");
    vtkDataArray* entering = output->GetFieldData()->GetArray("EnteringFlux");
    vtkDataArray* leaving = output->GetFieldData()->GetArray("LeavingFlux");
    double dark = 0.0;
    for (vtkIdType cell = 0; cell < output->GetNumberOfCells(); ++cell)
    {
      if (incident->GetComponent(cell, 0) == 0.0)
      {
        dark += GetArea(output, cell) * scattered->GetComponent(cell, 0);
      }
    }
    for (int band = 0; band < 3; ++band)
    {
      double s[3], a[3], index;
      vtkSubsurfaceScattering::GetMaterialProperties(vtkSubsurfaceScattering::MATERIAL_MARBLE, s, a,
        index);
      const DipoleProfile profile({ s[band], a[band], index });
      const double ratio = leaving->GetComponent(0, band) / entering->GetComponent(0, band);
      const std::string what = "bunny lit from " + std::to_string(side) + " z, band " +
        std::to_string(band) + ", leaving / entering " + std::to_string(ratio);
      std::cout << what << "\n";
      Check(ratio > 0.8 * profile.GetTotal() && ratio < 1.1 * profile.GetTotal(), what);
      Check(ratio < 1.0, what + " below 1");
    }
    std::cout << "share of red that leaves where no light falls: "
              << dark / leaving->GetComponent(0, 0) << "\n";
    Check(dark > 0.01 * leaving->GetComponent(0, 0), "light comes through to the dark side");
    Check(dark < 0.5 * leaving->GetComponent(0, 0), "most light leaves near where it entered");
  }
}

//------------------------------------------------------------------------------
/// What a square gives back in all does not depend on how it is cut into patches: slivers, a corner
/// in the middle of an edge, a corner named twice.
void TestCuts()
{
  const Point a{ 0, 0, 0 }, b{ 1, 0, 0 }, c{ 1, 1, 0 }, d{ 0, 1, 0 }, middle{ 0.5, 0, 0 };
  std::vector<Surface> cuts(5);
  cuts[0].AddPolygon({ a, middle, b, c, d });
  cuts[1].AddPolygon({ a, a, b, c, d });
  cuts[2].AddGrid({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 12, 1);
  const double heights[] = { 1e-2, 1e-6 };
  for (int k = 0; k < 2; ++k)
  {
    const Point apex{ 0.5, heights[k], 0 };
    for (const auto& side : { std::array<Point, 2>{ a, b }, { b, c }, { c, d }, { d, a } })
    {
      cuts[3 + k].AddPolygon({ side[0], side[1], apex });
    }
  }
  Surface whole;
  whole.AddPolygon({ a, b, c, d });
  for (const double millimeters : { 0.01, 1.0, 10.0 })
  {
    const auto getFlux = [&](const Surface& surface)
    {
      auto data = surface.Get();
      AddArray(data, "TransmittedIrradiance", { 1.0 });
      auto filter = MakeFilter(data);
      filter->SetMillimetersPerUnit(millimeters);
      filter->SetLinkTolerance(1e-5);
      filter->Update();
      return GetSummary(filter->GetPolyDataOutput(), "LeavingFlux");
    };
    const double expected = getFlux(whole);
    for (std::size_t k = 0; k < cuts.size(); ++k)
    {
      CheckClose(getFlux(cuts[k]), expected, 1e-4,
        "cut " + std::to_string(k) + " of a square of " + std::to_string(millimeters) + " mm");
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
int TestSubsurfaceScattering(int, char*[])
{
  TestSphere(0.1, 3, 1e-4);
  TestSphere(1.0, 3, 1e-4);
  TestExtrapolatedSphere(10.0);
  for (const int model :
    { vtkSubsurfaceScattering::MODEL_BETTER_DIPOLE,
      vtkSubsurfaceScattering::MODEL_PHOTON_BEAM_DIFFUSION,
      vtkSubsurfaceScattering::MODEL_CHRISTENSEN_BURLEY, vtkSubsurfaceScattering::MODEL_TABULATED })
  {
    TestExtrapolatedSphere(2.0, model);
  }
  TestSphere(100.0, 3, 1e-3);
  TestSphere(1000.0, 1, 5e-4);
  TestMaterials();
  TestIncidence();
  TestInvariance();
  TestCuts();
  TestThreads();
  TestSummaries();
  TestThickness();
  TestBunny(LIGHTTRANSPORT_DATA_DIRECTORY "/bunny.ply");
  return Result();
}
