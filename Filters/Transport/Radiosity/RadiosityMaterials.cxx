// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityMaterials.h"

#include "Radiosity/PlanckFraction.h"
#include "Scene/CellArrays.h"
#include "Scene/PatchScene.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
using Materials = RadiosityMaterials;

// W m^-2 K^-4, exact in the SI of 2019.
constexpr double StefanBoltzmann = 5.670374419e-8;
// Its fourth power is still far from overflow.
constexpr double HighestTemperature = 1e30;

const char* const DefaultNames[Materials::NUMBER_OF_ARRAYS] = { "Emission", "Reflectance",
  "Temperature", "Emissivity", "DirectIrradiance", "BoundaryCondition", "PrescribedNetFlux" };

// Values of the boundary condition.
constexpr double GivenTemperature = 0.0;
constexpr double GivenNetFlux = 1.0;

//------------------------------------------------------------------------------
struct BandArray
{
  std::string Name;
  std::vector<double> Values;
  int Components = 0;

  bool IsThere() const { return this->Components > 0; }
  double Get(vtkIdType patch, int band) const
  {
    return this->Values[patch * this->Components + (this->Components == 1 ? 0 : band)];
  }
  // Empty, or what is wrong with the range of the values.
  std::string CheckRange(const PatchScene& scene, double low, double high, const char* range) const
  {
    const auto count = static_cast<vtkIdType>(this->Values.size());
    for (vtkIdType k = 0; k < count; ++k)
    {
      const vtkIdType polygon = k / this->Components;
      const double value =
        this->Get(scene.GetPatch(polygon), static_cast<int>(k % this->Components));
      if (!(value >= low && value <= high))
      {
        return "The cell array \"" + this->Name + "\" is " + std::to_string(value) +
          " at polygon " + std::to_string(polygon) + ": it must be " + range + ".";
      }
    }
    return "";
  }
};

//------------------------------------------------------------------------------
// The input arrays as they are, and what they and the settings say together. Checks return an empty
// text, or what is wrong.
class Arrays
{
public:
  explicit Arrays(const Materials& settings) : Settings(settings) {}

  bool Gather(const CellArrays& source, const std::vector<std::string>& names, std::string& error);
  std::string Check(const PatchScene& scene);

  int GetNumberOfBands() const { return this->Bands; }
  bool IsThermal() const { return this->IsThere(Materials::TEMPERATURE); }
  bool HasGivenFlux(vtkIdType patch) const
  {
    return this->Get(Materials::BOUNDARY_CONDITION, patch, 0) == GivenNetFlux;
  }
  double GetEmission(vtkIdType patch, int band) const;
  double GetReflectance(vtkIdType patch, int band) const;
  double GetBackground(int band) const;
  // 0 where there is no such array.
  double Get(int array, vtkIdType patch, int band) const
  {
    return this->IsThere(array) ? this->Array[array].Get(patch, band) : 0.0;
  }

private:
  bool IsThere(int array) const { return this->Array[array].IsThere(); }
  std::string Quote(int array) const { return "\"" + this->Array[array].Name + "\""; }
  bool HasLimits() const { return !this->Settings.BandLimits.empty(); }

  std::string CheckSettings() const;
  std::string CheckBands();
  std::string CheckBandCount(const std::string& name, int count);
  std::string CheckCombination() const;
  std::string CheckThermal() const;
  std::string CheckRanges(const PatchScene& scene) const;
  std::string CheckGivenFluxes(const PatchScene& scene) const;
  std::string CheckTotals() const;

  // What a black body of this temperature emits in a band.
  double GetBandFlux(double temperature, int band) const;

  const Materials& Settings;
  BandArray Array[Materials::NUMBER_OF_ARRAYS];
  int Bands = 1;
};

//------------------------------------------------------------------------------
bool Arrays::Gather(const CellArrays& source, const std::vector<std::string>& names,
  std::string& error)
{
  for (int k = 0; k < Materials::NUMBER_OF_ARRAYS; ++k)
  {
    BandArray& array = this->Array[k];
    array.Name = names[k];
    // Where there are no temperatures, arrays of these names belong to something else.
    const bool ignored =
      (k == Materials::BOUNDARY_CONDITION || k == Materials::PRESCRIBED_NET_FLUX) &&
      !this->IsThermal();
    const Outcome read =
      ignored ? Outcome::Done() : source.Read(array.Name, false, array.Values, array.Components);
    if (!read)
    {
      error = read.GetMessage();
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::string Arrays::Check(const PatchScene& scene)
{
  std::string error = this->CheckSettings();
  error = error.empty() ? this->CheckBands() : error;
  error = error.empty() ? this->CheckCombination() : error;
  error = error.empty() ? this->CheckTotals() : error;
  error = error.empty() ? this->CheckRanges(scene) : error;
  return error.empty() ? this->CheckGivenFluxes(scene) : error;
}

//------------------------------------------------------------------------------
// Written so that a NaN does not pass.
std::string Arrays::CheckSettings() const
{
  const std::vector<double>& limits = this->Settings.BandLimits;
  bool increasing = limits.empty() || (limits.size() > 1 && limits.front() >= 0.0);
  for (std::size_t k = 1; k < limits.size(); ++k)
  {
    increasing = increasing && limits[k] > limits[k - 1];
  }
  if (!increasing)
  {
    return "BandLimits are no limits of bands: give at least two wavelengths in micrometres, the "
           "first at least 0 and each longer than the one before, or none for one total band.";
  }
  const double temperature = this->Settings.BackgroundTemperature;
  bool inRange = temperature >= 0.0 && temperature <= HighestTemperature;
  for (const double radiance : this->Settings.BackgroundRadiance)
  {
    inRange = inRange && radiance >= 0.0 && radiance <= VTK_DOUBLE_MAX;
  }
  return inRange ? ""
                 : "BackgroundTemperature must be from 0 to 1e30 K, BackgroundRadiance at least 0 "
                   "and finite: correct the one that is not.";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckBands()
{
  this->Bands = this->HasLimits() ? static_cast<int>(this->Settings.BandLimits.size()) - 1 : 1;
  std::string error;
  for (const BandArray& array : this->Array)
  {
    error = error.empty()
      ? this->CheckBandCount("The cell array \"" + array.Name + "\"", array.Components)
      : error;
  }
  const auto radiances = static_cast<int>(this->Settings.BackgroundRadiance.size());
  return error.empty() ? this->CheckBandCount("BackgroundRadiance", radiances) : error;
}

//------------------------------------------------------------------------------
std::string Arrays::CheckBandCount(const std::string& name, int count)
{
  if (count > 1 && count != this->Bands && (this->HasLimits() || this->Bands > 1))
  {
    return name + " has " + std::to_string(count) + " components where " +
      (this->HasLimits() ? "BandLimits" : "another") + " has " + std::to_string(this->Bands) +
      ": give all of them 1 or the same number of bands.";
  }
  this->Bands = std::max(this->Bands, count);
  return "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckCombination() const
{
  if (this->IsThermal())
  {
    return this->CheckThermal();
  }
  if (!this->IsThere(Materials::REFLECTANCE) && !this->IsThere(Materials::EMISSIVITY))
  {
    return "There is no reflectance: add a cell array " + this->Quote(Materials::REFLECTANCE) +
      " with values from 0 to 1 (or " + this->Quote(Materials::TEMPERATURE) + " and " +
      this->Quote(Materials::EMISSIVITY) + ").";
  }
  if (!this->IsThere(Materials::EMISSION) && !this->IsThere(Materials::DIRECT_IRRADIANCE) &&
    !this->Settings.HasBackground())
  {
    return "Nothing emits: add a cell array " + this->Quote(Materials::EMISSION) + ", or " +
      this->Quote(Materials::TEMPERATURE) + " and " + this->Quote(Materials::EMISSIVITY) + ", or " +
      this->Quote(Materials::DIRECT_IRRADIANCE) + " from vtkDirectIrradiance.";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckThermal() const
{
  const std::string temperature = this->Quote(Materials::TEMPERATURE);
  if (!this->IsThere(Materials::EMISSIVITY))
  {
    return "There is a temperature (" + temperature + ") but no emissivity: add a cell array " +
      this->Quote(Materials::EMISSIVITY) + " with values from 0 to 1.";
  }
  if (this->IsThere(Materials::EMISSION))
  {
    return "There are both " + this->Quote(Materials::EMISSION) + " and " + temperature +
      ": remove one of the two cell arrays.";
  }
  if (this->Array[Materials::TEMPERATURE].Components > 1 && this->HasLimits())
  {
    return "The cell array " + temperature +
      " has several components, but a patch has one temperature: use one component.";
  }
  if (this->IsThere(Materials::PRESCRIBED_NET_FLUX) &&
    !this->IsThere(Materials::BOUNDARY_CONDITION))
  {
    return "There is a net flux (" + this->Quote(Materials::PRESCRIBED_NET_FLUX) +
      "), but nothing says where it holds: add a cell array " +
      this->Quote(Materials::BOUNDARY_CONDITION) +
      " with 0 (the temperature is given) or 1 (the net flux is given).";
  }
  return "";
}

//------------------------------------------------------------------------------
// Temperatures in several bands need their limits.
std::string Arrays::CheckTotals() const
{
  if (this->Bands == 1 || this->HasLimits())
  {
    return "";
  }
  const std::string bands = "but there are " + std::to_string(this->Bands) +
    " bands: set BandLimits (wavelengths in micrometres), use one component, or ";
  if (this->IsThermal())
  {
    return "The temperature gives the total emission of one band, " + bands +
      this->Quote(Materials::EMISSION) + " with the emission of each band.";
  }
  return this->Settings.BackgroundTemperature > 0.0
    ? "BackgroundTemperature gives the total of one band, " + bands +
      "BackgroundRadiance with a value for each band."
    : "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckRanges(const PatchScene& scene) const
{
  struct Range
  {
    int Index;
    double Most;
    const char* Text;
  };
  const Range ranges[] = { { Materials::REFLECTANCE, 1.0, "from 0 to 1" },
    { Materials::EMISSIVITY, 1.0, "from 0 to 1" },
    { Materials::TEMPERATURE, HighestTemperature, "in kelvin, at least 0 and at most 1e30" },
    { Materials::EMISSION, VTK_DOUBLE_MAX, "at least 0" },
    { Materials::DIRECT_IRRADIANCE, VTK_DOUBLE_MAX, "at least 0" } };
  for (const Range& range : ranges)
  {
    const std::string error =
      this->Array[range.Index].CheckRange(scene, 0.0, range.Most, range.Text);
    if (!error.empty())
    {
      return error;
    }
  }
  return "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckGivenFluxes(const PatchScene& scene) const
{
  for (vtkIdType polygon = 0; polygon < scene.GetNumberOfPatches(); ++polygon)
  {
    const vtkIdType patch = scene.GetPatch(polygon);
    const double condition = this->Get(Materials::BOUNDARY_CONDITION, patch, 0);
    const std::string place = " at polygon " + std::to_string(polygon);
    if (condition != GivenTemperature && condition != GivenNetFlux)
    {
      return "The cell array " + this->Quote(Materials::BOUNDARY_CONDITION) + " is " +
        std::to_string(condition) + place +
        ": it must be 0 (the temperature is given) or 1 (the net flux is given).";
    }
    if (condition == GivenTemperature)
    {
      continue;
    }
    if (this->Bands > 1 || this->HasLimits())
    {
      return "The net flux is given" + place +
        ", which is the sum over all wavelengths and links the bands with each other: use one band "
        "(no BandLimits), or give all patches a temperature.";
    }
    if (this->Get(Materials::EMISSIVITY, patch, 0) == 0.0 &&
      this->Get(Materials::PRESCRIBED_NET_FLUX, patch, 0) != 0.0)
    {
      return "The cell array " + this->Quote(Materials::EMISSIVITY) + " is 0" + place +
        ", where a net flux is given, but what neither emits nor absorbs has none: give it an "
        "emissivity above 0, or a net flux of 0.";
    }
  }
  return "";
}

//------------------------------------------------------------------------------
double Arrays::GetBandFlux(double temperature, int band) const
{
  const std::vector<double>& limits = this->Settings.BandLimits;
  const double share =
    limits.empty() ? 1.0 : PlanckFraction::GetBand(limits[band], limits[band + 1], temperature);
  return share * StefanBoltzmann * std::pow(temperature, 4);
}

//------------------------------------------------------------------------------
double Arrays::GetEmission(vtkIdType patch, int band) const
{
  if (!this->IsThermal())
  {
    return this->Get(Materials::EMISSION, patch, band);
  }
  return this->HasGivenFlux(patch) ? this->Get(Materials::PRESCRIBED_NET_FLUX, patch, 0)
                                   : this->Get(Materials::EMISSIVITY, patch, band) *
      this->GetBandFlux(this->Get(Materials::TEMPERATURE, patch, 0), band);
}

//------------------------------------------------------------------------------
double Arrays::GetReflectance(vtkIdType patch, int band) const
{
  if (this->HasGivenFlux(patch))
  {
    return 1.0;
  }
  const bool byEmissivity = this->IsThermal() || !this->IsThere(Materials::REFLECTANCE);
  return byEmissivity ? 1.0 - this->Get(Materials::EMISSIVITY, patch, band)
                      : this->Get(Materials::REFLECTANCE, patch, band);
}

//------------------------------------------------------------------------------
double Arrays::GetBackground(int band) const
{
  const std::vector<double>& radiance = this->Settings.BackgroundRadiance;
  const double light =
    radiance.empty() ? 0.0 : vtkMath::Pi() * radiance[radiance.size() == 1 ? 0 : band];
  const double temperature = this->Settings.BackgroundTemperature;
  return light + (temperature > 0.0 ? this->GetBandFlux(temperature, band) : 0.0);
}
} // namespace

//------------------------------------------------------------------------------
const char* RadiosityMaterials::GetDefaultName(int array)
{
  return DefaultNames[array];
}

//------------------------------------------------------------------------------
bool RadiosityMaterials::Read(const CellArrays& source, const PatchScene& scene,
  const std::vector<std::string>& names, std::string& error)
{
  Arrays arrays(*this);
  if (!arrays.Gather(source, names, error) || !(error = arrays.Check(scene)).empty())
  {
    return false;
  }
  this->NumberOfBands = arrays.GetNumberOfBands();
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      this->Emission.push_back(arrays.GetEmission(patch, band));
      this->Reflectance.push_back(arrays.GetReflectance(patch, band));
      this->DirectIrradiance.push_back(arrays.Get(DIRECT_IRRADIANCE, patch, band));
    }
    if (arrays.IsThermal())
    {
      this->Temperature.push_back(arrays.Get(TEMPERATURE, patch, 0));
      this->Emissivity.push_back(arrays.Get(EMISSIVITY, patch, 0));
      this->HasGivenFlux.push_back(arrays.HasGivenFlux(patch));
    }
  }
  for (int band = 0; band < this->NumberOfBands; ++band)
  {
    this->Background.push_back(arrays.GetBackground(band));
  }
  return true;
}

//------------------------------------------------------------------------------
// Others only receive: what they would send to each other is nothing.
std::vector<bool> RadiosityMaterials::FindSenders() const
{
  std::vector<bool> senders(this->Reflectance.size() / this->NumberOfBands, false);
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    if (this->Reflectance[k] > 0.0 || this->Emission[k] != 0.0)
    {
      senders[k / this->NumberOfBands] = true;
    }
  }
  return senders;
}

//------------------------------------------------------------------------------
bool RadiosityMaterials::HasBackground() const
{
  return this->BackgroundTemperature > 0.0 ||
    std::any_of(this->BackgroundRadiance.begin(), this->BackgroundRadiance.end(),
      [](double radiance) { return radiance > 0.0; });
}

//------------------------------------------------------------------------------
void RadiosityMaterials::AddBackground(const std::vector<double>& skyFractions)
{
  for (std::size_t k = 0; k < this->DirectIrradiance.size(); ++k)
  {
    this->DirectIrradiance[k] +=
      skyFractions[k / this->NumberOfBands] * this->Background[k % this->NumberOfBands];
  }
}

//------------------------------------------------------------------------------
bool RadiosityMaterials::HasGivenFluxes() const
{
  return std::find(this->HasGivenFlux.begin(), this->HasGivenFlux.end(), true) !=
    this->HasGivenFlux.end();
}

//------------------------------------------------------------------------------
// q = emissivity (sigma T^4 - H). One band, where any flux is given.
std::vector<double> RadiosityMaterials::ComputeTemperatures(const std::vector<double>& irradiance,
  double tolerance, vtkIdType& impossible) const
{
  std::vector<double> temperatures = this->Temperature;
  impossible = 0;
  for (std::size_t patch = 0; patch < temperatures.size(); ++patch)
  {
    if (this->HasGivenFlux[patch])
    {
      const double flux = this->Emission[patch];
      const double black = irradiance[patch] + (flux == 0.0 ? 0.0 : flux / this->Emissivity[patch]);
      temperatures[patch] = std::pow(std::max(black, 0.0) / StefanBoltzmann, 0.25);
      impossible += black < -tolerance ? 1 : 0;
    }
  }
  return temperatures;
}

//------------------------------------------------------------------------------
std::vector<double> RadiosityMaterials::GetPointMaterials() const
{
  std::vector<double> materials;
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    const std::size_t patch = k / this->NumberOfBands;
    // Of a temperature every band has some, though it may be too little for a number.
    const double source = this->IsThermal() ? this->Temperature[patch] : this->Emission[k];
    const bool isFluxGiven = this->IsThermal() && this->HasGivenFlux[patch];
    materials.push_back(isFluxGiven ? 1.0 - this->Emissivity[patch] : this->Reflectance[k]);
    materials.push_back(isFluxGiven ? -1.0 : (source > 0.0 ? 1.0 : 0.0));
  }
  return materials;
}
} // namespace LightTransport
