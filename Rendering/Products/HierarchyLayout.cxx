// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/HierarchyLayout.h"

#include "Textures/FloatTextures.h"

#include <algorithm>
#include <numeric>

namespace LightTransport
{
namespace
{
constexpr int MostLinksPerPiece = 64;
} // namespace

//------------------------------------------------------------------------------
HierarchyLayout::HierarchyLayout(const vtkExchangeHierarchy& hierarchy, int width,
  int maximumHeight)
  : Hierarchy(hierarchy), Width(width),
    MaximumHeight(std::min(maximumHeight, static_cast<int>(FloatTextures::MaximumTexels / width))),
    LinksPerTexel(hierarchy.GetNumberOfKernels() == 1 ? 2 : 1),
    TexelsPerLink(FloatTextures::DivideUp(1 + hierarchy.GetNumberOfKernels(), 4)),
    Common(hierarchy, double(TexelsPerLink * FloatTextures::BytesPerTexel) / double(LinksPerTexel),
      width, MaximumHeight)
{
  this->LeaveOutCommon();
  this->PlaceSlots();
  this->CutRows();
  this->PlacePieces();
}

//------------------------------------------------------------------------------
void HierarchyLayout::LeaveOutCommon()
{
  if (this->Common.GetSlots().empty())
  {
    return;
  }
  const int nodes = this->Hierarchy.GetNumberOfNodes();
  this->OtherOffsets.assign(1, 0);
  for (int slot = 0; slot < this->Hierarchy.GetNumberOfSlots(); ++slot)
  {
    const auto [first, last] = this->Hierarchy.GetRow(slot);
    for (std::int64_t link = first; link < last; ++link)
    {
      if (slot < nodes ||
        !this->Common.Has(this->Hierarchy.GetColumns()[static_cast<std::size_t>(link)]))
      {
        this->OtherLinks.push_back(link);
      }
    }
    this->OtherOffsets.push_back(static_cast<std::int64_t>(this->OtherLinks.size()));
  }
}

//------------------------------------------------------------------------------
std::pair<std::int64_t, std::int64_t> HierarchyLayout::GetRow(int slot) const
{
  const auto index = static_cast<std::size_t>(slot);
  return this->OtherOffsets.empty()
    ? this->Hierarchy.GetRow(slot)
    : std::make_pair(this->OtherOffsets[index], this->OtherOffsets[index + 1]);
}

//------------------------------------------------------------------------------
int HierarchyLayout::CountTexels(std::int64_t links) const
{
  return FloatTextures::DivideUp(links, this->LinksPerTexel) * this->TexelsPerLink;
}

//------------------------------------------------------------------------------
bool HierarchyLayout::Fits() const
{
  const int coded = this->Hierarchy.GetCodedRows().Tiles.empty() ? 0 : this->GetNumberOfSlotLines();
  const int common = this->Common.GetNumberOfRounds() * this->Patches.Lines;
  const int received =
    this->GetNumberOfPieceLines() + this->GetNumberOfNodeLines() + coded + common;
  return std::max({ this->GetNumberOfSlotLines(), received, this->TexelsPerLink }) <=
    this->MaximumHeight;
}

//------------------------------------------------------------------------------
bool HierarchyLayout::HaveNodesRows() const
{
  const int nodes = this->Hierarchy.GetNumberOfNodes();
  const auto counts = this->PieceCounts.begin();
  const auto& tiles = this->Hierarchy.GetCodedRows().Tiles;
  return std::any_of(counts, counts + nodes, [](int count) { return count > 0; }) ||
    std::any_of(tiles.begin(), tiles.end(),
      [&](const auto& tile) { return tile.FirstRow < nodes; });
}

//------------------------------------------------------------------------------
void HierarchyLayout::PlaceSlots()
{
  this->SlotTexels.reserve(static_cast<std::size_t>(this->Hierarchy.GetNumberOfSlots()));
  const std::vector<int>& levels = this->Hierarchy.GetLevels();
  for (std::size_t level = 0; level + 1 < levels.size(); ++level)
  {
    this->Patches = this->PlaceRange(levels[level], levels[level + 1]);
    this->Levels.push_back(this->Patches);
  }
  this->Patches =
    this->PlaceRange(this->Hierarchy.GetNumberOfNodes(), this->Hierarchy.GetNumberOfSlots());
}

//------------------------------------------------------------------------------
// After the range placed last.
HierarchyLayout::Range HierarchyLayout::PlaceRange(int first, int last)
{
  const int line = this->GetNumberOfSlotLines();
  for (int slot = first; slot < last; ++slot)
  {
    this->SlotTexels.push_back(line * this->Width + slot - first);
  }
  return { last - first, line, FloatTextures::DivideUp(last - first, this->Width) };
}

//------------------------------------------------------------------------------
void HierarchyLayout::CutRows()
{
  const auto slots = static_cast<std::size_t>(this->Hierarchy.GetNumberOfSlots());
  const int most = std::max(
    std::min(MostLinksPerPiece / this->LinksPerTexel, this->MaximumHeight / this->TexelsPerLink),
    1);
  std::vector<int> lengths(slots);
  for (std::size_t slot = 0; slot < slots; ++slot)
  {
    const auto [first, last] = this->GetRow(static_cast<int>(slot));
    const int bunches = FloatTextures::DivideUp(last - first, this->LinksPerTexel);
    const int pieces = std::max(FloatTextures::DivideUp(bunches, most), 1);
    lengths[slot] = this->LinksPerTexel * FloatTextures::DivideUp(bunches, pieces);
  }
  std::vector<std::size_t> order(slots);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });
  this->FirstPieces.resize(slots);
  this->PieceCounts.resize(slots);
  for (const std::size_t slot : order)
  {
    const std::size_t before = this->Pieces.size();
    const auto [first, end] = this->GetRow(static_cast<int>(slot));
    for (std::int64_t link = first; link < end; link += lengths[slot])
    {
      this->Pieces.push_back(
        { link, static_cast<int>(std::min<std::int64_t>(end - link, lengths[slot])) });
    }
    this->FirstPieces[slot] = static_cast<int>(before);
    this->PieceCounts[slot] = static_cast<int>(this->Pieces.size() - before);
  }
}

//------------------------------------------------------------------------------
void HierarchyLayout::PlacePieces()
{
  const auto width = static_cast<std::size_t>(this->Width);
  for (std::size_t first = 0; first < this->Pieces.size(); first += width)
  {
    const std::size_t last = std::min(first + width, this->Pieces.size());
    int height = 0;
    for (std::size_t piece = first; piece < last; ++piece)
    {
      height = std::max(height, this->CountTexels(this->Pieces[piece].Links));
    }
    if (this->Tiles.empty() || this->Tiles.back().Height + height > this->MaximumHeight)
    {
      this->Tiles.push_back({ this->GetNumberOfPieceLines(), 0, 0 });
    }
    this->Heights.push_back(height);
    ++this->Tiles.back().Lines;
    this->Tiles.back().Height += height;
  }
}

//------------------------------------------------------------------------------
HierarchyLayout::Texels HierarchyLayout::MakeChildren() const
{
  Texels texels(std::size_t(4) * this->Width * this->GetNumberOfNodeLines(), 0.0f);
  const std::vector<vtkExchangeHierarchy::Node>& nodes = this->Hierarchy.GetNodes();
  for (std::size_t node = 0; node < nodes.size(); ++node)
  {
    float* texel = texels.data() + std::size_t(4) * this->SlotTexels[node];
    texel[0] = static_cast<float>(this->SlotTexels[static_cast<std::size_t>(nodes[node].First)]);
    texel[1] = static_cast<float>(nodes[node].Last - nodes[node].First);
  }
  return texels;
}

//------------------------------------------------------------------------------
HierarchyLayout::Texels HierarchyLayout::MakeRows() const
{
  Texels texels(std::size_t(4) * this->Width * this->GetNumberOfSlotLines(), 0.0f);
  const std::vector<int>& parents = this->Hierarchy.GetParents();
  const std::vector<double>& weights = this->Hierarchy.GetWeights();
  const std::size_t nodes = this->Hierarchy.GetNodes().size();
  const int behindPieces = this->GetNumberOfPieceLines() * this->Width;
  for (std::size_t texel = 2; texel < texels.size(); texel += 4)
  {
    texels[texel] = -1.0f;
  }
  for (std::size_t slot = 0; slot < parents.size(); ++slot)
  {
    float* texel = texels.data() + std::size_t(4) * this->SlotTexels[slot];
    texel[0] = static_cast<float>(this->FirstPieces[slot]);
    texel[1] = static_cast<float>(this->PieceCounts[slot]);
    if (parents[slot] >= 0)
    {
      texel[2] = static_cast<float>(
        behindPieces + this->SlotTexels[static_cast<std::size_t>(parents[slot])]);
    }
    texel[3] = slot < nodes ? 0.0f : static_cast<float>(weights[slot - nodes]);
  }
  return texels;
}

//------------------------------------------------------------------------------
HierarchyLayout::Texels HierarchyLayout::MakeLines() const
{
  Texels texels(4 * this->Heights.size(), 0.0f);
  for (const Tile& tile : this->Tiles)
  {
    int first = 0;
    for (int line = tile.FirstLine; line < tile.FirstLine + tile.Lines; ++line)
    {
      const int height = this->Heights[static_cast<std::size_t>(line)];
      float* texel = texels.data() + std::size_t(4) * line;
      texel[0] = static_cast<float>(first);
      texel[1] = static_cast<float>(height);
      first += height;
    }
  }
  return texels;
}

//------------------------------------------------------------------------------
// What fills up a piece repeats its last slot, with the value 0.
HierarchyLayout::Texels HierarchyLayout::MakeLinks(int lineOfPieces) const
{
  const int height = this->Heights[static_cast<std::size_t>(lineOfPieces)];
  Texels texels(std::size_t(4) * this->Width * height, 0.0f);
  const std::size_t first = static_cast<std::size_t>(lineOfPieces) * this->Width;
  const std::size_t last = std::min(first + this->Width, this->Pieces.size());
  const int kernels = this->Hierarchy.GetNumberOfKernels();
  for (std::size_t piece = first; piece < last; ++piece)
  {
    const Piece& links = this->Pieces[piece];
    for (int link = 0; link < this->LinksPerTexel * height / this->TexelsPerLink; ++link)
    {
      const bool inside = link < links.Links;
      const auto among = static_cast<std::size_t>(links.First + std::min(link, links.Links - 1));
      const std::size_t source =
        this->OtherOffsets.empty() ? among : static_cast<std::size_t>(this->OtherLinks[among]);
      const auto line = std::size_t(link / this->LinksPerTexel) * this->TexelsPerLink;
      float* texel =
        texels.data() + 4 * (line * this->Width + piece - first) + 2 * (link % this->LinksPerTexel);
      texel[0] = static_cast<float>(
        this->SlotTexels[static_cast<std::size_t>(this->Hierarchy.GetColumns()[source])]);
      for (int kernel = 0; inside && kernel < kernels; ++kernel)
      {
        const std::size_t below = std::size_t((1 + kernel) / 4) * this->Width;
        texel[4 * below + (1 + kernel) % 4] =
          this->Hierarchy.GetValues()[source * kernels + kernel];
      }
    }
  }
  return texels;
}
} // namespace LightTransport
