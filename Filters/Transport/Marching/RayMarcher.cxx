// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Marching/RayMarcher.h"

#include "Photons/HenyeyGreenstein.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace LightTransport
{
namespace
{
/// Of mean free paths of the clearest band: of what comes from further away 1e-8 is left.
constexpr double MostFreePaths = 18.0;
/// Coordinates of scenes are worth that, as MeshBoundary says.
constexpr double Margin = 4e-6;

//------------------------------------------------------------------------------
double GetReach(const std::vector<PhotonMedium>& media)
{
  double least = media[0].GetExtinction();
  for (const PhotonMedium& medium : media)
  {
    least = std::min(least, medium.GetExtinction());
  }
  return MostFreePaths / least;
}
} // namespace

//------------------------------------------------------------------------------
RayMarcher::RayMarcher(const PatchScene& scene, const std::vector<PhotonMedium>& media,
  double refractiveIndex, const Lights& lights)
  : Scene(scene), Media(media), Index(refractiveIndex), Sources(lights), Interface(refractiveIndex),
    Search(scene, refractiveIndex), Reach(GetReach(media))
{
}

//------------------------------------------------------------------------------
void RayMarcher::March(const Sample& sample, double radiance[LightBands]) const
{
  const Vector& normal = this->Scene.GetNormal(sample.Patch);
  const Vector inwards = this->Interface.RefractInwards(-sample.Outwards, normal);
  const InsidePath path(this->Boundary, this->Interface, this->Media, sample.Point, inwards,
    sample.Patch);
  if (path.GetNumberOfLegs() == 0)
  {
    return;
  }
  const InsidePath::Place chosen = path.Choose(sample.Place);
  Scattering place{ chosen.Position, chosen.Direction, {} };
  const double leaving =
    (1.0 - this->Interface.GetExternalReflectance(sample.Outwards.dot(normal))) /
    (this->Index * this->Index);
  for (int band = 0; band < LightBands; ++band)
  {
    place.Weights[band] = leaving * this->Media[band].Scattering * chosen.Weights[band];
  }
  for (const PunctualLight& light : this->Sources.Punctual)
  {
    if (light.IsPositional)
    {
      this->AddPoint(light, place, radiance);
      continue;
    }
    const Vector direction = light.GetDirection(this->Sources.Radius, sample.Sky[0], sample.Sky[1]);
    double irradiance[LightBands];
    std::transform(light.Color, light.Color + LightBands, irradiance,
      [factor = 1.0 / direction.dot(light.Axis)](double color) { return factor * color; });
    this->AddDistant(-direction, irradiance, place, radiance);
  }
  const Panorama* environment = this->Sources.Environment;
  if (environment && environment->HasPeaks())
  {
    double irradiance[LightBands];
    const Vector towards = environment->GetPeak(sample.Sky[0], sample.Sky[1], irradiance);
    this->AddDistant(towards, irradiance, place, radiance);
  }
  if (environment && environment->HasBackground())
  {
    this->AddBackground(sample, place, radiance);
  }
}

//------------------------------------------------------------------------------
void RayMarcher::AddPoint(const PunctualLight& light, const Scattering& place,
  double* radiance) const
{
  std::vector<EntrySearch::Entry> entries;
  this->Search.Find(place.Position, { true, light.Position }, this->Reach, entries);
  for (const EntrySearch::Entry& entry : entries)
  {
    if (!light.IsInCone(entry.Point))
    {
      continue;
    }
    const double strength = light.GetStrength(entry.Point, this->Scene.GetScale());
    double irradiance[LightBands];
    std::transform(light.Color, light.Color + LightBands, irradiance,
      [strength](double color) { return strength * color; });
    this->AddEntry(entry, irradiance, (light.Position - entry.Point).norm(), place, radiance);
  }
}

//------------------------------------------------------------------------------
void RayMarcher::AddDistant(const Vector& towards, const double* irradiance,
  const Scattering& place, double* radiance) const
{
  std::vector<EntrySearch::Entry> entries;
  this->Search.Find(place.Position, { false, towards }, this->Reach, entries);
  for (const EntrySearch::Entry& entry : entries)
  {
    this->AddEntry(entry, irradiance, PhotonBoundary::Unlimited, place, radiance);
  }
}

//------------------------------------------------------------------------------
// `distance` of the light from the entry.
void RayMarcher::AddEntry(const EntrySearch::Entry& entry, const double* irradiance,
  double distance, const Scattering& place, double* radiance) const
{
  if (!this->IsVisible(place.Position, entry) ||
    !this->IsLit(entry.Point, entry.Towards, distance, entry.Patch))
  {
    return;
  }
  const double cosine = -entry.Direction.dot(place.Direction);
  for (int band = 0; band < LightBands; ++band)
  {
    const PhotonMedium& medium = this->Media[band];
    radiance[band] += place.Weights[band] * irradiance[band] * entry.Spread *
      HenyeyGreenstein::GetDensity(medium.Anisotropy, cosine) *
      std::exp(-medium.GetExtinction() * entry.Distance);
  }
}

//------------------------------------------------------------------------------
// Along a ray in a direction that the phase function chooses, and its reflections: at each end
// some comes in. Radiance inside is larger by the square of the index, and smaller again outside.
void RayMarcher::AddBackground(const Sample& sample, const Scattering& place,
  double* radiance) const
{
  double weights[LightBands];
  const Vector direction = this->ChooseDirection(sample, place.Direction, weights);
  const InsidePath path(this->Boundary, this->Interface, this->Media, place.Position, direction,
    -1);
  for (int k = 0; k < path.GetNumberOfLegs(); ++k)
  {
    const InsidePath::Leg& leg = path.GetLeg(k);
    const double reflected = this->Interface.GetInternalReflectance(leg.Direction.dot(leg.Normal));
    const Vector end = leg.Origin + (leg.End - leg.Begin) * leg.Direction;
    const Vector towards = this->Interface.RefractOutwards(leg.Direction, leg.Normal);
    if (reflected == 1.0 || !this->IsLit(end, towards, PhotonBoundary::Unlimited, leg.Patch))
    {
      continue;
    }
    double sky[LightBands];
    this->Sources.Environment->GetBackground(towards, sky);
    const double factor = this->Index * this->Index * leg.Weight * (1.0 - reflected);
    for (int band = 0; band < LightBands; ++band)
    {
      radiance[band] += place.Weights[band] * weights[band] * factor * sky[band] *
        std::exp(-this->Media[band].GetExtinction() * leg.End);
    }
  }
}

//------------------------------------------------------------------------------
// As dense as the mean of all bands' phase functions; `weights`: each band's over that mean.
RayMarcher::Vector RayMarcher::ChooseDirection(const Sample& sample, const Vector& axis,
  double* weights) const
{
  const double cosine =
    HenyeyGreenstein::GetCosine(this->Media[sample.Band].Anisotropy, sample.Sky[0]);
  double mean = 0.0;
  for (int band = 0; band < LightBands; ++band)
  {
    weights[band] = HenyeyGreenstein::GetDensity(this->Media[band].Anisotropy, cosine);
    mean += weights[band] / LightBands;
  }
  std::for_each(weights, weights + LightBands, [mean](double& weight) { weight /= mean; });
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double angle = 2.0 * vtkMath::Pi() * sample.Sky[1];
  const Vector tangent = axis.unitOrthogonal();
  return (
    cosine * axis + sine * (std::cos(angle) * tangent + std::sin(angle) * axis.cross(tangent)))
    .normalized();
}

//------------------------------------------------------------------------------
// Whether the way inside the body from an entry to a point is free.
bool RayMarcher::IsVisible(const Vector& point, const EntrySearch::Entry& entry) const
{
  PhotonCrossing crossing;
  return !this->Boundary.FindCrossing({ point, -entry.Direction, entry.Distance, true, -1 },
           crossing) ||
    crossing.Distance > entry.Distance - Margin;
}

//------------------------------------------------------------------------------
// Whether the way outside from a point of a patch is free.
bool RayMarcher::IsLit(const Vector& point, const Vector& towards, double distance,
  vtkIdType patch) const
{
  PhotonCrossing crossing;
  return !this->Sources.HasShadows ||
    !this->Boundary.FindCrossing(
      { point, towards, distance - LightSource::Clearance, false, patch }, crossing);
}
} // namespace LightTransport
