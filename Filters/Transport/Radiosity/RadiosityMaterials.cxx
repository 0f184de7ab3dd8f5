// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityMaterials.h"

#include "Radiosity/BlackBody.h"
#include "Scene/PatchScene.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome RadiosityMaterials::Read(const CellArrays& source, const PatchScene& scene,
  const std::vector<std::string>& names)
{
  MaterialArrays arrays(this->Settings);
  Outcome read = arrays.Read(source, scene, names);
  if (!read)
  {
    return read;
  }
  this->NumberOfBands = arrays.GetNumberOfBands();
  this->Warnings = arrays.GetWarnings();
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    for (int band = 0; band < this->NumberOfBands; ++band)
    {
      this->Emission.push_back(arrays.GetEmission(patch, band));
      this->Reflectance.push_back(arrays.GetReflectance(patch, band));
      this->DirectIrradiance.push_back(arrays.Get(MaterialArrays::DIRECT_IRRADIANCE, patch, band));
    }
    if (arrays.IsThermal())
    {
      this->Temperature.push_back(arrays.Get(MaterialArrays::TEMPERATURE, patch, 0));
      this->Emissivity.push_back(arrays.Get(MaterialArrays::EMISSIVITY, patch, 0));
      this->HasGivenFlux.push_back(arrays.HasGivenFlux(patch));
    }
  }
  for (int band = 0; band < this->NumberOfBands; ++band)
  {
    this->Background.push_back(arrays.GetBackground(band));
  }
  return read;
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
std::vector<double> RadiosityMaterials::ComputeTemperatures(const PatchScene& scene,
  const std::vector<double>& irradiance, double tolerance, vtkIdType& impossible) const
{
  const SceneFaces& faces = scene.GetFaces();
  const std::vector<double> received = faces.GetMeans(irradiance, this->NumberOfBands);
  std::vector<double> temperatures(faces.GetNumberOfFaces(), 0.0);
  impossible = 0;
  for (vtkIdType face = 0; face < faces.GetNumberOfFaces(); ++face)
  {
    const vtkIdType patch = faces.GetPatch(face);
    if (patch < 0)
    {
      continue;
    }
    temperatures[face] = this->Temperature[patch];
    if (this->HasGivenFlux[patch])
    {
      const double flux = this->Emission[patch];
      const double black = received[face] + (flux == 0.0 ? 0.0 : flux / this->Emissivity[patch]);
      temperatures[face] = BlackBody::GetTemperature(std::max(black, 0.0));
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
