// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The repair of a surface from its first step to its last, as the properties of vtkPatchMesher ask
/// for it.
#ifndef SurfaceRepair_h
#define SurfaceRepair_h

#include "Common/TriangleSoup.h"
#include "Mesher/RepairCounts.h"
#include "Shared/Monitor.h"
#include "Shared/Outcome.h"

namespace LightTransport
{
namespace SurfaceRepair
{
/// What becomes of a surface that intersects itself.
enum class Intersections
{
  Resolve,
  Refuse,
  Keep
};

struct Settings
{
  /// Whether defects are repaired, or refused.
  bool Repair;
  bool FillHoles;
  /// The size of the holes to fill and of the crumbs to drop; 0 for a part of the surface's size.
  double HoleSize;
  Intersections SelfIntersections;
};

/// The size that is used: `wanted`, or the default for a soup.
double ChooseHoleSize(double wanted, const TriangleSoup& soup);

/// Make a soup an oriented manifold that does not intersect itself, or fail with what is in the
/// way.
Outcome Run(const Settings& settings, const Monitor& monitor, TriangleSoup& soup,
  RepairCounts& counts);
} // namespace SurfaceRepair
} // namespace LightTransport

#endif
