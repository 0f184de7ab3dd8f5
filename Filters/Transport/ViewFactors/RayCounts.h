// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How often rays of the patches of this rank have met which other patches, the sky and back faces,
 * and the links that follow: of two patches with areas A and N rays
 * G_ij = (c_ij + c_ji) / (N_i / A_i + N_j / A_j), the mean of what both directions say by their
 * densities of rays. Pairs that are known exactly (BrightRows) are taken from there. They and those
 * of patches that cast more rays than others stand apart: what is closed is the rest.
 */
#ifndef RayCounts_h
#define RayCounts_h

#include "Links/RayNumbers.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkExchangeHierarchy;

namespace LightTransport
{
class BrightRows;
class PatchScene;
class Ranks;
class RayHits;
struct Links;

class RayCounts
{
public:
  explicit RayCounts(const PatchScene& scene) : Scene(scene) {}

  /// Count the first rays of each patch, as many as `links` are of; what becomes of openings goes
  /// there. Collective.
  void Count(const RayHits& hits, const BrightRows& exact, const Ranks& ranks, Links& links);

  /// Of each patch: the part of its rays that meets others whose links do not stand apart.
  const std::vector<double>& GetSampledShares() const { return this->SampledShares; }
  ///@{ Links that stand apart: whether there are any, and what they add to each sum of a row's view
  /// factors.
  bool HaveApart() const { return !this->SumsApart.empty(); }
  const std::vector<double>& GetSumsApart() const { return this->SumsApart; }
  ///@}

  /// What this rank's rays, and what it has of exact rows, add to the rows of a hierarchy over the
  /// scene's tree, whose patches have these weights; without weights links that stand apart are 0,
  /// and weights are areas. Fails where there is no memory. Collective.
  Outcome Store(const BrightRows& exact, const std::vector<double>& weights, const Ranks& ranks,
    vtkExchangeHierarchy* hierarchy) const;

private:
  /// Rows of patches met, and how often.
  struct Rows
  {
    std::vector<std::int64_t> Offsets;
    std::vector<int> Columns; ///< ascending in each row
    std::vector<int> Counts;
    std::vector<int> Behind; ///< patches whose backs rays of any row have met

    std::int64_t GetSize() const { return static_cast<std::int64_t>(this->Columns.size()); }
    Rows Transpose() const;
  };
  struct Counter;
  struct Merger;

  void SumApart(const BrightRows& exact, const Ranks& ranks);

  const PatchScene& Scene;
  RayNumbers Rays;
  Rows Met;
  std::vector<double> SampledShares;
  std::vector<double> SumsApart; ///< empty: none
};
} // namespace LightTransport

#endif
