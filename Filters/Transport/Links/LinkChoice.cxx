// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/LinkChoice.h"

#include "Shared/Pulse.h"
#include "vtkExchangeHierarchy.h"

#include <algorithm>
#include <utility>

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
    const auto range = links.GetRow(row);
    for (std::int64_t link = range.first; link < range.second; ++link)
    {
      visit(row - nodes, links.GetColumns()[link]);
    }
  }
  using CodedRows = vtkExchangeHierarchy::CodedRows;
  const CodedRows& coded = links.GetCodedRows();
  int slots[CodedRows::BookSize];
  for (const CodedRows::Tile& tile : coded.Tiles)
  {
    Pulse::Beat();
    coded.VisitSlots(tile, [&](int place, int slot) { slots[place] = slot; });
    coded.VisitPieces(tile,
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        CodedRows::VisitLinks(tile, bytes, pairs,
          [&](int place, int code)
          {
            if (code > 0)
            {
              visit(row - nodes, slots[place]);
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
  std::vector<std::int64_t> offsets(patches + 1, 0);
  VisitLinks(links, [&](int receiver, int) { ++offsets[receiver + 1]; });
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    offsets[patch + 1] += offsets[patch];
  }
  std::vector<int> columns(offsets.back());
  std::vector<std::int64_t> ends(offsets.begin(), offsets.end() - 1);
  VisitLinks(links, [&](int receiver, int slot) { columns[ends[receiver]++] = slot; });
  const std::vector<int> first = FindFirstPatches(links);
  for (std::size_t patch = 0; patch < patches; ++patch)
  {
    Pulse::Beat(patch);
    std::sort(columns.begin() + offsets[patch], columns.begin() + offsets[patch + 1],
      [&](int a, int b) { return first[a] < first[b]; });
  }
  // All or nothing, where this ends by an exception.
  this->Columns = std::move(columns);
  this->Offsets = std::move(offsets);
}
} // namespace LightTransport
