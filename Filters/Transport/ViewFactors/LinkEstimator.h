// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One link between two slots: the mean of the kernel cos cos visible / (pi r^2) over both, and what
 * the link leaves out of the irradiance, from the same samples: a few points on either cluster, all
 * pairs of them, with a ray for each where anything may stand between the clusters. How the means
 * of rows and of columns differ is how the irradiance varies over the receiver, in both directions;
 * with geometry and visibility in one number a shadow's edge is refined as far as its light is
 * worth. Two patches get their exchange (PatchPairs).
 *
 * Errors are squares of the error of the irradiance, integrated over the receiver, for a radiosity
 * of 1 everywhere, or for a given one.
 */
#ifndef LinkEstimator_h
#define LinkEstimator_h

#include "Links/LinkSlots.h"
#include "Scene/PatchScene.h"
#include "ViewFactors/ClusterSampler.h"
#include "ViewFactors/PatchPairs.h"

#include <vector>

namespace LightTransport
{
class PairVisibility;
class SceneRayCaster;
class ShaftCuller;
class UnoccludedPairs;

class LinkEstimator
{
public:
  struct Pair
  {
    int I, J;    ///< slots
    bool IsFree; ///< nothing can be between them
  };

  struct Estimate
  {
    static constexpr int Points = ClusterSampler::Points;

    double Value = 0.0;  ///< mean of the kernel
    double ErrorI = 0.0; ///< squared error of the irradiance of I, integrated over I
    double ErrorJ = 0.0;
    double Mean = 0.0;               ///< of which what the mean itself may be off
    double DeviationsI[Points] = {}; ///< of the irradiance of the quarters of I
    double DeviationsJ[Points] = {};
  };

  /// What is found of two slots, whatever their link is for: means of the kernel over pairs of
  /// points.
  struct View
  {
    float Rows[Estimate::Points];
    float Columns[Estimate::Points];
    float Open;    ///< as if nothing were between
    float Highest; ///< a bound of the kernel
  };

  /// `caster` holds the same scene. All must outlive this.
  LinkEstimator(const PatchScene& scene, const LinkSlots& slots, const SceneRayCaster& caster,
    const UnoccludedPairs& open, const ShaftCuller& culler);

  /// The radiosity of each patch (>= 0) that counts.
  void SetBrightness(const std::vector<double>& brightness);
  /// Its square relative to the largest one, integrated over the scene.
  double GetSquaredBrightness() const { return this->SquaredBrightness; }

  ///@{ Two slots that are not both patches. The kernel is at most `highest`; adds to `rays`.
  View Look(const Pair& pair, double highest, double& rays) const;
  Estimate Weigh(const Pair& pair, const View& view) const;
  ///@}

  ///@{ Two patches; how much of the exchange is visible as well as an error below `threshold`
  /// needs.
  PatchPairs::View LookAtPatches(const Pair& pair, PairVisibility& visibility) const;
  Estimate WeighPatches(const Pair& pair, double threshold, PairVisibility& visibility,
    PatchPairs::View& view) const;
  ///@}

private:
  static constexpr int Points = ClusterSampler::Points;

  double GetKernel(const ClusterSampler::Sample& a, const ClusterSampler::Sample& b) const;

  const PatchScene& Scene;
  const LinkSlots& Slots;
  const SceneRayCaster& Caster;
  const PatchPairs Pairs;
  ClusterSampler Sampler;
  std::vector<double> Brightness; ///< of each slot, at most 1
  double SquaredBrightness = 0.0;
};
} // namespace LightTransport

#endif
