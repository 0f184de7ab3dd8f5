// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// On which sides of a plane a scene is. Patches that have all of it on one side come between no
/// two points of it.
#ifndef PlaneSides_h
#define PlaneSides_h

#include "Scene/PatchPlane.h"

#include <vector>

namespace LightTransport
{
class PatchScene;

/// Whether anything is certainly behind a plane.
bool IsAnyBehind(const PatchScene& scene, const PatchPlane& plane);

/// Of each patch, whether anything is certainly in front of it: of none where the scene is one
/// convex body.
std::vector<bool> FindHollows(const PatchScene& scene);
} // namespace LightTransport

#endif
