// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The patches of a scene as devices that shoot take them.
#ifndef ShotPatches_h
#define ShotPatches_h

#include "vtkDeviceShooter.h"

namespace LightTransport
{
class PatchScene;

vtkDeviceShooter::Patches DescribePatches(const PatchScene& scene);
} // namespace LightTransport

#endif
