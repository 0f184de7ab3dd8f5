// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScattering.h"

#include "Links/LinkCache.h"
#include "Links/LinkOperators.h"
#include "Run/TransportRun.h"
#include "Scattering/ScatteringLinks.h"
#include "Scattering/ScatteringMaterials.h"
#include "Scene/CellArrays.h"
#include "Scene/SceneOutput.h"
#include "Scene/SmoothPoints.h"
#include "Shared/ArrayNames.h"
#include "Shared/FieldValues.h"
#include "Shared/Fresnel.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkLinkOperator.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScattering);

namespace
{
constexpr int Bands = 3;
// Indices of refraction that differ by less are the same.
constexpr double IndexTolerance = 1e-6;
// The links as a fraction of the progress.
constexpr double LinksDone = 0.95;

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
} // namespace

//------------------------------------------------------------------------------
class vtkSubsurfaceScattering::Run : public TransportRun
{
public:
  Run(vtkSubsurfaceScattering* owner, const RunPorts& ports) : TransportRun(ports), Owner(owner) {}

protected:
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

private:
  Outcome CheckMedia() const;
  Outcome ReadIrradiance();
  void CompareIndices() const;
  double GetEntering() const;

  vtkSubsurfaceScattering* Owner;
  std::vector<ScatteringMedium> Media; ///< of each band
  ///@{ patches x bands
  std::vector<double> Irradiance;
  std::vector<double> Scattered;
  ///@}
  double ApplySeconds = 0.0;
  std::string DeviceUsed;
  std::string DeviceExplanation;
};

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Check()
{
  if (Outcome device =
        LinkOperators::CheckDevice(static_cast<LinkDevice>(this->Owner->Device), this->AllRanks);
      !device)
  {
    return device;
  }
  double scattering[Bands];
  double absorption[Bands];
  double index;
  if (!GetMaterialProperties(this->Owner->Material, scattering, absorption, index))
  {
    std::copy_n(this->Owner->ScatteringCoefficient, Bands, scattering);
    std::copy_n(this->Owner->AbsorptionCoefficient, Bands, absorption);
    index = this->Owner->RefractiveIndex;
  }
  for (int band = 0; band < Bands; ++band)
  {
    this->Media.push_back({ scattering[band], absorption[band], index });
  }
  return this->CheckMedia();
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::CheckMedia() const
{
  std::ostringstream text;
  for (int band = 0; band < Bands; ++band)
  {
    const double scattering = this->Media[band].Scattering;
    const double absorption = this->Media[band].Absorption;
    if (!(scattering >= 0.0) || !(absorption >= 0.0) || !std::isfinite(scattering + absorption))
    {
      text << "ScatteringCoefficient and AbsorptionCoefficient must be finite and not negative, "
              "but component "
           << band << " has " << scattering << " and " << absorption << " per mm.";
      return Outcome::Failed(text.str());
    }
    if (scattering + absorption == 0.0)
    {
      text << "ScatteringCoefficient and AbsorptionCoefficient are both 0 in component " << band
           << ": light would pass through unchanged. Set one of them above 0.";
      return Outcome::Failed(text.str());
    }
  }
  const double index = this->Media[0].RefractiveIndex;
  if (!(index >= 1.0) || !std::isfinite(index))
  {
    text << "RefractiveIndex is " << index
         << ": it must be at least 1 (1.3 for water, 1.5 for glass and marble).";
    return Outcome::Failed(text.str());
  }
  const double unit = this->Owner->MillimetersPerUnit;
  if (!(unit > 0.0) || !std::isfinite(unit))
  {
    text << "MillimetersPerUnit is " << unit
         << ": it must be above 0 (10 for a mesh in centimetres).";
    return Outcome::Failed(text.str());
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Read()
{
  Outcome read = this->ReadIrradiance();
  if (read)
  {
    this->CompareIndices();
  }
  return read;
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::ReadIrradiance()
{
  const bool isDiffuse = this->Owner->Incidence == INCIDENCE_DIFFUSE;
  const std::string first =
    this->GetArrayName(0, isDiffuse ? ArrayNames::Irradiance : ArrayNames::TransmittedIrradiance);
  const std::string name = isDiffuse ? first : this->GetArrayName(1, first.c_str());
  std::vector<double> values;
  int components = 0;
  const CellArrays arrays(this->Scene, this->Input, this->AllRanks);
  if (Outcome read = arrays.Read(name, true, values, components); !read)
  {
    return read;
  }
  if (components != 1 && components != Bands)
  {
    return Outcome::Failed("The cell array \"" + name + "\" has " + std::to_string(components) +
      " components: it must have 1 (the same in all bands) or 3 (red, green, blue).");
  }
  const std::size_t patches = this->Scene.GetAreas().size();
  this->Irradiance.resize(patches * Bands);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    for (int band = 0; band < Bands; ++band)
    {
      this->Irradiance[patch * Bands + band] =
        values[patch * components + (components == 1 ? 0 : band)];
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::CompareIndices() const
{
  vtkDataArray* recorded = FindFieldArray(this->Input, ArrayNames::RefractiveIndex);
  if (this->Owner->Incidence != INCIDENCE_TRANSMITTED || !recorded ||
    recorded->GetNumberOfTuples() == 0)
  {
    return;
  }
  const double before = recorded->GetComponent(0, 0);
  const double here = this->Media[0].RefractiveIndex;
  if (std::abs(before - here) > IndexTolerance)
  {
    std::ostringstream text;
    text << "The transmitted irradiance was computed for a refractive index of " << before
         << ", but " << here
         << " is used here. Give vtkDirectIrradiance and vtkSubsurfaceScattering the same one.";
    this->Warn(text.str());
  }
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Link()
{
  const ScatteringLinks builder(this->Owner->Model, this->Media, this->Owner->MillimetersPerUnit,
    this->Owner->LinkTolerance);
  LinkCache& cache = *this->Owner->Links;
  Outcome updated = cache.Update(this->Scene, builder, this->AllRanks,
    this->Progress.GetMonitor().GetStage(0.0, LinksDone));
  if (updated && cache.WereMade() && !cache.Get().Warning.empty())
  {
    this->Warn(cache.Get().Warning);
  }
  return updated;
}

//------------------------------------------------------------------------------
/// Part of the input array that enters the surface.
double vtkSubsurfaceScattering::Run::GetEntering() const
{
  return this->Owner->Incidence == INCIDENCE_DIFFUSE
    ? 1.0 - Fresnel::GetMeanExternalReflectance(this->Media[0].RefractiveIndex)
    : 1.0;
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Compute()
{
  enum Slot
  {
    INCIDENT,
    LEFT,
    RIGHT,
    SCATTERED,
    SCRATCH
  };
  const double start = vtkTimerLog::GetUniversalTime();
  vtkExchange* exchange = this->Owner->Links->Get().GetExchange();
  vtkSmartPointer<vtkLinkOperator> links;
  if (Outcome made = LinkOperators::Make(static_cast<LinkDevice>(this->Owner->Device), exchange,
        Bands, this->AllRanks, links, this->DeviceExplanation);
      !made)
  {
    return made;
  }
  const std::vector<double>& areas = exchange->GetAreas();
  std::vector<double> left(this->Irradiance.size());
  const std::vector<double> right(this->Irradiance.size(), this->GetEntering());
  for (std::size_t k = 0; k < left.size(); ++k)
  {
    left[k] = 1.0 / areas[k / Bands];
  }
  this->Scattered.resize(this->Irradiance.size());
  if (!links->SetVector(INCIDENT, this->Irradiance.data()) ||
    !links->SetVector(LEFT, left.data()) || !links->SetVector(RIGHT, right.data()) ||
    !links->Apply(SCATTERED, LEFT, RIGHT, INCIDENT, SCRATCH) ||
    !links->GetVector(SCATTERED, this->Scattered.data()))
  {
    return Outcome::FailedAsReported();
  }
  this->DeviceUsed = links->GetDeviceName();
  this->ApplySeconds = vtkTimerLog::GetUniversalTime() - start;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::Write()
{
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle);
  SceneOutput(this->Scene, &points, this->Input, this->Output)
    .AddArray(ArrayNames::ScatteredIrradiance, this->Scattered, Bands);

  double enteringFlux[Bands] = {};
  double leavingFlux[Bands] = {};
  const double entering = this->GetEntering();
  for (std::size_t k = 0; k < this->Irradiance.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetAreas()[k / Bands];
    enteringFlux[k % Bands] += area * entering * this->Irradiance[k];
    leavingFlux[k % Bands] += area * this->Scattered[k];
  }
  const LightTransport::Links& links = this->Owner->Links->Get();
  vtkFieldData* fields = this->GetOutputFields();
  links.AddSummaries(fields);
  FieldValues::Add(fields, "ApplySeconds", this->ApplySeconds);
  FieldValues::Add(fields, "EnteringFlux", enteringFlux, Bands);
  FieldValues::Add(fields, "LeavingFlux", leavingFlux, Bands);
  FieldValues::Add(fields, "DeviceUsed", this->DeviceUsed);
  FieldValues::Add(fields, "DeviceExplanation", this->DeviceExplanation);

  this->Table->Initialize();
  vtkFieldData* row = this->Table->GetRowData();
  FieldValues::Add(row, "Links", links.GetSummary("NumberOfLinks"));
  FieldValues::Add(row, "LinksLeftOut", links.GetSummary("LinksLeftOut"));
  FieldValues::Add(row, "LinkSeconds", links.GetSummary("LinkSeconds"));
  FieldValues::Add(row, "ApplySeconds", this->ApplySeconds);
  FieldValues::Add(row, "ErrorBound", links.GetSummary("LinkErrorBound"));
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::vtkSubsurfaceScattering() : Links(new LinkCache)
{
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::~vtkSubsurfaceScattering() = default;

//------------------------------------------------------------------------------
std::unique_ptr<TransportRun> vtkSubsurfaceScattering::MakeRun(const RunPorts& ports)
{
  return std::make_unique<Run>(this, ports);
}

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
