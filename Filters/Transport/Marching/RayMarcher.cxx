// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Marching/RayMarcher.h"

#include "Geometry/PlaneSides.h"
#include "Photons/HenyeyGreenstein.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>

namespace LightTransport
{
namespace
{
/// Of mean free paths of the clearest band: of what comes from further away 1e-8 is left.
constexpr double MostFreePaths = 18.0;
/// How often light is scattered that is all reflected before.
constexpr double ScatteringsPerRay = 8.0;
/// Multiples of them, and where they start, are evenly spread in three dimensions (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018).
constexpr double Steps[3] = { 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 };
/// Coordinates of scenes are worth that, as MeshBoundary says.
constexpr double Margin = 4e-6;
/// Where edges of bodies meet a ray may leave one and enter the other for ever, losing nothing.
constexpr int MostRoundsInPlace = 16;

//------------------------------------------------------------------------------
void Scale(const double* values, double factor, double scaled[LightBands])
{
  std::transform(values, values + LightBands, scaled,
    [factor](double value) { return factor * value; });
}

//------------------------------------------------------------------------------
double Shift(double number, double step)
{
  return std::fmod(number + step, 1.0);
}

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
  double refractiveIndex, const Lights& lights, double leastWeight)
  : Scene(scene), Media(media), Index(refractiveIndex), Sources(lights), LeastWeight(leastWeight),
    Interface(refractiveIndex), Search(scene, refractiveIndex), Reach(GetReach(media))
{
}

//------------------------------------------------------------------------------
Outcome RayMarcher::Build()
{
  const std::vector<bool> hollows = FindHollows(this->Scene);
  // Bodies that do not shade each other do not light each other, either.
  this->HasHollows =
    this->Sources.HasShadows && std::find(hollows.begin(), hollows.end(), true) != hollows.end();
  return this->Boundary.Build(this->Scene, 0.0);
}

//------------------------------------------------------------------------------
void RayMarcher::March(const Sample& sample, double radiance[LightBands]) const
{
  const Vector& normal = this->Scene.GetNormal(sample.Patch);
  const double leaving =
    (1.0 - this->Interface.GetExternalReflectance(sample.Outwards.dot(normal))) /
    (this->Index * this->Index);
  Ray ray;
  ray.Position = sample.Point;
  ray.Direction = this->Interface.RefractInwards(-sample.Outwards, normal);
  ray.Patch = sample.Patch;
  std::fill_n(ray.Weights, LightBands, leaving);
  PhotonRandom random(sample.Stream, 0);
  double number = sample.Place;
  for (bool goesOn = true; goesOn; number = random.Get())
  {
    const InsidePath path = this->Follow(ray);
    if (path.GetNumberOfLegs() == 0)
    {
      return;
    }
    this->AddScattered(path, number, ray, sample, random, radiance);
    goesOn = this->GoOn(path, ray, random);
  }
}

//------------------------------------------------------------------------------
// From inside a body through one of the places where the ray leaves it into a body again. False
// where it does not enter, or next to nothing of it is left.
bool RayMarcher::GoOn(const InsidePath& path, Ray& ray, PhotonRandom& random) const
{
  InsidePath::Exit exit;
  ray.Reflections = 0;
  if (!this->HasHollows || !path.ChooseExit(this->Interface, random.Get(), exit))
  {
    return false;
  }
  const Vector before = ray.Position;
  double mean = 0.0;
  for (int band = 0; band < LightBands; ++band)
  {
    ray.Weights[band] *= exit.Weights[band];
    mean += exit.Weights[band] / LightBands;
  }
  ray.Part *= mean;
  ray.Position = exit.Position;
  ray.Direction = exit.Direction;
  ray.Patch = exit.Patch;
  if (ray.Part <= this->LeastWeight || !ray.Enter(this->Boundary, this->Interface, random))
  {
    return false;
  }
  const bool hasMoved = (ray.Position - before).norm() > Margin;
  ray.RoundsInPlace = hasMoved ? 0 : ray.RoundsInPlace + 1;
  return ray.RoundsInPlace < MostRoundsInPlace;
}

//------------------------------------------------------------------------------
// Light that is scattered at one point of a path.
void RayMarcher::AddScattered(const InsidePath& path, double number, const Ray& ray,
  const Sample& sample, PhotonRandom& random, double* radiance) const
{
  const InsidePath::Place chosen = path.Choose(number);
  Scattering place{ chosen.Position, chosen.Direction, {} };
  for (int band = 0; band < LightBands; ++band)
  {
    place.Weights[band] = ray.Weights[band] * this->Media[band].Scattering * chosen.Weights[band];
  }
  for (const PunctualLight& light : this->Sources.Punctual)
  {
    if (light.IsPositional)
    {
      this->AddPoint(light, place, radiance);
      continue;
    }
    double irradiance[LightBands];
    const Vector towards = this->GetTowards(light, sample.Sky, irradiance);
    this->AddDistant(towards, irradiance, place, radiance);
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
    this->AddBackground(sample, place, random, radiance);
  }
}

//------------------------------------------------------------------------------
// Towards a directional light, and its irradiance across that.
RayMarcher::Vector RayMarcher::GetTowards(const PunctualLight& light, const double* disc,
  double* irradiance) const
{
  const Vector direction = light.GetDirection(this->Sources.Radius, disc[0], disc[1]);
  Scale(light.Color, 1.0 / direction.dot(light.Axis), irradiance);
  return -direction;
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
    double irradiance[LightBands];
    Scale(light.Color, light.GetStrength(entry.Point, this->Scene.GetScale()), irradiance);
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
// Along a ray in a direction that the phase function chooses, and its reflections: at each end some
// comes in. Radiance inside is larger by the square of the index, and smaller again outside.
void RayMarcher::AddBackground(const Sample& sample, const Scattering& place, PhotonRandom& random,
  double* radiance) const
{
  double phase[LightBands];
  Ray ray;
  ray.Position = place.Position;
  ray.Direction = this->ChooseDirection(sample.Band, sample.Sky, place.Direction, phase);
  ray.Patch = -1;
  for (int band = 0; band < LightBands; ++band)
  {
    ray.Weights[band] = place.Weights[band] * phase[band] * this->Index * this->Index;
  }
  for (bool goesOn = true; goesOn;)
  {
    const InsidePath path = this->Follow(ray);
    for (int k = 0; k < path.GetNumberOfLegs(); ++k)
    {
      this->AddSkyAt(path, k, ray, radiance);
    }
    goesOn = this->GoOn(path, ray, random);
    // What comes straight from the sky has been added.
    if (!goesOn && ray.Reflections > 0)
    {
      this->AddSky(ray.Direction, ray.Weights, radiance);
    }
  }
}

//------------------------------------------------------------------------------
// Straight, at the end of a leg.
void RayMarcher::AddSkyAt(const InsidePath& path, int k, const Ray& ray, double* radiance) const
{
  const InsidePath::Leg& leg = path.GetLeg(k);
  const double leaving = path.GetLeaving(this->Interface, k);
  const Vector end = leg.Origin + (leg.End - leg.Begin) * leg.Direction;
  const Vector towards = this->Interface.RefractOutwards(leg.Direction, leg.Normal);
  if (leaving == 0.0 || !this->IsLit(end, towards, PhotonBoundary::Unlimited, leg.Patch))
  {
    return;
  }
  double weights[LightBands];
  for (int band = 0; band < LightBands; ++band)
  {
    weights[band] =
      ray.Weights[band] * leaving * std::exp(-this->Media[band].GetExtinction() * leg.End);
  }
  this->AddSky(towards, weights, radiance);
}

//------------------------------------------------------------------------------
void RayMarcher::AddSky(const Vector& towards, const double* weights, double* radiance) const
{
  double sky[LightBands];
  this->Sources.Environment->GetBackground(towards, sky);
  for (int band = 0; band < LightBands; ++band)
  {
    radiance[band] += weights[band] * sky[band];
  }
}

//------------------------------------------------------------------------------
// As dense as the mean of all bands' phase functions; `weights`: each band's over that mean.
RayMarcher::Vector RayMarcher::ChooseDirection(int chosen, const double* turn, const Vector& axis,
  double* weights) const
{
  const double cosine = HenyeyGreenstein::GetCosine(this->Media[chosen].Anisotropy, turn[0]);
  double mean = 0.0;
  for (int band = 0; band < LightBands; ++band)
  {
    weights[band] = HenyeyGreenstein::GetDensity(this->Media[band].Anisotropy, cosine);
    mean += weights[band] / LightBands;
  }
  std::for_each(weights, weights + LightBands, [mean](double& weight) { weight /= mean; });
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double angle = 2.0 * vtkMath::Pi() * turn[1];
  const Vector tangent = axis.unitOrthogonal();
  return (
    cosine * axis + sine * (std::cos(angle) * tangent + std::sin(angle) * axis.cross(tangent)))
    .normalized();
}

//------------------------------------------------------------------------------
bool RayMarcher::HasReflections() const
{
  const Panorama* environment = this->Sources.Environment;
  return (this->Index > 1.0 || this->HasHollows) &&
    (!this->Sources.Punctual.empty() || (environment && environment->HasPeaks()));
}

//------------------------------------------------------------------------------
void RayMarcher::Shine(const Entrance& entrance, const Receive& receive) const
{
  double irradiance[LightBands];
  for (const PunctualLight& light : this->Sources.Punctual)
  {
    if (!light.IsPositional)
    {
      const Vector towards = this->GetTowards(light, entrance.Sky, irradiance);
      this->ShineFrom(towards, PhotonBoundary::Unlimited, irradiance, entrance, receive);
    }
    else if (light.IsInCone(entrance.Point))
    {
      const Vector path = light.Position - entrance.Point;
      Scale(light.Color, light.GetStrength(entrance.Point, this->Scene.GetScale()), irradiance);
      this->ShineFrom(path.normalized(), path.norm(), irradiance, entrance, receive);
    }
  }
  const Panorama* environment = this->Sources.Environment;
  if (environment && environment->HasPeaks())
  {
    const Vector towards = environment->GetPeak(entrance.Sky[0], entrance.Sky[1], irradiance);
    this->ShineFrom(towards, PhotonBoundary::Unlimited, irradiance, entrance, receive);
  }
}

//------------------------------------------------------------------------------
// Straight inwards March looks; what follows is what has been reflected there, or enters again.
void RayMarcher::ShineFrom(const Vector& towards, double distance, const double* irradiance,
  const Entrance& entrance, const Receive& receive) const
{
  const Vector& normal = this->Scene.GetNormal(entrance.Patch);
  const double cosine = towards.dot(normal);
  if (!(cosine > 0.0) || !this->IsLit(entrance.Point, towards, distance, entrance.Patch))
  {
    return;
  }
  PhotonRandom random(entrance.Stream, 0);
  const double reflected = this->Interface.GetExternalReflectance(cosine);
  Ray ray;
  ray.Position = entrance.Point;
  ray.Direction = this->Interface.RefractInwards(-towards, normal);
  ray.Patch = entrance.Patch;
  Scale(irradiance, entrance.Area * cosine * (1.0 - reflected), ray.Weights);
  const InsidePath first = this->Follow(ray);
  this->Scatter(first, 1, ray, entrance, random, receive);
  // On goes by chance what has entered, or what has been reflected.
  Scale(irradiance, entrance.Area * cosine, ray.Weights);
  const bool isReflected = this->HasHollows && random.Get() < reflected;
  ray.Direction = isReflected ? PhotonInterface::Reflect(-towards, normal) : ray.Direction;
  bool goesOn = isReflected ? ray.Enter(this->Boundary, this->Interface, random)
                            : this->GoOn(first, ray, random);
  while (goesOn)
  {
    const InsidePath path = this->Follow(ray);
    Entrance numbers = entrance;
    for (double* number : { &numbers.Number, &numbers.Place, numbers.Turn, numbers.Turn + 1 })
    {
      *number = random.Get();
    }
    this->Scatter(path, 0, ray, numbers, random, receive);
    goesOn = this->GoOn(path, ray, random);
  }
}

//------------------------------------------------------------------------------
// From the leg `first` on; the more often the larger its part of what is scattered, so that all
// that leaves weighs about the same.
void RayMarcher::Scatter(const InsidePath& path, int first, const Ray& ray,
  const Entrance& entrance, PhotonRandom& random, const Receive& receive) const
{
  const double share = path.GetShare(first);
  if (!(share > 0.0))
  {
    return;
  }
  const double expected = ScatteringsPerRay * ray.Part * share / path.GetShare(0);
  const int times = static_cast<int>(expected + entrance.Number);
  for (int k = 0; k < times; ++k)
  {
    const InsidePath::Place chosen = path.Choose(Shift(entrance.Place, k * Steps[0]), first);
    const double turn[2] = { Shift(entrance.Turn[0], k * Steps[1]),
      Shift(entrance.Turn[1], k * Steps[2]) };
    Scattering place{ chosen.Position, chosen.Direction, {} };
    for (int band = 0; band < LightBands; ++band)
    {
      place.Weights[band] =
        ray.Weights[band] * this->Media[band].Scattering * chosen.Weights[band] / expected;
    }
    this->SendOut(place, (entrance.Band + k) % LightBands, turn, random, receive);
  }
}

//------------------------------------------------------------------------------
// In a direction that the phase function chooses, and reflected from there: at each end some
// leaves.
void RayMarcher::SendOut(const Scattering& place, int chosen, const double* turn,
  PhotonRandom& random, const Receive& receive) const
{
  double phase[LightBands];
  Ray ray;
  ray.Position = place.Position;
  ray.Direction = this->ChooseDirection(chosen, turn, place.Direction, phase);
  ray.Patch = -1;
  std::transform(phase, phase + LightBands, place.Weights, ray.Weights, std::multiplies<double>());
  for (bool goesOn = true; goesOn;)
  {
    const InsidePath path = this->Follow(ray);
    for (int k = 0; k < path.GetNumberOfLegs(); ++k)
    {
      const double leaving = path.GetLeaving(this->Interface, k);
      double flux[LightBands];
      for (int band = 0; leaving > 0.0 && band < LightBands; ++band)
      {
        flux[band] = ray.Weights[band] * leaving *
          std::exp(-this->Media[band].GetExtinction() * path.GetLeg(k).End);
      }
      if (leaving > 0.0)
      {
        receive(path.GetLeg(k).Patch, flux);
      }
    }
    goesOn = this->GoOn(path, ray, random);
  }
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
