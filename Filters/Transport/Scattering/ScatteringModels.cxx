// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringModels.h"

#include "Scattering/BetterDipoleProfile.h"
#include "Scattering/ChristensenBurleyProfile.h"
#include "Scattering/DipoleProfile.h"
#include "Scattering/PhotonBeamProfile.h"
#include "Scattering/TabulatedProfile.h"
#include "vtkSubsurfaceScattering.h"

#include <algorithm>
#include <cstddef>
#include <string>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
template <typename Profile>
std::unique_ptr<const ScatteringProfile> Make(const ScatteringMedium& medium,
  const ScatteringOptions&)
{
  return std::make_unique<const Profile>(medium);
}

//------------------------------------------------------------------------------
std::unique_ptr<const ScatteringProfile> MakeChristensenBurley(const ScatteringMedium& medium,
  const ScatteringOptions& options)
{
  return std::make_unique<const ChristensenBurleyProfile>(medium, options.BurleyFit);
}

//------------------------------------------------------------------------------
std::unique_ptr<const ScatteringProfile> MakeTabulated(const ScatteringMedium& medium,
  const ScatteringOptions& options)
{
  return std::make_unique<const TabulatedProfile>(medium, options.NumberOfPhotons, options.Seed,
    options.AllRanks);
}

//------------------------------------------------------------------------------
// The diffuse mean free path is a length that exists.
Outcome CheckOptions(int number, const ScatteringOptions& options,
  const std::vector<ScatteringMedium>& bands)
{
  if (number == vtkSubsurfaceScattering::MODEL_CHRISTENSEN_BURLEY &&
    options.BurleyFit == vtkSubsurfaceScattering::BURLEY_FIT_DIFFUSE_MEAN_FREE_PATH)
  {
    for (std::size_t band = 0; band < bands.size(); ++band)
    {
      if (bands[band].Absorption == 0.0)
      {
        return Outcome::Failed("BurleyFit is DiffuseMeanFreePath, but component " +
          std::to_string(band) +
          " absorbs nothing: its diffuse mean free path is infinite. Choose DiffuseSurface or "
          "Searchlight, or set AbsorptionCoefficient above 0.");
      }
    }
  }
  return Outcome::Done();
}
} // namespace

//------------------------------------------------------------------------------
const std::vector<ScatteringModel>& ScatteringModels::GetAll()
{
  static const std::vector<ScatteringModel> models = {
    { vtkSubsurfaceScattering::MODEL_DIPOLE, "Dipole", Make<DipoleProfile> },
    { vtkSubsurfaceScattering::MODEL_BETTER_DIPOLE, "BetterDipole", Make<BetterDipoleProfile> },
    { vtkSubsurfaceScattering::MODEL_PHOTON_BEAM_DIFFUSION, "PhotonBeamDiffusion",
      Make<PhotonBeamProfile> },
    { vtkSubsurfaceScattering::MODEL_CHRISTENSEN_BURLEY, "ChristensenBurley",
      MakeChristensenBurley },
    { vtkSubsurfaceScattering::MODEL_TABULATED, "Tabulated", MakeTabulated },
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
Outcome ScatteringModels::MakeProfiles(int number, const ScatteringOptions& options,
  const std::vector<ScatteringMedium>& bands, ScatteringProfiles& profiles)
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
  if (Outcome fits = CheckOptions(number, options, bands); !fits)
  {
    return fits;
  }
  profiles.clear();
  for (const ScatteringMedium& band : bands)
  {
    profiles.push_back(model->MakeProfile(band, options));
  }
  return Outcome::Done();
}
} // namespace LightTransport
