// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringRun.h"

#include "Links/LinkBuilder.h"
#include "Links/LinkCache.h"
#include "Links/LinkOperators.h"
#include "Scattering/BodyThickness.h"
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
#include "vtkSubsurfaceScattering.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace LightTransport
{
namespace
{
// Indices of refraction that differ by less are the same.
constexpr double IndexTolerance = 1e-6;
// Diffusion lengths below which a body is thin.
constexpr double ThinBody = 2.0;
// Of one product. More do not go faster: what the clusters send leaves the caches then.
constexpr int LightsAtOnce = 4;

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
NumberProperties::List ScatteringRun::ListNumbers() const
{
  NumberProperties::List numbers = this->TransportRun::ListNumbers();
  numbers.emplace_back("TargetError", this->Owner->GetTargetError());
  numbers.emplace_back("LinkTolerance", this->Owner->GetLinkTolerance());
  numbers.emplace_back("CompressionTolerance", this->Owner->GetCompressionTolerance());
  return numbers;
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::Check()
{
  if (Outcome device = LinkOperators::CheckDevice(static_cast<LinkDevice>(this->Owner->GetDevice()),
        this->AllRanks);
      !device)
  {
    return device;
  }
  // Links of other profiles do not depend on anisotropy.
  const MediumProperties properties{ this->Owner->GetMaterial(),
    this->Owner->GetScatteringCoefficient(), this->Owner->GetAbsorptionCoefficient(),
    this->Owner->GetRefractiveIndex(),
    this->IsAnisotropic() ? this->Owner->GetAnisotropy() : nullptr,
    this->Owner->GetMillimetersPerUnit() };
  return properties.MakeMedia(this->Media);
}

//------------------------------------------------------------------------------
const char* ScatteringRun::FindUseOfBody() const
{
  return this->Owner->GetComputeThickness() ? "ComputeThickness" : nullptr;
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::CheckTexels() const
{
  const char* use = this->Scene.IsOfTexels() ? this->FindUseOfBody() : nullptr;
  return use ? Outcome::Failed(std::string("The input is a texel image, and ") + use +
                 " looks into the body, which texels do not enclose without gaps: give the "
                 "surface, and bring the result to the atlas with vtkSurfaceToAtlas.")
             : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::Read()
{
  Outcome read = this->CheckTexels();
  read = read ? this->ReadIrradiance() : read;
  if (read)
  {
    this->CompareIndices();
  }
  return read;
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::ReadIrradiance()
{
  const bool isDiffuse = this->Owner->GetIncidence() == vtkSubsurfaceScattering::INCIDENCE_DIFFUSE;
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
  if (components != 1 && components % Bands != 0)
  {
    return Outcome::Failed("The " + arrays.GetKind() + " \"" + name + "\" has " +
      std::to_string(components) +
      " components: it must have 1 (the same in all bands), 3 (red, green, blue), or 3 for each of "
      "several lights, one light after another.");
  }
  if (components > 1)
  {
    this->NumberOfLights = components / Bands;
    this->Irradiance = std::move(values);
    return Outcome::Done();
  }
  this->Irradiance.clear();
  this->Irradiance.reserve(values.size() * Bands);
  for (const double value : values)
  {
    this->Irradiance.insert(this->Irradiance.end(), Bands, value);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void ScatteringRun::CompareIndices() const
{
  vtkDataArray* recorded = FindFieldArray(this->Input, ArrayNames::RefractiveIndex);
  if (this->Owner->GetIncidence() != vtkSubsurfaceScattering::INCIDENCE_TRANSMITTED || !recorded ||
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
Outcome ScatteringRun::Link()
{
  Outcome updated = this->Cache.Update(this->Scene, *this->MakeBuilder(), this->AllRanks,
    this->Progress.GetMonitor().GetStage(0.0, LinksDone));
  if (updated && this->Cache.WereMade() && !this->Cache.Get().Warning.empty())
  {
    this->Warn(this->Cache.Get().Warning);
  }
  return updated;
}

//------------------------------------------------------------------------------
/// Part of the input array that enters the surface.
double ScatteringRun::GetEnteringShare() const
{
  return this->Owner->GetIncidence() == vtkSubsurfaceScattering::INCIDENCE_DIFFUSE
    ? 1.0 - Fresnel::GetMeanExternalReflectance(this->Media[0].RefractiveIndex)
    : 1.0;
}

//------------------------------------------------------------------------------
std::vector<double> ScatteringRun::GetEntering() const
{
  std::vector<double> entering = this->Irradiance;
  const double share = this->GetEnteringShare();
  for (double& irradiance : entering)
  {
    irradiance *= share;
  }
  return entering;
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::Compute()
{
  const double start = vtkTimerLog::GetUniversalTime();
  Outcome done = this->Scatter();
  this->ApplySeconds = vtkTimerLog::GetUniversalTime() - start;
  return done && this->Owner->GetComputeThickness()
    ? this->AllRanks.Agree(BodyThickness::Measure(this->Scene, this->Thickness))
    : done;
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::Scatter()
{
  this->Scattered = this->GetEntering();
  return this->ApplyLinks(this->Scattered, this->NumberOfLights);
}

//------------------------------------------------------------------------------
Outcome ScatteringRun::ApplyLinks(std::vector<double>& light, int numberOfLights)
{
  enum Slot
  {
    ENTERING,
    LEAVING
  };
  vtkExchange* exchange = this->Cache.Get().GetExchange();
  const std::vector<double>& areas = exchange->GetAreas();
  const int products = (numberOfLights + LightsAtOnce - 1) / LightsAtOnce;
  const int bands = Bands * ((numberOfLights + products - 1) / products);
  const int components = Bands * numberOfLights;
  vtkSmartPointer<vtkLinkOperator> links;
  Outcome done = LinkOperators::Make(static_cast<LinkDevice>(this->Owner->GetDevice()), exchange,
    bands, this->AllRanks, links, this->DeviceExplanation);
  std::vector<double> some(areas.size() * bands, 0.0);
  for (int first = 0; done && first < components; first += bands)
  {
    const int count = std::min(bands, components - first);
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      std::copy_n(light.begin() + patch * components + first, count, some.begin() + patch * bands);
    }
    if (!links->SetVector(ENTERING, some.data()) || !links->Multiply(LEAVING, ENTERING) ||
      !links->GetVector(LEAVING, some.data()))
    {
      return Outcome::FailedAsReported();
    }
    for (std::size_t patch = 0; patch < areas.size(); ++patch)
    {
      std::transform(some.begin() + patch * bands, some.begin() + patch * bands + count,
        light.begin() + patch * components + first,
        [scale = 1.0 / areas[patch]](double power) { return scale * power; });
    }
    done = this->Progress.GetMonitor()
             .GetStage(LinksDone, 1.0)
             .Check(static_cast<double>(first + count) / components);
  }
  if (done)
  {
    this->DeviceUsed = links->GetDeviceName();
  }
  return done;
}

//------------------------------------------------------------------------------
void ScatteringRun::Write()
{
  std::unique_ptr<SmoothPoints> points;
  if (!this->Scene.IsOfTexels())
  {
    points = std::make_unique<SmoothPoints>(this->Scene, this->Owner->GetFeatureAngle());
  }
  const SceneOutput output(this->Scene, points.get(), this->Input, this->Output);
  if (this->Owner->GetComputeThickness())
  {
    this->WriteThickness(output);
  }
  this->WriteFluxes();
  this->WriteScattered(output);
}

//------------------------------------------------------------------------------
void ScatteringRun::WriteThickness(const SceneOutput& output)
{
  const double scale = this->Scene.GetScale() * this->Owner->GetMillimetersPerUnit();
  const std::size_t patches = this->Thickness.size();
  std::vector<double> millimeters(patches);
  std::vector<double> lengths(patches * Bands);
  double total = 0.0;
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    const double area = this->Scene.GetAreas()[patch];
    millimeters[patch] = scale * this->Thickness[patch];
    total += area;
    for (int band = 0; band < Bands; ++band)
    {
      double& value = lengths[patch * Bands + band];
      value = millimeters[patch] * BodyThickness::GetTransportCoefficient(this->Media[band]);
      this->ThinShares[band] += value < ThinBody ? area : 0.0;
    }
  }
  for (double& share : this->ThinShares)
  {
    share /= total;
  }
  output.AddArray("Thickness", millimeters, 1);
  output.AddArray("DiffusionThickness", lengths, Bands);
  FieldValues::Add(this->GetOutputFields(), "ThinShare", this->ThinShares, Bands);
}

//------------------------------------------------------------------------------
void ScatteringRun::WriteFluxes()
{
  const double share = this->GetEnteringShare();
  const auto components = static_cast<std::size_t>(this->GetNumberOfComponents());
  this->EnteringFlux.assign(components, 0.0);
  this->LeavingFlux.assign(components, 0.0);
  for (std::size_t k = 0; k < this->Irradiance.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetAreas()[k / components];
    this->EnteringFlux[k % components] += area * share * this->Irradiance[k];
  }
  this->SumLeaving();
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, "EnteringFlux", this->EnteringFlux.data(),
    this->GetNumberOfComponents());
  FieldValues::Add(fields, "LeavingFlux", this->LeavingFlux.data(), this->GetNumberOfComponents());
  FieldValues::Add(fields, "DeviceUsed", this->DeviceUsed);
  FieldValues::Add(fields, "DeviceExplanation", this->DeviceExplanation);
}

//------------------------------------------------------------------------------
void ScatteringRun::SumLeaving()
{
  const auto components = static_cast<std::size_t>(this->GetNumberOfComponents());
  for (std::size_t k = 0; k < this->Scattered.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetAreas()[k / components];
    this->LeavingFlux[k % components] += area * this->Scattered[k];
  }
}

//------------------------------------------------------------------------------
void ScatteringRun::WriteScattered(const SceneOutput& output)
{
  output.AddArray(ArrayNames::ScatteredIrradiance, this->Scattered, this->GetNumberOfComponents());
  const Links& links = this->Cache.Get();
  vtkFieldData* fields = this->GetOutputFields();
  links.AddSummaries(fields);
  FieldValues::Add(fields, "LinksReused", this->Cache.WereMade() ? links.ReusedShare : 1.0);
  FieldValues::Add(fields, "ApplySeconds", this->ApplySeconds);

  this->Table->Initialize();
  vtkFieldData* row = this->Table->GetRowData();
  FieldValues::Add(row, "Links", links.GetSummary("NumberOfLinks"));
  FieldValues::Add(row, "LinksLeftOut", links.GetSummary("LinksLeftOut"));
  FieldValues::Add(row, "LinkSeconds", links.GetSummary("LinkSeconds"));
  FieldValues::Add(row, "ApplySeconds", this->ApplySeconds);
  FieldValues::Add(row, "ErrorBound", links.GetSummary("LinkErrorBound"));
}
} // namespace LightTransport
