// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What became of photons that walked: what left through each face, and what share of all left for
 * good, ran through without being scattered, or was lost. In whole numbers of a small unit, so that
 * sums are the same in whichever order photons come, on any number of threads and ranks. A photon
 * weighs 1 where it starts, on average over all photons.
 *
 * Photons start evenly spread, one in each of many equal parts of the light, so that how much
 * enters each patch is not left to chance. Variances are those of the differences between photons
 * of neighbouring parts: squares of what each photon did would count as chance what they have in
 * common, in large bodies that absorb little several times as much as the rest.
 */
#ifndef PhotonTally_h
#define PhotonTally_h

#include "Photons/PhotonListener.h"
#include "Photons/PhotonRecorder.h"
#include "Photons/PhotonSource.h"
#include "Photons/PhotonUnits.h"
#include "Scene/SceneFaces.h"
#include "Support/Ranks.h"

#include <atomic>
#include <cstdint>
#include <vector>

namespace LightTransport
{
class PhotonTally
{
public:
  /// Sums of all ranks.
  struct Totals
  {
    ///@{ faces x bands: what left, and its variance.
    std::vector<double> Left;
    std::vector<double> LeftVariances;
    ///@}
    ///@{ Of each band: what went away for good after scattering, its variance, and the rest; and
    /// the
    /// squares of all weights that left.
    std::vector<double> Leaving;
    std::vector<double> LeavingVariances;
    std::vector<double> Unscattered;
    std::vector<double> Lost;
    std::vector<double> WeightSquares;
    ///@}
  };

  PhotonTally(const SceneFaces& faces, int bands);

  int GetNumberOfBands() const { return this->Bands; }
  Totals Collect(const Ranks& ranks) const;

  class Pair;
  /// Takes what becomes of one photon.
  class Listener;

private:
  /// A number that many threads add to.
  class Sum
  {
  public:
    void Add(double value)
    {
      this->Units.fetch_add(PhotonUnits::Count(value), std::memory_order_relaxed);
    }
    std::int64_t GetUnits() const { return this->Units.load(std::memory_order_relaxed); }

  private:
    std::atomic<std::int64_t> Units{ 0 };
  };

  enum Share
  {
    LEAVING,
    LEAVING_VARIANCES,
    UNSCATTERED,
    LOST,
    WEIGHT_SQUARES,
    NUMBER_OF_SHARES
  };
  static std::vector<double> Collect(const std::vector<Sum>& sums, const Ranks& ranks);

  const SceneFaces& Faces;
  int Bands;
  std::vector<Sum> Left;
  std::vector<Sum> LeftVariances;
  std::vector<Sum> Shares[NUMBER_OF_SHARES]; ///< of each band
};

/// Two photons that start next to each other, and what one did minus what the other did.
class PhotonTally::Pair
{
public:
  explicit Pair(PhotonTally& tally) : Tally(tally) {}

  ///@{ Of the photon that walks.
  void AddExit(vtkIdType face, const double* weights);
  void AddLeaving(const double* weights);
  ///@}
  /// The photon has ended. Adds to the tally after the second one.
  void End();
  /// No second one will come.
  void Close();

private:
  struct Exit
  {
    vtkIdType Face;
    double Weights[MostPhotonBands];
  };

  PhotonTally& Tally;
  double Sign = 1.0;
  std::vector<Exit> Exits; ///< one for each face
  double Leaving[MostPhotonBands] = {};
};

class PhotonTally::Listener : public PhotonListener
{
public:
  /// `events`: where it enters and leaves is added there, unless nullptr.
  Listener(PhotonTally& tally, const PhotonSource::Photon& photon, Pair& pair,
    std::vector<PhotonRecorder::Event>* events)
    : Tally(tally), Photon(photon), InPair(pair), Events(events)
  {
  }

  void Leave(vtkIdType patch, const Eigen::Vector3d& position, const double* weights) override;
  void Escape(bool isScattered, const double* weights) override;
  void Lose(const Eigen::Vector3d& position, const double* weights) override;

private:
  PhotonTally& Tally;
  const PhotonSource::Photon& Photon;
  Pair& InPair;
  std::vector<PhotonRecorder::Event>* Events;
};
} // namespace LightTransport

#endif
