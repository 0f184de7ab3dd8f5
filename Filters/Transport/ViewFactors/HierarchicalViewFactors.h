// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// View factors between clusters of patches, in an exchange hierarchy (LinkRefinement). Rows are
/// always closed: with what they see of the sky and of back faces they sum to 1.
#ifndef HierarchicalViewFactors_h
#define HierarchicalViewFactors_h

#include "Links/LinkBuilder.h"
#include "ViewFactors/PairLooks.h"

#include <memory>
#include <vector>

namespace LightTransport
{
class HierarchicalViewFactors : public LinkBuilder
{
public:
  /// `brightness` is a radiosity for each patch to refine the links for, empty for one that is the
  /// same everywhere. The clusters are nodes of the scene's tree. What links of the same scene have
  /// found is taken from `looks`, which keep what these find, unless that is much.
  explicit HierarchicalViewFactors(double tolerance, std::vector<double> brightness = {},
    std::shared_ptr<PairLooks> looks = std::make_shared<PairLooks>());

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

private:
  double Tolerance;
  std::vector<double> Brightness;
  std::shared_ptr<PairLooks> Looks;
};
} // namespace LightTransport

#endif
