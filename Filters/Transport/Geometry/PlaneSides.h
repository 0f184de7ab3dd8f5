// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// On which sides of a plane a scene is. Patches that have all of it on one side come between no
/// two points of it.
#ifndef PlaneSides_h
#define PlaneSides_h

#include "Scene/PatchPlane.h"

namespace LightTransport
{
class PatchScene;

/// Whether anything is certainly behind a plane. (In front of it: behind it turned round.)
bool IsAnyBehind(const PatchScene& scene, const PatchPlane& plane);
} // namespace LightTransport

#endif
