// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * vtkSubsurfaceScattering with compressed links against the same links as they are and all pairs:
 * errors, bytes, the bound on request, which changes make new links, and what is refused.
 */
#include "LightTransportTesting.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkSphereSource.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkTestErrorObserver.h"

#include <cmath>
#include <iostream>

using namespace LightTransportTesting;

namespace
{
using Filter = vtkSubsurfaceScattering;

//------------------------------------------------------------------------------
// A sphere of 40 mm that is lit from above, with spots.
vtkSmartPointer<vtkPolyData> MakeScene()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(20.0);
  sphere->SetThetaResolution(36);
  sphere->SetPhiResolution(19);
  sphere->Update();
  vtkSmartPointer<vtkPolyData> scene = sphere->GetOutput();
  vtkNew<vtkFloatArray> irradiance;
  irradiance->SetName("Irradiance");
  for (vtkIdType cell = 0; cell < scene->GetNumberOfCells(); ++cell)
  {
    double bounds[6];
    scene->GetCellBounds(cell, bounds);
    const double spot = cell % 97 == 0 ? 5.0 : 0.0;
    irradiance->InsertNextValue(static_cast<float>(std::max(bounds[5], 0.0) / 20.0 + spot + 0.02));
  }
  scene->GetCellData()->AddArray(irradiance);
  return scene;
}

//------------------------------------------------------------------------------
double GetField(Filter* filter, const char* name)
{
  vtkDataArray* array = filter->GetOutputDataObject(0)->GetFieldData()->GetArray(name);
  return array ? array->GetTuple1(0) : -1.0;
}

//------------------------------------------------------------------------------
vtkDataArray* GetResult(Filter* filter)
{
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0))
    ->GetCellData()
    ->GetArray("ScatteredIrradiance");
}

//------------------------------------------------------------------------------
// Relative, root mean square, of the worst band.
double Compare(vtkDataArray* found, vtkDataArray* expected)
{
  double worst = 0.0;
  for (int band = 0; band < 3; ++band)
  {
    double error = 0.0;
    double size = 0.0;
    for (vtkIdType cell = 0; cell < expected->GetNumberOfTuples(); ++cell)
    {
      error += std::pow(found->GetComponent(cell, band) - expected->GetComponent(cell, band), 2);
      size += std::pow(expected->GetComponent(cell, band), 2);
    }
    worst = std::max(worst, std::sqrt(error / size));
  }
  return worst;
}

//------------------------------------------------------------------------------
vtkSmartPointer<Filter> MakeFilter(vtkPolyData* scene, int method, int material)
{
  auto filter = vtkSmartPointer<Filter>::New();
  filter->SetInputData(scene);
  filter->SetMaterial(material);
  filter->SetLinkMethod(method);
  return filter;
}

//------------------------------------------------------------------------------
void TestMethod(vtkPolyData* scene, int method, int material, const std::string& what)
{
  const auto dense = MakeFilter(scene, Filter::LINK_METHOD_DENSE, material);
  const auto plain = MakeFilter(scene, method, material);
  const auto coded = MakeFilter(scene, method, material);
  coded->CompressLinksOn();
  vtkDataArray* all = GetResult(dense);
  const double before = Compare(GetResult(plain), all);
  const double after = Compare(GetResult(coded), all);
  const double error = GetField(coded, "CompressionError");
  const double links = GetField(coded, "LinksPerReceiver");
  std::cout << what << ": " << links << " links a patch, error " << before << ", compressed "
            << after << " (links alone " << error << "), bytes a patch "
            << GetField(plain, "LinkBytes") / scene->GetNumberOfCells() << " and "
            << GetField(coded, "LinkBytes") / scene->GetNumberOfCells() << "\n";
  Check(after < before + 0.01, what + ": at most 1 % more");
  Check(error > 0.0 && Compare(GetResult(coded), GetResult(plain)) < 1.2 * error,
    what + ": the error that is told");
  Check(GetField(plain, "CompressionError") == -1.0, what + ": no error of what is not compressed");
  Check(links == GetField(plain, "LinksPerReceiver"), what + ": all links are there");
  Check(GetField(coded, "LinkBytes") < 0.6 * GetField(plain, "LinkBytes"), what + ": bytes");

  coded->SetCompressionTolerance(0.005);
  const double bounded = Compare(GetResult(coded), GetResult(plain));
  Check(GetField(coded, "CompressionError") < 0.005 && bounded < 0.005, what + ": the bound");
}

//------------------------------------------------------------------------------
void TestRefusal(vtkPolyData* scene)
{
  const auto filter = MakeFilter(scene, Filter::LINK_METHOD_DENSE, Filter::MATERIAL_MARBLE);
  filter->CompressLinksOn();
  vtkNew<vtkTest::ErrorObserver> observer;
  filter->AddObserver(vtkCommand::ErrorEvent, observer);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  filter->Update();
  Check(observer->GetErrorMessage().find("CompressLinks is on, and links are those of all pairs") !=
      std::string::npos,
    "all pairs are not compressed");
  filter->SetLinkMethodToAuto();
  Check(GetResult(filter) != nullptr && GetField(filter, "CompressionError") > 0.0,
    "Auto takes clusters");
}
} // namespace

//------------------------------------------------------------------------------
int TestCompressedScattering(int, char*[])
{
  const vtkSmartPointer<vtkPolyData> scene = MakeScene();
  TestMethod(scene, Filter::LINK_METHOD_ADAPTIVE, Filter::MATERIAL_MARBLE, "marble, adaptive");
  TestMethod(scene, Filter::LINK_METHOD_UNIFORM, Filter::MATERIAL_MARBLE, "marble, uniform");
  TestMethod(scene, Filter::LINK_METHOD_ADAPTIVE, Filter::MATERIAL_SKIMMILK, "milk, adaptive");
  TestRefusal(scene);
  return Result();
}
