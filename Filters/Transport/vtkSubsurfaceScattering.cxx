// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScattering.h"

#include "Scattering/ScatteringAssembly.h"
#include "Scattering/ScatteringMaterials.h"
#include "Scattering/ScatteringModels.h"
#include "Scene/PatchScene.h"
#include "Shared/Fresnel.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLinkOperator.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScattering);

namespace
{
constexpr int Bands = 3;

//------------------------------------------------------------------------------
/// A field data array of one of the data sets, or nullptr.
vtkDataArray* FindFieldArray(vtkDataObject* data, const char* name)
{
  if (vtkDataArray* array = data->GetFieldData()->GetArray(name))
  {
    return array;
  }
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkCompositeDataIterator> blocks;
  blocks.TakeReference(composite->NewIterator());
  for (blocks->InitTraversal(); !blocks->IsDoneWithTraversal(); blocks->GoToNextItem())
  {
    if (vtkDataArray* array = blocks->GetCurrentDataObject()->GetFieldData()->GetArray(name))
    {
      return array;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
void AddColumn(vtkTable* table, const char* name, double value)
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  column->InsertNextValue(value);
  table->AddColumn(column);
}
} // namespace

//------------------------------------------------------------------------------
/// The material in use.
struct vtkSubsurfaceScattering::Optics
{
  double Scattering[Bands];
  double Absorption[Bands];
  double RefractiveIndex;
  /// Part of the input array that enters the surface.
  double Entering;
};

//------------------------------------------------------------------------------
struct vtkSubsurfaceScattering::Internals
{
  PatchScene Scene;

  /// The links, kept for as long as what they depend on stays the same.
  vtkSmartPointer<vtkExchangeMatrix> Exchange;
  std::vector<double> Key;
  std::uint64_t Fingerprint = 0;

  double NumberOfLinks = 0.0;
  double LinksLeftOut = 0.0;
  double ErrorBound = 0.0;
  double LinkSeconds = 0.0;

  std::vector<double> Scattered;
  double ApplySeconds = 0.0;
  std::string DeviceUsed;
  std::string DeviceExplanation;
};

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::vtkSubsurfaceScattering() : Self(new Internals)
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::~vtkSubsurfaceScattering() = default;

//------------------------------------------------------------------------------
bool vtkSubsurfaceScattering::GetMaterialProperties(int material, double scattering[3],
  double absorption[3], double& refractiveIndex)
{
  const ScatteringMaterial* found = ScatteringMaterials::Find(material);
  if (!found)
  {
    return false;
  }
  std::copy_n(found->Scattering, Bands, scattering);
  std::copy_n(found->Absorption, Bands, absorption);
  refractiveIndex = found->RefractiveIndex;
  return true;
}

//------------------------------------------------------------------------------
const char* vtkSubsurfaceScattering::GetMaterialName(int material)
{
  if (material == MATERIAL_CUSTOM)
  {
    return "Custom";
  }
  const ScatteringMaterial* found = ScatteringMaterials::Find(material);
  return found ? found->Name : nullptr;
}

//------------------------------------------------------------------------------
int vtkSubsurfaceScattering::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  Optics optics;
  if (!this->CheckDevice(this->Device) || !this->FindOptics(optics))
  {
    return 0;
  }
  std::string error;
  if (!this->Self->Scene.Build(input, this->Controller, error))
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  std::vector<double> irradiance;
  if (!this->ReadIrradiance(input, irradiance))
  {
    return 0;
  }
  this->CompareIndices(input, optics.RefractiveIndex);
  if (!this->MakeLinks(optics) || !this->ApplyLinks(optics, irradiance))
  {
    return 0;
  }
  this->WriteResults(irradiance, optics.Entering, input, output, vtkTable::GetData(outputs, 1));
  this->UpdateProgress(1.0);
  return 1;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScattering::FindOptics(Optics& optics)
{
  if (!GetMaterialProperties(this->Material, optics.Scattering, optics.Absorption,
        optics.RefractiveIndex))
  {
    std::copy_n(this->ScatteringCoefficient, Bands, optics.Scattering);
    std::copy_n(this->AbsorptionCoefficient, Bands, optics.Absorption);
    optics.RefractiveIndex = this->RefractiveIndex;
  }
  for (int band = 0; band < Bands; ++band)
  {
    const double scattering = optics.Scattering[band];
    const double absorption = optics.Absorption[band];
    if (!(scattering >= 0.0) || !(absorption >= 0.0) || !std::isfinite(scattering + absorption))
    {
      vtkErrorMacro("ScatteringCoefficient and AbsorptionCoefficient must be finite and not "
                    "negative, but component "
        << band << " has " << scattering << " and " << absorption << " per mm.");
      return false;
    }
    if (scattering + absorption == 0.0)
    {
      vtkErrorMacro("ScatteringCoefficient and AbsorptionCoefficient are both 0 in component "
        << band << ": light would pass through unchanged. Set one of them above 0.");
      return false;
    }
  }
  if (!(optics.RefractiveIndex >= 1.0) || !std::isfinite(optics.RefractiveIndex))
  {
    vtkErrorMacro("RefractiveIndex is " << optics.RefractiveIndex
                                        << ": it must be at least 1 (1.3 for water, 1.5 for "
                                           "glass and marble).");
    return false;
  }
  if (!(this->MillimetersPerUnit > 0.0) || !std::isfinite(this->MillimetersPerUnit))
  {
    vtkErrorMacro("MillimetersPerUnit is " << this->MillimetersPerUnit
                                           << ": it must be above 0 (10 for a mesh in "
                                              "centimetres).");
    return false;
  }
  optics.Entering = this->Incidence == INCIDENCE_DIFFUSE
    ? 1.0 - Fresnel::GetMeanExternalReflectance(optics.RefractiveIndex)
    : 1.0;
  return true;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScattering::ReadIrradiance(vtkDataObject* input, std::vector<double>& irradiance)
{
  std::string name = this->Incidence == INCIDENCE_DIFFUSE ? "Irradiance" : "TransmittedIrradiance";
  vtkInformation* chosen = this->GetInputArrayInformation(0);
  const char* chosenName = chosen->Get(vtkDataObject::FIELD_NAME());
  if (chosenName && *chosenName)
  {
    name = chosenName;
  }
  std::vector<double> values;
  int components = 0;
  std::string error;
  if (!this->Self->Scene.GatherCellArray(input, name, true, values, components, error))
  {
    vtkErrorMacro(<< error);
    return false;
  }
  if (components != 1 && components != Bands)
  {
    vtkErrorMacro("The cell array \"" << name << "\" has " << components
                                      << " components: it must have 1 (the same in all bands) "
                                         "or 3 (red, green, blue).");
    return false;
  }
  const std::size_t patches = this->Self->Scene.GetAreas().size();
  irradiance.resize(patches * Bands);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    for (int band = 0; band < Bands; ++band)
    {
      irradiance[patch * Bands + band] = values[patch * components + (components == 1 ? 0 : band)];
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::CompareIndices(vtkDataObject* input, double refractiveIndex)
{
  vtkDataArray* recorded = FindFieldArray(input, "RefractiveIndex");
  if (this->Incidence != INCIDENCE_TRANSMITTED || !recorded || recorded->GetNumberOfTuples() == 0)
  {
    return;
  }
  const double index = recorded->GetComponent(0, 0);
  if (std::abs(index - refractiveIndex) > 1e-6)
  {
    vtkWarningMacro("The transmitted irradiance was computed for a refractive index of "
      << index << ", but " << refractiveIndex
      << " is used here. Give vtkDirectIrradiance and vtkSubsurfaceScattering the same one.");
  }
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScattering::MakeLinks(const Optics& optics)
{
  Internals& self = *this->Self;
  const double scale = self.Scene.GetScale() * this->MillimetersPerUnit;
  std::vector<double> key = { scale, optics.RefractiveIndex, static_cast<double>(this->Model),
    this->LinkTolerance, static_cast<double>(this->GetNumberOfRanks()) };
  key.insert(key.end(), optics.Scattering, optics.Scattering + Bands);
  key.insert(key.end(), optics.Absorption, optics.Absorption + Bands);
  if (self.Exchange && self.Key == key && self.Fingerprint == self.Scene.GetFingerprint())
  {
    return true;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  std::vector<double> areas = self.Scene.GetAreas();
  for (double& area : areas)
  {
    area *= scale * scale;
  }
  self.Exchange = nullptr;
  vtkSmartPointer<vtkExchangeMatrix> exchange = this->MakeExchange(areas, Bands);
  if (!exchange)
  {
    return false;
  }
  std::vector<ScatteringMedium> media;
  for (int band = 0; band < Bands; ++band)
  {
    media.push_back({ optics.Scattering[band], optics.Absorption[band], optics.RefractiveIndex });
  }
  ScatteringProfiles profiles;
  if (Outcome made = ScatteringModels::MakeProfiles(this->Model, media, profiles); !made)
  {
    vtkErrorMacro(<< made.GetMessage());
    return false;
  }
  this->SetProgressStage(0.0, 0.95);
  const Monitor monitor([this](double fraction) { return this->ReportProgress(fraction); });
  ScatteringAssembly::Summary summary;
  if (!ScatteringAssembly::Fill(self.Scene, scale, profiles, this->LinkTolerance, exchange, monitor,
        summary))
  {
    return false;
  }
  double counts[2] = { static_cast<double>(summary.Links), static_cast<double>(summary.LeftOut) };
  if (this->GetNumberOfRanks() > 1)
  {
    const double mine[2] = { counts[0], counts[1] };
    this->Controller->AllReduce(mine, counts, 2, vtkCommunicator::SUM_OP);
    const std::vector<double> errors = summary.Errors;
    this->Controller->AllReduce(errors.data(), summary.Errors.data(),
      static_cast<vtkIdType>(errors.size()), vtkCommunicator::SUM_OP);
  }
  self.NumberOfLinks = counts[0];
  self.LinksLeftOut = counts[1];
  self.ErrorBound = 0.0;
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    self.ErrorBound = std::max(self.ErrorBound, summary.Errors[patch] / areas[patch]);
  }
  if (self.ErrorBound > 2.0 * this->LinkTolerance)
  {
    vtkWarningMacro("The links may be wrong by "
      << self.ErrorBound
      << " of the profile's total, more than twice LinkTolerance: the patches are many mean free "
         "paths wide. Use smaller patches, or check MillimetersPerUnit.");
  }
  self.Exchange = exchange;
  self.Key = key;
  self.Fingerprint = self.Scene.GetFingerprint();
  self.LinkSeconds = vtkTimerLog::GetUniversalTime() - start;
  return true;
}

//------------------------------------------------------------------------------
bool vtkSubsurfaceScattering::ApplyLinks(const Optics& optics,
  const std::vector<double>& irradiance)
{
  enum Slot
  {
    INCIDENT,
    LEFT,
    RIGHT,
    SCATTERED,
    SCRATCH
  };
  Internals& self = *this->Self;
  const double start = vtkTimerLog::GetUniversalTime();
  vtkSmartPointer<vtkLinkOperator> links =
    this->MakeLinkOperator(this->Device, self.Exchange, Bands, self.DeviceExplanation);
  if (!links)
  {
    return false;
  }
  const std::vector<double>& areas = self.Exchange->GetAreas();
  std::vector<double> left(irradiance.size());
  const std::vector<double> right(irradiance.size(), optics.Entering);
  for (std::size_t k = 0; k < left.size(); ++k)
  {
    left[k] = 1.0 / areas[k / Bands];
  }
  self.Scattered.resize(irradiance.size());
  if (!links->SetVector(INCIDENT, irradiance.data()) || !links->SetVector(LEFT, left.data()) ||
    !links->SetVector(RIGHT, right.data()) ||
    !links->Apply(SCATTERED, LEFT, RIGHT, INCIDENT, SCRATCH) ||
    !links->GetVector(SCATTERED, self.Scattered.data()))
  {
    return false;
  }
  self.DeviceUsed = links->GetDeviceName();
  self.ApplySeconds = vtkTimerLog::GetUniversalTime() - start;
  return true;
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::WriteResults(const std::vector<double>& irradiance, double entering,
  vtkDataObject* input, vtkDataObject* output, vtkTable* table)
{
  Internals& self = *this->Self;
  self.Scene.BuildSmoothPoints(this->FeatureAngle, {}, 0);
  self.Scene.CopyStructure(input, output);
  self.Scene.AddArray(output, "ScatteredIrradiance", self.Scattered, Bands);

  double enteringFlux[Bands] = {};
  double leavingFlux[Bands] = {};
  const double unit = self.Scene.GetScale() * self.Scene.GetScale();
  for (std::size_t k = 0; k < irradiance.size(); ++k)
  {
    const double area = unit * self.Scene.GetAreas()[k / Bands];
    enteringFlux[k % Bands] += area * entering * irradiance[k];
    leavingFlux[k % Bands] += area * self.Scattered[k];
  }
  vtkFieldData* fields = output->GetFieldData();
  AddSummary(fields, "NumberOfLinks", self.NumberOfLinks);
  AddSummary(fields, "LinksLeftOut", self.LinksLeftOut);
  AddSummary(fields, "LinkErrorBound", self.ErrorBound);
  AddSummary(fields, "LinkSeconds", self.LinkSeconds);
  AddSummary(fields, "ApplySeconds", self.ApplySeconds);
  AddSummary(fields, "EnteringFlux", enteringFlux);
  AddSummary(fields, "LeavingFlux", leavingFlux);
  AddSummary(fields, "DeviceUsed", self.DeviceUsed);
  AddSummary(fields, "DeviceExplanation", self.DeviceExplanation);

  table->Initialize();
  AddColumn(table, "Links", self.NumberOfLinks);
  AddColumn(table, "LinksLeftOut", self.LinksLeftOut);
  AddColumn(table, "LinkSeconds", self.LinkSeconds);
  AddColumn(table, "ApplySeconds", self.ApplySeconds);
  AddColumn(table, "ErrorBound", self.ErrorBound);
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material: " << GetMaterialName(this->Material) << "\n";
  os << indent << "ScatteringCoefficient: " << this->ScatteringCoefficient[0] << " "
     << this->ScatteringCoefficient[1] << " " << this->ScatteringCoefficient[2] << "\n";
  os << indent << "AbsorptionCoefficient: " << this->AbsorptionCoefficient[0] << " "
     << this->AbsorptionCoefficient[1] << " " << this->AbsorptionCoefficient[2] << "\n";
  os << indent << "RefractiveIndex: " << this->RefractiveIndex << "\n";
  os << indent << "MillimetersPerUnit: " << this->MillimetersPerUnit << "\n";
  os << indent << "Model: " << this->Model << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "Incidence: " << this->Incidence << "\n";
  os << indent << "Device: " << this->Device << "\n";
}
