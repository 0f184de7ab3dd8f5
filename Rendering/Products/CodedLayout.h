// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the coded rows of a vtkExchangeHierarchy lie in textures of unsigned integers.
 *
 * The bytes of a row stand one after the other, 16 in a texel: those of its first tile, the codes
 * of the common slots first, then the pairs, filled up with pairs that add nothing; then, for each
 * further tile, a texel with the number of texels of pairs that follow, its codes and its pairs.
 * Rows are in the order of the slots, so that neighbouring fragments read neighbouring bytes and
 * take about equally long. The rows of several lines of slots share a texture.
 *
 * The slots of tiles, *entries*, are texels one tile after the other.
 */
#ifndef CodedLayout_h
#define CodedLayout_h

#include "Products/HierarchyLayout.h"

#include "vtkExchangeHierarchy.h"

#include <cstdint>
#include <vector>

namespace LightTransport
{
class CodedLayout
{
public:
  using Words = std::vector<std::uint32_t>;

  /// Lines of slots, and the height of the texture that holds their bytes.
  struct Part
  {
    int FirstLine;
    int Lines;
    int Height;
  };

  CodedLayout(const vtkExchangeHierarchy& hierarchy, const HierarchyLayout& slots, int width,
    int maximumHeight);

  /// False when some texture would be too large.
  bool Fits() const { return this->Fit; }

  const std::vector<Part>& GetParts() const { return this->Parts; }
  int GetNumberOfRowLines() const { return static_cast<int>(this->Lines.size()); }
  int GetNumberOfEntryLines() const;
  int GetNumberOfTileLines() const;

  ///@{
  /**
   * The tables: of each slot, where its bytes begin in their texture, and, in one word, its first
   * tile (20 bits; NoTile without) and the texels of pairs there; of each tile, its first entry,
   * and, in one word, the texels of common codes (8 bits) and whether the next tile has the same
   * rows; of each entry, the texel of the slot; the bytes of a line of slots.
   */
  Words MakeRows() const;
  Words MakeTiles() const;
  Words MakeEntries() const;
  Words MakeBytes(int line) const;
  ///@}

  /// For each code and each group of four bands, the values of the bands' kernels: a line of texels
  /// for each group.
  std::vector<float> MakeBook(int groups) const;

private:
  using CodedRows = vtkExchangeHierarchy::CodedRows;

  /// What a row has in a tile.
  struct Piece
  {
    std::int64_t FirstByte;
    int Tile;
    int Pairs;
  };

  void FindPieces();
  void PlaceBytes();
  int CountTexels(int slot) const;
  static int CountPairTexels(const Piece& piece);
  void AppendPiece(const Piece& piece, std::vector<std::uint8_t>& bytes) const;

  const vtkExchangeHierarchy& Hierarchy;
  const CodedRows& Coded;
  const HierarchyLayout& Slots;
  const int Width;
  const int MaximumHeight;
  bool Fit = true;
  std::vector<int> Entries;                ///< the slots of all tiles
  std::vector<std::uint32_t> FirstEntries; ///< of each tile
  std::vector<std::vector<Piece>> Pieces;  ///< of each slot
  std::vector<std::vector<int>> Lines;     ///< slots of each line of them
  std::vector<int> FirstTexels;            ///< of each slot, in its texture
  std::vector<Part> Parts;
};
} // namespace LightTransport

#endif
