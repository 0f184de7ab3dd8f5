// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Radiance from afar, a Panorama: rays over the sky for its background, rays towards its peaks,
/// and more of either until the irradiance is known well enough.
#ifndef Environment_h
#define Environment_h

#include "Lighting/LightSource.h"
#include "Lighting/Panorama.h"
#include "Shared/Outcome.h"

class vtkImageData;

namespace LightTransport
{
class Environment : public LightSource
{
public:
  /// Rays of a patch are at most this many times those that it gets at first, for each part.
  static constexpr int MostRefined = 16;

  explicit Environment(const LightEffort& effort) : Effort(effort) {}

  /// Take over a picture. Fails where it is none of 1 or 3 components, or not finite.
  Outcome Read(vtkImageData* picture) { return this->Picture.Read(picture); }

  double Light(const LitPatch& patch, LightSum& sum) const override;

private:
  ///@{ A sample; of a patch that is free nothing is in the way.
  void AddBackground(const LitPatch& patch, const double* unshadowed, bool isFree, int k,
    LightSum& sum) const;
  void AddPeak(const LitPatch& patch, bool isFree, int k, LightSum& sum) const;
  ///@}

  LightEffort Effort;
  Panorama Picture;
};
} // namespace LightTransport

#endif
