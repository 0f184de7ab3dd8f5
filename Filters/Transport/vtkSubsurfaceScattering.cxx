// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSubsurfaceScattering.h"

#include "Links/LinkCache.h"
#include "Photons/MonteCarloRun.h"
#include "Scattering/ProfileRun.h"
#include "Scattering/ScatteringMaterials.h"
#include "Scattering/TexelLinksRun.h"
#include "Shared/AbortCheck.h"
#include "vtkExchange.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using namespace LightTransport;

vtkStandardNewMacro(vtkSubsurfaceScattering);

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
    this->Superclass::FillInputPortInformation(port, info);
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  // Refused, but here: the pipeline would run the filter for each block.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// All ranks need all of the medium, and all texels of their pieces whatever is asked of the output.
int vtkSubsurfaceScattering::RequestUpdateExtent(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* texels = inputs[0]->GetInformationObject(0);
  if (vtkImageData::GetData(texels) && texels->Has(Pipeline::WHOLE_EXTENT()))
  {
    texels->Set(Pipeline::UPDATE_EXTENT(), texels->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  if (vtkInformation* medium = inputs[1]->GetInformationObject(0))
  {
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
  if (ports.LinksAlone)
  {
    return std::make_unique<TexelLinksRun>(this, *this->Links, ports);
  }
  if (this->Model == MODEL_MONTE_CARLO)
  {
    return std::make_unique<MonteCarloRun>(this, *this->Links, ports);
  }
  return std::make_unique<ProfileRun>(this, *this->Links, ports);
}

//------------------------------------------------------------------------------
vtkExchange* vtkSubsurfaceScattering::MakeTexelLinks(vtkImageData* texels, vtkImageData* rows)
{
  if (!texels || !rows)
  {
    vtkErrorMacro("There is no texel image to link, or none to write the rows to.");
    return nullptr;
  }
  AbortCheck::Forget(this);
  RunPorts ports;
  ports.Filter = this;
  ports.Input = texels;
  ports.Output = rows;
  ports.ProgressInterval = this->ProgressInterval;
  ports.LinksAlone = true;
  const Outcome outcome = this->Run(ports);
  if (!outcome)
  {
    rows->Initialize();
  }
  if (!outcome.GetMessage().empty())
  {
    vtkErrorMacro(<< outcome.GetMessage());
  }
  return outcome ? this->Links->Get().GetExchange() : nullptr;
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
  std::copy_n(found->Scattering, 3, scattering);
  std::copy_n(found->Absorption, 3, absorption);
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
  os << indent << "NumberOfLinks: " << this->NumberOfLinks << "\n";
  os << indent << "ReuseLinks: " << this->ReuseLinks << "\n";
  os << indent << "RefineByIrradiance: " << this->RefineByIrradiance << "\n";
  os << indent << "CompressLinks: " << this->CompressLinks << "\n";
  os << indent << "CompressionTolerance: " << this->CompressionTolerance << "\n";
  os << indent << "DropLinksThroughAir: " << this->DropLinksThroughAir << "\n";
  os << indent << "LinkTolerance: " << this->LinkTolerance << "\n";
  os << indent << "Incidence: " << this->Incidence << "\n";
  os << indent << "Device: " << this->Device << "\n";
}
