// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/Environment.h"

#include "Lighting/SampleMean.h"
#include "vtkMath.h"

namespace LightTransport
{
namespace
{
/// Peaks are small and mostly seen as a whole: they begin with this part of the rays.
constexpr int PeakPart = 4;
} // namespace

//------------------------------------------------------------------------------
// Directions are even in projected solid angle.
void Environment::AddBackground(const LitPatch& patch, const double* unshadowed, bool isFree, int k,
  LightSum& sum) const
{
  const LitPatch::Vector direction = patch.GetDirection(k);
  if (!isFree)
  {
    const LitPatch::Vector point = patch.GetPoint(k);
    if (patch.IsBlocked(point, point + OutOfScene * direction))
    {
      sum.Add(unshadowed, 1.0, 0.0, true);
      return;
    }
  }
  double radiance[LightBands];
  this->Picture.GetBackground(direction, radiance);
  sum.Add(radiance, vtkMath::Pi(), patch.GetTransmittance(direction.dot(patch.GetNormal())));
}

//------------------------------------------------------------------------------
void Environment::AddPeak(const LitPatch& patch, bool isFree, int k, LightSum& sum) const
{
  double weights[LightBands];
  const PatchSampler& sampler = patch.GetSampler();
  const LitPatch::Vector direction =
    this->Picture.GetPeak(sampler.Get(k, 2), sampler.Get(k, 3), weights);
  const double cosine = direction.dot(patch.GetNormal());
  if (cosine > 0.0)
  {
    const LitPatch::Vector point = patch.GetPoint(k);
    sum.Add(weights, cosine, patch.GetTransmittance(cosine),
      !isFree && patch.IsBlocked(point, point + OutOfScene * direction));
  }
}

//------------------------------------------------------------------------------
// The part whose error is larger gets as many rays again.
double Environment::Light(const LitPatch& patch, LightSum& sum) const
{
  const int samples = this->Effort.EnvironmentSamples;
  const bool isFree = !patch.HasBlockers();
  double unshadowed[LightBands];
  this->Picture.GetIrradiance(patch.GetNormal(), unshadowed);
  SampleMean background(samples, !this->Picture.HasBackground());
  SampleMean peaks(samples / PeakPart, !this->Picture.HasPeaks());
  for (;;)
  {
    background.Fill(
      [&](int k, LightSum& part) { this->AddBackground(patch, unshadowed, isFree, k, part); });
    peaks.Fill([&](int k, LightSum& part) { this->AddPeak(patch, isFree, k, part); });
    const LightSum even = background.GetMean();
    const LightSum sharp = peaks.GetMean();
    LightSum both = even;
    both.Add(sharp);
    both.RaiseUnshadowed(this->Picture.GetMeanIrradiance(), 1.0);
    const double allowed =
      this->Effort.Tolerance * (sum.GetLargestUnshadowed() + both.GetLargestUnshadowed());
    const bool isPeak = sharp.GetLargestError() > even.GetLargestError();
    SampleMean& worse = isPeak ? peaks : background;
    if (both.GetLargestError() <= allowed ||
      worse.GetCount() * 2 > std::max(samples, 8) * MostRefined)
    {
      sum.Add(both);
      return isFree ? 0.0 : background.GetCount() + peaks.GetCount();
    }
    worse.Double();
  }
}
} // namespace LightTransport
