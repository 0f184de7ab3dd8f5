// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/LinkChoice.h"

#include "Shared/Pulse.h"
#include "vtkExchangeHierarchy.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
/// visit(receiver, slot) for each link, in whatever order.
template <typename Visitor>
void VisitLinks(const vtkExchangeHierarchy& links, const Visitor& visit)
{
  const int nodes = links.GetNumberOfNodes();
  for (int row = nodes; row < links.GetNumberOfSlots(); ++row)
  {
    Pulse::Beat(row);
    for (std::int64_t link = links.GetOffsets()[row]; link < links.GetOffsets()[row + 1]; ++link)
    {
      visit(row - nodes, links.GetColumns()[link]);
    }
  }
  const vtkExchangeHierarchy::CodedRows& coded = links.GetCodedRows();
  for (const auto& tile : coded.Tiles)
  {
    Pulse::Beat();
    coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        coded.VisitLinks(tile, bytes, pairs,
          [&](int place, int code)
          {
            if (code > 0)
            {
              visit(row - nodes, coded.Slots[tile.FirstSlot + place]);
            }
          });
      });
  }
}

//------------------------------------------------------------------------------
/// Of each slot.
std::vector<int> FindFirstPatches(const vtkExchangeHierarchy& links)
{
  const int nodes = links.GetNumberOfNodes();
  std::vector<int> first(links.GetNumberOfSlots());
  for (int slot = links.GetNumberOfSlots(); slot-- > 0;)
  {
    first[slot] = slot < nodes ? first[links.GetNodes()[slot].First] : slot - nodes;
  }
  return first;
}
} // namespace

//------------------------------------------------------------------------------
void LinkChoice::TakeRows(const vtkExchangeHierarchy& links)
{
  const auto patches = static_cast<std::size_t>(links.GetNumberOfPatches());
  this->Offsets.assign(patches + 1, 0);
  VisitLinks(links, [&](int receiver, int) { ++this->Offsets[receiver + 1]; });
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    this->Offsets[patch + 1] += this->Offsets[patch];
  }
  this->Columns.resize(this->Offsets.back());
  std::vector<std::int64_t> ends(this->Offsets.begin(), this->Offsets.end() - 1);
  VisitLinks(links, [&](int receiver, int slot) { this->Columns[ends[receiver]++] = slot; });
  const std::vector<int> first = FindFirstPatches(links);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    Pulse::Beat(patch);
    std::sort(this->Columns.begin() + this->Offsets[patch],
      this->Columns.begin() + this->Offsets[patch + 1],
      [&](int a, int b) { return first[a] < first[b]; });
  }
}
} // namespace LightTransport
