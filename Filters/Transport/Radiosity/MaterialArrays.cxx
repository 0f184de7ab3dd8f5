// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/MaterialArrays.h"

#include "Radiosity/BlackBody.h"
#include "Scene/CellArrays.h"
#include "Scene/PatchScene.h"
#include "Shared/ArrayNames.h"
#include "vtkMath.h"

#include <algorithm>
#include <sstream>

namespace LightTransport
{
namespace
{
constexpr const char* DefaultNames[MaterialArrays::NUMBER_OF_ARRAYS] = { "Emission", "Reflectance",
  "Temperature", "Emissivity", ArrayNames::DirectIrradiance, "BoundaryCondition",
  "PrescribedNetFlux" };

//------------------------------------------------------------------------------
// As short as it may be: values may be 1e300.
std::string Format(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

// Values of the boundary condition.
constexpr double GivenTemperature = 0.0;
constexpr double GivenNetFlux = 1.0;
} // namespace

//------------------------------------------------------------------------------
bool MaterialSettings::HasBackground() const
{
  return this->BackgroundTemperature > 0.0 ||
    std::any_of(this->BackgroundRadiance.begin(), this->BackgroundRadiance.end(),
      [](double radiance) { return radiance > 0.0; });
}

//------------------------------------------------------------------------------
const char* MaterialArrays::GetDefaultName(int array)
{
  return DefaultNames[array];
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::BandArray::CheckRange(const PatchScene& scene, double low, double high,
  const char* range) const
{
  for (vtkIdType face = 0; face < scene.GetFaces().GetNumberOfFaces(); ++face)
  {
    const vtkIdType patch = scene.GetPatch(face);
    for (int component = 0; patch >= 0 && component < this->Components; ++component)
    {
      const double value = this->Get(patch, component);
      if (!(value >= low && value <= high))
      {
        return Outcome::Failed("The cell array \"" + this->Name + "\" is " + Format(value) +
          " at " + scene.GetFaces().Describe(face) + ": it must be " + range + ".");
      }
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::Read(const CellArrays& source, const PatchScene& scene,
  const std::vector<std::string>& names)
{
  Outcome good = this->Gather(source, names);
  if (good && scene.GetFaces().GetNumberOfSides() == 2)
  {
    this->LookAtBacks(scene);
  }
  good = good ? this->CheckSettings() : good;
  good = good ? this->CheckBands() : good;
  good = good ? this->CheckCombination() : good;
  good = good ? this->CheckTotals() : good;
  if (good && !this->NearMisses.empty())
  {
    this->Warnings.push_back("Some arrays are not read, since others are asked for." +
      this->NearMisses + " Then rename it.");
  }
  good = good ? this->CheckRanges(scene) : good;
  return good ? this->CheckGivenFluxes(scene) : good;
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::Gather(const CellArrays& source, const std::vector<std::string>& names)
{
  for (int k = 0; k < NUMBER_OF_ARRAYS; ++k)
  {
    BandArray& array = this->Arrays[k];
    array.Name = names[k];
    // Where there are no temperatures, arrays of these names belong to something else.
    const bool ignored =
      (k == BOUNDARY_CONDITION || k == PRESCRIBED_NET_FLUX) && !this->IsThermal();
    Outcome read = ignored
      ? Outcome::Done()
      : source.Read(array.Name, false, array.Values, array.Components, &array.HasBack);
    if (!read)
    {
      return read;
    }
    this->NearMisses += ignored || array.IsThere() ? "" : source.Suggest(array.Name);
  }
  this->HasFluxAlone = !this->IsThermal() && source.IsInput(this->Arrays[PRESCRIBED_NET_FLUX].Name);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Materials of both sides may well be the same; lamps seldom are, and light that falls on one side
// never is.
void MaterialArrays::LookAtBacks(const PatchScene& scene)
{
  const BandArray& emission = this->Arrays[EMISSION];
  const bool emits = std::any_of(emission.Values.begin(), emission.Values.end(),
    [](double value) { return value > 0.0; });
  if (emits && !emission.HasBack)
  {
    this->Warnings.push_back("Lamps shine from both sides: there is " + this->Quote(EMISSION) +
      " and no \"" + emission.Name + ArrayNames::BackSuffix +
      "\". Add that cell array, with 0 where a back emits nothing.");
  }
  BandArray& direct = this->Arrays[DIRECT_IRRADIANCE];
  if (!direct.IsThere() || direct.HasBack)
  {
    return;
  }
  for (std::size_t k = 0; k < direct.Values.size(); ++k)
  {
    const vtkIdType face = scene.GetFaces().GetFace(static_cast<vtkIdType>(k) / direct.Components);
    direct.Values[k] = scene.GetFaces().GetSide(face) == 0 ? direct.Values[k] : 0.0;
  }
  this->Warnings.push_back("No direct light falls on backs: there is " +
    this->Quote(DIRECT_IRRADIANCE) + " and no \"" + direct.Name + ArrayNames::BackSuffix +
    "\". Switch TwoSided of vtkDirectIrradiance on.");
}

//------------------------------------------------------------------------------
// Written so that a NaN does not pass.
Outcome MaterialArrays::CheckSettings() const
{
  const std::vector<double>& limits = this->Settings.BandLimits;
  bool increasing = limits.empty() || (limits.size() > 1 && limits.front() >= 0.0);
  for (std::size_t k = 1; k < limits.size(); ++k)
  {
    increasing = increasing && limits[k] > limits[k - 1];
  }
  if (!increasing)
  {
    return Outcome::Failed(
      "BandLimits are no limits of bands: give at least two wavelengths in micrometres, the "
      "first at least 0 and each longer than the one before, or none for one total band.");
  }
  const double temperature = this->Settings.BackgroundTemperature;
  bool inRange = temperature >= 0.0 && temperature <= BlackBody::HighestTemperature;
  for (const double radiance : this->Settings.BackgroundRadiance)
  {
    inRange = inRange && radiance >= 0.0 && radiance <= VTK_DOUBLE_MAX;
  }
  return inRange
    ? Outcome::Done()
    : Outcome::Failed("BackgroundTemperature must be from 0 to 1e30 K, BackgroundRadiance at least "
                      "0 and finite: correct the one that is not.");
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckBands()
{
  this->Bands = this->HasLimits() ? static_cast<int>(this->Settings.BandLimits.size()) - 1 : 1;
  Outcome fits = Outcome::Done();
  for (const BandArray& array : this->Arrays)
  {
    fits =
      fits ? this->CheckBandCount("The cell array \"" + array.Name + "\"", array.Components) : fits;
  }
  const auto radiances = static_cast<int>(this->Settings.BackgroundRadiance.size());
  return fits ? this->CheckBandCount("BackgroundRadiance", radiances) : fits;
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckBandCount(const std::string& name, int count)
{
  if (count > 1 && count != this->Bands && (this->HasLimits() || this->Bands > 1))
  {
    return Outcome::Failed(name + " has " + std::to_string(count) + " components where " +
      (this->HasLimits() ? "BandLimits" : "another") + " has " + std::to_string(this->Bands) +
      ": give all of them 1 or the same number of bands.");
  }
  this->Bands = std::max(this->Bands, count);
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckCombination() const
{
  if (this->IsThermal())
  {
    return this->CheckThermal();
  }
  if (!this->IsThere(REFLECTANCE) && !this->IsThere(EMISSIVITY))
  {
    return Outcome::Failed("There is no reflectance: add a cell array " + this->Quote(REFLECTANCE) +
      " with values from 0 to 1 (or " + this->Quote(TEMPERATURE) + " and " +
      this->Quote(EMISSIVITY) + ")." + this->NearMisses);
  }
  if (!this->IsThere(EMISSION) && !this->IsThere(DIRECT_IRRADIANCE) &&
    !this->Settings.HasBackground())
  {
    if (this->HasFluxAlone)
    {
      return Outcome::Failed("There is a net flux (" + this->Quote(PRESCRIBED_NET_FLUX) +
        ") but no temperature: add a cell array " + this->Quote(TEMPERATURE) +
        ", in kelvin. Where the net flux is given its values do not count." + this->NearMisses);
    }
    return Outcome::Failed("Nothing emits: add a cell array " + this->Quote(EMISSION) + ", or " +
      this->Quote(TEMPERATURE) + " and " + this->Quote(EMISSIVITY) + ", or " +
      this->Quote(DIRECT_IRRADIANCE) + " from vtkDirectIrradiance." + this->NearMisses);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckThermal() const
{
  const std::string temperature = this->Quote(TEMPERATURE);
  if (!this->IsThere(EMISSIVITY))
  {
    return Outcome::Failed("There is a temperature (" + temperature +
      ") but no emissivity: add a cell array " + this->Quote(EMISSIVITY) +
      " with values from 0 to 1." + this->NearMisses);
  }
  if (this->IsThere(EMISSION))
  {
    return Outcome::Failed("There are both " + this->Quote(EMISSION) + " and " + temperature +
      ": remove one of the two cell arrays.");
  }
  if (this->Arrays[TEMPERATURE].Components > 1 && this->HasLimits())
  {
    return Outcome::Failed("The cell array " + temperature +
      " has several components, but a patch has one temperature: use one component.");
  }
  if (this->IsThere(PRESCRIBED_NET_FLUX) && !this->IsThere(BOUNDARY_CONDITION))
  {
    return Outcome::Failed("There is a net flux (" + this->Quote(PRESCRIBED_NET_FLUX) +
      "), but nothing says where it holds: add a cell array " + this->Quote(BOUNDARY_CONDITION) +
      " with 0 (the temperature is given) or 1 (the net flux is given)." + this->NearMisses);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Temperatures in several bands need their limits.
Outcome MaterialArrays::CheckTotals() const
{
  if (this->Bands == 1 || this->HasLimits())
  {
    return Outcome::Done();
  }
  const std::string bands = "but there are " + std::to_string(this->Bands) +
    " bands: set BandLimits (wavelengths in micrometres), use one component, or ";
  if (this->IsThermal())
  {
    return Outcome::Failed("The temperature gives the total emission of one band, " + bands +
      this->Quote(EMISSION) + " with the emission of each band.");
  }
  return this->Settings.BackgroundTemperature > 0.0
    ? Outcome::Failed("BackgroundTemperature gives the total of one band, " + bands +
        "BackgroundRadiance with a value for each band.")
    : Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckRanges(const PatchScene& scene) const
{
  struct Range
  {
    int Index;
    double Most;
    const char* Text;
  };
  const Range ranges[] = { { REFLECTANCE, 1.0, "from 0 to 1" }, { EMISSIVITY, 1.0, "from 0 to 1" },
    { TEMPERATURE, BlackBody::HighestTemperature, "in kelvin, at least 0 and at most 1e30" },
    { EMISSION, VTK_DOUBLE_MAX, "at least 0" },
    { DIRECT_IRRADIANCE, VTK_DOUBLE_MAX, "at least 0" } };
  for (const Range& range : ranges)
  {
    Outcome inRange = this->Arrays[range.Index].CheckRange(scene, 0.0, range.Most, range.Text);
    if (!inRange)
    {
      return inRange;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome MaterialArrays::CheckGivenFluxes(const PatchScene& scene) const
{
  for (vtkIdType face = 0; face < scene.GetFaces().GetNumberOfFaces(); ++face)
  {
    const vtkIdType patch = scene.GetPatch(face);
    if (patch < 0)
    {
      continue;
    }
    const double condition = this->Get(BOUNDARY_CONDITION, patch, 0);
    const std::string place = " at " + scene.GetFaces().Describe(face);
    if (condition != GivenTemperature && condition != GivenNetFlux)
    {
      return Outcome::Failed("The cell array " + this->Quote(BOUNDARY_CONDITION) + " is " +
        Format(condition) + place +
        ": it must be 0 (the temperature is given) or 1 (the net flux is given).");
    }
    if (condition == GivenTemperature)
    {
      continue;
    }
    if (this->Bands > 1 || this->HasLimits())
    {
      return Outcome::Failed("The net flux is given" + place +
        ", which is the sum over all wavelengths and links the bands with each other: use one band "
        "(no BandLimits), or give all patches a temperature.");
    }
    if (this->Get(EMISSIVITY, patch, 0) == 0.0 && this->Get(PRESCRIBED_NET_FLUX, patch, 0) != 0.0)
    {
      return Outcome::Failed("The cell array " + this->Quote(EMISSIVITY) + " is 0" + place +
        ", where a net flux is given, but what neither emits nor absorbs has none: give it an "
        "emissivity above 0, or a net flux of 0.");
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool MaterialArrays::HasGivenFlux(vtkIdType patch) const
{
  return this->Get(BOUNDARY_CONDITION, patch, 0) == GivenNetFlux;
}

//------------------------------------------------------------------------------
double MaterialArrays::GetEmission(vtkIdType patch, int band) const
{
  if (!this->IsThermal())
  {
    return this->Get(EMISSION, patch, band);
  }
  return this->HasGivenFlux(patch) ? this->Get(PRESCRIBED_NET_FLUX, patch, 0)
                                   : this->Get(EMISSIVITY, patch, band) *
      BlackBody::GetFlux(this->Get(TEMPERATURE, patch, 0), this->Settings.BandLimits, band);
}

//------------------------------------------------------------------------------
double MaterialArrays::GetReflectance(vtkIdType patch, int band) const
{
  if (this->HasGivenFlux(patch))
  {
    return 1.0;
  }
  const bool byEmissivity = this->IsThermal() || !this->IsThere(REFLECTANCE);
  return byEmissivity ? 1.0 - this->Get(EMISSIVITY, patch, band)
                      : this->Get(REFLECTANCE, patch, band);
}

//------------------------------------------------------------------------------
double MaterialArrays::GetBackground(int band) const
{
  const std::vector<double>& radiance = this->Settings.BackgroundRadiance;
  const double light =
    radiance.empty() ? 0.0 : vtkMath::Pi() * radiance[radiance.size() == 1 ? 0 : band];
  const double temperature = this->Settings.BackgroundTemperature;
  return light +
    (temperature > 0.0 ? BlackBody::GetFlux(temperature, this->Settings.BandLimits, band) : 0.0);
}
} // namespace LightTransport
