// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/MappedArrays.h"

#include "Passes/PlainMapper.h"
#include "Passes/RadianceShader.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkRenderState.h"

#include <iterator>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
/// Of the array that a mapper can hand to its shaders; 0 when it can hand none.
int FindComponents(vtkPolyDataMapper* mapper, const std::string& arrayName)
{
  if (!FindPlainMapper(mapper))
  {
    return 0;
  }
  mapper->Update();
  vtkPolyData* input = mapper->GetInput();
  vtkDataArray* array = input ? input->GetPointData()->GetArray(arrayName.c_str()) : nullptr;
  const int components = array ? array->GetNumberOfComponents() : 0;
  return components == 1 || components == 3 || components == 4 ? components : 0;
}
} // namespace

//------------------------------------------------------------------------------
void MappedArrays::ForgetDeadMappers()
{
  for (auto entry = this->Drawings.begin(); entry != this->Drawings.end();)
  {
    entry = entry->second.Mapper ? std::next(entry) : this->Drawings.erase(entry);
  }
}

//------------------------------------------------------------------------------
bool MappedArrays::Map(const vtkRenderState* state,
  const std::function<std::string(vtkActor*)>& getName)
{
  this->ForgetDeadMappers();
  bool found = false;
  for (int index = 0; index < state->GetPropArrayCount(); ++index)
  {
    auto* actor = vtkActor::SafeDownCast(state->GetPropArray()[index]);
    auto* mapper = actor ? vtkPolyDataMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    if (mapper)
    {
      const std::string arrayName = getName(actor);
      const int components = arrayName.empty() ? 0 : FindComponents(mapper, arrayName);
      found = found || components > 0;
      this->Map(mapper, arrayName, components);
    }
  }
  return found;
}

//------------------------------------------------------------------------------
void MappedArrays::Map(vtkPolyDataMapper* mapper, const std::string& arrayName, int components)
{
  Drawing& drawing = this->Drawings[mapper];
  if (components == drawing.Components && drawing.ArrayName == arrayName)
  {
    return;
  }
  if (drawing.Components > 0)
  {
    mapper->RemoveVertexAttributeMapping(RadianceShader::Attribute);
  }
  if (components > 0)
  {
    mapper->MapDataArrayToVertexAttribute(RadianceShader::Attribute, arrayName.c_str(),
      vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
  drawing = { mapper, arrayName, components };
  this->Time.Modified();
}

//------------------------------------------------------------------------------
void MappedArrays::Unmap()
{
  for (auto& entry : this->Drawings)
  {
    if (entry.second.Mapper && entry.second.Components > 0)
    {
      entry.second.Mapper->RemoveVertexAttributeMapping(RadianceShader::Attribute);
    }
  }
  this->Drawings.clear();
  this->Time.Modified();
}

//------------------------------------------------------------------------------
int MappedArrays::GetNumberOfComponents(const void* mapper) const
{
  const auto drawing = this->Drawings.find(mapper);
  return drawing == this->Drawings.end() ? 0 : drawing->second.Components;
}
} // namespace LightTransport
