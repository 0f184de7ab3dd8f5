// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How wrong sampled links are, from eight groups of their rays: what the links of each group alone,
 * closed like those of all, would change of the irradiance.
 *
 * The groups are parts of one sequence, which is evener than each of them: their spread says more
 * than the error is. GetDeviation takes that into account, by what was measured.
 */
#ifndef RayErrors_h
#define RayErrors_h

#include "Shared/Outcome.h"
#include "ViewFactors/LinkDoubts.h"

#include <cstddef>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;
class RayHits;
struct Links;

class RayErrors : public LinkDoubts
{
public:
  /// The hits that the links come from. All must outlive this.
  RayErrors(const PatchScene& scene, const RayHits& hits, const Links& links, const Ranks& ranks);

  /// Nothing is known of these with its sign.
  Outcome FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
    const std::vector<double>& background, std::vector<double>& differences,
    std::vector<double>& known) const override;

  /// Standard errors, patches x bands, from differences like those above: the variance of a patch
  /// is the mean of its own and that of its neighbours in the tree that face alike, so that some
  /// thirty differences tell it.
  std::vector<double> GetDeviations(const std::vector<double>& differences) const override;

private:
  struct Sums;
  class GroupSums;

  std::vector<double> FindMeans(const std::vector<double>& radiosity, int numberOfBands) const;
  static double GetWhole(std::size_t patch, const Sums& sums);
  double GetRest(std::size_t patch, const Sums& sums) const;
  void SumHits(const std::vector<double>& radiosity, int numberOfBands, Sums& sums) const;
  Outcome Close(const std::vector<double>& radiosity, int numberOfBands, const Sums& sums,
    std::vector<double>& changes, std::vector<double>& received) const;

  const PatchScene& Scene;
  const RayHits& Hits;
  const Links& AllLinks;
  const Ranks& AllRanks;
};
} // namespace LightTransport

#endif
