// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the tables of a vtkExchangeHierarchy lie in RGBA textures. What most patches are linked with
 * is a table of its own, CommonLinks.
 *
 * Slots are texels, each level of the tree and the patches from a line of their own on, so that
 * they are rectangles to draw.
 *
 * Rows of links differ in length, from none to that of the root. Each is cut into equal pieces of
 * at most 64 links, one fragment each. Pieces are sorted by length and lie side by side in lines,
 * the links of a piece below each other: neighbouring fragments take equally long and read what
 * lies side by side in memory, and next to nothing is filled up (sliced ELLPACK: M. Kreutzer et
 * al., SIAM J. Sci. Comput. 36, C401, 2014). The links of several lines share a texture, a tile.
 *
 * A texel holds two links of one kernel, each the texel of a slot and a value. With more kernels a
 * link is the texel of a slot and all its values, four numbers a texel, in texels below each other.
 *
 * Texels are numbered line by line; single precision holds these numbers exactly up to
 * FloatTextures::MaximumTexels.
 */
#ifndef HierarchyLayout_h
#define HierarchyLayout_h

#include "Products/CommonLinks.h"

#include "vtkExchangeHierarchy.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace LightTransport
{
class HierarchyLayout
{
public:
  /// Slots from the start of a line on.
  struct Range
  {
    int Slots;
    int FirstLine;
    int Lines;
  };

  /// Lines of pieces, and the height of the texture that holds their links.
  struct Tile
  {
    int FirstLine;
    int Lines;
    int Height;
  };

  using Texels = std::vector<float>;

  HierarchyLayout(const vtkExchangeHierarchy& hierarchy, int width, int maximumHeight);

  ///@{ How links lie in texels: several of them in one, or one in several.
  int GetLinksPerTexel() const { return this->LinksPerTexel; }
  int GetTexelsPerLink() const { return this->TexelsPerLink; }
  ///@}

  /// False when some texture would be too large.
  bool Fits() const;

  /// Whether nodes receive anything, which their patches get from them.
  bool HaveNodesRows() const;

  const std::vector<Range>& GetLevels() const { return this->Levels; }
  const Range& GetPatches() const { return this->Patches; }
  const CommonLinks& GetCommon() const { return this->Common; }
  const std::vector<Tile>& GetTiles() const { return this->Tiles; }
  int GetSlotTexel(int slot) const { return this->SlotTexels[static_cast<std::size_t>(slot)]; }
  int GetNumberOfSlotLines() const { return this->Patches.FirstLine + this->Patches.Lines; }
  int GetNumberOfNodeLines() const { return this->Patches.FirstLine; }
  int GetNumberOfPieceLines() const { return static_cast<int>(this->Heights.size()); }

  ///@{
  /**
   * The tables: of each node, the texel of the first child and how many there are; of each slot,
   * its first piece, how many there are, the texel of its parent (-1 without), counted behind the
   * lines of pieces, and its weight; of each line of pieces, its first line in the tile's texture
   * and how many there are; and the links in these lines.
   */
  Texels MakeChildren() const;
  Texels MakeRows() const;
  Texels MakeLines() const;
  Texels MakeLinks(int lineOfPieces) const;
  ///@}

private:
  /// A row's links, or some of them.
  struct Piece
  {
    std::int64_t First;
    int Links;
  };

  int CountTexels(std::int64_t links) const;
  std::pair<std::int64_t, std::int64_t> GetRow(int slot) const;
  void LeaveOutCommon();
  void PlaceSlots();
  Range PlaceRange(int first, int last);
  void CutRows();
  void PlacePieces();

  const vtkExchangeHierarchy& Hierarchy;
  const int Width;
  const int MaximumHeight;
  const int LinksPerTexel;
  const int TexelsPerLink;
  const CommonLinks Common;
  ///@{ The links that are not common, where some are: rows as the hierarchy has them.
  std::vector<std::int64_t> OtherOffsets;
  std::vector<std::int64_t> OtherLinks;
  ///@}
  std::vector<Range> Levels;
  Range Patches{};
  std::vector<int> SlotTexels;
  std::vector<Piece> Pieces;
  std::vector<int> FirstPieces; ///< of each slot
  std::vector<int> PieceCounts; ///< likewise
  std::vector<int> Heights;     ///< of each line of pieces
  std::vector<Tile> Tiles;
};
} // namespace LightTransport

#endif
