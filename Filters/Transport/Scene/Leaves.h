// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The polygonal data sets of a data object, and where their polygons are.
#ifndef Leaves_h
#define Leaves_h

#include "vtkType.h"

#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace LightTransport
{
namespace Leaves
{
/// The leaves of composite data that are not empty, or the data object itself, in a fixed order.
/// Leaves of other types come as nullptr.
std::vector<vtkPolyData*> Get(vtkDataObject* object);

/// A number of each leaf that is the same on all ranks.
std::vector<vtkIdType> GetNumbers(vtkDataObject* object);

/// The cell that the first polygon is: vertices and lines come before.
vtkIdType GetFirstPolygonCell(vtkPolyData* data);
} // namespace Leaves
} // namespace LightTransport

#endif
