// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/DistantLight.h"

#include "Lighting/SampleMean.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Corners of a polygon that holds the disc: a straight edge that cuts the disc has some of them on
/// either side.
constexpr int EdgeDirections = 8;
/// With more patches before it a ray for each direction is better than the lit part of a patch.
constexpr std::size_t MostBlockers = 256;
/// Rays at first for each of what else are directions.
constexpr int RaysOfDirection = 16;
/// Of shares of a patch.
constexpr double Rounding = 1e-9;
/// Directions or rays are at most this many times those at first.
constexpr int MostRefined = 64;
/// Directions of a disc of which only the transmitted part is asked.
constexpr int TransmissionDirections = 16;
} // namespace

//------------------------------------------------------------------------------
DistantLight::DistantLight(const PunctualLight& light, const LightEffort& effort,
  double angularDiameter)
  : Origin(light), Effort(effort), Radius(0.5 * vtkMath::RadiansFromDegrees(angularDiameter))
{
}

//------------------------------------------------------------------------------
double DistantLight::Light(const LitPatch& patch, LightSum& sum) const
{
  LightSum light;
  const double rays =
    this->Radius > 0.0 ? this->LightFromDisc(patch, light) : this->LightFromPoint(patch, light);
  light.RaiseUnshadowed(this->Origin.Color, PunctualLight::Facing);
  sum.Add(light);
  return rays;
}

//------------------------------------------------------------------------------
ShadowClipper::Origin DistantLight::GetOrigin(const Vector& direction)
{
  return { false, Vector::Zero(), direction };
}

//------------------------------------------------------------------------------
// What the lit parts of a patch get from one direction.
void DistantLight::AddParts(const ShadowClipper& clipper, const LitParts& parts,
  const Vector& direction, LightSum& sum) const
{
  const LitPatch& patch = clipper.GetPatch();
  const double share = parts.GetShare(clipper);
  const double cosine = -direction.dot(patch.GetNormal());
  const double strength = cosine / direction.dot(this->Origin.Axis);
  const double transmittance = patch.GetTransmittance(cosine);
  for (int band = 0; band < LightBands; ++band)
  {
    const double whole = this->Origin.Color[band] * strength;
    sum.Unshadowed[band] += whole;
    sum.Incident[band] += whole * share;
    sum.Transmitted[band] += whole * share * transmittance;
    sum.Variance[band] += whole * whole * parts.GetVariance();
  }
}

//------------------------------------------------------------------------------
double DistantLight::LightFromPoint(const LitPatch& patch, LightSum& sum) const
{
  const double cosine = -this->Origin.Axis.dot(patch.GetNormal());
  if (!(cosine > 0.0))
  {
    return 0.0;
  }
  const ShadowClipper clipper(patch);
  const ShadowClipper::Origin origin = GetOrigin(this->Origin.Axis);
  const Blockers blockers = clipper.FindBlockers(clipper.GetWhole(), origin);
  const LitParts parts = blockers.empty()
    ? LitParts(clipper.GetWhole())
    : LitParts::Refine(
        clipper, clipper.GetWhole(), origin, blockers, this->Effort,
        [](const Vector&) { return 1.0; }, std::max(1.0, PunctualLight::Facing / cosine));
  this->AddParts(clipper, parts, this->Origin.Axis, sum);
  return parts.GetNumberOfRays();
}

//------------------------------------------------------------------------------
DistantLight::Vector DistantLight::GetDirection(const LitPatch& patch, int k) const
{
  return this->Origin.GetDirection(this->Radius, patch.GetSampler().Get(k, 2),
    patch.GetSampler().Get(k, 3));
}

//------------------------------------------------------------------------------
// Returns the rays cast.
double DistantLight::AddDirection(const ShadowClipper& clipper, const Blockers& blockers, int k,
  LightSum& sum) const
{
  const LitPatch& patch = clipper.GetPatch();
  const Vector direction = this->GetDirection(patch, k);
  const double cosine = -direction.dot(patch.GetNormal());
  if (!(cosine > 0.0))
  {
    return 0.0;
  }
  if (blockers.size() > MostBlockers)
  {
    const Vector point = patch.GetPoint(k);
    sum.Add(this->Origin.Color, cosine / direction.dot(this->Origin.Axis),
      patch.GetTransmittance(cosine), patch.IsBlocked(point, point - OutOfScene * direction));
    return 1.0;
  }
  const LitParts parts(clipper, clipper.GetWhole(), GetOrigin(direction), blockers, this->Effort);
  this->AddParts(clipper, parts, direction, sum);
  return parts.GetNumberOfRays();
}

//------------------------------------------------------------------------------
// Whether directions all around the disc light the same part of the patch, nothing or all.
bool DistantLight::IsEdgeAlike(const ShadowClipper& clipper, const Blockers& blockers,
  double& share) const
{
  const double step = vtkMath::Pi() / EdgeDirections;
  for (int k = 0; k < EdgeDirections; ++k)
  {
    const Vector direction =
      this->Origin.Lean(std::tan(this->Radius) / std::cos(step), 2.0 * k * step);
    if (!(direction.dot(clipper.GetPatch().GetNormal()) < 0.0))
    {
      return false;
    }
    const double part =
      LitParts(clipper, clipper.GetWhole(), GetOrigin(direction), blockers, this->Effort)
        .GetShare(clipper);
    share = k == 0 ? part : share;
    if ((part > Rounding && part < 1.0 - Rounding) || std::abs(part - share) > Rounding)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// A disc that is seen as a whole gives what it would from its middle; directions tell how much of
// that enters.
LightSum DistantLight::GetWholeDisc(const LitPatch& patch) const
{
  double entering = 0.0;
  double all = 0.0;
  for (int k = 0; k < TransmissionDirections; ++k)
  {
    const Vector direction = this->GetDirection(patch, k);
    const double cosine = -direction.dot(patch.GetNormal());
    const double strength = cosine / direction.dot(this->Origin.Axis);
    all += strength;
    entering += strength * patch.GetTransmittance(cosine);
  }
  LightSum light;
  light.Add(this->Origin.Color, -this->Origin.Axis.dot(patch.GetNormal()), entering / all);
  return light;
}

//------------------------------------------------------------------------------
double DistantLight::LightFromDisc(const LitPatch& patch, LightSum& sum) const
{
  const double cosine = -this->Origin.Axis.dot(patch.GetNormal());
  if (!(cosine > -std::sin(this->Radius)))
  {
    return 0.0;
  }
  const bool isUp = cosine >= std::sin(this->Radius);
  const ShadowClipper clipper(patch);
  const double outer = std::atan(std::tan(this->Radius) / std::cos(vtkMath::Pi() / EdgeDirections));
  const Blockers blockers =
    clipper.FindBlockers(clipper.GetWhole(), GetOrigin(this->Origin.Axis), outer);
  if (isUp && blockers.empty())
  {
    sum = this->GetWholeDisc(patch);
    return 0.0;
  }
  double share = 0.0;
  const bool isEdgeAlike =
    isUp && blockers.size() <= MostBlockers && this->IsEdgeAlike(clipper, blockers, share);
  const double rays = this->SampleDisc(clipper, blockers, isEdgeAlike, sum);
  if (isEdgeAlike && share > 0.5 &&
    std::equal(sum.Incident, sum.Incident + LightBands, sum.Unshadowed))
  {
    sum = this->GetWholeDisc(patch);
  }
  return rays;
}

//------------------------------------------------------------------------------
// Where the edge of the disc is seen, or not, as its inside is, that is all; elsewhere directions
// are taken until the light is known well enough.
double DistantLight::SampleDisc(const ShadowClipper& clipper, const Blockers& blockers,
  bool isEdgeAlike, LightSum& light) const
{
  double rays = 0.0;
  const int first =
    this->Effort.ShadowSamples * (blockers.size() > MostBlockers ? RaysOfDirection : 1);
  SampleMean mean(first);
  for (;;)
  {
    mean.Fill(
      [&](int k, LightSum& part) { rays += this->AddDirection(clipper, blockers, k, part); });
    light = mean.GetMean(!isEdgeAlike);
    LightSum scale = light;
    scale.RaiseUnshadowed(this->Origin.Color, PunctualLight::Facing);
    if (light.GetLargestError() <= this->Effort.Tolerance * scale.GetLargestUnshadowed() ||
      mean.GetCount() * 2 > std::max(first, 8) * MostRefined)
    {
      return rays;
    }
    mean.Double();
  }
}
} // namespace LightTransport
