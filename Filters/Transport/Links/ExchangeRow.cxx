// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/ExchangeRow.h"

#include "vtkExchange.h"
#include "vtkExchangeHierarchy.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// To all patches below a slot.
void AddBelow(const vtkExchangeHierarchy& hierarchy, int slot, double value,
  std::vector<double>& row)
{
  const int nodes = hierarchy.GetNumberOfNodes();
  if (slot >= nodes)
  {
    row[slot - nodes] += value;
    return;
  }
  const vtkExchangeHierarchy::Node& children = hierarchy.GetNodes()[slot];
  for (int child = children.First; child < children.Last; ++child)
  {
    AddBelow(hierarchy, child, value, row);
  }
}

//------------------------------------------------------------------------------
// Links of the patch and of all nodes above it.
void CopyLinks(const vtkExchangeHierarchy& hierarchy, vtkIdType patch, std::vector<double>& row)
{
  const int kernels = hierarchy.GetNumberOfKernels();
  for (int slot = hierarchy.GetNumberOfNodes() + static_cast<int>(patch); slot >= 0;
       slot = hierarchy.GetParents()[slot])
  {
    const auto [first, last] = hierarchy.GetRow(slot);
    for (std::int64_t link = first; link < last; ++link)
    {
      AddBelow(hierarchy, hierarchy.GetColumns()[link],
        static_cast<double>(hierarchy.GetValues()[link * kernels]), row);
    }
  }
  const std::vector<double>& weights = hierarchy.GetWeights();
  for (std::size_t other = 0; other < row.size(); ++other)
  {
    row[other] = weights[patch] * row[other] * weights[other];
  }
}
} // namespace

//------------------------------------------------------------------------------
void ExchangeRow::Copy(const vtkExchange* exchange, vtkIdType patch, std::vector<double>& row)
{
  const vtkIdType patches = exchange->GetNumberOfPatches();
  row.assign(patches, 0.0);
  const auto* hierarchy = dynamic_cast<const vtkExchangeHierarchy*>(exchange);
  if (hierarchy && hierarchy->GetCodedRows().Tiles.empty())
  {
    CopyLinks(*hierarchy, patch, row);
    return;
  }
  for (vtkIdType other = 0; other < patches; ++other)
  {
    row[other] = exchange->GetValue(patch, other);
  }
}
} // namespace LightTransport
