// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringClusters.h"

#include "Scene/PatchScene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
/// Of a cluster, at most.
constexpr int MostPieces = 4;
/// Of the squared spread: a wider piece is not what it is at its centre.
constexpr double WidestSpread2 = 0.5;
constexpr double SmallestSquare = 1e-60;
/// Of the correction of a cluster's value, over the squared spread of its pieces: of 1 / r over a
/// disc.
constexpr double ErrorOfCorrection = 6.0;
} // namespace

//------------------------------------------------------------------------------
ScatteringClusters::ScatteringClusters(const PatchScene& scene, const ScatteringPatches& patches,
  const ScatteringIntegrals& integrals, const Tolerances& tolerances)
  : Patches(patches), Integrals(integrals), Factors(tolerances), Slots(scene)
{
  this->FillPlaces();
  this->GatherPieces();
}

//------------------------------------------------------------------------------
// Children come after their parents.
void ScatteringClusters::FillPlaces()
{
  const int nodes = this->Slots.GetNumberOfNodes();
  this->Places.resize(this->Slots.GetNumberOfSlots());
  for (int slot = this->Slots.GetNumberOfSlots(); slot-- > 0;)
  {
    Place& place = this->Places[slot];
    if (this->Slots.IsPatch(slot))
    {
      const vtkIdType patch = slot - nodes;
      place = { this->Patches.Centroids[patch], this->Patches.Areas[patch],
        this->Patches.GetMoment(patch), this->Patches.Radii[patch], patch, patch + 1 };
      continue;
    }
    const LinkSlots::Node children = this->Slots.GetChildren(slot);
    place.First = this->Places[children.First].First;
    place.Last = this->Places[children.Last - 1].Last;
    for (int child = children.First; child < children.Last; ++child)
    {
      place.Area += this->Places[child].Area;
      place.Center += this->Places[child].Area * this->Places[child].Center;
    }
    place.Center /= place.Area;
    for (int child = children.First; child < children.Last; ++child)
    {
      const Place& part = this->Places[child];
      const double squared = (part.Center - place.Center).squaredNorm();
      place.Moment += part.Area * (part.Moment + squared) / place.Area;
      place.Radius = std::max(place.Radius, part.Radius + std::sqrt(squared));
    }
  }
}

//------------------------------------------------------------------------------
// The children, or where there are few their children.
void ScatteringClusters::GatherPieces()
{
  this->PieceOffsets.assign(1, 0);
  for (int node = 0; node < this->Slots.GetNumberOfNodes(); ++node)
  {
    std::vector<int> pieces{ node };
    std::vector<int> finer;
    while (true)
    {
      finer.clear();
      for (const int piece : pieces)
      {
        const LinkSlots::Node below = this->Slots.IsPatch(piece)
          ? LinkSlots::Node{ piece, piece + 1 }
          : this->Slots.GetChildren(piece);
        for (int child = below.First; child < below.Last; ++child)
        {
          finer.push_back(child);
        }
      }
      if (finer == pieces || (finer.size() > MostPieces && pieces.front() != node))
      {
        break;
      }
      pieces.swap(finer);
    }
    this->Pieces.insert(this->Pieces.end(), pieces.begin(), pieces.end());
    this->PieceOffsets.push_back(static_cast<int>(this->Pieces.size()));
  }
}

//------------------------------------------------------------------------------
bool ScatteringClusters::HoldsPatch(int slot, vtkIdType patch) const
{
  return this->Places[slot].First <= patch && patch < this->Places[slot].Last;
}

//------------------------------------------------------------------------------
vtkIdType ScatteringClusters::Pick(int slot, double number) const
{
  double left = number * this->Places[slot].Area;
  while (!this->Slots.IsPatch(slot))
  {
    const LinkSlots::Node children = this->Slots.GetChildren(slot);
    int child = children.First;
    for (; child + 1 < children.Last && left >= this->Places[child].Area; ++child)
    {
      left -= this->Places[child].Area;
    }
    slot = child;
  }
  return this->Slots.GetPatch(slot);
}

//------------------------------------------------------------------------------
double ScatteringClusters::GetBound(vtkIdType receiver, int slot) const
{
  const Place& here = this->GetReceiver(receiver);
  const Place& there = this->Places[slot];
  const double gap =
    std::max(0.0, (here.Center - there.Center).norm() - here.Radius - there.Radius);
  return this->Integrals.GetValue(gap * gap).maxCoeff();
}

//------------------------------------------------------------------------------
// Whether a piece is what it is at its centre, by how the profile changes over it. Where it is 0
// there may be something nearer, and near the peak of 1/r the table is flat.
bool ScatteringClusters::IsNarrow(double size2, const Bands& value, const Bands& change) const
{
  return (change <= WidestSpread2 * value.square()).all() &&
    (value > 0.0 || size2 * this->Integrals.GetDecays().square() <= WidestSpread2).all();
}

//------------------------------------------------------------------------------
ScatteringClusters::Estimate ScatteringClusters::Look(vtkIdType receiver, int node,
  bool onlyIfSmooth) const
{
  const Place& here = this->GetReceiver(receiver);
  const Place& all = this->Places[node];
  Estimate estimate;
  double moment = 0.0;
  Bands changes = Bands::Zero();
  for (int k = this->PieceOffsets[node]; k < this->PieceOffsets[node + 1]; ++k)
  {
    const Place& piece = this->Places[this->Pieces[k]];
    const double weight = piece.Area / all.Area;
    const double distance2 = (here.Center - piece.Center).squaredNorm();
    // Along one direction: half of the moments.
    const double size2 = 0.5 * (here.Moment + piece.Moment);
    if (this->Integrals.AreSingular() && size2 > WidestSpread2 * distance2)
    {
      estimate.IsSmooth = false;
    }
    if (onlyIfSmooth && !estimate.IsSmooth)
    {
      return estimate;
    }
    Bands derivative;
    const Bands value = this->Integrals.GetValue(distance2, derivative).max(0.0);
    const Bands change = 4.0 * distance2 * size2 * derivative.square();
    estimate.IsSmooth = estimate.IsSmooth && this->IsNarrow(size2, value, change);
    estimate.Value += weight * value;
    estimate.Squares += weight * value.square();
    changes += weight * change;
    moment += weight * piece.Moment;
  }
  if (onlyIfSmooth && !estimate.IsSmooth)
  {
    return estimate;
  }
  // The mean by the centre of all and by those of the pieces are off in proportion to what they
  // leave of the moments.
  const Bands rough = this->Integrals.GetValue((here.Center - all.Center).squaredNorm()).max(0.0);
  const double within = moment + here.Moment;
  const double factor = within / std::max(all.Moment - moment, within);
  const Bands correction = factor * (estimate.Value - rough);
  const Bands spread2 = changes / estimate.Squares.max(SmallestSquare);
  estimate.Error = correction.abs() * (ErrorOfCorrection * spread2).min(1.0);
  estimate.Squares += changes;
  estimate.Value = (estimate.Value + correction).max(0.0);
  return estimate;
}

//------------------------------------------------------------------------------
ScatteringClusters::Bands ScatteringClusters::Integrate(vtkIdType receiver, int slot) const
{
  Bands sum = Bands::Zero();
  this->AddIntegral(receiver, slot, sum);
  return sum;
}

//------------------------------------------------------------------------------
void ScatteringClusters::AddIntegral(vtkIdType receiver, int slot, Bands& sum) const
{
  if (this->Slots.IsPatch(slot))
  {
    sum += this->IntegratePatch(receiver, this->Slots.GetPatch(slot));
    return;
  }
  const Estimate estimate = this->Look(receiver, slot, true);
  if (this->IsFactor(estimate))
  {
    sum += this->Places[slot].Area * estimate.Value;
    return;
  }
  for (int k = this->PieceOffsets[slot]; k < this->PieceOffsets[slot + 1]; ++k)
  {
    this->AddIntegral(receiver, this->Pieces[k], sum);
  }
}

//------------------------------------------------------------------------------
ScatteringClusters::Bands ScatteringClusters::IntegratePatch(vtkIdType receiver,
  vtkIdType patch) const
{
  ScatteringIntegrals::Result result;
  const double area = this->Patches.Areas[receiver];
  if (receiver == patch)
  {
    this->Patches.AddSelf(this->Integrals, patch, this->Factors.PerNeighbour / area, result);
    return result.Value / area;
  }
  const double distance =
    (this->Patches.Centroids[receiver] - this->Patches.Centroids[patch]).norm();
  const double tolerance = this->Patches.GetTolerance(receiver, patch, distance,
    this->Factors.PerArea, this->Factors.PerNeighbour);
  this->Patches.AddPair(this->Integrals, receiver, patch, tolerance, result);
  return result.Value / area;
}

//------------------------------------------------------------------------------
void ScatteringClusters::Describe(vtkDeviceLinkRefiner::Body& body) const
{
  body.NumberOfNodes = this->Slots.GetNumberOfNodes();
  body.Slots.resize(this->Places.size());
  for (int index = 0; index < static_cast<int>(this->Places.size()); ++index)
  {
    const Place& place = this->Places[index];
    vtkDeviceLinkRefiner::Slot& slot = body.Slots[index];
    slot.Center = { place.Center[0], place.Center[1], place.Center[2] };
    slot.Area = place.Area;
    slot.Moment = place.Moment;
    slot.Radius = place.Radius;
    slot.FirstPatch = static_cast<int>(place.First);
    slot.LastPatch = static_cast<int>(place.Last);
    if (!this->Slots.IsPatch(index))
    {
      const LinkSlots::Node children = this->Slots.GetChildren(index);
      slot.FirstChild = children.First;
      slot.LastChild = children.Last;
      slot.FirstPiece = this->PieceOffsets[index];
      slot.LastPiece = this->PieceOffsets[index + 1];
    }
  }
  body.Pieces = this->Pieces;
  body.RelativeTolerance = this->Factors.Relative;
  body.TolerancePerArea = this->Factors.PerArea;
  body.WidestSpread2 = WidestSpread2;
  body.ErrorOfCorrection = ErrorOfCorrection;
  this->Integrals.Describe(body.Profile);
}
} // namespace LightTransport
