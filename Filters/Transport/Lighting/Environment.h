// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Radiance from afar by longitude and latitude: a picture of the surroundings, +z up.
#ifndef Environment_h
#define Environment_h

#include "Lighting/LightSource.h"
#include "Shared/Outcome.h"

#include <vector>

class vtkImageData;

namespace LightTransport
{
class Environment : public LightSource
{
public:
  /// Rays of each patch.
  explicit Environment(int samples) : Samples(samples) {}

  /// Take over a picture. Fails where it is none of 1 or 3 components, or not finite.
  Outcome Read(vtkImageData* picture);

  double Light(const LitPatch& patch, LightSum& sum) const override;

private:
  void Evaluate(const LitPatch::Vector& direction, double radiance[LightBands]) const;

  int Samples;
  int Width = 0;
  int Height = 0;
  std::vector<double> Values;
};
} // namespace LightTransport

#endif
