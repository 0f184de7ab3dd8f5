// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// Any surface with any arrays and properties gives an error and nothing, or whole results; a result
// that is not finite is told of.
//
// With LIGHT_TRANSPORT_FUZZ_PRINT in the environment, filter and input are printed before the
// filter runs.
#include "AnyFilter.h"
#include "AnySurface.h"
#include "Choices.h"
#include "FuzzFile.h"

#include "vtkCellData.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSurfaceAtlas.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <vector>

using namespace LightTransportFuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace
{
//------------------------------------------------------------------------------
// All surfaces and images in it.
std::vector<vtkDataSet*> ListPieces(vtkDataObject* object)
{
  std::vector<vtkDataSet*> pieces;
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(object))
  {
    const auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
    {
      pieces.push_back(vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject()));
    }
  }
  else
  {
    pieces.push_back(vtkDataSet::SafeDownCast(object));
  }
  return pieces;
}

//------------------------------------------------------------------------------
// That of the first surface, as far as it is known.
Room GetRoom(vtkDataObject* object)
{
  Room room;
  const std::vector<vtkDataSet*> pieces = ListPieces(object);
  if (!pieces.empty() && pieces[0]->GetLength() > 0.0 && std::isfinite(pieces[0]->GetLength()))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      room.Low[axis] = pieces[0]->GetBounds()[2 * axis];
    }
    room.Size = pieces[0]->GetLength();
  }
  return room;
}

//------------------------------------------------------------------------------
std::set<std::string> ListArrays(vtkDataObject* object)
{
  std::set<std::string> names;
  for (vtkDataSet* piece : ListPieces(object))
  {
    for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* arrays = piece->GetAttributes(type);
      for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
      {
        names.insert(arrays->GetAbstractArray(k)->GetName());
      }
    }
  }
  return names;
}

//------------------------------------------------------------------------------
bool IsFinite(vtkDataArray* array)
{
  for (vtkIdType tuple = 0; tuple < array->GetNumberOfTuples(); ++tuple)
  {
    for (int k = 0; k < array->GetNumberOfComponents(); ++k)
    {
      if (!std::isfinite(array->GetComponent(tuple, k)))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// What the filter adds (names that the input does not have) is whole, and finite or told of.
void CheckResults(vtkDataObject* output, const std::set<std::string>& given, bool silent)
{
  for (vtkDataSet* piece : ListPieces(output))
  {
    for (int type : { vtkDataObject::POINT, vtkDataObject::CELL })
    {
      vtkDataSetAttributes* arrays = piece->GetAttributes(type);
      for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
      {
        const std::string name = arrays->GetAbstractArray(k)->GetName();
        vtkDataArray* array = arrays->GetArray(k);
        if (array && given.count(name) == 0)
        {
          Require(array->GetNumberOfTuples() == piece->GetNumberOfElements(type),
            name + " is not as long as the surface");
          Require(!silent || IsFinite(array), name + " is not finite, without a word");
        }
      }
    }
  }
}
} // namespace

//------------------------------------------------------------------------------
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  BeQuiet();
  Choices choices(data, size);
  const FilterKind& kind = ChooseFilter(choices);
  if (kind.Input.AreSome() && !choices.Chance(3))
  {
    choices.CalmDown();
  }
  vtkSmartPointer<vtkDataObject> input = MakeAnyInput(choices, kind.TakesComposite, kind.Input);
  const vtkSmartPointer<vtkAlgorithm> filter = kind.Make(choices, GetRoom(input));
  const Messages messages(filter);
  if (kind.TakesAtlas)
  {
    vtkNew<vtkSurfaceAtlas> atlas;
    atlas->SetResolution(16);
    atlas->SetInputDataObject(input);
    atlas->Update();
    input = choices.Chance(4) ? input.Get() : atlas->GetOutputDataObject(0);
  }
  filter->SetInputDataObject(0, input);
  if (std::getenv("LIGHT_TRANSPORT_FUZZ_PRINT"))
  {
    filter->Print(std::cerr);
    input->Print(std::cerr);
  }
  filter->Update();
  // Arrays that are carried over are as they were, and the same goes for those of a second input.
  std::set<std::string> given = ListArrays(input);
  if (filter->GetNumberOfInputPorts() > 1 && filter->GetNumberOfInputConnections(1) > 0)
  {
    given.merge(ListArrays(filter->GetInputDataObject(1, 0)));
  }
  CheckResults(filter->GetOutputDataObject(0), given,
    messages.Errors == 0 && messages.Warnings == 0);
  return 0;
}
