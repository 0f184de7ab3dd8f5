// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether a scene is the surface of bodies: without holes, and with the fronts of its patches
 * outside. Each edge must be passed as often in one direction as in the other; edges that are one
 * line cut at different points (a wall meshed differently on both sides of it) are compared piece
 * by piece. Cavities and several bodies are closed, too; a sheet of two sides has no inside.
 */
#ifndef ClosedSurface_h
#define ClosedSurface_h

#include "Shared/Outcome.h"

namespace LightTransport
{
class PatchScene;

namespace ClosedSurface
{
/// Fails with the place of a hole, or of a part that is inside out or has no inside.
Outcome Check(const PatchScene& scene);
} // namespace ClosedSurface
} // namespace LightTransport

#endif
