// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What became of photons that walked: what left through each face, and what share of all left for
 * good, ran through without being scattered, or was lost. In whole numbers of a small unit, so that
 * sums are the same in whichever order photons come, on any number of threads and ranks. A photon
 * weighs 1 where it starts, on average over all photons.
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
    ///@{ faces x bands: what left, and the squares of what each photon did.
    std::vector<double> Left;
    std::vector<double> LeftSquares;
    ///@}
    ///@{ Of each band: what went away for good after scattering, the squares, and the rest.
    std::vector<double> Leaving;
    std::vector<double> LeavingSquares;
    std::vector<double> Unscattered;
    std::vector<double> Lost;
    ///@}
  };

  PhotonTally(const SceneFaces& faces, int bands);

  int GetNumberOfBands() const { return this->Bands; }
  Totals Collect(const Ranks& ranks) const;

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
    LEAVING_SQUARES,
    UNSCATTERED,
    LOST,
    NUMBER_OF_SHARES
  };
  static std::vector<double> Collect(const std::vector<Sum>& sums, const Ranks& ranks);

  const SceneFaces& Faces;
  int Bands;
  std::vector<Sum> Left;
  std::vector<Sum> LeftSquares;
  std::vector<Sum> Shares[NUMBER_OF_SHARES]; ///< of each band
};

class PhotonTally::Listener : public PhotonListener
{
public:
  /// `events`: where it enters and leaves is added there, unless nullptr.
  Listener(PhotonTally& tally, const PhotonSource::Photon& photon,
    std::vector<PhotonRecorder::Event>* events)
    : Tally(tally), Photon(photon), Events(events)
  {
  }

  void Leave(vtkIdType patch, const Eigen::Vector3d& position, const double* weights) override;
  void Escape(bool isScattered, const double* weights) override;
  void Lose(const Eigen::Vector3d& position, const double* weights) override;

private:
  PhotonTally& Tally;
  const PhotonSource::Photon& Photon;
  std::vector<PhotonRecorder::Event>* Events;
};
} // namespace LightTransport

#endif
