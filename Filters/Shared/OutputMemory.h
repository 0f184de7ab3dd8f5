// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Room for outputs that VTK fills cell by cell and tuple by tuple. Some of its builds end the
/// process where they get no memory, so that all of it is asked for before. Everything here throws
/// std::bad_alloc where it is not there.
#ifndef OutputMemory_h
#define OutputMemory_h

#include "Shared/TransportMemory.h"
#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkDataSetAttributes.h"

namespace LightTransport
{
namespace OutputMemory
{
/// Bytes of one tuple of all arrays.
inline double GetBytesPerTuple(vtkFieldData* data)
{
  double bytes = 0.0;
  for (int index = 0; index < data->GetNumberOfArrays(); ++index)
  {
    const vtkAbstractArray* array = data->GetAbstractArray(index);
    bytes += static_cast<double>(array->GetNumberOfComponents()) * array->GetElementComponentSize();
  }
  return bytes;
}

/// Room for so many cells, which have so many corners together.
inline void Allocate(vtkIdType numberOfCells, vtkIdType numberOfCorners, vtkCellArray* cells)
{
  TransportMemory::Require(static_cast<double>(sizeof(vtkIdType)) *
    static_cast<double>(numberOfCells + 1 + numberOfCorners));
  cells->AllocateExact(numberOfCells, numberOfCorners);
}

/// Room for so many copies of tuples of `from`.
inline void AllocateCopies(vtkDataSetAttributes* from, vtkIdType tuples, vtkDataSetAttributes* to)
{
  TransportMemory::Require(GetBytesPerTuple(from) * static_cast<double>(tuples));
  to->CopyAllocate(from, tuples);
}

/// Room for so many means of tuples of `from`.
inline void AllocateMeans(vtkDataSetAttributes* from, vtkIdType tuples, vtkDataSetAttributes* to)
{
  TransportMemory::Require(GetBytesPerTuple(from) * static_cast<double>(tuples));
  to->InterpolateAllocate(from, tuples);
}
} // namespace OutputMemory
} // namespace LightTransport

#endif
