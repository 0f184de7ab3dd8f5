// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Marching/InsidePath.h"

#include <algorithm>
#include <cmath>

namespace LightTransport
{
//------------------------------------------------------------------------------
InsidePath::InsidePath(const PhotonBoundary& boundary, const PhotonInterface& interface,
  const std::vector<PhotonMedium>& media, double leastWeight, const Vector& origin,
  const Vector& direction, vtkIdType from)
{
  std::transform(media.begin(), media.end(), this->Extinction.begin(),
    [](const PhotonMedium& medium) { return medium.GetExtinction(); });
  Leg leg{ origin, direction, 0.0, 0.0, 1.0, from, Vector::Zero() };
  while (this->NumberOfLegs < MostLegs &&
    leg.Weight * this->GetMeanTransmission(leg.Begin) > leastWeight)
  {
    PhotonCrossing crossing;
    if (!boundary.FindCrossing(
          { leg.Origin, leg.Direction, PhotonBoundary::Unlimited, true, leg.Patch }, crossing) ||
      !crossing.IsExpected)
    {
      return;
    }
    leg.End = leg.Begin + crossing.Distance;
    leg.Patch = crossing.Patch;
    leg.Normal = crossing.Normal;
    this->Legs[this->NumberOfLegs++] = leg;
    leg.Weight *= interface.GetInternalReflectance(leg.Direction.dot(leg.Normal));
    leg.Origin += crossing.Distance * leg.Direction;
    leg.Direction = PhotonInterface::Reflect(leg.Direction, leg.Normal);
    leg.Begin = leg.End;
  }
}

//------------------------------------------------------------------------------
double InsidePath::GetMeanTransmission(double length) const
{
  double sum = 0.0;
  for (const double extinction : this->Extinction)
  {
    sum += std::exp(-extinction * length);
  }
  return sum / Bands;
}

//------------------------------------------------------------------------------
// Where the mean transmission has gone the part `u` of its way along a leg. Its logarithm is
// convex, so that Newton's steps never go too far.
double InsidePath::FindLength(const Leg& leg, double u) const
{
  constexpr int mostSteps = 50;
  constexpr double accuracy = 1e-10;
  const double begin = this->GetMeanTransmission(leg.Begin);
  const double target = begin - u * (begin - this->GetMeanTransmission(leg.End));
  double length = leg.Begin;
  for (int step = 0; step < mostSteps; ++step)
  {
    double value = 0.0;
    double slope = 0.0;
    for (const double extinction : this->Extinction)
    {
      const double part = std::exp(-extinction * length) / Bands;
      value += part;
      slope += extinction * part;
    }
    const double change = std::log(value / target) * value / slope;
    length += change;
    if (!(std::abs(change) > accuracy * (length - leg.Begin)))
    {
      break;
    }
  }
  return std::min(std::max(length, leg.Begin), leg.End);
}

//------------------------------------------------------------------------------
double InsidePath::GetShare(const Leg& leg) const
{
  return leg.Weight * (this->GetMeanTransmission(leg.Begin) - this->GetMeanTransmission(leg.End));
}

//------------------------------------------------------------------------------
double InsidePath::GetShare(int first) const
{
  double share = 0.0;
  for (int k = first; k < this->NumberOfLegs; ++k)
  {
    share += this->GetShare(this->Legs[k]);
  }
  return share;
}

//------------------------------------------------------------------------------
InsidePath::Place InsidePath::Choose(double u, int first) const
{
  std::array<double, MostLegs> ends;
  double total = 0.0;
  for (int k = first; k < this->NumberOfLegs; ++k)
  {
    total += this->GetShare(this->Legs[k]);
    ends[k] = total;
  }
  const auto last = ends.begin() + this->NumberOfLegs - 1;
  const auto chosen = std::upper_bound(ends.begin() + first, last, u * total) - ends.begin();
  const double before = chosen > first ? ends[chosen - 1] : 0.0;
  const double width = ends[chosen] - before;
  const Leg& leg = this->Legs[chosen];
  const double length =
    this->FindLength(leg, width > 0.0 ? std::min((u * total - before) / width, 1.0) : 0.5);
  Place place;
  place.Position = leg.Origin + (length - leg.Begin) * leg.Direction;
  place.Direction = leg.Direction;
  double density = 0.0;
  for (int band = 0; band < Bands; ++band)
  {
    place.Weights[band] = total * std::exp(-this->Extinction[band] * length);
    density += this->Extinction[band] * std::exp(-this->Extinction[band] * length) / Bands;
  }
  for (double& weight : place.Weights)
  {
    weight = density > 0.0 ? weight / density : 0.0;
  }
  return place;
}

//------------------------------------------------------------------------------
double InsidePath::GetLeaving(const PhotonInterface& interface, int leg) const
{
  const Leg& last = this->Legs[leg];
  return last.Weight * (1.0 - interface.GetInternalReflectance(last.Direction.dot(last.Normal)));
}

//------------------------------------------------------------------------------
// As likely as all bands leave there.
bool InsidePath::ChooseExit(const PhotonInterface& interface, double u, Exit& exit) const
{
  std::array<double, MostLegs> ends;
  double total = 0.0;
  for (int k = 0; k < this->NumberOfLegs; ++k)
  {
    total += this->GetLeaving(interface, k) * this->GetMeanTransmission(this->Legs[k].End);
    ends[k] = total;
  }
  if (!(total > 0.0))
  {
    return false;
  }
  const auto last = ends.begin() + this->NumberOfLegs - 1;
  const auto chosen = std::upper_bound(ends.begin(), last, u * total) - ends.begin();
  const Leg& leg = this->Legs[chosen];
  exit.Position = leg.Origin + (leg.End - leg.Begin) * leg.Direction;
  exit.Direction = interface.RefractOutwards(leg.Direction, leg.Normal);
  exit.Patch = leg.Patch;
  const double mean = this->GetMeanTransmission(leg.End);
  for (int band = 0; band < Bands; ++band)
  {
    exit.Weights[band] = total * std::exp(-this->Extinction[band] * leg.End) / mean;
  }
  return true;
}
} // namespace LightTransport
