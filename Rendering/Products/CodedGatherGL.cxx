// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/CodedGatherGL.h"

#include "Context/OpenGLFunctions.h"
#include "vtkLightTransportProductsHierarchyGatherCodesFS.h"
#include "vtkLightTransportProductsHierarchyHearEntriesFS.h"

#include "vtkShaderProgram.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
CodedGatherGL::CodedGatherGL(FloatTextures& engine, const FloatVectors::Layout& layout)
  : Engine(engine), Vectors(layout)
{
}

//------------------------------------------------------------------------------
double CodedGatherGL::GetNumberOfBytes(const CodedLayout& tables, int width)
{
  double bytes = 0.0;
  for (const CodedLayout::Part& part : tables.GetParts())
  {
    bytes += static_cast<double>(part.Height) * width * FloatTextures::BytesPerTexel;
  }
  return bytes;
}

//------------------------------------------------------------------------------
Outcome CodedGatherGL::Initialize(const CodedLayout& tables, const ProductGL::Pause& pause)
{
  using Texel = FloatTextures::Texel;
  const int width = this->Vectors.Width;
  const int groups = this->Vectors.Groups;
  this->Parts = tables.GetParts();
  this->EntryLines = tables.GetNumberOfEntryLines();
  Outcome allocated = Outcome::Done();
  const auto allocate = [&](Group& group, int textures, int columns, int lines, Texel texel)
  {
    allocated = allocated
      ? this->Engine.Allocate(group, static_cast<std::size_t>(textures), columns, lines, texel)
      : allocated;
  };
  allocate(this->Rows, 1, width, tables.GetNumberOfRowLines(), Texel::TwoWords);
  allocate(this->Tiles, 1, width, tables.GetNumberOfTileLines(), Texel::TwoWords);
  allocate(this->Entries, 1, width, this->EntryLines, Texel::Word);
  allocate(this->Book, 1, vtkExchangeHierarchy::CodedRows::BookSize, groups, Texel::Floats);
  allocate(this->Heard, groups, width, this->EntryLines, Texel::Floats);
  for (const CodedLayout::Part& part : this->Parts)
  {
    this->Bytes.emplace_back();
    allocate(this->Bytes.back(), 1, width, part.Height, Texel::FourWords);
  }
  if (allocated)
  {
    this->Upload(tables, pause);
  }
  return allocated;
}

//------------------------------------------------------------------------------
void CodedGatherGL::Upload(const CodedLayout& tables, const ProductGL::Pause& pause)
{
  this->Engine.UploadTable(this->Rows, tables.MakeRows());
  this->Engine.UploadTable(this->Tiles, tables.MakeTiles());
  this->Engine.UploadTable(this->Entries, tables.MakeEntries());
  this->Engine.UploadTable(this->Book, tables.MakeBook(this->Vectors.Groups));
  for (std::size_t part = 0; part < this->Parts.size(); ++part)
  {
    const int begin = this->Parts[part].FirstLine;
    this->Engine.UploadLines(
      this->Bytes[part][0], begin, begin + this->Parts[part].Lines,
      [&tables](int line) { return tables.MakeBytes(line); }, pause);
  }
}

//------------------------------------------------------------------------------
Outcome CodedGatherGL::Draw(const Group& target, int firstLine, const Group& sent)
{
  if (Outcome heard = this->HearEntries(sent); !heard)
  {
    return heard;
  }
  vtkShaderProgram* program = nullptr;
  const Outcome used =
    this->Engine.Use(program, "GatherCodes", vtkLightTransportProductsHierarchyGatherCodesFS,
      this->Vectors.GetDefines(this->Vectors.Groups));
  for (std::size_t part = 0; used && part < this->Parts.size(); ++part)
  {
    this->Engine.SetTextures(program, "rows", this->Rows);
    this->Engine.SetTextures(program, "tiles", this->Tiles);
    this->Engine.SetTextures(program, "bytes", this->Bytes[part]);
    this->Engine.SetTextures(program, "book", this->Book);
    this->Engine.SetTextures(program, "heard", this->Heard);
    program->SetUniformi("firstLine", firstLine);
    const int region[4] = { 0, firstLine + this->Parts[part].FirstLine, this->Vectors.Width,
      this->Parts[part].Lines };
    this->Engine.Draw(target, region);
    // As in HierarchicalProductGL::GatherLinks.
    glFlush();
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome CodedGatherGL::HearEntries(const Group& sent)
{
  vtkShaderProgram* program = nullptr;
  Outcome used =
    this->Engine.Use(program, "HearEntries", vtkLightTransportProductsHierarchyHearEntriesFS,
      this->Vectors.GetDefines(this->Vectors.Groups));
  if (used)
  {
    this->Engine.SetTextures(program, "entries", this->Entries);
    this->Engine.SetTextures(program, "sent", sent);
    const int region[4] = { 0, 0, this->Vectors.Width, this->EntryLines };
    this->Engine.Draw(this->Heard, region);
  }
  return used;
}
} // namespace LightTransport
