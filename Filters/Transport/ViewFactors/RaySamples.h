// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What sampled links are made of, kept for links of more rays, or of the same rays and other exact
/// rows.
#ifndef RaySamples_h
#define RaySamples_h

#include "ViewFactors/BrightRows.h"
#include "ViewFactors/RayHits.h"

namespace LightTransport
{
struct RaySamples
{
  RayHits Hits;
  BrightRows Exact;
};
} // namespace LightTransport

#endif
