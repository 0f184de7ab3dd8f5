// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Photons that walk in a body: straight steps, scattering by Henyey and Greenstein's phase
 * function, and at the surface, which is smooth, reflection by chance or refraction (Fresnel,
 * Snell). What leaves may meet the body, or another one, again, and enters by the same laws. L.
 * Wang, S. L. Jacques, L. Zheng, "MCML - Monte Carlo modeling of light transport in multi-layered
 * tissues", Computer Methods and Programs in Biomedicine 47, 1995.
 *
 * Where a step ends in a ball that the surface does not reach no ray is cast. The walk is the same
 * without.
 */
#ifndef PhotonWalk_h
#define PhotonWalk_h

#include "Photons/PhotonBoundary.h"
#include "Photons/PhotonInterface.h"
#include "Photons/PhotonListener.h"
#include "Photons/PhotonMedium.h"
#include "Photons/PhotonRandom.h"

#include <Eigen/Geometry>

namespace LightTransport
{
struct PhotonStart
{
  Eigen::Vector3d Position;
  Eigen::Vector3d Direction;
  vtkIdType Patch; ///< that it is on, or -1
};

class PhotonWalk
{
public:
  using Vector = Eigen::Vector3d;

  struct Counts
  {
    long long Scatterings = 0;
    long long Entries = 0;
    long long Rays = 0;

    void Add(const Counts& other)
    {
      this->Scatterings += other.Scatterings;
      this->Entries += other.Entries;
      this->Rays += other.Rays;
    }
  };

  ///@{ Scatterings, and places that might have been some, after which a photon is given up, and
  /// reflections inside without leaving: a fifth of a second.
  static constexpr long long MostScatterings = 4000000;
  static constexpr int MostReflections = 1000000;
  ///@}

  PhotonWalk(const PhotonBoundary& boundary, double refractiveIndex, double anisotropy)
    : Boundary(boundary), Interface(refractiveIndex), Anisotropy(anisotropy)
  {
  }

  /// Follow a photon to its end, from its start on the surface, or from one outside. `Path` is
  /// UniformPath or VaryingPath.
  template <typename Path>
  void Follow(const PhotonStart& start, bool isInside, Path& path, PhotonRandom& random,
    PhotonListener& listener, Counts& counts) const;

  /// A direction inwards of light that falls on a surface evenly from outside.
  Vector Enter(const Vector& outward, PhotonRandom& random) const;

private:
  // Between surfaces in one place, in the unit of the walk.
  static constexpr double SamePlace = 1e-6;

  struct State
  {
    Vector Position;
    Vector Direction;
    vtkIdType From;  ///< the patch that the photon is on, or -1
    PhotonBall Ball; ///< that the photon is in, or an empty one
    PhotonCrossing Crossing;
    bool HasJustEntered; ///< where it had left before
    double Weights[MostPhotonBands];
  };
  enum class Fate
  {
    CROSSED,
    ABSORBED,
    ESCAPED,
    LOST
  };

  template <typename Path>
  Fate WalkInside(State& photon, Path& path, PhotonRandom& random, Counts& counts) const;
  Fate WalkOutside(State& photon, PhotonRandom& random, Counts& counts) const;
  // Whether a step ends at the surface.
  bool MeetsSurface(State& photon, const Vector& target, double step, Counts& counts) const;
  Vector Scatter(const Vector& direction, PhotonRandom& random) const;

  const PhotonBoundary& Boundary;
  PhotonInterface Interface;
  double Anisotropy;
};

//------------------------------------------------------------------------------
template <typename Path>
void PhotonWalk::Follow(const PhotonStart& start, bool isInside, Path& path, PhotonRandom& random,
  PhotonListener& listener, Counts& counts) const
{
  State photon{ start.Position, start.Direction, start.Patch, {}, {}, false, {} };
  path.GetWeights(photon.Weights);
  Fate fate = isInside ? Fate::CROSSED : this->WalkOutside(photon, random, counts);
  while (fate == Fate::CROSSED)
  {
    ++counts.Entries;
    fate = this->WalkInside(photon, path, random, counts);
    if (fate == Fate::CROSSED)
    {
      path.GetWeights(photon.Weights);
      if (path.GetNumberOfScatterings() > 0)
      {
        listener.Leave(photon.Crossing.Patch, photon.Position, photon.Weights);
      }
      fate = this->WalkOutside(photon, random, counts);
    }
  }
  counts.Scatterings += path.GetNumberOfScatterings();
  if (fate == Fate::ESCAPED)
  {
    listener.Escape(path.GetNumberOfScatterings() > 0, photon.Weights);
  }
  else if (fate == Fate::LOST)
  {
    path.GetWeights(photon.Weights);
    listener.Lose(photon.Position, photon.Weights);
  }
}

//------------------------------------------------------------------------------
template <typename Path>
PhotonWalk::Fate PhotonWalk::WalkInside(State& photon, Path& path, PhotonRandom& random,
  Counts& counts) const
{
  photon.Ball.SquaredRadius = 0.0;
  int reflections = 0;
  while (path.GetNumberOfEvents() < MostScatterings && reflections < MostReflections)
  {
    const double step = path.ChooseStep(photon.Position, photon.Direction, random);
    const Vector target = photon.Position + step * photon.Direction;
    if (!this->MeetsSurface(photon, target, step, counts))
    {
      if (step == PhotonBoundary::Unlimited)
      {
        return Fate::LOST;
      }
      path.Advance(step);
      photon.Position = target;
      photon.From = -1;
      photon.HasJustEntered = false;
      const PhotonEvent event = path.Meet(random);
      if (event == PhotonEvent::ENDED)
      {
        return Fate::ABSORBED;
      }
      if (event == PhotonEvent::SCATTERED)
      {
        photon.Direction = this->Scatter(photon.Direction, random);
      }
      continue;
    }
    const PhotonCrossing& crossing = photon.Crossing;
    if (!crossing.IsExpected)
    {
      return Fate::LOST;
    }
    // At an edge that rounding has taken for two surfaces: it would turn there for ever.
    if (photon.HasJustEntered && crossing.Distance < SamePlace)
    {
      return Fate::ESCAPED;
    }
    photon.HasJustEntered = false;
    path.Advance(crossing.Distance);
    photon.Position += crossing.Distance * photon.Direction;
    photon.From = crossing.Patch;
    const double cosine = photon.Direction.dot(crossing.Normal);
    if (random.Get() >= this->Interface.GetInternalReflectance(cosine))
    {
      photon.Direction = this->Interface.RefractOutwards(photon.Direction, crossing.Normal);
      return Fate::CROSSED;
    }
    photon.Direction = PhotonInterface::Reflect(photon.Direction, crossing.Normal);
    ++reflections;
  }
  return Fate::LOST;
}
} // namespace LightTransport

#endif
