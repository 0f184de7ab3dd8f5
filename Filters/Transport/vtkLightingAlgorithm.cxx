// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightingAlgorithm.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <vector>

//------------------------------------------------------------------------------
struct vtkLightingAlgorithm::LightList
{
  std::vector<vtkSmartPointer<vtkLight>> Objects;
};

//------------------------------------------------------------------------------
vtkLightingAlgorithm::vtkLightingAlgorithm() : Lights(new LightList)
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
vtkLightingAlgorithm::~vtkLightingAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::SetEnvironment(vtkImageData* environment)
{
  this->SetInputDataObject(1, environment);
}

//------------------------------------------------------------------------------
vtkImageData* vtkLightingAlgorithm::GetEnvironment()
{
  return vtkImageData::SafeDownCast(this->GetInputDataObject(1, 0));
}

//------------------------------------------------------------------------------
int vtkLightingAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
// Every rank needs the whole picture for its piece of the surface.
int vtkLightingAlgorithm::RequestUpdateExtent(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (vtkInformation* picture = inputs[1]->GetInformationObject(0))
  {
    picture->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    picture->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    picture->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (picture->Has(Pipeline::WHOLE_EXTENT()))
    {
      picture->Set(Pipeline::UPDATE_EXTENT(), picture->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::AddLight(vtkLight* light)
{
  auto& lights = this->Lights->Objects;
  if (light && std::find(lights.begin(), lights.end(), light) == lights.end())
  {
    lights.emplace_back(light);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::RemoveLight(vtkLight* light)
{
  auto& lights = this->Lights->Objects;
  const auto found = std::find(lights.begin(), lights.end(), light);
  if (found != lights.end())
  {
    lights.erase(found);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::RemoveAllLights()
{
  if (!this->Lights->Objects.empty())
  {
    this->Lights->Objects.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkLightingAlgorithm::GetNumberOfLights()
{
  return static_cast<int>(this->Lights->Objects.size());
}

//------------------------------------------------------------------------------
vtkLight* vtkLightingAlgorithm::GetLight(int index)
{
  return index >= 0 && index < this->GetNumberOfLights() ? this->Lights->Objects[index].Get()
                                                         : nullptr;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkLightingAlgorithm::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkLight* light : this->Lights->Objects)
  {
    time = std::max(time, light->GetMTime());
    if (vtkMatrix4x4* matrix = light->GetTransformMatrix())
    {
      time = std::max(time, matrix->GetMTime());
    }
  }
  return time;
}

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  os << indent << "Environment: " << this->GetEnvironment() << "\n";
  os << indent << "LightAngularDiameter: " << this->LightAngularDiameter << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
}
