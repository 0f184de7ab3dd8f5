// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LightingRun.h"

#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightingAlgorithm.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace LightTransport
{
namespace
{
/// Calls of the progress function, at least, and rays at most between two of them, by which a user
/// who aborts does not wait. The same on all ranks.
constexpr double LeastBatches = 50.0;
constexpr double RaysOfBatch = 4e6;
} // namespace

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

//------------------------------------------------------------------------------
Outcome LightingRun::ForLocalPatches(double rays, double done,
  const std::function<void(vtkIdType)>& compute, const std::function<void(vtkIdType)>& finish)
{
  const std::vector<vtkIdType> locals = this->Scene.GetLocalPatches();
  const auto count = static_cast<vtkIdType>(locals.size());
  const auto computeSome = [&locals, &compute](vtkIdType first, vtkIdType last)
  {
    for (vtkIdType local = first; local < last; ++local)
    {
      Pulse::Beat();
      compute(locals[local]);
    }
  };
  const Monitor monitor = this->Progress.GetMonitor().GetStage(0.0, done);
  const auto patches = static_cast<double>(this->Scene.GetAreas().size());
  const auto batches = static_cast<vtkIdType>(
    std::max(LeastBatches, std::min(patches, std::ceil(patches * rays / RaysOfBatch))));
  for (vtkIdType batch = 0; batch < batches; ++batch)
  {
    const vtkIdType first = count * batch / batches;
    const vtkIdType last = count * (batch + 1) / batches;
    Threads::For(first, last, std::min<vtkIdType>(16, 1 + (last - first) / 16), computeSome);
    if (finish)
    {
      std::for_each(locals.begin() + first, locals.begin() + last, finish);
    }
    if (!monitor.Report(static_cast<double>(batch + 1) / static_cast<double>(batches)))
    {
      return Outcome::Aborted();
    }
  }
  return Outcome::Done();
}
} // namespace LightTransport
