// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/HierarchicalProductGL.h"

#include "Context/LightTransportOpenGL.h"
#include "vtkLightTransportProductsHierarchyGatherLinksFS.h"
#include "vtkLightTransportProductsHierarchySumChildrenFS.h"
#include "vtkLightTransportProductsHierarchySumPiecesFS.h"
#include "vtkLightTransportProductsHierarchyWeighPatchesFS.h"

#include "vtkShaderProgram.h"

#include <algorithm>

namespace LightTransport
{
//------------------------------------------------------------------------------
HierarchicalProductGL::HierarchicalProductGL(FloatTextures& engine, const Layout& layout)
  : ProductGL(engine, layout)
{
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::Initialize(vtkExchangeHierarchy* hierarchy, std::string& reason)
{
  const HierarchyLayout tables(*hierarchy, this->Vectors.Width, this->Vectors.MaximumSize);
  if (!tables.Fits())
  {
    reason = std::to_string(hierarchy->GetNumberOfLinks()) + " links between " +
      std::to_string(hierarchy->GetNumberOfSlots()) +
      " clusters and patches are too many for OpenGL's textures of at most " +
      std::to_string(this->Vectors.MaximumSize) + " texels a side";
    return false;
  }
  this->Levels = tables.GetLevels();
  this->Patches = tables.GetPatches();
  this->Tiles = tables.GetTiles();
  this->PieceLines = tables.GetNumberOfPieceLines();
  double bytes = 0.0;
  for (const Tile& tile : this->Tiles)
  {
    bytes += static_cast<double>(tile.Height) * this->Vectors.Width * FloatTextures::BytesPerTexel;
  }
  if (!this->CheckMemory(bytes, reason))
  {
    return false;
  }
  if (!this->Allocate(tables))
  {
    reason = this->DescribeMemory();
    return false;
  }
  this->Upload(tables);
  return true;
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::Allocate(const HierarchyLayout& tables)
{
  const int width = this->Vectors.Width;
  bool good = true;
  const auto allocate = [&](int groups, int lines)
  {
    Group group = this->Engine.Allocate(static_cast<std::size_t>(groups), width, lines);
    good = good && !group.empty();
    return group;
  };
  const int groups = this->Vectors.Groups;
  this->Children = allocate(1, tables.GetNumberOfNodeLines());
  this->Rows = allocate(1, tables.GetNumberOfSlotLines());
  this->Sent = allocate(groups, tables.GetNumberOfSlotLines());
  this->Beside = allocate(groups, tables.GetNumberOfNodeLines());
  this->Parts = allocate(groups, this->PieceLines + tables.GetNumberOfNodeLines());
  this->Lines = this->Engine.Allocate(1, 1, std::max(this->PieceLines, 1));
  good = good && !this->Lines.empty();
  for (const Tile& tile : this->Tiles)
  {
    this->Links.push_back(allocate(1, tile.Height));
  }
  return good;
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::Upload(const HierarchyLayout& tables)
{
  this->UploadTable(this->Children, tables.MakeChildren());
  this->UploadTable(this->Rows, tables.MakeRows());
  if (!this->Tiles.empty())
  {
    this->UploadTable(this->Lines, tables.MakeLines());
    this->UploadLinks(tables);
  }
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::UploadTable(const Group& table, const std::vector<float>& texels)
{
  const int width = static_cast<int>(table[0]->GetWidth());
  const int region[4] = { 0, 0, width, static_cast<int>(table[0]->GetHeight()) };
  this->Engine.Upload(table[0], region, width, texels.data());
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::UploadLinks(const HierarchyLayout& tables)
{
  const int width = this->Vectors.Width;
  for (std::size_t tile = 0; tile < this->Tiles.size(); ++tile)
  {
    const int begin = this->Tiles[tile].FirstLine;
    int at = 0;
    for (int line = begin; line < begin + this->Tiles[tile].Lines; ++line)
    {
      const std::vector<float> texels = tables.MakeLinks(line);
      const int height = static_cast<int>(texels.size() / 4) / width;
      const int region[4] = { 0, at, width, height };
      this->Engine.Upload(this->Links[tile][0], region, width, texels.data());
      at += height;
    }
  }
}

//------------------------------------------------------------------------------
vtkShaderProgram* HierarchicalProductGL::Use(const char* name, const char* body,
  const std::string& extra)
{
  return this->Engine.Use(name, body, this->Vectors.GetDefines(this->Vectors.Groups) + extra);
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::Draw(Group& target, const Group& source)
{
  return this->SweepUp(source) && this->GatherLinks() && this->SweepDown(target);
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::SweepUp(const Group& source)
{
  vtkShaderProgram* weigh =
    this->Use("WeighPatches", vtkLightTransportProductsHierarchyWeighPatchesFS);
  if (!weigh)
  {
    return false;
  }
  this->Engine.SetTextures(weigh, "rows", this->Rows);
  this->Engine.SetTextures(weigh, "vector", source);
  weigh->SetUniformi("firstLine", this->Patches.FirstLine);
  const int region[4] = { 0, this->Patches.FirstLine, this->Vectors.Width, this->Patches.Lines };
  this->Engine.Draw(this->Sent, region);

  vtkShaderProgram* sum = this->Use("SumChildren", vtkLightTransportProductsHierarchySumChildrenFS);
  for (auto level = this->Levels.rbegin(); sum && level != this->Levels.rend(); ++level)
  {
    this->Engine.SetTextures(sum, "children", this->Children);
    this->Engine.SetTextures(sum, "sent", this->Sent);
    this->DrawBeside(*level, this->Sent, level->FirstLine);
  }
  return sum != nullptr;
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::GatherLinks()
{
  vtkShaderProgram* program =
    this->Use("GatherLinks", vtkLightTransportProductsHierarchyGatherLinksFS);
  for (std::size_t tile = 0; program && tile < this->Tiles.size(); ++tile)
  {
    this->Engine.SetTextures(program, "links", this->Links[tile]);
    this->Engine.SetTextures(program, "lines", this->Lines);
    this->Engine.SetTextures(program, "sent", this->Sent);
    const int region[4] = { 0, this->Tiles[tile].FirstLine, this->Vectors.Width,
      this->Tiles[tile].Lines };
    this->Engine.Draw(this->Parts, region);
    // A bunch of work at a time: a GPU that draws a screen as well is taken away from whoever keeps
    // it for seconds.
    glFlush();
  }
  return program != nullptr;
}

//------------------------------------------------------------------------------
bool HierarchicalProductGL::SweepDown(const Group& target)
{
  for (const Range& level : this->Levels)
  {
    if (!this->UseSums(false))
    {
      return false;
    }
    this->DrawBeside(level, this->Parts, this->PieceLines + level.FirstLine);
  }
  vtkShaderProgram* program = this->UseSums(true);
  if (program)
  {
    program->SetUniformi("firstLine", this->Patches.FirstLine);
    const int region[4] = { 0, 0, this->Vectors.Width, this->Vectors.Height };
    this->Engine.Draw(target, region);
  }
  return program != nullptr;
}

//------------------------------------------------------------------------------
vtkShaderProgram* HierarchicalProductGL::UseSums(bool ofPatches)
{
  vtkShaderProgram* program = this->Use(ofPatches ? "SumPiecesOfPatches" : "SumPieces",
    vtkLightTransportProductsHierarchySumPiecesFS,
    ofPatches ? "#define PATCHES 1\n" : "#define PATCHES 0\n");
  if (program)
  {
    this->Engine.SetTextures(program, "rows", this->Rows);
    this->Engine.SetTextures(program, "parts", this->Parts);
  }
  return program;
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::DrawBeside(const Range& range, const Group& target, int line)
{
  const int region[4] = { 0, range.FirstLine, std::min(range.Slots, this->Vectors.Width),
    range.Lines };
  this->Engine.Draw(this->Beside, region);
  this->Engine.Copy(target, line, this->Beside, region);
}
} // namespace LightTransport
