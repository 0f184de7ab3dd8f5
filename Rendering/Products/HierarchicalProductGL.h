// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The product with a vtkExchangeHierarchy: up-sweep, gather and down-sweep, with the tables of
 * HierarchyLayout.
 *
 * OpenGL 3.2 does not let a texture be read while it is drawn into: what a sweep draws for one
 * level of the tree is drawn beside and copied in. Gathering sums pieces of rows, and the
 * down-sweep adds them up, compensated.
 */
#ifndef HierarchicalProductGL_h
#define HierarchicalProductGL_h

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
  int GetNumberOfLinkTextures() const override { return static_cast<int>(this->Links.size()); }

private:
  using Range = HierarchyLayout::Range;
  using Tile = HierarchyLayout::Tile;

  Outcome Allocate(const HierarchyLayout& tables);
  void Upload(const HierarchyLayout& tables, const Pause& pause);
  void UploadTable(const Group& table, const std::vector<float>& texels);
  void UploadLinks(const HierarchyLayout& tables, const Pause& pause);

  Outcome Use(vtkShaderProgram*& program, const char* name, const char* body,
    const std::string& extra = "");
  Outcome SweepUp(const Group& source);
  Outcome GatherLinks();
  Outcome SweepDown(const Group& target);
  Outcome UseSums(vtkShaderProgram*& program, bool ofPatches);
  void DrawBeside(const Range& range, const Group& target, int line);

  std::vector<Range> Levels; ///< of nodes
  Range Patches{};
  int PieceLines = 0;
  int LinksPerTexel = 0;
  int TexelsPerLink = 0;
  std::vector<Tile> Tiles;
  std::vector<Group> Links; ///< of each tile
  Group Children;
  Group Rows;
  Group Lines;
  Group Sent;   ///< by slots
  Group Parts;  ///< sums by pieces, then what nodes receive
  Group Beside; ///< a level of either
};
} // namespace LightTransport

#endif
