// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/PhotonTally.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
PhotonTally::PhotonTally(const SceneFaces& faces, int bands)
  : Faces(faces), Bands(bands), Left(faces.GetNumberOfFaces() * bands),
    LeftSquares(faces.GetNumberOfFaces() * bands)
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
  return { Collect(this->Left, ranks), Collect(this->LeftSquares, ranks),
    Collect(this->Shares[LEAVING], ranks), Collect(this->Shares[LEAVING_SQUARES], ranks),
    Collect(this->Shares[UNSCATTERED], ranks), Collect(this->Shares[LOST], ranks) };
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
    this->Tally.LeftSquares[face * bands + band].Add(weight * weight);
    event.Weights[band] = weight;
  }
  if (this->Events)
  {
    this->Events->push_back(event);
  }
}

//------------------------------------------------------------------------------
void PhotonTally::Listener::Escape(bool isScattered, const double* weights)
{
  for (int band = 0; band < this->Tally.Bands; ++band)
  {
    const double weight = weights[band] * this->Photon.Scales[band];
    this->Tally.Shares[isScattered ? LEAVING : UNSCATTERED][band].Add(weight);
    if (isScattered)
    {
      this->Tally.Shares[LEAVING_SQUARES][band].Add(weight * weight);
    }
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
