// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What patches see that is no front of another patch: the sky, where a ray leaves the scene, and
 * back faces. Two columns more of each row of the view factors, integrated by rays around the
 * normal (PatchOutlook), twice as many each time until their error is small enough; the same rays
 * for the same scene. The ranks share the patches.
 */
#ifndef Openings_h
#define Openings_h

#include "vtkType.h"

#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;
class SceneRayCaster;
struct Links;

class Openings
{
public:
  /// How many standard deviations an error of rays is: they cover it in more than 99 % of all
  /// patches.
  static constexpr double Confidence = 3.0;

  /// `caster` holds the same scene. Both must outlive this.
  Openings(const PatchScene& scene, const SceneRayCaster& caster) : Scene(scene), Caster(caster) {}

  /// Whether the scene has any, by 128 rays from up to some 2,000 patches.
  bool Exist() const;

  ///@{
  /**
   * Set the sky and back face fractions of `links`, their errors, and how often patches were met by
   * rays of others; add the summary "RaysCast". Both are collective.
   *
   * What a row misses and what rays find are combined by their variances, and rays divide it, until
   * the errors keep the `tolerance`. A row that misses no more than its error, and where the first
   * rays find nothing, has no opening; what a row misses and rays cannot find is none. The summary
   * "RowGap" is by how much the two differ at most, beyond the error of the sum and twice that of
   * the rays (which single rows of many exceed). No patch casts more than GetMostRays(tolerance).
   *
   * Complete is for rows whose sums are known to their RowErrors. Returns the error of what is open
   * in each row, whichever way it divides.
   *
   * CompleteClusters is for rows of which one deviation is known for all (root mean square); 0.7
   * times the tolerance is then the deviation of the fractions, which their errors are, too.
   */
  std::vector<double> Complete(double tolerance, const Ranks& ranks, Links& links) const;
  void CompleteClusters(double tolerance, double deviation, const Ranks& ranks, Links& links) const;
  ///@}

  /// The same by the first rays alone, where rows are not whole. Collective.
  void Survey(const Ranks& ranks, Links& links) const;

  /// The work that a tolerance is worth: 100 rays over it, 32,768 at most.
  static int GetMostRays(double tolerance);

  /// No row sees an opening, or nothing is known of any.
  static void Clear(Links& links);

  /// Likewise without rays in a scene that has none: the same summaries, with the error of each row
  /// sum.
  static void Skip(const std::vector<double>& errors, Links& links);

private:
  struct Row;
  struct Settings
  {
    int MostRays;
    double Deviation; ///< that is small enough
    double Confidence;
  };
  template <typename Judge, typename Fewest>
  std::vector<double> CastRays(const Settings& settings, const Ranks& ranks, Links& links,
    const Judge& judge, const Fewest& fewest) const;

  const PatchScene& Scene;
  const SceneRayCaster& Caster;
};
} // namespace LightTransport

#endif
