// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonTally.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
PhotonTally::PhotonTally(const SceneFaces& faces, int bands)
  : Faces(faces), Bands(bands), Left(faces.GetNumberOfFaces() * bands),
    LeftVariances(faces.GetNumberOfFaces() * bands)
{
  for (std::vector<Sum>& share : this->Shares)
  {
    share = std::vector<Sum>(bands);
  }
}

//------------------------------------------------------------------------------
std::vector<double> PhotonTally::Collect(const std::vector<Sum>& sums, const Ranks& ranks)
{
  // Doubles hold whole photons and what is left of one exactly, and their sums.
  std::vector<double> photons, rest;
  for (const Sum& sum : sums)
  {
    photons.push_back(static_cast<double>(sum.GetUnits() / PhotonUnits::PerPhoton));
    rest.push_back(
      static_cast<double>(sum.GetUnits() % PhotonUnits::PerPhoton) / PhotonUnits::PerPhoton);
  }
  ranks.Sum(photons);
  ranks.Sum(rest);
  for (std::size_t k = 0; k < photons.size(); ++k)
  {
    photons[k] += rest[k];
  }
  return photons;
}

//------------------------------------------------------------------------------
PhotonTally::Totals PhotonTally::Collect(const Ranks& ranks) const
{
  return { Collect(this->Left, ranks), Collect(this->LeftVariances, ranks),
    Collect(this->Shares[LEAVING], ranks), Collect(this->Shares[LEAVING_VARIANCES], ranks),
    Collect(this->Shares[UNSCATTERED], ranks), Collect(this->Shares[LOST], ranks),
    Collect(this->Shares[WEIGHT_SQUARES], ranks) };
}

//------------------------------------------------------------------------------
void PhotonTally::Pair::AddExit(vtkIdType face, const double* weights)
{
  auto exit = std::find_if(this->Exits.begin(), this->Exits.end(),
    [face](const Exit& other) { return other.Face == face; });
  if (exit == this->Exits.end())
  {
    exit = this->Exits.insert(exit, { face, {} });
  }
  for (int band = 0; band < this->Tally.Bands; ++band)
  {
    exit->Weights[band] += this->Sign * weights[band];
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Pair::AddLeaving(const double* weights)
{
  for (int band = 0; band < this->Tally.Bands; ++band)
  {
    this->Leaving[band] += this->Sign * weights[band];
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Pair::End()
{
  this->Sign = -this->Sign;
  if (this->Sign > 0.0)
  {
    this->Close();
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Pair::Close()
{
  const int bands = this->Tally.Bands;
  for (int band = 0; band < bands; ++band)
  {
    for (const Exit& exit : this->Exits)
    {
      this->Tally.LeftVariances[exit.Face * bands + band].Add(
        exit.Weights[band] * exit.Weights[band]);
    }
    this->Tally.Shares[LEAVING_VARIANCES][band].Add(this->Leaving[band] * this->Leaving[band]);
    this->Leaving[band] = 0.0;
  }
  this->Exits.clear();
  this->Sign = 1.0;
}

//------------------------------------------------------------------------------
void PhotonTally::Listener::Leave(vtkIdType patch, const Eigen::Vector3d&, const double* weights)
{
  const int bands = this->Tally.Bands;
  const vtkIdType face = this->Tally.Faces.GetFace(patch);
  PhotonRecorder::Event event{ this->Photon.Start.Patch, patch, {} };
  for (int band = 0; band < bands; ++band)
  {
    const double weight = weights[band] * this->Photon.Scales[band];
    this->Tally.Left[face * bands + band].Add(weight);
    this->Tally.Shares[WEIGHT_SQUARES][band].Add(weight * weight);
    event.Weights[band] = weight;
  }
  this->InPair.AddExit(face, event.Weights);
  if (this->Events)
  {
    this->Events->push_back(event);
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Listener::Escape(bool isScattered, const double* weights)
{
  double scaled[MostPhotonBands] = {};
  for (int band = 0; band < this->Tally.Bands; ++band)
  {
    scaled[band] = weights[band] * this->Photon.Scales[band];
    this->Tally.Shares[isScattered ? LEAVING : UNSCATTERED][band].Add(scaled[band]);
  }
  if (isScattered)
  {
    this->InPair.AddLeaving(scaled);
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Listener::Lose(const Eigen::Vector3d&, const double* weights)
{
  for (int band = 0; band < this->Tally.Bands; ++band)
  {
    this->Tally.Shares[LOST][band].Add(weights[band] * this->Photon.Scales[band]);
  }
}
} // namespace LightTransport
