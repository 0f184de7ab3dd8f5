// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause

// vtkCompositePolyDataMapper2 is deprecated in VTK 9.3, and there until then: whoever has one sees
// its blocks as they are.
#define VTK_DEPRECATION_LEVEL 0
#include "Passes/BlockSurfaces.h"

#include "Passes/PlainMapper.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositePolyDataMapper.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#if __has_include("vtkCompositePolyDataMapper2.h")
#include "vtkCompositePolyDataMapper2.h"
#endif

namespace LightTransport
{
namespace
{
using Attributes = vtkCompositeDataDisplayAttributes;

///@{
/// Which of the mappers has attributes depends on VTK.
template <typename Mapper>
auto GetAttributes(Mapper* mapper, int) -> decltype(mapper->GetCompositeDataDisplayAttributes())
{
  return mapper ? mapper->GetCompositeDataDisplayAttributes() : nullptr;
}
template <typename Mapper>
Attributes* GetAttributes(Mapper*, long)
{
  return nullptr;
}
///@}

//------------------------------------------------------------------------------
Attributes* FindAttributes(vtkMapper* mapper)
{
  Attributes* attributes = GetAttributes(vtkCompositePolyDataMapper::SafeDownCast(mapper), 0);
#if __has_include("vtkCompositePolyDataMapper2.h")
  attributes =
    attributes ? attributes : GetAttributes(vtkCompositePolyDataMapper2::SafeDownCast(mapper), 0);
#endif
  return attributes;
}

//------------------------------------------------------------------------------
void SetAttributes(Attributes* attributes, vtkDataObject* data, BlockSurface& block)
{
  if (attributes->HasBlockVisibility(data))
  {
    block.IsVisible = attributes->GetBlockVisibility(data);
  }
  if (attributes->HasBlockOpacity(data))
  {
    block.HasOpacity = true;
    block.Opacity = attributes->GetBlockOpacity(data);
  }
  if (attributes->HasBlockColor(data))
  {
    block.HasColor = true;
    attributes->GetBlockColor(data, block.Color.data());
  }
}

//------------------------------------------------------------------------------
void Collect(vtkDataObject* data, Attributes* attributes, BlockSurface block,
  std::vector<BlockSurface>& blocks)
{
  if (attributes)
  {
    SetAttributes(attributes, data, block);
  }
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    vtkSmartPointer<vtkDataObjectTreeIterator> children;
    children.TakeReference(tree->NewTreeIterator());
    children->VisitOnlyLeavesOff();
    children->TraverseSubTreeOff();
    for (children->InitTraversal(); !children->IsDoneWithTraversal(); children->GoToNextItem())
    {
      Collect(children->GetCurrentDataObject(), attributes, block, blocks);
    }
  }
  block.Surface = vtkPolyData::SafeDownCast(data);
  if (block.Surface && block.Surface->GetNumberOfPolys() + block.Surface->GetNumberOfStrips() > 0)
  {
    blocks.push_back(block);
  }
}
} // namespace

//------------------------------------------------------------------------------
bool FindBlockSurfaces(vtkMapper* mapper, std::vector<BlockSurface>& blocks)
{
  blocks.clear();
  if (!mapper || mapper->GetNumberOfInputConnections(0) == 0 || FindPlainMapper(mapper) ||
    !DrawsItsInput(mapper))
  {
    return false;
  }
  mapper->Update();
  vtkDataObject* data = mapper->GetInputDataObject(0, 0);
  if (data)
  {
    Collect(data, FindAttributes(mapper), {}, blocks);
  }
  return data != nullptr;
}
} // namespace LightTransport
