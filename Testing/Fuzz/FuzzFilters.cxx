// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Any surface with any arrays and properties gives an error and nothing, or whole results; a result
// that is not finite is told of.
//
// Sizes are bounded where a filter does all that is asked for, however long that takes: texels,
// iterations, patches, tolerances. With LIGHT_TRANSPORT_FUZZ_PRINT in the environment, filter and
// input are printed before the filter runs.
#include "AnySurface.h"
#include "Choices.h"
#include "FuzzFile.h"

#include "vtkAtlasToSurface.h"
#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDirectIrradiance.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPatchMesher.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRadiosity.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#include "vtkViewFactors.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <vector>

using namespace LightTransportFuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
//------------------------------------------------------------------------------
// The default mostly; `usual` sometimes; any number now and then.
double Choose(Choices& choices, double standard, double usual)
{
  const int kind = choices.Index(12);
  return kind == 0 ? choices.Extreme() : kind < 4 ? usual : standard;
}

//------------------------------------------------------------------------------
// Another array than the default one, which may be missing, or of points.
void ChooseArrays(Choices& choices, vtkAlgorithm* filter, int count)
{
  if (choices.Chance(4))
  {
    const char* name = choices.Among({ "Other", "Emission", "Temperature", "Nowhere", "" });
    filter->SetInputArrayToProcess(choices.Index(count), 0, 0,
      choices.Chance(4) ? vtkDataObject::FIELD_ASSOCIATION_POINTS
                        : vtkDataObject::FIELD_ASSOCIATION_CELLS,
      name);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeImage(Choices& choices)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const int side = choices.Among({ 1, 2, 4, 8, 16, 3 });
  image->SetDimensions(side, choices.Chance(8) ? 2 : side, choices.Chance(16) ? 2 : 1);
  vtkNew<vtkFloatArray> values;
  values->SetName(choices.Among({ "Irradiance", "Radiance", "Area" }));
  values->SetNumberOfComponents(choices.Among({ 1, 3, 3, 2 }));
  values->SetNumberOfTuples(choices.Chance(12) ? 1 : image->GetNumberOfPoints());
  const bool extreme = choices.Chance(8);
  for (vtkIdType k = 0; k < values->GetNumberOfValues(); ++k)
  {
    values->SetValue(k,
      static_cast<float>(extreme && choices.Chance(3) ? choices.Extreme() : choices.Share()));
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLight> MakeLight(Choices& choices)
{
  const auto number = [&] { return Choose(choices, choices.Between(-3.0, 3.0), 0.0); };
  auto light = vtkSmartPointer<vtkLight>::New();
  const double place[3] = { number(), number(), number() };
  light->SetPosition(place);
  light->SetIntensity(Choose(choices, 1.0, 0.0));
  light->SetPositional(choices.Index(2));
  light->SetConeAngle(Choose(choices, 180.0, 30.0));
  light->SetExponent(choices.Index(4));
  light->SetAttenuationValues(choices.Index(2), 0.0, choices.Index(2));
  return light;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeMesher(Choices& choices, double size)
{
  auto mesher = vtkSmartPointer<vtkPatchMesher>::New();
  mesher->SetTargetEdgeLength(Choose(choices, 0.0, size * choices.Between(0.02, 0.2)));
  mesher->SetSizeField(choices.Among({ 0, 0, 1, 2 }));
  mesher->SetApproximationError(Choose(choices, 0.0, size * 1e-2));
  mesher->SetMinimumEdgeLength(Choose(choices, 0.0, size * 0.02));
  mesher->SetGrading(Choose(choices, 0.3, 1.0));
  mesher->SetCoarsePlanarRegions(choices.Chance(3));
  mesher->SetTargetNumberOfPatches(choices.Among({ 0, 0, 0, 1, 100, 1000, VTK_INT_MAX, -1 }));
  mesher->SetFeatureAngle(Choose(choices, 60.0, choices.Between(0.0, 180.0)));
  mesher->SetNumberOfIterations(choices.Index(4));
  mesher->SetRepair(!choices.Chance(6));
  mesher->SetFillHoles(!choices.Chance(3));
  mesher->SetHoleSize(Choose(choices, 0.0, size * 0.2));
  mesher->SetSelfIntersections(choices.Index(3));
  mesher->SetFlipNormals(choices.Chance(4));
  ChooseArrays(choices, mesher, 2);
  return mesher;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeAtlas(Choices& choices, double)
{
  auto atlas = vtkSmartPointer<vtkSurfaceAtlas>::New();
  atlas->SetResolution(choices.Among({ 16, 32, 64, 128, 1, 2, 17, 0, -1, VTK_INT_MAX }));
  atlas->SetMaximumStretch(Choose(choices, 1.2, 2.0));
  atlas->SetTexelMaps(choices.Chance(2));
  return atlas;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeSurfaceToAtlas(Choices& choices, double)
{
  auto transfer = vtkSmartPointer<vtkSurfaceToAtlas>::New();
  transfer->SetResolution(choices.Among({ 0, 0, 8, 64, 3, -1, VTK_INT_MAX }));
  return transfer;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeAtlasToSurface(Choices& choices, double)
{
  auto transfer = vtkSmartPointer<vtkAtlasToSurface>::New();
  transfer->SetInputDataObject(1, MakeImage(choices));
  return transfer;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeViewFactors(Choices& choices, double)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetTolerance(choices.Among({ 1e-1, 1e-2, 1e-3, 1e9 }));
  factors->SetEnforceClosure(choices.Chance(3));
  factors->SetHierarchical(choices.Chance(3));
  factors->SetLinkTolerance(choices.Among({ 1e-2, 1e-1, 1.0 }));
  factors->SetClusterTree(choices.Index(3));
  factors->SetTwoSided(choices.Chance(3));
  factors->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  ChooseArrays(choices, factors, 1);
  return factors;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeDirectIrradiance(Choices& choices, double)
{
  auto direct = vtkSmartPointer<vtkDirectIrradiance>::New();
  for (int k = choices.Index(3); k >= 0; --k)
  {
    direct->AddLight(MakeLight(choices));
  }
  if (choices.Chance(3))
  {
    direct->SetEnvironment(MakeImage(choices));
  }
  direct->SetTolerance(choices.Among({ 1e-2, 1e-1, 1e9 }));
  direct->SetEnvironmentSamples(choices.Among({ 256, 1, -1 }));
  direct->SetShadowSamples(choices.Among({ 16, 1, -1 }));
  direct->SetLightAngularDiameter(Choose(choices, 0.0, 0.53));
  direct->SetShadows(!choices.Chance(4));
  direct->SetRefractiveIndex(Choose(choices, 1.0, 1.5));
  direct->SetTwoSided(choices.Chance(3));
  direct->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  return direct;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeRadiosity(Choices& choices, double)
{
  auto radiosity = vtkSmartPointer<vtkRadiosity>::New();
  radiosity->SetSolver(choices.Index(6));
  radiosity->SetTolerance(Choose(choices, 1e-4, 1e-8));
  radiosity->SetMaximumNumberOfIterations(choices.Among({ 1000, 1, -1, 7 }));
  radiosity->SetLinkMethod(choices.Index(3));
  radiosity->SetLinkTolerance(choices.Among({ 1e-2, 1e-1, 1.0 }));
  radiosity->SetClusterTree(choices.Index(3));
  radiosity->SetRefineByBrightness(choices.Chance(4));
  radiosity->SetViewFactorTolerance(choices.Among({ 1e-1, 1e-2, 1e-3 }));
  radiosity->SetEnforceClosure(choices.Chance(3));
  radiosity->SetTwoSided(choices.Chance(3));
  radiosity->SetDeviceToCPU();
  radiosity->SetBackgroundTemperature(Choose(choices, 0.0, 300.0));
  for (int k = choices.Chance(4) ? choices.Index(5) : 0; k > 0; --k)
  {
    radiosity->AddBandLimit(Choose(choices, 10.0 / k, 0.0));
  }
  for (int k = choices.Chance(4) ? choices.Index(4) : 0; k > 0; --k)
  {
    radiosity->AddBackgroundRadiance(Choose(choices, 1.0, 0.0));
  }
  radiosity->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  ChooseArrays(choices, radiosity, 7);
  return radiosity;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeScattering(Choices& choices, double)
{
  auto scattering = vtkSmartPointer<vtkSubsurfaceScattering>::New();
  const auto color = [&](double standard, double usual) {
    return std::vector<double>{ standard, Choose(choices, standard, usual), usual };
  };
  scattering->SetMaterial(choices.Chance(2) ? 0 : choices.Index(13));
  scattering->SetScatteringCoefficient(color(1.0, 10.0).data());
  scattering->SetAbsorptionCoefficient(color(0.01, 0.0).data());
  scattering->SetRefractiveIndex(Choose(choices, 1.3, 1.0));
  scattering->SetMillimetersPerUnit(Choose(choices, 1.0, 10.0));
  scattering->SetLinkTolerance(choices.Among({ 1e-2, 1e-3, 1e-4 }));
  scattering->SetIncidence(choices.Index(2));
  scattering->SetDeviceToCPU();
  scattering->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  ChooseArrays(choices, scattering, 1);
  return scattering;
}

//------------------------------------------------------------------------------
// All surfaces and images in it.
std::vector<vtkDataSet*> ListPieces(vtkDataObject* object)
{
  std::vector<vtkDataSet*> pieces;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      pieces.push_back(vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()));
    }
  }
  else
  {
    pieces.push_back(vtkDataSet::SafeDownCast(object));
  }
  return pieces;
}

//------------------------------------------------------------------------------
// That of the first surface, or 1.
double GetSize(vtkDataObject* object)
{
  const std::vector<vtkDataSet*> pieces = ListPieces(object);
  const double size = pieces.empty() ? 0.0 : pieces[0]->GetLength();
  return size > 0.0 && std::isfinite(size) ? size : 1.0;
}

//------------------------------------------------------------------------------
std::set<std::string> ListArrays(vtkDataObject* object)
{
  std::set<std::string> names;
  for (vtkDataSet* piece : ListPieces(object))
  {
    for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* arrays = piece->GetAttributes(type);
      for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
      {
        names.insert(arrays->GetAbstractArray(k)->GetName());
      }
    }
  }
  return names;
}

//------------------------------------------------------------------------------
bool IsFinite(vtkDataArray* array)
{
  for (vtkIdType tuple = 0; tuple < array->GetNumberOfTuples(); ++tuple)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      if (!std::isfinite(array->GetComponent(tuple, k)))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// What the filter adds (names that the input does not have) is whole, and finite or told of.
void CheckResults(vtkDataObject* output, const std::set<std::string>& given, bool silent)
{
  for (vtkDataSet* piece : ListPieces(output))
  {
    for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* arrays = piece->GetAttributes(type);
      for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
      {
        const std::string name = arrays->GetAbstractArray(k)->GetName();
        vtkDataArray* array = arrays->GetArray(k);
        if (array && given.count(name) == 0)
        {
          Require(array->GetNumberOfTuples() == piece->GetNumberOfElements(type),
            name + " is not as long as the surface");
          Require(!silent || IsFinite(array), name + " is not finite, without a word");
        }
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  struct Kind
  {
    vtkSmartPointer<vtkAlgorithm> (*Make)(Choices& choices, double size);
    bool TakesComposite;
  };
  constexpr Kind kinds[] = { { MakeMesher, true }, { MakeAtlas, false },
    { MakeSurfaceToAtlas, false }, { MakeAtlasToSurface, false }, { MakeViewFactors, true },
    { MakeDirectIrradiance, true }, { MakeRadiosity, true }, { MakeScattering, true } };
  BeQuiet();
  Choices choices(data, size);
  const Kind& kind = kinds[choices.Index(static_cast<int>(std::size(kinds)))];
  vtkSmartPointer<vtkDataObject> input = MakeAnyInput(choices, kind.TakesComposite);
  const vtkSmartPointer<vtkAlgorithm> filter = kind.Make(choices, GetSize(input));
  const Messages messages(filter);
  if (kind.Make == MakeSurfaceToAtlas || kind.Make == MakeAtlasToSurface)
  {
    vtkNew<vtkSurfaceAtlas> atlas;
    atlas->SetResolution(16);
    atlas->SetInputDataObject(input);
    atlas->Update();
    input = choices.Chance(4) ? input.Get() : atlas->GetOutputDataObject(0);
  }
  filter->SetInputDataObject(0, input);
  if (std::getenv("LIGHT_TRANSPORT_FUZZ_PRINT"))
  {
    filter->Print(std::cerr);
    input->Print(std::cerr);
  }
  filter->Update();
  // Arrays that are carried over are as they were, and the same goes for those of a second input.
  std::set<std::string> given = ListArrays(input);
  if (filter->GetNumberOfInputPorts() > 1 && filter->GetNumberOfInputConnections(1) > 0)
  {
    given.merge(ListArrays(filter->GetInputDataObject(1, 0)));
  }
  CheckResults(filter->GetOutputDataObject(0), given,
    messages.Errors == 0 && messages.Warnings == 0);
  return 0;
}
