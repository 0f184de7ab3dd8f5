// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Chooses the links of a vtkExchangeHierarchy over the tree of a scene: from pairs of large
 * clusters down, a pair becomes one link where what that does to the irradiance is small enough,
 * and is divided where it is not.
 *
 * A link stands for the mean of the kernel over both clusters (LinkEstimator), which also tells
 * what the link leaves out. Two patches get their exchange.
 *
 * The measure is the square of the error of the irradiance, integrated over the scene, for a
 * radiosity of 1 everywhere, or for a given one (refinement by brightness). What the links of one
 * cluster leave out often has one sign (all of a floor is nearer to the lower rows of a wall), so
 * the deviations of its quarters are summed over its links first: that is what the sum is then
 * squared of, and clusters where it is more than its parts get finer links in the next pass. Passes
 * end when the error keeps the tolerance (root mean square, relative). What one has found of a pair
 * the next ones, and other refinements of the scene, do not look at again (PairLooks).
 *
 * Sources: P. Hanrahan, D. Salzman, L. Aupperle, A rapid hierarchical radiosity algorithm (1991);
 * F. X. Sillion, A unified hierarchical algorithm for global illumination with scattering volumes
 * and object clusters (1995).
 */
#ifndef LinkRefinement_h
#define LinkRefinement_h

#include "Geometry/ShaftCuller.h"
#include "Links/LinkSlots.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "ViewFactors/LinkEstimator.h"
#include "ViewFactors/PairLooks.h"
#include "ViewFactors/SlotErrors.h"
#include "ViewFactors/UnoccludedPairs.h"
#include "vtkExchangeHierarchy.h"

#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;
class SceneRayCaster;

class LinkRefinement
{
public:
  /// What became of the pairs that the last pass came to.
  struct Counters
  {
    double Links = 0.0;
    double PatchLinks = 0.0; ///< of which between two patches
    double PairsExamined = 0.0;
    double PairsBackFacing = 0.0;
    double PairsUnobstructed = 0.0; ///< nothing reaches into the shaft between them
    double Rays = 0.0;              ///< that this refinement has cast, in all its passes
    double SquaredError = 0.0;      ///< of means and of pairs of patches
    void Add(const Counters& other);
  };

  /// Of the exchange of two patches with nothing in between: sum of the errors of a row.
  static constexpr double OpenTolerance = 1e-4;

  /// `caster` holds the same scene; what `looks` have of it is not looked at again, and they keep
  /// what is. All must outlive this.
  LinkRefinement(const PatchScene& scene, const SceneRayCaster& caster, PairLooks& looks);

  /// A radiosity for each patch (>= 0) that counts instead of 1 everywhere.
  void SetBrightness(const std::vector<double>& brightness);

  /// Whether the scene has openings. The closure of the rows brings in what the links of a cluster
  /// leave out with one sign; with openings a little less of it.
  void SetHasOpenings(bool has) { this->HasOpenings = has; }

  /// The nodes of the scene's tree in the form of vtkExchangeHierarchy.
  std::vector<vtkExchangeHierarchy::Node> GetNodes() const { return this->Slots.GetNodes(); }

  /**
   * Refine until the error estimate keeps `tolerance`, or there is nothing left to divide. This
   * rank's share of the links is then in GetLinks. Fails, on all ranks alike, where links and what
   * is kept of their pairs would take more than `availableBytes`. Collective.
   */
  Outcome Refine(double tolerance, double availableBytes, const Ranks& ranks,
    const Monitor& monitor);

  const std::vector<vtkExchangeHierarchy::Link>& GetLinks() const { return this->Links; }
  /// Of all ranks.
  const Counters& GetCounters() const { return this->Total; }
  /// Root mean square error of the irradiance when rows have been closed, relative to the radiosity
  /// that counts.
  double GetErrorEstimate() const { return this->ErrorEstimate; }
  /// Root mean square error of the row sums, before any closure.
  double GetRowDeviation() const { return this->RowDeviation; }

private:
  using Pair = LinkEstimator::Pair;
  using Estimate = LinkEstimator::Estimate;
  struct Result
  {
    std::vector<vtkExchangeHierarchy::Link> Links;
    Counters Count;
  };
  struct Refiner;

  void MakeUnits();
  Outcome RunPass(double threshold, double availableBytes, const Ranks& ranks,
    const Monitor& monitor);
  Outcome CheckMemory(double availableBytes) const;
  void AddUpRanks(const Ranks& ranks);
  void Assess();

  const PatchScene& Scene;
  const LinkSlots Slots;
  const UnoccludedPairs Open;
  const ShaftCuller Culler;
  LinkEstimator Estimator;
  PairLooks& Looks;
  double BytesBefore = 0.0; ///< of what was kept already
  bool HasOpenings = true;
  std::vector<Pair> Units;
  std::vector<vtkExchangeHierarchy::Link> Links;
  Counters Total;
  SlotErrors Errors; ///< of the links of all ranks
  double ErrorEstimate = 0.0;
  double RowDeviation = 0.0;
  std::vector<double> Shares; ///< of the threshold that a slot's links may use
};
} // namespace LightTransport

#endif
