// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/SurfaceValues.h"

#include "Shared/BitHash.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
std::pair<vtkDataArray*, vtkDataArray*> SurfaceValues::Find(vtkPolyData* surface,
  const std::string& name)
{
  return { surface->GetCellData()->GetArray(name.c_str()),
    surface->GetPointData()->GetArray(name.c_str()) };
}

//------------------------------------------------------------------------------
std::uint64_t SurfaceValues::GetStamp(vtkPolyData* surface, const std::string& name)
{
  const auto arrays = Find(surface, name);
  BitHash hash;
  hash.AddObjects({ surface->GetPolys(), arrays.first, arrays.second });
  return hash.Get();
}

//------------------------------------------------------------------------------
Outcome SurfaceValues::Update(FloatTextures& engine, vtkPolyData* surface, const std::string& name,
  const std::string& remedy)
{
  const std::uint64_t stamp = GetStamp(surface, name);
  if (this->Stamp == stamp && this->Table.Get())
  {
    return Outcome::Done();
  }
  this->Stamp = 0;
  const auto arrays = Find(surface, name);
  this->OfPoints = arrays.first == nullptr;
  vtkDataArray* array = this->OfPoints ? arrays.second : arrays.first;
  if (!array)
  {
    return Outcome::Failed(
      "The surface has no cell or point array \"" + name + "\": " + remedy + ".");
  }
  const vtkIdType first =
    this->OfPoints ? 0 : surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  const vtkIdType count =
    this->OfPoints ? surface->GetNumberOfPoints() : surface->GetNumberOfPolys();
  if (array->GetNumberOfTuples() < first + count)
  {
    return Outcome::Failed("The array \"" + name + "\" has " +
      std::to_string(array->GetNumberOfTuples()) + " values for " + std::to_string(first + count) +
      (this->OfPoints ? " points" : " cells") + ": " + remedy + ".");
  }
  bool isFinite = true;
  std::vector<float> texels = TupleTable::Pack({ array }, first, count, isFinite);
  if (!isFinite)
  {
    return Outcome::Failed(
      "The array \"" + name + "\" has values that are not finite: replace them.");
  }
  Outcome uploaded = this->Table.Upload(engine, std::move(texels));
  this->Components = array->GetNumberOfComponents();
  this->Stamp = uploaded ? stamp : 0;
  return uploaded;
}
} // namespace LightTransport
