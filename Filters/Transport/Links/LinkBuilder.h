// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What fills links: view factors for all pairs (DenseViewFactors) or between clusters
 * (HierarchicalViewFactors), and subsurface scattering (ScatteringLinks). Filters ask for links
 * through a LinkCache and know no more of how they are made.
 */
#ifndef LinkBuilder_h
#define LinkBuilder_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <string>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;
struct Links;

/// What links depend on beside the geometry of the scene.
struct LinkKey
{
  std::string Kind; ///< of the builder
  std::vector<double> Parameters;
  std::vector<bool> Senders; ///< patches that send anything; empty: all of them

  /// Whether links that were made for `kept` do for this: the same, and all who send now were known
  /// to send.
  bool IsServedBy(const LinkKey& kept) const;
};

class LinkBuilder
{
public:
  virtual ~LinkBuilder() = default;

  virtual LinkKey GetKey() const = 0;

  /// Make the links of a scene; `links` is empty before, but for a choice that was made for its
  /// patches elsewhere: where that does not hold any more, no links are made. Collective: the
  /// outcome is the same on all ranks.
  virtual Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const = 0;
};
} // namespace LightTransport

#endif
