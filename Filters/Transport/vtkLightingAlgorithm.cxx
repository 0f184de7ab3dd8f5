// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLightingAlgorithm.h"

#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <vector>

//------------------------------------------------------------------------------
struct vtkLightingAlgorithm::LightList
{
  std::vector<vtkSmartPointer<vtkLight>> Objects;
};

//------------------------------------------------------------------------------
vtkLightingAlgorithm::vtkLightingAlgorithm() : Lights(new LightList) {}

//------------------------------------------------------------------------------
vtkLightingAlgorithm::~vtkLightingAlgorithm()
{
  this->SetEnvironment(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkLightingAlgorithm, Environment, vtkImageData);

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
  return this->Environment ? std::max(time, this->Environment->GetMTime()) : time;
}

//------------------------------------------------------------------------------
void vtkLightingAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLights: " << this->GetNumberOfLights() << "\n";
  os << indent << "Environment: " << this->Environment << "\n";
  os << indent << "LightAngularDiameter: " << this->LightAngularDiameter << "\n";
  os << indent << "Shadows: " << this->Shadows << "\n";
}
