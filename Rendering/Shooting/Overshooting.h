// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What patches shoot beyond what is unshot there: their share of an ambient radiosity, all unshot
 * power as if it were spread over the scene evenly and went on until it is lost (M. Feda, W.
 * Purgathofer, Accelerating radiosity by overshooting, 1992).
 *
 * Shots of what is unshot alone always converge: where overshooting gains nothing over as many
 * shots as there are patches (a sweep), as where most light leaves the scene, it ends.
 */
#ifndef Overshooting_h
#define Overshooting_h

#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class Overshooting
{
public:
  /// `areas`: fractions of the whole; `reflectance`: patches x bands. Off, the ambient radiosity
  /// stays 0.
  Overshooting(bool on, const std::vector<double>& areas, const std::vector<double>& reflectance);

  bool IsOn() const { return this->On; }

  void AddShots(vtkIdType shots) { this->ShotsOfSweep += shots; }
  /// True where `EndSweep` is to be called, also before the first shot.
  bool IsSweepOver() const { return this->On && this->ShotsOfSweep >= this->ShotsPerSweep; }
  /// `remainder`: the sum of the squares of what is unshot.
  void EndSweep(double remainder);

  /// The unshot power of each band, as an area-weighted mean.
  void SetUnshotPower(const std::vector<double>& power);
  const std::vector<double>& GetAmbientRadiosity() const { return this->Ambient; }

private:
  bool On;
  const vtkIdType ShotsPerSweep;
  vtkIdType ShotsOfSweep;
  double Remainder;           ///< a sweep ago
  std::vector<double> Losses; ///< of each band: what does not come back of an ambient radiosity
  std::vector<double> Ambient;
};
} // namespace LightTransport

#endif
