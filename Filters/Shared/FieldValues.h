// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Numbers and texts that summarise a run, as arrays of one tuple in field data or as columns of a
/// table with one row. A vtkTable's row data are field data too.
#ifndef FieldValues_h
#define FieldValues_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <initializer_list>
#include <string>

namespace LightTransport
{
namespace FieldValues
{
//------------------------------------------------------------------------------
/// An array of one tuple with the components of `values`.
inline void Add(vtkFieldData* fields, const char* name, const double* values, int components)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->InsertNextTuple(values);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
inline void Add(vtkFieldData* fields, const char* name, double value)
{
  Add(fields, name, &value, 1);
}

//------------------------------------------------------------------------------
inline void Add(vtkFieldData* fields, const char* name, const std::string& value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
/// An array of this type, of one tuple with the components of `values`.
template <typename Array>
void AddAs(vtkFieldData* fields, const char* name,
  std::initializer_list<typename Array::ValueType> values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(values.size()));
  array->InsertNextTypedTuple(values.begin());
  fields->AddArray(array);
}
} // namespace FieldValues
} // namespace LightTransport

#endif
