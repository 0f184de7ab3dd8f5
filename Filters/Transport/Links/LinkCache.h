// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Keeps the links that were made last, for as long as they serve.
#ifndef LinkCache_h
#define LinkCache_h

#include "Links/LinkBuilder.h"
#include "Links/Links.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

#include <memory>

namespace LightTransport
{
class PatchScene;
class Ranks;

class LinkCache
{
public:
  /// Bring the links up to date for a scene: made by `builder` unless those that are kept are of
  /// the same scene, as many ranks, and a key that serves the builder's. Where the scene is
  /// arranged as these were (FindArrangement) the builder may keep what they chose; none are made,
  /// and none are kept, where that does not hold: the scene is to be arranged anew then. After a
  /// failure or an abort none are kept. Collective.
  Outcome Update(const PatchScene& scene, const LinkBuilder& builder, const Ranks& ranks,
    const Monitor& monitor);

  /// How patches have to be arranged for what `builder` may keep of their links when they have
  /// moved; nullptr where it can keep nothing.
  std::shared_ptr<const PatchArrangement> FindArrangement(const LinkBuilder& builder,
    const Ranks& ranks) const;

  /// Keep links that come from elsewhere, until the next Update or Put.
  void Put(Links&& links);

  const Links& Get() const { return this->Kept; }
  /// What the kept links were made for.
  const LinkKey& GetKey() const { return this->Key; }
  /// Whether the last Update made them.
  bool WereMade() const { return this->Made; }

private:
  bool Fits(const LinkKey& key, const Ranks& ranks) const;

  Links Kept;
  LinkKey Key;
  bool Made = false;
};
} // namespace LightTransport

#endif
