// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosityMaterials.h"

#include "vtkPatchScene.h"

#include <algorithm>
#include <cmath>

namespace
{
using Materials = vtkRadiosityMaterials;

// W m^-2 K^-4, exact in the SI of 2019.
constexpr double StefanBoltzmann = 5.670374419e-8;

const char* const DefaultNames[Materials::NUMBER_OF_ARRAYS] = { "Emission", "Reflectance",
  "Temperature", "Emissivity", "DirectIrradiance" };

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
  std::string CheckRange(const vtkPatchScene& scene, double low, double high,
    const char* range) const
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
// The input arrays as they are, and what they say together. Checks return an empty text, or what is
// wrong.
class Arrays
{
public:
  bool Gather(vtkDataObject* input, const vtkPatchScene& scene,
    const std::vector<std::string>& names, std::string& error);
  std::string CheckBands();
  std::string CheckCombination() const;
  std::string CheckRanges(const vtkPatchScene& scene) const;

  bool IsThermal() const { return this->Array[Materials::TEMPERATURE].IsThere(); }
  double GetEmission(vtkIdType patch, int band) const;
  double GetReflectance(vtkIdType patch, int band) const;
  double GetDirectIrradiance(vtkIdType patch, int band) const;
  int GetNumberOfBands() const { return this->Bands; }

private:
  bool IsThere(int array) const { return this->Array[array].IsThere(); }
  std::string Quote(int array) const { return "\"" + this->Array[array].Name + "\""; }

  BandArray Array[Materials::NUMBER_OF_ARRAYS];
  int Bands = 1;
};

//------------------------------------------------------------------------------
bool Arrays::Gather(vtkDataObject* input, const vtkPatchScene& scene,
  const std::vector<std::string>& names, std::string& error)
{
  for (int k = 0; k < Materials::NUMBER_OF_ARRAYS; ++k)
  {
    BandArray& array = this->Array[k];
    array.Name = names[k];
    if (!scene.GatherCellArray(input, array.Name, false, array.Values, array.Components, error))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::string Arrays::CheckBands()
{
  for (const BandArray& array : this->Array)
  {
    if (array.Components > 1 && this->Bands > 1 && array.Components != this->Bands)
    {
      return "The cell array \"" + array.Name + "\" has " + std::to_string(array.Components) +
        " components where another has " + std::to_string(this->Bands) +
        ": give all of them 1 or the same number of bands.";
    }
    this->Bands = std::max(this->Bands, array.Components);
  }
  return "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckCombination() const
{
  const bool thermal = this->IsThermal();
  if (thermal && !this->IsThere(Materials::EMISSIVITY))
  {
    return "There is a temperature (" + this->Quote(Materials::TEMPERATURE) +
      ") but no emissivity: add a cell array " + this->Quote(Materials::EMISSIVITY) +
      " with values from 0 to 1.";
  }
  if (thermal && this->IsThere(Materials::EMISSION))
  {
    return "There are both " + this->Quote(Materials::EMISSION) + " and " +
      this->Quote(Materials::TEMPERATURE) + ": remove one of the two cell arrays.";
  }
  if (thermal && this->Bands > 1)
  {
    return "The temperature gives the total emission of one band, but there are " +
      std::to_string(this->Bands) + " bands: use one component, or " +
      this->Quote(Materials::EMISSION) + " with the emission of each band.";
  }
  if (!thermal && !this->IsThere(Materials::REFLECTANCE) && !this->IsThere(Materials::EMISSIVITY))
  {
    return "There is no reflectance: add a cell array " + this->Quote(Materials::REFLECTANCE) +
      " with values from 0 to 1 (or " + this->Quote(Materials::TEMPERATURE) + " and " +
      this->Quote(Materials::EMISSIVITY) + ").";
  }
  if (!thermal && !this->IsThere(Materials::EMISSION) &&
    !this->IsThere(Materials::DIRECT_IRRADIANCE))
  {
    return "Nothing emits: add a cell array " + this->Quote(Materials::EMISSION) + ", or " +
      this->Quote(Materials::TEMPERATURE) + " and " + this->Quote(Materials::EMISSIVITY) + ", or " +
      this->Quote(Materials::DIRECT_IRRADIANCE) + " from vtkDirectIrradiance.";
  }
  return "";
}

//------------------------------------------------------------------------------
std::string Arrays::CheckRanges(const vtkPatchScene& scene) const
{
  const double most = VTK_DOUBLE_MAX;
  for (const std::string& problem :
    { this->Array[Materials::REFLECTANCE].CheckRange(scene, 0.0, 1.0, "from 0 to 1"),
      this->Array[Materials::EMISSIVITY].CheckRange(scene, 0.0, 1.0, "from 0 to 1"),
      this->Array[Materials::TEMPERATURE].CheckRange(scene, 0.0, most, "in kelvin, at least 0"),
      this->Array[Materials::EMISSION].CheckRange(scene, 0.0, most, "at least 0"),
      this->Array[Materials::DIRECT_IRRADIANCE].CheckRange(scene, 0.0, most, "at least 0") })
  {
    if (!problem.empty())
    {
      return problem;
    }
  }
  return "";
}

//------------------------------------------------------------------------------
double Arrays::GetEmission(vtkIdType patch, int band) const
{
  if (this->IsThermal())
  {
    return this->Array[Materials::EMISSIVITY].Get(patch, band) * StefanBoltzmann *
      std::pow(this->Array[Materials::TEMPERATURE].Get(patch, band), 4);
  }
  const BandArray& emission = this->Array[Materials::EMISSION];
  return emission.IsThere() ? emission.Get(patch, band) : 0.0;
}

//------------------------------------------------------------------------------
double Arrays::GetReflectance(vtkIdType patch, int band) const
{
  const BandArray& reflectance = this->Array[Materials::REFLECTANCE];
  const bool byEmissivity = this->IsThermal() || !reflectance.IsThere();
  return byEmissivity ? 1.0 - this->Array[Materials::EMISSIVITY].Get(patch, band)
                      : reflectance.Get(patch, band);
}

//------------------------------------------------------------------------------
double Arrays::GetDirectIrradiance(vtkIdType patch, int band) const
{
  const BandArray& direct = this->Array[Materials::DIRECT_IRRADIANCE];
  return direct.IsThere() ? direct.Get(patch, band) : 0.0;
}
} // namespace

//------------------------------------------------------------------------------
const char* vtkRadiosityMaterials::GetDefaultName(int array)
{
  return DefaultNames[array];
}

//------------------------------------------------------------------------------
bool vtkRadiosityMaterials::Read(vtkDataObject* input, const vtkPatchScene& scene,
  const std::vector<std::string>& names, std::string& error)
{
  Arrays arrays;
  if (!arrays.Gather(input, scene, names, error) || !(error = arrays.CheckBands()).empty() ||
    !(error = arrays.CheckCombination()).empty() || !(error = arrays.CheckRanges(scene)).empty())
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
      this->DirectIrradiance.push_back(arrays.GetDirectIrradiance(patch, band));
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Others only receive: what they would send to each other is nothing.
std::vector<bool> vtkRadiosityMaterials::FindSenders() const
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
std::vector<double> vtkRadiosityMaterials::GetPointMaterials() const
{
  std::vector<double> materials;
  for (std::size_t k = 0; k < this->Reflectance.size(); ++k)
  {
    materials.push_back(this->Reflectance[k]);
    materials.push_back(this->Emission[k] > 0.0 ? 1.0 : 0.0);
  }
  return materials;
}
