// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Arrays of zeros whose memory is not asked for through VTK: SetNumberOfTuples of some of its
/// builds ends the process where there is none.
#ifndef ZeroedArray_h
#define ZeroedArray_h

#include "vtkDataArray.h"

#include <algorithm>
#include <cstdlib>
#include <new>

namespace LightTransport
{
namespace ZeroedArray
{
/// Give an array of numbers, which has its components already, so many tuples of zeros. Throws
/// std::bad_alloc.
inline void Fill(vtkDataArray* array, vtkIdType tuples)
{
  const vtkIdType values = tuples * array->GetNumberOfComponents();
  void* memory =
    std::calloc(static_cast<std::size_t>(std::max<vtkIdType>(values, 1)), array->GetDataTypeSize());
  if (!memory)
  {
    throw std::bad_alloc();
  }
  array->SetVoidArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_FREE);
}
} // namespace ZeroedArray
} // namespace LightTransport

#endif
