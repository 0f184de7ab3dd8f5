// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Surfaces as people's disks hold them, and worse, with arrays that fit or do not.
#ifndef AnySurface_h
#define AnySurface_h

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace LightTransportFuzz
{
class Choices;

/// A vtkPolyData, or (where `composite`, now and then) a vtkMultiBlockDataSet of up to three.
vtkSmartPointer<vtkDataObject> MakeAnyInput(Choices& choices, bool composite);
} // namespace LightTransportFuzz

#endif
