// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/LinkCache.h"

#include "Scene/PatchScene.h"
#include "Support/Ranks.h"

#include <algorithm>
#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
bool LinkKey::IsServedBy(const LinkKey& kept) const
{
  if (this->Kind != kept.Kind || this->Parameters != kept.Parameters)
  {
    return false;
  }
  return kept.Senders.empty() ||
    (!this->Senders.empty() &&
      std::equal(this->Senders.begin(), this->Senders.end(), kept.Senders.begin(),
        [](bool now, bool then) { return then || !now; }));
}

//------------------------------------------------------------------------------
bool LinkCache::Fits(const LinkKey& key, const Ranks& ranks) const
{
  const vtkExchange* exchange = this->Kept.GetExchange();
  return exchange && exchange->GetNumberOfParts() == ranks.GetNumber() && key.IsServedBy(this->Key);
}

//------------------------------------------------------------------------------
std::shared_ptr<const PatchArrangement> LinkCache::FindArrangement(const LinkBuilder& builder,
  const Ranks& ranks) const
{
  return this->Kept.Choice && this->Fits(builder.GetKey(), ranks) ? this->Kept.Choice->Arrangement
                                                                  : nullptr;
}

//------------------------------------------------------------------------------
Outcome LinkCache::Update(const PatchScene& scene, const LinkBuilder& builder, const Ranks& ranks,
  const Monitor& monitor)
{
  const LinkKey key = builder.GetKey();
  const bool fits = this->Fits(key, ranks);
  this->Made = !fits || this->Kept.Fingerprint != scene.GetFingerprint();
  if (!this->Made)
  {
    return Outcome::Done();
  }
  Links old = std::move(this->Kept);
  this->Kept = Links();
  Links links;
  links.Fingerprint = scene.GetFingerprint();
  if (fits && old.Choice && scene.GetArrangement() == old.Choice->Arrangement)
  {
    links.Choice = old.Choice;
    if (!links.Choice->HasRows())
    {
      links.Choice->TakeRows(*old.Hierarchy);
    }
  }
  // The old ones go first, since both may not fit into memory.
  old = Links();
  Outcome built = builder.Build(scene, ranks, monitor, links);
  if (built)
  {
    this->Kept = std::move(links);
    this->Key = key;
  }
  return built;
}

//------------------------------------------------------------------------------
void LinkCache::Put(Links&& links)
{
  this->Kept = std::move(links);
  this->Key = LinkKey();
  this->Made = false;
}
} // namespace LightTransport
