// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Leaves.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
vtkDataSet* TakeLeaf(vtkDataObject* object)
{
  const bool hasPatches = vtkPolyData::SafeDownCast(object) || vtkImageData::SafeDownCast(object);
  return hasPatches ? static_cast<vtkDataSet*>(object) : nullptr;
}
} // namespace

//------------------------------------------------------------------------------
std::vector<vtkDataSet*> Leaves::Get(vtkDataObject* object)
{
  std::vector<vtkDataSet*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      leaves.push_back(TakeLeaf(leaf->GetCurrentDataObject()));
    }
  }
  else if (object)
  {
    leaves.push_back(TakeLeaf(object));
  }
  return leaves;
}

//------------------------------------------------------------------------------
std::vector<vtkIdType> Leaves::GetNumbers(vtkDataObject* object)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(object);
  if (!composite)
  {
    return { 0 };
  }
  std::vector<vtkIdType> numbers;
  vtkSmartPointer<vtkCompositeDataIterator> leaf;
  leaf.TakeReference(composite->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    numbers.push_back(leaf->GetCurrentFlatIndex());
  }
  return numbers;
}

//------------------------------------------------------------------------------
vtkDataSetAttributes* Leaves::GetPatchData(vtkDataSet* leaf)
{
  return vtkImageData::SafeDownCast(leaf) ? static_cast<vtkDataSetAttributes*>(leaf->GetPointData())
                                          : leaf->GetCellData();
}

//------------------------------------------------------------------------------
vtkIdType Leaves::GetFirstPolygonCell(vtkPolyData* data)
{
  return data->GetNumberOfVerts() + data->GetNumberOfLines();
}
} // namespace LightTransport
