// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringModels.h"

#include "Scattering/DipoleProfile.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <string>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
template <typename Profile>
std::unique_ptr<const ScatteringProfile> Make(const ScatteringMedium& medium)
{
  return std::make_unique<const Profile>(medium);
}
} // namespace

//------------------------------------------------------------------------------
const std::vector<ScatteringModel>& ScatteringModels::GetAll()
{
  static const std::vector<ScatteringModel> models = {
    { vtkSubsurfaceScattering::MODEL_DIPOLE, "Dipole", Make<DipoleProfile> },
  };
  return models;
}

//------------------------------------------------------------------------------
const ScatteringModel* ScatteringModels::Find(int number)
{
  const std::vector<ScatteringModel>& models = GetAll();
  const auto found = std::find_if(models.begin(), models.end(),
    [number](const ScatteringModel& model) { return model.Number == number; });
  return found != models.end() ? &*found : nullptr;
}

//------------------------------------------------------------------------------
Outcome ScatteringModels::MakeProfiles(int number, const std::vector<ScatteringMedium>& bands,
  ScatteringProfiles& profiles)
{
  const ScatteringModel* model = Find(number);
  if (!model)
  {
    std::string names;
    for (const ScatteringModel& known : GetAll())
    {
      names += (names.empty() ? "" : ", ") + std::string(known.Name) + " (" +
        std::to_string(known.Number) + ")";
    }
    return Outcome::Failed(
      "Model is " + std::to_string(number) + ", which no profile has. Choose from: " + names + ".");
  }
  profiles.clear();
  for (const ScatteringMedium& band : bands)
  {
    profiles.push_back(model->MakeProfile(band));
  }
  return Outcome::Done();
}
} // namespace LightTransport
