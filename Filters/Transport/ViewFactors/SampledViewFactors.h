// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors between patches from rays, in an exchange hierarchy whose links all join patches:
 * rows of counts, those of both directions together by how densely either patch casts rays
 * (RayCounts), and the exact rows of a few patches that send most of the light. Rows are always
 * closed: with what they see of the sky and of back faces they sum to 1.
 */
#ifndef SampledViewFactors_h
#define SampledViewFactors_h

#include "Links/LinkBuilder.h"
#include "ViewFactors/SamplingPlan.h"

#include <memory>

namespace LightTransport
{
class RayCounts;
struct RaySamples;

class SampledViewFactors : public LinkBuilder
{
public:
  /// Rays that `samples` have already are not cast again, nor are rows integrated again.
  SampledViewFactors(SamplingPlan plan, std::shared_ptr<RaySamples> samples);

  /// The rays that a LinkTolerance asks for.
  static int GetRaysFor(double tolerance);

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

private:
  Outcome Gather(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor) const;
  Outcome Count(RayCounts& counts, const Ranks& ranks, Links& links) const;
  Outcome Close(const RayCounts& counts, const Ranks& ranks, Links& links) const;
  void Summarize(const Ranks& ranks, Links& links) const;

  SamplingPlan Plan;
  std::shared_ptr<RaySamples> Samples;
};
} // namespace LightTransport

#endif
