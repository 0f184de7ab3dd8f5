// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "AnyFilter.h"

#include "AnySurface.h"
#include "Choices.h"

#include "vtkAtlasToSurface.h"
#include "vtkCellData.h"
#include "vtkDirectIrradiance.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightingAlgorithm.h"
#include "vtkNew.h"
#include "vtkPatchMesher.h"
#include "vtkPointData.h"
#include "vtkRadianceTransfer.h"
#include "vtkRadiosity.h"
#include "vtkSingleScattering.h"
#include "vtkSubsurfaceScattering.h"
#include "vtkSurfaceAtlas.h"
#include "vtkSurfaceToAtlas.h"
#include "vtkViewFactors.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <vector>

namespace LightTransportFuzz
{
namespace
{

//------------------------------------------------------------------------------
// The default mostly; `usual` sometimes; any number now and then.
double Choose(Choices& choices, double standard, double usual)
{
  const int kind = choices.Index(12);
  return kind == 0 && !choices.IsCalm() ? choices.Extreme() : kind < 4 ? usual : standard;
}

//------------------------------------------------------------------------------
// One that takes no more work than a run may, or none at all.
double ChooseTolerance(Choices& choices, std::initializer_list<double> values)
{
  return choices.Strange(24) ? std::numeric_limits<double>::quiet_NaN() : choices.Among(values);
}

//------------------------------------------------------------------------------
// Another array than the default one, which may be missing, or of points.
void ChooseArrays(Choices& choices, vtkAlgorithm* filter, int count)
{
  if (choices.Strange(4))
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
  image->SetDimensions(side, choices.Chance(8) ? 2 : side, choices.Strange(16) ? 2 : 1);
  vtkNew<vtkFloatArray> values;
  values->SetName(choices.Among({ "Irradiance", "Radiance", "Area" }));
  values->SetNumberOfComponents(choices.Among({ 1, 3, 3, choices.IsCalm() ? 1 : 2 }));
  values->SetNumberOfTuples(choices.Strange(12) ? 1 : image->GetNumberOfPoints());
  const bool extreme = choices.Strange(8);
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
  light->SetAttenuationValues(choices.Strange(12) ? 0.0 : 1.0, 0.0, choices.Index(2));
  return light;
}

//------------------------------------------------------------------------------
// Of edges: the mesher makes as many as are asked for, up to what it refuses, which takes minutes.
double ChooseLength(Choices& choices, const Room& room, double usual)
{
  const double length = Choose(choices, 0.0, usual) / room.Size;
  const bool takesLong = std::abs(length) > 1e-7 && std::abs(length) < 1e-2;
  return room.Size * (takesLong ? 1e-2 : length);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeMesher(Choices& choices, const Room& room)
{
  auto mesher = vtkSmartPointer<vtkPatchMesher>::New();
  const double size = room.Size;
  mesher->SetTargetEdgeLength(ChooseLength(choices, room, size * choices.Between(0.02, 0.2)));
  mesher->SetSizeField(choices.Among({ 0, 0, 1, 2 }));
  mesher->SetApproximationError(Choose(choices, 0.0, size * 1e-2));
  mesher->SetMinimumEdgeLength(ChooseLength(choices, room, size * 0.02));
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
  mesher->SetWeldTolerance(Choose(choices, 0.0, size * 1e-3));
  return mesher;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeAtlas(Choices& choices, const Room&)
{
  auto atlas = vtkSmartPointer<vtkSurfaceAtlas>::New();
  atlas->SetResolution(choices.Among({ 16, 32, 64, 128, 1, 2, 17, 0, -1, VTK_INT_MAX }));
  atlas->SetMaximumStretch(Choose(choices, 1.2, 2.0));
  atlas->SetTexelMaps(choices.Chance(2));
  return atlas;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeSurfaceToAtlas(Choices& choices, const Room&)
{
  auto transfer = vtkSmartPointer<vtkSurfaceToAtlas>::New();
  transfer->SetResolution(choices.Among({ 0, 0, 8, 64, 3, -1, VTK_INT_MAX }));
  return transfer;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeAtlasToSurface(Choices& choices, const Room&)
{
  auto transfer = vtkSmartPointer<vtkAtlasToSurface>::New();
  transfer->SetInputDataObject(1, MakeImage(choices));
  return transfer;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeViewFactors(Choices& choices, const Room&)
{
  auto factors = vtkSmartPointer<vtkViewFactors>::New();
  factors->SetTolerance(ChooseTolerance(choices, { 1e-1, 3e-2, 1e-2, 1e9 }));
  factors->SetEnforceClosure(choices.Chance(3));
  factors->SetHierarchical(choices.Chance(3));
  factors->SetLinkTolerance(ChooseTolerance(choices, { 1e-2, 1e-1, 1.0 }));
  factors->SetClusterTree(choices.Index(3));
  factors->SetTwoSided(choices.Chance(3));
  factors->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  ChooseArrays(choices, factors, 1);
  return factors;
}

//------------------------------------------------------------------------------
void ChooseLighting(Choices& choices, vtkLightingAlgorithm* lit)
{
  for (int k = choices.Index(3); k >= 0; --k)
  {
    lit->AddLight(MakeLight(choices));
  }
  if (choices.Chance(3))
  {
    lit->SetEnvironment(MakeImage(choices));
  }
  lit->SetLightAngularDiameter(Choose(choices, 0.0, 0.53));
  lit->SetShadows(!choices.Chance(4));
  lit->SetFeatureAngle(Choose(choices, 60.0, 0.0));
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeDirectIrradiance(Choices& choices, const Room&)
{
  auto direct = vtkSmartPointer<vtkDirectIrradiance>::New();
  ChooseLighting(choices, direct);
  direct->SetTolerance(ChooseTolerance(choices, { 1e-2, 1e-1, 1e9 }));
  direct->SetEnvironmentSamples(choices.Among({ 256, 1, -1 }));
  direct->SetShadowSamples(choices.Among({ 16, 1, -1 }));
  direct->SetRefractiveIndex(Choose(choices, 1.0, 1.5));
  direct->SetTwoSided(choices.Chance(3));
  return direct;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeRadianceTransfer(Choices& choices, const Room&)
{
  auto transfer = vtkSmartPointer<vtkRadianceTransfer>::New();
  transfer->SetDegree(choices.Among({ 4, 0, 5, 99 }));
  transfer->SetSamples(choices.Among({ 64, 1, -1 }));
  transfer->SetShadows(!choices.Chance(4));
  transfer->SetRefractiveIndex(Choose(choices, 1.0, 1.5));
  return transfer;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeRadiosity(Choices& choices, const Room&)
{
  auto radiosity = vtkSmartPointer<vtkRadiosity>::New();
  radiosity->SetSolver(choices.Index(6));
  radiosity->SetTolerance(Choose(choices, 1e-4, 1e-8));
  radiosity->SetMaximumNumberOfIterations(choices.Among({ 1000, 1, -1, 7 }));
  radiosity->SetLinkMethod(choices.Index(3));
  radiosity->SetLinkTolerance(ChooseTolerance(choices, { 1e-2, 1e-1, 1.0 }));
  radiosity->SetClusterTree(choices.Index(3));
  radiosity->SetRefineByBrightness(choices.Chance(4));
  radiosity->SetViewFactorTolerance(ChooseTolerance(choices, { 1e-1, 3e-2, 1e-2 }));
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
// Three components: the standard, any number now and then, and the usual.
std::vector<double> ChooseColor(Choices& choices, double standard, double usual)
{
  return { standard, Choose(choices, standard, usual), usual };
}

//------------------------------------------------------------------------------
// What both filters of translucent bodies have.
template <typename Filter>
void ChooseMedium(Choices& choices, Filter* filter)
{
  filter->SetMaterial(choices.Chance(2) ? 0 : choices.Index(13));
  filter->SetScatteringCoefficient(ChooseColor(choices, 1.0, 10.0).data());
  filter->SetAbsorptionCoefficient(ChooseColor(choices, 0.01, 0.0).data());
  filter->SetRefractiveIndex(Choose(choices, 1.3, 1.0));
  filter->SetMillimetersPerUnit(Choose(choices, 1.0, 10.0));
  filter->SetAnisotropy(ChooseColor(choices, 0.0, choices.Among({ 0.9, -0.9, 0.99 })).data());
}

//------------------------------------------------------------------------------
// Coefficients around the surface or beside it, in voxels of any shape.
vtkSmartPointer<vtkImageData> MakeMedium(Choices& choices, const Room& room)
{
  auto medium = vtkSmartPointer<vtkImageData>::New();
  int counts[3];
  double origin[3], spacing[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    counts[axis] = choices.Among({ 2, 3, 5, 9, 17, choices.IsCalm() ? 4 : 1 });
    origin[axis] = room.Low[axis] + Choose(choices, 0.0, 0.3 * room.Size);
    spacing[axis] = Choose(choices, room.Size / counts[axis], 0.1 * room.Size);
    spacing[axis] *= choices.Strange(12) ? -1.0 : 1.0;
  }
  medium->SetDimensions(counts);
  medium->SetOrigin(origin);
  medium->SetSpacing(spacing);
  if (choices.Chance(6))
  {
    double directions[9];
    std::generate(std::begin(directions), std::end(directions),
      [&] { return Choose(choices, choices.Between(-1.0, 1.0), 0.0); });
    medium->SetDirectionMatrix(directions);
  }
  for (const char* name : { "Scattering", "Absorption" })
  {
    const bool ofCells = choices.Chance(2);
    vtkDataSetAttributes* arrays =
      medium->GetAttributes(ofCells ? vtkDataObject::CELL : vtkDataObject::POINT);
    if (!choices.Chance(6))
    {
      arrays->AddArray(MakeArray(choices, name,
        ofCells ? medium->GetNumberOfCells() : medium->GetNumberOfPoints()));
    }
  }
  return medium;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeSubsurfaceScattering(Choices& choices, const Room& room)
{
  auto scattering = vtkSmartPointer<vtkSubsurfaceScattering>::New();
  using Filter = vtkSubsurfaceScattering;
  ChooseMedium(choices, scattering.Get());
  scattering->SetLinkTolerance(ChooseTolerance(choices, { 1e-2, 1e-3, 1e-4, 0.0 }));
  scattering->SetIncidence(choices.Index(2));
  scattering->SetDeviceToCPU();
  scattering->SetFeatureAngle(Choose(choices, 60.0, 0.0));
  scattering->SetModel(choices.Among({ Filter::MODEL_MONTE_CARLO, Filter::MODEL_MONTE_CARLO,
    Filter::MODEL_MONTE_CARLO, Filter::MODEL_DIPOLE, Filter::MODEL_BETTER_DIPOLE,
    Filter::MODEL_PHOTON_BEAM_DIFFUSION, Filter::MODEL_CHRISTENSEN_BURLEY,
    Filter::MODEL_CHRISTENSEN_BURLEY, Filter::MODEL_TABULATED }));
  scattering->SetBurleyFit(choices.Index(3));
  scattering->SetLinkMethod(choices.Index(4));
  scattering->SetNumberOfLinks(choices.Among({ 64, 16, 1, -1, VTK_INT_MAX }));
  scattering->SetDropLinksThroughAir(choices.Chance(3));
  scattering->SetCompressLinks(choices.Chance(3));
  scattering->SetCompressionTolerance(ChooseTolerance(choices, { 0.0, 1e-2, 1e-300, 1e300 }));
  scattering->SetNumberOfPhotons(choices.Among({ 1000, 100, 100, 300, 1, -1 }));
  if (scattering->GetNumberOfPhotons() == 0)
  {
    // As many as the error asks for: none of them is to be scattered very often.
    scattering->SetAnisotropy(0.0, 0.5, -0.5);
  }
  scattering->SetTargetError(ChooseTolerance(choices, { 0.1, 0.5, 1.0, 1e300 }));
  scattering->SetSeed(choices.ExtremeInteger());
  scattering->SetComputeThickness(choices.Chance(3));
  const bool isMonteCarlo = scattering->GetModel() == Filter::MODEL_MONTE_CARLO;
  if (isMonteCarlo ? choices.Chance(2) : choices.Strange(12))
  {
    scattering->SetInputDataObject(1, MakeMedium(choices, room));
  }
  ChooseArrays(choices, scattering, 2);
  return scattering;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkAlgorithm> MakeSingleScattering(Choices& choices, const Room&)
{
  auto scattering = vtkSmartPointer<vtkSingleScattering>::New();
  ChooseMedium(choices, scattering.Get());
  ChooseLighting(choices, scattering);
  scattering->SetNumberOfSamples(choices.Among({ 16, 64, 1, -1 }));
  scattering->SetMinimumContribution(ChooseTolerance(choices, { 1e-2, 1e-3, 1e9 }));
  return scattering;
}
} // namespace

//------------------------------------------------------------------------------
const FilterKind& ChooseFilter(Choices& choices)
{
  const Needs nothing, closed{ true, {} };
  static const FilterKind kinds[] = { { MakeMesher, true, false, nothing },
    { MakeAtlas, false, false, closed }, { MakeSurfaceToAtlas, false, true, closed },
    { MakeAtlasToSurface, false, true, closed }, { MakeViewFactors, true, false, nothing },
    { MakeDirectIrradiance, true, false, nothing },
    { MakeRadiosity, true, false, { false, { "Emission", "Reflectance" } } },
    { MakeSubsurfaceScattering, true, false, { true, { "Irradiance", "TransmittedIrradiance" } } },
    { MakeSingleScattering, true, false, closed }, { MakeRadianceTransfer, true, false, nothing } };
  return kinds[choices.Index(static_cast<int>(std::size(kinds)))];
}
} // namespace LightTransportFuzz
