// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What sampled links are made of, kept for links of more rays, or of the same rays and other exact
/// rows.
#ifndef RaySamples_h
#define RaySamples_h

#include "ViewFactors/BrightRows.h"
#include "ViewFactors/RayHits.h"

#include <memory>

namespace LightTransport
{
struct RaySamples
{
  RayHits Hits;
  BrightRows Exact;
  std::weak_ptr<PatchRays> Rays; ///< of a scene that is there for several looks; else empty
};
} // namespace LightTransport

#endif
