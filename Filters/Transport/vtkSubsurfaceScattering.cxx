// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScattering.h"

#include "Links/LinkCache.h"
#include "Links/LinkOperators.h"
#include "Photons/ClosedSurface.h"
#include "Photons/MediumImage.h"
#include "Photons/PhotonLinks.h"
#include "Photons/PhotonScattering.h"
#include "Run/TransportRun.h"
#include "Scattering/BodyThickness.h"
#include "Scattering/MediumProperties.h"
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
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLinkOperator.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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
// Light that photons lose on their way: of less nobody need know, and with more nothing is known.
constexpr double LostShareToTell = 1e-4;
constexpr double LostShareToFail = 0.02;
// More light than entered, beyond the error of the links, that is not worth a warning.
constexpr double NegligibleExcess = 0.01;
// Diffusion lengths below which a body is thin, and how much of it may be.
constexpr double ThinBody = 2.0;
constexpr double LargestThinShare = 0.1;

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
  NumberProperties::List ListNumbers() const override;
  Outcome Check() override;
  Outcome Read() override;
  Outcome Link() override;
  Outcome Compute() override;
  void Write() override;

private:
  Outcome ReadIrradiance();
  Outcome ReadMedium();
  void CompareIndices() const;
  void CheckEnergy(const double entering[], const double leaving[]) const;
  double GetEntering() const;
  void SumFlux(double entering[], double leaving[]) const;
  bool IsMonteCarlo() const { return this->Owner->Model == MODEL_MONTE_CARLO; }
  bool IsTabulated() const { return this->Owner->Model == MODEL_TABULATED; }
  /// Without links.
  bool FollowsPhotons() const
  {
    return this->IsMonteCarlo() && this->Owner->LinkMethod == LINK_METHOD_AUTO;
  }
  PhotonScattering::Settings GetPhotonSettings() const;
  std::unique_ptr<LinkBuilder> MakeBuilder() const;
  Outcome CheckLost(double share) const;
  Outcome ApplyLinks();
  Outcome FollowPhotons();
  void WriteLinks() const;
  void WritePhotons(const SceneOutput& output) const;
  void WriteThickness(const SceneOutput& output) const;

  vtkSubsurfaceScattering* Owner;
  std::vector<ScatteringMedium> Media; ///< of each band
  /// Where the medium varies; else nullptr.
  std::unique_ptr<MediumImage> Image;
  ///@{ patches x bands
  std::vector<double> Irradiance;
  std::vector<double> Scattered;
  std::vector<double> Errors; ///< where links are counts of photons
  ///@}
  PhotonScattering::Result Photons;
  std::vector<double> Thickness; ///< of each patch, in scene units
  double ApplySeconds = 0.0;
  std::string DeviceUsed;
  std::string DeviceExplanation;
};

//------------------------------------------------------------------------------
NumberProperties::List vtkSubsurfaceScattering::Run::ListNumbers() const
{
  NumberProperties::List numbers = this->TransportRun::ListNumbers();
  numbers.emplace_back("TargetError", this->Owner->TargetError);
  numbers.emplace_back("LinkTolerance", this->Owner->LinkTolerance);
  return numbers;
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Check()
{
  if (Outcome device =
        LinkOperators::CheckDevice(static_cast<LinkDevice>(this->Owner->Device), this->AllRanks);
      !device)
  {
    return device;
  }
  if (this->FollowsPhotons() && this->Owner->Device == DEVICE_OPENGL)
  {
    return Outcome::Failed("Device is OpenGL, which applies links: photons are followed on the "
                           "CPU. Set Device to Auto, or LinkMethod to Dense.");
  }
  if (this->Owner->GetNumberOfInputConnections(1) > 0 && !this->IsMonteCarlo())
  {
    return Outcome::Failed("A medium that varies is connected (input port 1), and Model is a "
                           "profile of uniform media: set Model to MonteCarlo, or disconnect it.");
  }
  // Links of other profiles do not depend on it.
  const bool isAnisotropic = this->IsMonteCarlo() || this->IsTabulated();
  const MediumProperties properties{ this->Owner->Material, this->Owner->ScatteringCoefficient,
    this->Owner->AbsorptionCoefficient, this->Owner->RefractiveIndex,
    isAnisotropic ? this->Owner->Anisotropy : nullptr, this->Owner->MillimetersPerUnit };
  return properties.MakeMedia(this->Media);
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::Read()
{
  Outcome read = this->ReadIrradiance();
  if (read)
  {
    this->CompareIndices();
  }
  return read ? this->ReadMedium() : read;
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::ReadMedium()
{
  if (this->Owner->GetNumberOfInputConnections(1) == 0)
  {
    return Outcome::Done();
  }
  vtkDataObject* medium = this->Owner->GetInputDataObject(1, 0);
  auto* image = vtkImageData::SafeDownCast(medium);
  if (!image)
  {
    return Outcome::Failed(std::string("The medium (input port 1) is a ") +
      (medium ? medium->GetClassName() : "connection without data") +
      ": it must be one vtkImageData. Extract the block that has it.");
  }
  const double scale = this->Scene.GetScale();
  this->Image = std::make_unique<MediumImage>();
  Outcome read = this->Image->Read(image,
    { this->Scene.GetCenter(), scale, scale * this->Owner->MillimetersPerUnit });
  if (!read)
  {
    return read;
  }
  const std::vector<std::uint64_t> all =
    this->AllRanks.Gather(std::vector<std::uint64_t>{ this->Image->GetFingerprint() });
  return std::equal(all.begin() + 1, all.end(), all.begin())
    ? Outcome::Done()
    : Outcome::Failed("The medium is not the same on all ranks: each of them needs all of it.");
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
  if (this->FollowsPhotons())
  {
    return ClosedSurface::Check(this->Scene);
  }
  LinkCache& cache = *this->Owner->Links;
  Outcome updated = cache.Update(this->Scene, *this->MakeBuilder(), this->AllRanks,
    this->Progress.GetMonitor().GetStage(0.0, LinksDone));
  if (updated && cache.WereMade() && !cache.Get().Warning.empty())
  {
    this->Warn(cache.Get().Warning);
  }
  return updated ? this->CheckLost(cache.Get().GetSummary("LostShare")) : updated;
}

//------------------------------------------------------------------------------
std::unique_ptr<LinkBuilder> vtkSubsurfaceScattering::Run::MakeBuilder() const
{
  if (this->IsMonteCarlo())
  {
    return std::make_unique<PhotonLinks>(this->Media, this->Owner->MillimetersPerUnit,
      this->GetPhotonSettings(), this->Image.get());
  }
  ScatteringOptions options;
  options.BurleyFit = this->Owner->BurleyFit;
  if (this->IsTabulated())
  {
    options.NumberOfPhotons = this->Owner->NumberOfPhotons;
    options.Seed = static_cast<std::uint64_t>(this->Owner->Seed);
  }
  return std::make_unique<ScatteringLinks>(this->Owner->Model, options, this->Media,
    this->Owner->MillimetersPerUnit, this->Owner->LinkTolerance);
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
  const double start = vtkTimerLog::GetUniversalTime();
  Outcome done = this->FollowsPhotons() ? this->FollowPhotons() : this->ApplyLinks();
  this->ApplySeconds = vtkTimerLog::GetUniversalTime() - start;
  return done && this->Owner->ComputeThickness
    ? this->AllRanks.Agree(BodyThickness::Measure(this->Scene, this->Thickness))
    : done;
}

//------------------------------------------------------------------------------
PhotonScattering::Settings vtkSubsurfaceScattering::Run::GetPhotonSettings() const
{
  return { this->Owner->TargetError, this->Owner->NumberOfPhotons,
    static_cast<std::uint64_t>(this->Owner->Seed) };
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::FollowPhotons()
{
  std::vector<double> entering = this->Irradiance;
  const double share = this->GetEntering();
  for (double& irradiance : entering)
  {
    if (irradiance < 0.0)
    {
      return Outcome::Failed(
        "The irradiance is negative on some polygons, which photons cannot be: "
        "set LinkMethod to Dense for differences of light.");
    }
    irradiance *= share;
  }
  const PhotonScattering scattering(this->Scene,
    PhotonScattering::GetMedia(this->Media,
      this->Scene.GetScale() * this->Owner->MillimetersPerUnit),
    this->Media[0].RefractiveIndex, this->Image.get());
  Outcome done = scattering.Run(entering, this->GetPhotonSettings(), this->AllRanks,
    this->Progress.GetMonitor().GetStage(0.0, LinksDone), this->Photons);
  this->DeviceUsed = "CPU";
  this->DeviceExplanation = "photons are followed on the CPU";
  return done ? this->CheckLost(*std::max_element(this->Photons.LostShares.begin(),
                  this->Photons.LostShares.end()))
              : done;
}

//------------------------------------------------------------------------------
// Of the light that photons have lost.
Outcome vtkSubsurfaceScattering::Run::CheckLost(double share) const
{
  std::ostringstream text;
  text
    << 100.0 * share
    << " % of the light is lost on its way: the surface crosses itself, or photons are scattered "
       "more than "
    << PhotonWalk::MostScatterings
    << " times. Unite its parts (vtkPatchMesher with Repair), or check MillimetersPerUnit.";
  if (share > LostShareToFail)
  {
    return Outcome::Failed(text.str());
  }
  if (share > LostShareToTell)
  {
    this->WarnOnce({ text.str() });
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome vtkSubsurfaceScattering::Run::ApplyLinks()
{
  enum Slot
  {
    INCIDENT,
    LEFT,
    RIGHT,
    SCATTERED,
    SCRATCH
  };
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
  std::vector<double> light = this->Irradiance;
  const double share = this->GetEntering();
  for (std::size_t k = 0; k < left.size(); ++k)
  {
    left[k] = 1.0 / areas[k / Bands];
    light[k] *= share;
  }
  this->Scattered.resize(this->Irradiance.size());
  const std::vector<double> right(left.size(), 1.0);
  const auto apply = [&](const std::vector<double>& from, std::vector<double>& to)
  {
    return links->SetVector(INCIDENT, from.data()) && links->SetVector(LEFT, left.data()) &&
      links->SetVector(RIGHT, right.data()) &&
      links->Apply(SCATTERED, LEFT, RIGHT, INCIDENT, SCRATCH) &&
      links->GetVector(SCATTERED, to.data());
  };
  if (!apply(light, this->Scattered))
  {
    return Outcome::FailedAsReported();
  }
  if (this->IsMonteCarlo())
  {
    std::vector<double> squares(light.size());
    std::transform(light.begin(), light.end(), squares.begin(), [](double e) { return e * e; });
    if (!apply(squares, squares))
    {
      return Outcome::FailedAsReported();
    }
    this->Errors =
      PhotonLinks::GetErrors(this->Owner->Links->Get(), light, squares, this->AllRanks);
  }
  this->DeviceUsed = links->GetDeviceName();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
/// More than all of it comes back only by an error.
void vtkSubsurfaceScattering::Run::CheckEnergy(const double entering[],
  const double leaving[]) const
{
  const double margin = NegligibleExcess + this->Owner->Links->Get().GetSummary("LinkErrorBound");
  for (int band = 0; band < Bands; ++band)
  {
    if (leaving[band] > (1.0 + margin) * entering[band])
    {
      std::ostringstream text;
      text
        << "In component " << band << " " << leaving[band] / entering[band]
        << " times the light that enters leaves again: the model claims too much where little is "
           "absorbed, or straight links do, across sharp edges and the air between parts of the "
           "body. Compare with Model MonteCarlo, which keeps energy in closed bodies.";
      this->Warn(text.str());
      return;
    }
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::WriteThickness(const SceneOutput& output) const
{
  const double scale = this->Scene.GetScale() * this->Owner->MillimetersPerUnit;
  const std::size_t patches = this->Thickness.size();
  std::vector<double> millimeters(patches);
  std::vector<double> lengths(patches * Bands);
  double thin[Bands] = {};
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
      thin[band] += value < ThinBody ? area : 0.0;
    }
  }
  for (double& share : thin)
  {
    share /= total;
  }
  output.AddArray("Thickness", millimeters, 1);
  output.AddArray("DiffusionThickness", lengths, Bands);
  FieldValues::Add(this->GetOutputFields(), "ThinShare", thin, Bands);
  const double* worst = std::max_element(thin, thin + Bands);
  if (*worst > LargestThinShare && !this->IsMonteCarlo())
  {
    std::ostringstream text;
    text << "In component " << worst - thin << " " << 100.0 * *worst
         << " % of the surface is thinner than two diffusion lengths (DiffusionThickness), where "
            "models of a medium without end claim too much. Use Model MonteCarlo.";
    this->WarnOnce({ text.str() });
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::Write()
{
  const SmoothPoints points(this->Scene, this->Owner->FeatureAngle);
  const SceneOutput output(this->Scene, &points, this->Input, this->Output);
  if (this->Owner->ComputeThickness)
  {
    this->WriteThickness(output);
  }
  double entering[Bands] = {};
  double leaving[Bands] = {};
  this->SumFlux(entering, leaving);
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, "EnteringFlux", entering, Bands);
  FieldValues::Add(fields, "LeavingFlux", leaving, Bands);
  FieldValues::Add(fields, "DeviceUsed", this->DeviceUsed);
  FieldValues::Add(fields, "DeviceExplanation", this->DeviceExplanation);
  this->Table->Initialize();
  if (this->FollowsPhotons())
  {
    this->WritePhotons(output);
  }
  else
  {
    output.AddArray(ArrayNames::ScatteredIrradiance, this->Scattered, Bands);
    if (this->IsMonteCarlo())
    {
      output.AddArray(ArrayNames::ScatteredIrradianceError, this->Errors, Bands);
    }
    else
    {
      this->CheckEnergy(entering, leaving);
    }
    this->WriteLinks();
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::SumFlux(double entering[], double leaving[]) const
{
  const double share = this->GetEntering();
  for (std::size_t k = 0; k < this->Irradiance.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetAreas()[k / Bands];
    entering[k % Bands] += area * share * this->Irradiance[k];
    leaving[k % Bands] += this->FollowsPhotons() ? 0.0 : area * this->Scattered[k];
  }
  for (std::size_t k = 0; k < this->Photons.Scattered.size(); ++k)
  {
    const double area = this->GetAreaUnit() * this->Scene.GetFaces().GetArea(k / Bands);
    leaving[k % Bands] += area * this->Photons.Scattered[k];
  }
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::WriteLinks() const
{
  const LightTransport::Links& links = this->Owner->Links->Get();
  vtkFieldData* fields = this->GetOutputFields();
  links.AddSummaries(fields);
  if (this->IsTabulated())
  {
    FieldValues::Add(fields, "ProfileError", links.ProfileErrors.data(), Bands);
  }
  FieldValues::Add(fields, "LinksReused", this->Owner->Links->WereMade() ? 0.0 : 1.0);
  FieldValues::Add(fields, "ApplySeconds", this->ApplySeconds);

  vtkFieldData* row = this->Table->GetRowData();
  FieldValues::Add(row, "Links", links.GetSummary("NumberOfLinks"));
  FieldValues::Add(row, "LinksLeftOut", links.GetSummary("LinksLeftOut"));
  FieldValues::Add(row, "LinkSeconds", links.GetSummary("LinkSeconds"));
  FieldValues::Add(row, "ApplySeconds", this->ApplySeconds);
  FieldValues::Add(row, "ErrorBound", links.GetSummary("LinkErrorBound"));
}

//------------------------------------------------------------------------------
void vtkSubsurfaceScattering::Run::WritePhotons(const SceneOutput& output) const
{
  const PhotonScattering::Result& photons = this->Photons;
  output.AddFaceArray(ArrayNames::ScatteredIrradiance, photons.Scattered, Bands);
  output.AddFaceArray(ArrayNames::ScatteredIrradianceError, photons.Errors, Bands);
  const double count = std::max<double>(photons.Photons, 1.0);
  const double error =
    *std::max_element(photons.RelativeErrors.begin(), photons.RelativeErrors.end());
  vtkFieldData* fields = this->GetOutputFields();
  FieldValues::Add(fields, "LeavingShare", photons.LeavingShares.data(), Bands);
  FieldValues::Add(fields, "LeavingShareError", photons.LeavingShareErrors.data(), Bands);
  FieldValues::Add(fields, "UnscatteredShare", photons.UnscatteredShares.data(), Bands);
  FieldValues::Add(fields, "LostShare", photons.LostShares.data(), Bands);
  FieldValues::Add(fields, "RelativeError", photons.RelativeErrors.data(), Bands);
  FieldValues::Add(fields, "PhotonsTraced", static_cast<double>(photons.Photons));
  FieldValues::Add(fields, "ScatteringsPerPhoton", photons.Counts.Scatterings / count);
  FieldValues::Add(fields, "EntriesPerPhoton", photons.Counts.Entries / count);
  FieldValues::Add(fields, "WalkSeconds", this->ApplySeconds);

  vtkFieldData* row = this->Table->GetRowData();
  FieldValues::Add(row, "Photons", static_cast<double>(photons.Photons));
  FieldValues::Add(row, "WalkSeconds", this->ApplySeconds);
  FieldValues::Add(row, "Error", error);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::vtkSubsurfaceScattering() : Links(new LinkCache)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

//------------------------------------------------------------------------------
vtkSubsurfaceScattering::~vtkSubsurfaceScattering() = default;

//------------------------------------------------------------------------------
int vtkSubsurfaceScattering::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  // Refused, but here: the pipeline would run the filter for each block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// All ranks need all of the medium.
int vtkSubsurfaceScattering::RequestUpdateExtent(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (vtkInformation* medium = inputs[1]->GetInformationObject(0))
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    medium->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    medium->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    medium->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (medium->Has(Pipeline::WHOLE_EXTENT()))
    {
      medium->Set(Pipeline::UPDATE_EXTENT(), medium->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

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
  os << indent << "LinkMethod: " << this->LinkMethod << "\n";
  os << indent << "Anisotropy: " << this->Anisotropy[0] << " " << this->Anisotropy[1] << " "
     << this->Anisotropy[2] << "\n";
  os << indent << "NumberOfPhotons: " << this->NumberOfPhotons << "\n";
  os << indent << "TargetError: " << this->TargetError << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "BurleyFit: " << this->BurleyFit << "\n";
  os << indent << "ComputeThickness: " << this->ComputeThickness << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "Incidence: " << this->Incidence << "\n";
  os << indent << "Device: " << this->Device << "\n";
}
