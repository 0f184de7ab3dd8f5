// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The input arrays of vtkRadiosity that say what patches are made of, read and checked, and what
 * they and its settings say together: the coefficients of B = E + rho H of a patch in a band.
 *
 * A patch with a given net flux q has B = q + H (it "reflects" all and adds q, negative where heat
 * is taken out), whatever its emissivity; that only decides how warm it becomes.
 */
#ifndef MaterialArrays_h
#define MaterialArrays_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
class CellArrays;
class PatchScene;

/// See the properties of vtkRadiosity.
struct MaterialSettings
{
  /// Whether anything enters through openings.
  bool HasBackground() const;

  std::vector<double> BandLimits;
  double BackgroundTemperature = 0.0;
  std::vector<double> BackgroundRadiance;
};

class MaterialArrays
{
public:
  /// The input arrays of vtkRadiosity by their index.
  enum InputArray
  {
    EMISSION,
    REFLECTANCE,
    TEMPERATURE,
    EMISSIVITY,
    DIRECT_IRRADIANCE,
    BOUNDARY_CONDITION,
    PRESCRIBED_NET_FLUX,
    NUMBER_OF_ARRAYS
  };
  static const char* GetDefaultName(int array);

  explicit MaterialArrays(const MaterialSettings& settings) : Settings(settings) {}

  /// `names` are those of the input arrays. Fails, on every rank alike, where arrays or settings
  /// are wrong or do not fit each other.
  Outcome Read(const CellArrays& source, const PatchScene& scene,
    const std::vector<std::string>& names);

  int GetNumberOfBands() const { return this->Bands; }
  bool IsThermal() const { return this->IsThere(TEMPERATURE); }
  bool HasGivenFlux(vtkIdType patch) const;
  double GetEmission(vtkIdType patch, int band) const;
  double GetReflectance(vtkIdType patch, int band) const;
  /// The irradiance of a patch that sees nothing but the background.
  double GetBackground(int band) const;
  /// 0 where there is no such array.
  double Get(int array, vtkIdType patch, int band) const
  {
    return this->IsThere(array) ? this->Arrays[array].Get(patch, band) : 0.0;
  }

  /// What users should know of arrays that are right, a line each.
  const std::vector<std::string>& GetWarnings() const { return this->Warnings; }

private:
  struct BandArray
  {
    bool IsThere() const { return this->Components > 0; }
    double Get(vtkIdType patch, int band) const
    {
      return this->Values[patch * this->Components + (this->Components == 1 ? 0 : band)];
    }
    Outcome CheckRange(const PatchScene& scene, double low, double high, const char* range) const;

    std::string Name;
    std::vector<double> Values;
    int Components = 0;
    bool HasBack = false; ///< whether backs have an array of their own
  };

  bool IsThere(int array) const { return this->Arrays[array].IsThere(); }
  std::string Quote(int array) const { return "\"" + this->Arrays[array].Name + "\""; }
  bool HasLimits() const { return !this->Settings.BandLimits.empty(); }

  Outcome Gather(const CellArrays& source, const std::vector<std::string>& names);
  void LookAtBacks(const PatchScene& scene);
  Outcome CheckSettings() const;
  Outcome CheckBands();
  Outcome CheckBandCount(const std::string& name, int count);
  Outcome CheckCombination() const;
  Outcome CheckThermal() const;
  Outcome CheckTotals() const;
  Outcome CheckRanges(const PatchScene& scene) const;
  Outcome CheckGivenFluxes(const PatchScene& scene) const;

  const MaterialSettings& Settings;
  BandArray Arrays[NUMBER_OF_ARRAYS];
  int Bands = 1;
  bool HasFluxAlone = false; ///< a given net flux, but no temperatures
  std::string NearMisses;    ///< arrays that may have been meant for those that are missing
  std::vector<std::string> Warnings;
};
} // namespace LightTransport

#endif
