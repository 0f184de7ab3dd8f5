// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/CodedLayout.h"

#include "Textures/FloatTextures.h"

#include <algorithm>

namespace LightTransport
{
namespace
{
constexpr int BytesPerTexel = 16;
constexpr int PairsPerTexel = BytesPerTexel / 2;
constexpr int TileBits = 20;
constexpr std::uint32_t NoTile = (1u << TileBits) - 1u;
constexpr int MostPairTexels = (1 << (32 - TileBits)) - 1;
constexpr std::uint32_t HasNext = 256;

//------------------------------------------------------------------------------
/// Four to a word, the first in its lowest bits, whatever the machine.
CodedLayout::Words Pack(const std::vector<std::uint8_t>& bytes)
{
  CodedLayout::Words words(bytes.size() / 4, 0);
  for (std::size_t byte = 0; byte < bytes.size(); ++byte)
  {
    words[byte / 4] |= static_cast<std::uint32_t>(bytes[byte]) << (8 * (byte % 4));
  }
  return words;
}
} // namespace

//------------------------------------------------------------------------------
CodedLayout::CodedLayout(const vtkExchangeHierarchy& hierarchy, const HierarchyLayout& slots,
  int width, int maximumHeight)
  : Hierarchy(hierarchy), Coded(hierarchy.GetCodedRows()), Slots(slots), Width(width),
    MaximumHeight(std::min(maximumHeight, static_cast<int>(FloatTextures::MaximumTexels / width)))
{
  if (this->Coded.Tiles.empty())
  {
    return;
  }
  this->FindPieces();
  this->PlaceBytes();
  this->Fit = this->Fit && this->Coded.Tiles.size() < NoTile &&
    std::max(this->GetNumberOfEntryLines(), this->GetNumberOfTileLines()) <= this->MaximumHeight;
}

//------------------------------------------------------------------------------
int CodedLayout::GetNumberOfEntryLines() const
{
  return FloatTextures::DivideUp(static_cast<vtkIdType>(this->Entries.size()), this->Width);
}

//------------------------------------------------------------------------------
int CodedLayout::GetNumberOfTileLines() const
{
  return FloatTextures::DivideUp(static_cast<vtkIdType>(this->Coded.Tiles.size()), this->Width);
}

//------------------------------------------------------------------------------
void CodedLayout::FindPieces()
{
  this->Pieces.resize(static_cast<std::size_t>(this->Hierarchy.GetNumberOfSlots()));
  for (std::size_t tile = 0; tile < this->Coded.Tiles.size(); ++tile)
  {
    this->FirstEntries.push_back(static_cast<std::uint32_t>(this->Entries.size()));
    this->Coded.VisitSlots(this->Coded.Tiles[tile],
      [this](int, int slot) { this->Entries.push_back(slot); });
    this->Coded.VisitPieces(this->Coded.Tiles[tile],
      [&](int row, const std::uint8_t* bytes, int pairs)
      {
        this->Pieces[static_cast<std::size_t>(row)].push_back(
          { bytes - this->Coded.Bytes.data(), static_cast<int>(tile), pairs });
      });
  }
}

//------------------------------------------------------------------------------
int CodedLayout::CountPairTexels(const Piece& piece)
{
  return FloatTextures::DivideUp(piece.Pairs, PairsPerTexel);
}

//------------------------------------------------------------------------------
int CodedLayout::CountTexels(int slot) const
{
  const std::vector<Piece>& pieces = this->Pieces[static_cast<std::size_t>(slot)];
  int texels = static_cast<int>(std::max<std::size_t>(pieces.size(), 1)) - 1;
  for (const Piece& piece : pieces)
  {
    texels += this->Coded.Tiles[static_cast<std::size_t>(piece.Tile)].Common / BytesPerTexel +
      CountPairTexels(piece);
  }
  return texels;
}

//------------------------------------------------------------------------------
void CodedLayout::PlaceBytes()
{
  this->Lines.resize(static_cast<std::size_t>(this->Slots.GetNumberOfSlotLines()));
  this->FirstTexels.resize(this->Pieces.size());
  for (int slot = 0; slot < static_cast<int>(this->Pieces.size()); ++slot)
  {
    this->Lines[static_cast<std::size_t>(this->Slots.GetSlotTexel(slot) / this->Width)].push_back(
      slot);
  }
  for (int line = 0; line < static_cast<int>(this->Lines.size()); ++line)
  {
    std::int64_t texels = 0;
    for (const int slot : this->Lines[static_cast<std::size_t>(line)])
    {
      const std::vector<Piece>& pieces = this->Pieces[static_cast<std::size_t>(slot)];
      texels += this->CountTexels(slot);
      this->Fit = this->Fit && (pieces.empty() || CountPairTexels(pieces[0]) <= MostPairTexels);
    }
    const int height = FloatTextures::DivideUp(texels, this->Width);
    this->Fit = this->Fit && height <= this->MaximumHeight;
    if (height == 0)
    {
      continue;
    }
    const bool begins = this->Parts.empty() ||
      this->Parts.back().FirstLine + this->Parts.back().Lines != line ||
      this->Parts.back().Height + height > this->MaximumHeight;
    if (begins)
    {
      this->Parts.push_back({ line, 0, 0 });
    }
    int texel = this->Parts.back().Height * this->Width;
    for (const int slot : this->Lines[static_cast<std::size_t>(line)])
    {
      this->FirstTexels[static_cast<std::size_t>(slot)] = texel;
      texel += this->CountTexels(slot);
    }
    ++this->Parts.back().Lines;
    this->Parts.back().Height += height;
  }
}

//------------------------------------------------------------------------------
CodedLayout::Words CodedLayout::MakeRows() const
{
  Words words(std::size_t(2) * this->Width * this->Lines.size(), 0);
  for (std::size_t texel = 0; texel < words.size(); texel += 2)
  {
    words[texel + 1] = NoTile;
  }
  for (std::size_t slot = 0; slot < this->Pieces.size(); ++slot)
  {
    if (!this->Pieces[slot].empty())
    {
      const Piece& piece = this->Pieces[slot][0];
      const auto texel = static_cast<std::size_t>(this->Slots.GetSlotTexel(static_cast<int>(slot)));
      words[2 * texel] = static_cast<std::uint32_t>(this->FirstTexels[slot]);
      words[2 * texel + 1] = static_cast<std::uint32_t>(piece.Tile) |
        static_cast<std::uint32_t>(CountPairTexels(piece)) << TileBits;
    }
  }
  return words;
}

//------------------------------------------------------------------------------
CodedLayout::Words CodedLayout::MakeTiles() const
{
  Words words(std::size_t(2) * this->Width * this->GetNumberOfTileLines(), 0);
  for (std::size_t tile = 0; tile < this->Coded.Tiles.size(); ++tile)
  {
    const CodedRows::Tile& source = this->Coded.Tiles[tile];
    const bool hasNext = tile + 1 < this->Coded.Tiles.size() && this->Coded.Continues(tile + 1);
    words[2 * tile] = this->FirstEntries[tile];
    words[2 * tile + 1] =
      static_cast<std::uint32_t>(source.Common / BytesPerTexel) | (hasNext ? HasNext : 0u);
  }
  return words;
}

//------------------------------------------------------------------------------
CodedLayout::Words CodedLayout::MakeEntries() const
{
  Words words(static_cast<std::size_t>(this->Width) * this->GetNumberOfEntryLines(), 0);
  std::transform(this->Entries.begin(), this->Entries.end(), words.begin(),
    [this](int slot) { return static_cast<std::uint32_t>(this->Slots.GetSlotTexel(slot)); });
  return words;
}

//------------------------------------------------------------------------------
CodedLayout::Words CodedLayout::MakeBytes(int line) const
{
  std::vector<std::uint8_t> bytes;
  for (const int slot : this->Lines[static_cast<std::size_t>(line)])
  {
    const std::vector<Piece>& pieces = this->Pieces[static_cast<std::size_t>(slot)];
    for (std::size_t piece = 0; piece < pieces.size(); ++piece)
    {
      if (piece > 0)
      {
        const auto texels = static_cast<std::uint32_t>(CountPairTexels(pieces[piece]));
        for (int byte = 0; byte < BytesPerTexel; ++byte)
        {
          bytes.push_back(byte < 4 ? static_cast<std::uint8_t>(texels >> (8 * byte)) : 0);
        }
      }
      this->AppendPiece(pieces[piece], bytes);
    }
  }
  const std::size_t perLine = static_cast<std::size_t>(BytesPerTexel) * this->Width;
  bytes.resize((bytes.size() + perLine - 1) / perLine * perLine, 0);
  return Pack(bytes);
}

//------------------------------------------------------------------------------
// What fills up the pairs repeats the last place, with the code that stands for nothing.
void CodedLayout::AppendPiece(const Piece& piece, std::vector<std::uint8_t>& bytes) const
{
  const int common = this->Coded.Tiles[static_cast<std::size_t>(piece.Tile)].Common;
  const auto first = this->Coded.Bytes.begin() + piece.FirstByte;
  bytes.insert(bytes.end(), first, first + common + 2 * static_cast<std::ptrdiff_t>(piece.Pairs));
  for (int pair = piece.Pairs; pair < PairsPerTexel * CountPairTexels(piece); ++pair)
  {
    const std::uint8_t place = bytes[bytes.size() - 2];
    bytes.push_back(place);
    bytes.push_back(0);
  }
}

//------------------------------------------------------------------------------
std::vector<float> CodedLayout::MakeBook(int groups) const
{
  const int kernels = this->Hierarchy.GetNumberOfKernels();
  std::vector<float> texels(std::size_t(4) * CodedRows::BookSize * groups, 0.0f);
  for (int value = 0; value < static_cast<int>(texels.size()); ++value)
  {
    const int code = value / 4 % CodedRows::BookSize;
    const int band = value / (4 * CodedRows::BookSize) * 4 + value % 4;
    texels[static_cast<std::size_t>(value)] =
      this->Coded.Book[static_cast<std::size_t>(code) * kernels + band % kernels];
  }
  return texels;
}
} // namespace LightTransport
