// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The sums over the coded rows of a vtkExchangeHierarchy, with the tables of CodedLayout: what the
 * slots of the tiles send is copied into one place, then a fragment for each row adds up its links.
 */
#ifndef CodedGatherGL_h
#define CodedGatherGL_h

#include "Products/CodedLayout.h"
#include "Products/ProductGL.h"

namespace LightTransport
{
class CodedGatherGL
{
public:
  using Group = FloatTextures::Group;

  CodedGatherGL(FloatTextures& engine, const FloatVectors::Layout& layout);

  /// Bytes of the links on the device.
  static double GetNumberOfBytes(const CodedLayout& tables, int width);

  /// Takes memory for the tables, and uploads them.
  Outcome Initialize(const CodedLayout& tables, const ProductGL::Pause& pause);

  /// Into the lines of slots of `target` that have coded rows; slots begin at `firstLine`.
  Outcome Draw(const Group& target, int firstLine, const Group& sent);

  int GetNumberOfTextures() const { return static_cast<int>(this->Bytes.size()); }

private:
  void Upload(const CodedLayout& tables, const ProductGL::Pause& pause);
  Outcome HearEntries(const Group& sent);

  FloatTextures& Engine;
  const FloatVectors::Layout Vectors;
  int EntryLines = 0;
  std::vector<CodedLayout::Part> Parts;
  std::vector<Group> Bytes; ///< of each part
  Group Rows;
  Group Tiles;
  Group Entries;
  Group Book;
  Group Heard; ///< by entries
};
} // namespace LightTransport

#endif
