// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/Leaves.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
std::vector<vtkPolyData*> Leaves::Get(vtkDataObject* object)
{
  std::vector<vtkPolyData*> leaves;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      leaves.push_back(vtkPolyData::SafeDownCast(leaf->GetCurrentDataObject()));
    }
  }
  else if (object)
  {
    leaves.push_back(vtkPolyData::SafeDownCast(object));
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
vtkIdType Leaves::GetFirstPolygonCell(vtkPolyData* data)
{
  return data->GetNumberOfVerts() + data->GetNumberOfLines();
}
} // namespace LightTransport
