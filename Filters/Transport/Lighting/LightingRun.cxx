// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LightingRun.h"

#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightingAlgorithm.h"

#include <string>

namespace LightTransport
{
//------------------------------------------------------------------------------
NumberProperties::List LightingRun::ListNumbers() const
{
  NumberProperties::List numbers = this->TransportRun::ListNumbers();
  numbers.emplace_back("LightAngularDiameter", this->Lighting->GetLightAngularDiameter());
  return numbers;
}

//------------------------------------------------------------------------------
Outcome LightingRun::ReadLights(std::vector<PunctualLight>& lights) const
{
  for (int index = 0; index < this->Lighting->GetNumberOfLights(); ++index)
  {
    vtkLight* object = this->Lighting->GetLight(index);
    if (!object->GetSwitch())
    {
      continue;
    }
    const std::string name = "Light " + std::to_string(index);
    if (!object->LightTypeIsSceneLight())
    {
      return Outcome::Failed(name +
        " is a headlight or camera light, which follows a camera, and a filter has none: call "
        "SetLightTypeToSceneLight().");
    }
    PunctualLight light;
    if (Outcome read = light.Read(object, this->Scene); !read)
    {
      return Outcome::Failed(name + read.GetMessage());
    }
    lights.push_back(light);
  }
  if (lights.empty() && !this->Lighting->GetEnvironment())
  {
    this->Warn("No light is on and there is no environment: the irradiance is 0. Add one with "
               "AddLight or SetEnvironment.");
  }
  return Outcome::Done();
}
} // namespace LightTransport
