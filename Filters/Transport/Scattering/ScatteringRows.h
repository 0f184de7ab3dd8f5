// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Fills the rows of a vtkExchangeHierarchy with the profiles' means over the clusters that
/// ScatteringRefinement has chosen for each receiver, on the CPU or with what a device has found,
/// and tells how much goes through air.
#ifndef ScatteringRows_h
#define ScatteringRows_h

#include "Links/LinksThroughAir.h"
#include "Scattering/ScatteringClusters.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <vector>

class vtkExchangeHierarchy;

namespace LightTransport
{
class AirGaps;
class Ranks;
class RefinementOnDevice;
class ScatteringRefinement;

class ScatteringRows
{
public:
  /// All must outlive this.
  ScatteringRows(const ScatteringRefinement& chosen, const ScatteringProfiles& profiles,
    const AirGaps& gaps);

  struct Summary
  {
    double Links = 0.0;
    double LeftOut = 0.0;
    double Reused = 0.0; ///< from clusters of the choice that is kept
    /// Of links that were looked at, each between the receiver and a patch of the cluster.
    LinksThroughAir ThroughAir;
  };

  /// This rank's rows. The counts are those of all ranks, what goes
  /// through air that of this one. `device` looks for the receivers where there is one, which one
  /// rank alone may have.
  Outcome Fill(const Ranks& ranks, const Monitor& monitor, RefinementOnDevice* device,
    vtkExchangeHierarchy* exchange, Summary& summary) const;

  /// Whether a rank fills the row of a patch.
  static bool IsOfRank(vtkIdType patch, const Ranks& ranks);

private:
  static constexpr int Bands = ScatteringIntegrals::NumberOfBands;
  /// A link through air that was looked at: who sends, and how much for a unit of light.
  struct AirLink
  {
    vtkIdType Sender;
    ScatteringClusters::Bands Value;
  };
  /// The rows of some receivers, one after another.
  struct Block
  {
    std::vector<int> Counts;
    std::vector<int> Columns;
    std::vector<float> Values;
    double LeftOut = 0.0;
    double Reused = 0.0;
    std::vector<AirLink> ThroughAir;
  };
  struct Filler;

  static Outcome FillAll(vtkIdType blocks, const Filler& filler, const Monitor& monitor);
  Outcome FillFromDevice(RefinementOnDevice& device, const Filler& filler,
    const Monitor& monitor) const;
  double GetAirSample() const;
  void SumUpAir(const std::vector<Block>& blocks, LinksThroughAir& sums) const;
  Outcome Store(const std::vector<Block>& blocks, int mine, int ranks,
    vtkExchangeHierarchy* exchange) const;

  const ScatteringRefinement& Chosen;
  const ScatteringClusters& Clusters;
  const std::vector<double>& Areas;
  const ScatteringProfiles& Profiles;
  const AirGaps& Gaps;
  ScatteringIntegrals::Bands Totals = ScatteringIntegrals::Bands::Zero();
};
} // namespace LightTransport

#endif
