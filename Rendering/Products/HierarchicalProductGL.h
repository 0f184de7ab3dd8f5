// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product with a vtkExchangeHierarchy: up-sweep, gather and down-sweep, with the tables of
 * HierarchyLayout.
 *
 * Links that patches have in common are gathered by CommonGatherGL, coded rows by CodedGatherGL;
 * their sums are added to those of the pieces.
 *
 * OpenGL 3.2 does not let a texture be read while it is drawn into: what a sweep draws for one
 * level of the tree is drawn beside and copied in. Gathering sums pieces of rows, and the
 * down-sweep adds them up, compensated.
 */
#ifndef HierarchicalProductGL_h
#define HierarchicalProductGL_h

#include "Products/CodedGatherGL.h"
#include "Products/CommonGatherGL.h"
#include "Products/HierarchyLayout.h"
#include "Products/ProductGL.h"

namespace LightTransport
{
class HierarchicalProductGL : public ProductGL
{
public:
  HierarchicalProductGL(FloatTextures& engine, const Layout& layout);

  Outcome Initialize(vtkExchangeHierarchy* hierarchy, const Pause& pause);
  Outcome Draw(Group& target, const Group& source) override;
  int GetNumberOfLinkTextures() const override;

private:
  using Range = HierarchyLayout::Range;
  using Tile = HierarchyLayout::Tile;

  Outcome InitializeCommon(const HierarchyLayout& tables, const Pause& pause);
  Outcome InitializeCodes(const CodedLayout& tables, const Pause& pause);
  Outcome Allocate(const HierarchyLayout& tables);
  void Upload(const HierarchyLayout& tables, const Pause& pause);
  void UploadLinks(const HierarchyLayout& tables, const Pause& pause);

  Outcome Use(vtkShaderProgram*& program, const char* name, const char* body,
    const std::string& extra = "");
  Outcome SweepUp(const Group& source);
  Outcome GatherLinks();
  Outcome SweepDown(const Group& target);
  Outcome UseSums(vtkShaderProgram*& program, bool ofPatches);
  void DrawBeside(const Range& range, const Group& target, int line);

  std::vector<Range> Levels;    ///< of nodes
  std::vector<Range> Receivers; ///< likewise, none where no node receives anything
  Range Patches{};
  int PieceLines = 0;
  int LinksPerTexel = 0;
  int TexelsPerLink = 0;
  int Kernels = 0;
  int CommonLine = 0; ///< where sums of common links begin, rounds of patches
  int CommonRounds = 0;
  int CodedLine = 0;                      ///< where sums of coded rows begin
  std::unique_ptr<CommonGatherGL> Common; ///< where there are common links
  std::unique_ptr<CodedGatherGL> Codes;   ///< where there are coded rows
  std::vector<Tile> Tiles;
  std::vector<Group> Links; ///< of each tile
  Group Children;
  Group Rows;
  Group Lines;
  Group Sent; ///< by slots
  /// Sums by pieces, then what nodes receive, then sums of common links by patches, round after
  /// round, then sums of coded rows by slots.
  Group Parts;
  Group Beside; ///< a level of either
};
} // namespace LightTransport

#endif
