// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A ray inside a body, followed against the light or with it: from where it has been refracted
 * inwards to the surface, and on from there, reflected, with what is reflected. Until next to
 * nothing is left.
 */
#ifndef InsidePath_h
#define InsidePath_h

#include "Photons/PhotonBoundary.h"
#include "Photons/PhotonInterface.h"
#include "Photons/PhotonMedium.h"

#include <array>
#include <vector>

namespace LightTransport
{
class InsidePath
{
public:
  using Vector = Eigen::Vector3d;
  static constexpr int Bands = 3;

  /// A straight piece.
  struct Leg
  {
    Vector Origin;
    Vector Direction;
    double Begin;  ///< on the way from the start
    double End;    ///< where it meets the surface
    double Weight; ///< what reflections have left
    vtkIdType Patch;
    Vector Normal; ///< of the surface at its end, outwards
  };

  /// A point of the path.
  struct Place
  {
    Vector Position;
    Vector Direction;
    /// Of each band: what reaches the start of it, over the density of such points in length.
    double Weights[Bands];
  };

  /// A place where some of it leaves the body.
  struct Exit
  {
    Vector Position;
    Vector Direction; ///< outside
    vtkIdType Patch;
    double Weights[Bands]; ///< what leaves there, over the probability of the place
  };

  /// `from`: the patch that the ray starts on, or -1. What is worth less than `leastWeight`, on
  /// average over the bands, is not followed.
  InsidePath(const PhotonBoundary& boundary, const PhotonInterface& interface,
    const std::vector<PhotonMedium>& media, double leastWeight, const Vector& origin,
    const Vector& direction, vtkIdType from);

  int GetNumberOfLegs() const { return this->NumberOfLegs; }
  const Leg& GetLeg(int leg) const { return this->Legs[leg]; }

  /// What part of the light that starts is lost on the leg `first` and behind: absorbed, or
  /// scattered.
  double GetShare(int first) const;

  /// A point for a number evenly spread in (0, 1), on the leg `first`, which there must be, or
  /// behind: as dense as light of all bands reaches it.
  Place Choose(double u, int first = 0) const;

  /// What leaves the body at the end of a leg, over what would reach it in a clear one.
  double GetLeaving(const PhotonInterface& interface, int leg) const;
  /// One of the places where it leaves, for such a number; false where there is none.
  bool ChooseExit(const PhotonInterface& interface, double u, Exit& exit) const;

private:
  /// More reflections are not followed.
  static constexpr int MostLegs = 256;

  double GetMeanTransmission(double length) const;
  double GetShare(const Leg& leg) const;
  double FindLength(const Leg& leg, double u) const;

  std::array<double, Bands> Extinction;
  std::array<Leg, MostLegs> Legs;
  int NumberOfLegs = 0;
};
} // namespace LightTransport

#endif
