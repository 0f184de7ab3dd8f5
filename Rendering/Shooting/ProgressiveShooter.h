// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Progressive refinement on the device: what is unshot and what has been received, and the shots
 * that change them. All calls but the constructor within a DeviceSession; created and destroyed
 * outside.
 */
#ifndef ProgressiveShooter_h
#define ProgressiveShooter_h

#include "Shooting/BrightestPatches.h"
#include "Shooting/HemisphereItems.h"
#include "Shooting/Overshooting.h"
#include "Shooting/ShootingScene.h"
#include "Textures/FloatTextures.h"
#include "Textures/FloatVectors.h"

#include <vector>

namespace LightTransport
{
class ProgressiveShooter
{
public:
  using Shooter = BrightestPatches::Patch;

  /// `reflectance`: patches x bands.
  ProgressiveShooter(vtkOpenGLRenderWindow* window, const vtkDeviceShooter::Patches& patches,
    const std::vector<double>& reflectance, bool overshooting);

  /// False after the window has gone, and where it cannot make floating-point textures.
  bool IsAlive() const { return this->Engine.IsAlive(); }

  int GetNumberOfPatches() const { return this->Scene.GetNumberOfPatches(); }

  /// The message of a failure has no full stop.
  Outcome AllocateVectors();
  /// Begin with nothing shot: `source`, patches x bands, is unshot. `resolution` as in
  /// vtkOpenGLShooter. A failure means that the memory is not there.
  Outcome Begin(const double* source, int resolution);

  /// Those that shoot together next, the brightest first; none where nothing is left to shoot.
  Outcome FindShooters(std::vector<Shooter>& shooters);
  ///@{
  /// Their shots, by as many eye points at a time as one has time for, until none is left.
  /// `density`: eye points for a shot with all the emitted power.
  void Aim(const std::vector<Shooter>& shooters, double density);
  bool IsShooting() const { return !this->Eyes.empty(); }
  Outcome ShootNext(std::size_t mostEyes);
  ///@}

  ///@{
  /// Draws the radiosity so far, what is unshot included, into a vector, in units of the largest
  /// source of each band (GetScales). With `ambient`, what patches will have to reflect of what is
  /// unshot, were it spread evenly, is added to it.
  Outcome ComputeRadiosity(bool ambient);
  const FloatTextures::Group& GetRadiosity();
  const std::vector<double>& GetScales() const { return this->Scales; }
  ///@}

  ///@{
  /// Per band; per patch and band.
  Outcome GetLargestUnshot(double* perBand);
  void GetIrradiance(double* values);
  void GetUnshot(double* values);
  ///@}

  vtkTypeInt64 GetNumberOfEyePoints() const { return this->NumberOfEyePoints; }
  vtkTypeInt64 GetNumberOfBytesRead() const
  {
    return this->Brightest.GetNumberOfBytesRead() + this->Vectors.GetNumberOfBytesRead();
  }

private:
  vtkIdType GetSize() const { return static_cast<vtkIdType>(this->Reflectance.size()); }
  void ComputeScales(const double* source);
  Outcome SetMaterials(const double* source);
  Outcome EndSweep();
  Outcome ComputeShots();
  Outcome Collect();
  std::vector<double> GetMeanReflectance() const;
  void TakeAway(int patch);
  void Unscale(double* values, vtkIdType size) const;

  const ShootingScene Scene;
  const std::vector<double> Reflectance; ///< patches x bands
  const int Bands;
  Overshooting Ambient;
  std::vector<double> Scales;          ///< of each band: its largest source
  std::vector<double> MeanReflectance; ///< of each band
  double FirstPower = 0.0;
  ///@{ Of the shots under way.
  std::vector<Shooter> Aimed;
  std::vector<HemisphereItems::Eye> Eyes;
  std::size_t NextEye = 0;
  ///@}
  vtkTypeInt64 NumberOfEyePoints = 0;

  FloatTextures Engine;
  FloatVectors Vectors;
  HemisphereItems Items;
  BrightestPatches Brightest;
};
} // namespace LightTransport

#endif
