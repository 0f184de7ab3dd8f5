// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The data sets of a data object that have patches, and where these are: the polygons of a
/// surface, the points of a texel image.
#ifndef Leaves_h
#define Leaves_h

#include "vtkType.h"

#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkDataSetAttributes;
class vtkPolyData;

namespace LightTransport
{
namespace Leaves
{
/// The leaves of composite data that are not empty, or the data object itself, in a fixed order.
/// Leaves of other types than polygonal data and images come as nullptr.
std::vector<vtkDataSet*> Get(vtkDataObject* object);

/// A number of each leaf that is the same on all ranks.
std::vector<vtkIdType> GetNumbers(vtkDataObject* object);

/// The arrays that patches have: those of cells, in an image those of points.
vtkDataSetAttributes* GetPatchData(vtkDataSet* leaf);

/// The cell that the first polygon is: vertices and lines come before.
vtkIdType GetFirstPolygonCell(vtkPolyData* data);
} // namespace Leaves
} // namespace LightTransport

#endif
