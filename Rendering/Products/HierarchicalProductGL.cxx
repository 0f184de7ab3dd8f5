// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/HierarchicalProductGL.h"

#include "Context/OpenGLFunctions.h"
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
Outcome HierarchicalProductGL::Initialize(vtkExchangeHierarchy* hierarchy, const Pause& pause)
{
  const HierarchyLayout tables(*hierarchy, this->Vectors.Width, this->Vectors.MaximumSize);
  const CodedLayout codes(*hierarchy, tables, this->Vectors.Width, this->Vectors.MaximumSize);
  if (!tables.Fits() || !codes.Fits())
  {
    return Outcome::Failed(std::to_string(hierarchy->GetNumberOfLinks()) + " links between " +
      std::to_string(hierarchy->GetNumberOfSlots()) +
      " clusters and patches are too many for OpenGL's textures of at most " +
      std::to_string(this->Vectors.MaximumSize) + " texels a side");
  }
  this->Levels = tables.GetLevels();
  this->Receivers = tables.HaveNodesRows() ? this->Levels : std::vector<Range>();
  this->Patches = tables.GetPatches();
  this->Tiles = tables.GetTiles();
  this->PieceLines = tables.GetNumberOfPieceLines();
  this->LinksPerTexel = tables.GetLinksPerTexel();
  this->TexelsPerLink = tables.GetTexelsPerLink();
  this->Kernels = hierarchy->GetNumberOfKernels();
  this->CommonLine = this->PieceLines + tables.GetNumberOfNodeLines();
  this->CommonRounds = tables.GetCommon().GetNumberOfRounds();
  this->CodedLine = this->CommonLine + this->CommonRounds * this->Patches.Lines;
  if (this->CommonRounds > 0)
  {
    this->Common = std::make_unique<CommonGatherGL>(this->Engine, this->Vectors);
  }
  if (!codes.GetParts().empty())
  {
    this->Codes = std::make_unique<CodedGatherGL>(this->Engine, this->Vectors);
  }
  double bytes = CodedGatherGL::GetNumberOfBytes(codes, this->Vectors.Width) +
    CommonGatherGL::GetNumberOfBytes(tables.GetCommon(), this->Vectors.Width);
  for (const Tile& tile : this->Tiles)
  {
    bytes += static_cast<double>(tile.Height) * this->Vectors.Width * FloatTextures::BytesPerTexel;
  }
  if (Outcome enough = this->CheckMemory(bytes); !enough)
  {
    return enough;
  }
  if (!this->Allocate(tables))
  {
    return this->RefuseMemory();
  }
  this->Upload(tables, pause);
  const Outcome common = this->InitializeCommon(tables, pause);
  return common ? this->InitializeCodes(codes, pause) : common;
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::InitializeCommon(const HierarchyLayout& tables, const Pause& pause)
{
  return !this->Common || this->Common->Initialize(tables, this->Kernels, pause)
    ? Outcome::Done()
    : this->RefuseMemory();
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::InitializeCodes(const CodedLayout& tables, const Pause& pause)
{
  if (!this->Codes)
  {
    return Outcome::Done();
  }
  // Slots without coded rows are not drawn.
  this->Engine.Clear(this->Parts);
  return this->Codes->Initialize(tables, pause) ? Outcome::Done() : this->RefuseMemory();
}

//------------------------------------------------------------------------------
int HierarchicalProductGL::GetNumberOfLinkTextures() const
{
  return static_cast<int>(this->Links.size()) +
    (this->Common ? this->Common->GetNumberOfTextures() : 0) +
    (this->Codes ? this->Codes->GetNumberOfTextures() : 0);
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::Allocate(const HierarchyLayout& tables)
{
  Outcome allocated = Outcome::Done();
  const auto allocate = [&](Group& group, int textures, int width, int lines)
  {
    if (allocated)
    {
      allocated = this->Engine.Allocate(group, static_cast<std::size_t>(textures), width, lines);
    }
  };
  const int width = this->Vectors.Width;
  const int groups = this->Vectors.Groups;
  const int nodeLines = tables.GetNumberOfNodeLines();
  const int slotLines = tables.GetNumberOfSlotLines();
  allocate(this->Children, 1, width, nodeLines);
  allocate(this->Rows, 1, width, slotLines);
  allocate(this->Sent, groups, width, slotLines);
  allocate(this->Beside, groups, width, nodeLines);
  allocate(this->Parts, groups, width, this->CodedLine + (this->Codes ? slotLines : 0));
  allocate(this->Lines, 1, 1, std::max(this->PieceLines, 1));
  for (const Tile& tile : this->Tiles)
  {
    this->Links.emplace_back();
    allocate(this->Links.back(), 1, width, tile.Height);
  }
  return allocated;
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::Upload(const HierarchyLayout& tables, const Pause& pause)
{
  this->Engine.UploadTable(this->Children, tables.MakeChildren());
  this->Engine.UploadTable(this->Rows, tables.MakeRows());
  if (!this->Tiles.empty())
  {
    this->Engine.UploadTable(this->Lines, tables.MakeLines());
    this->UploadLinks(tables, pause);
  }
}

//------------------------------------------------------------------------------
void HierarchicalProductGL::UploadLinks(const HierarchyLayout& tables, const Pause& pause)
{
  for (std::size_t tile = 0; tile < this->Tiles.size(); ++tile)
  {
    const int begin = this->Tiles[tile].FirstLine;
    this->Engine.UploadLines(
      this->Links[tile][0], begin, begin + this->Tiles[tile].Lines,
      [&tables](int line) { return tables.MakeLinks(line); }, pause);
  }
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::Use(vtkShaderProgram*& program, const char* name, const char* body,
  const std::string& extra)
{
  return this->Engine.Use(program, name, body,
    this->Vectors.GetDefines(this->Vectors.Groups) + extra);
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::Draw(Group& target, const Group& source)
{
  if (Outcome swept = this->SweepUp(source); !swept)
  {
    return swept;
  }
  if (Outcome gathered = this->GatherLinks(); !gathered)
  {
    return gathered;
  }
  return this->SweepDown(target);
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::SweepUp(const Group& source)
{
  vtkShaderProgram* program = nullptr;
  if (Outcome used =
        this->Use(program, "WeighPatches", vtkLightTransportProductsHierarchyWeighPatchesFS);
      !used)
  {
    return used;
  }
  this->Engine.SetTextures(program, "rows", this->Rows);
  this->Engine.SetTextures(program, "vector", source);
  program->SetUniformi("firstLine", this->Patches.FirstLine);
  const int region[4] = { 0, this->Patches.FirstLine, this->Vectors.Width, this->Patches.Lines };
  this->Engine.Draw(this->Sent, region);

  const Outcome used =
    this->Use(program, "SumChildren", vtkLightTransportProductsHierarchySumChildrenFS);
  for (auto level = this->Levels.rbegin(); used && level != this->Levels.rend(); ++level)
  {
    this->Engine.SetTextures(program, "children", this->Children);
    this->Engine.SetTextures(program, "sent", this->Sent);
    this->DrawBeside(*level, this->Sent, level->FirstLine);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::GatherLinks()
{
  vtkShaderProgram* program = nullptr;
  Outcome used = this->Use(program, "GatherLinks", vtkLightTransportProductsHierarchyGatherLinksFS,
    "#define LINKS_PER_TEXEL " + std::to_string(this->LinksPerTexel) +
      "\n#define TEXELS_PER_LINK " + std::to_string(this->TexelsPerLink) + "\n#define KERNELS " +
      std::to_string(this->Kernels) + "\n");
  for (std::size_t tile = 0; used && tile < this->Tiles.size(); ++tile)
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
  if (used && this->Common)
  {
    used = this->Common->Draw(this->Parts, this->CommonLine, this->Sent);
  }
  return used && this->Codes ? this->Codes->Draw(this->Parts, this->CodedLine, this->Sent) : used;
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::SweepDown(const Group& target)
{
  vtkShaderProgram* program = nullptr;
  for (const Range& level : this->Receivers)
  {
    if (Outcome used = this->UseSums(program, false); !used)
    {
      return used;
    }
    this->DrawBeside(level, this->Parts, this->PieceLines + level.FirstLine);
  }
  const Outcome used = this->UseSums(program, true);
  if (used)
  {
    program->SetUniformi("firstLine", this->Patches.FirstLine);
    const int region[4] = { 0, 0, this->Vectors.Width, this->Vectors.Height };
    this->Engine.Draw(target, region);
  }
  return used;
}

//------------------------------------------------------------------------------
Outcome HierarchicalProductGL::UseSums(vtkShaderProgram*& program, bool ofPatches)
{
  const Outcome used = this->Use(program, ofPatches ? "SumPiecesOfPatches" : "SumPieces",
    vtkLightTransportProductsHierarchySumPiecesFS,
    std::string(ofPatches ? "#define PATCHES 1\n" : "#define PATCHES 0\n") +
      (this->Receivers.empty() ? "#define PARENTS 0\n" : "#define PARENTS 1\n") +
      (this->Codes ? "#define CODED 1\n" : "#define CODED 0\n") +
      (this->Common && ofPatches ? "#define COMMON 1\n" : "#define COMMON 0\n"));
  if (used)
  {
    this->Engine.SetTextures(program, "rows", this->Rows);
    this->Engine.SetTextures(program, "parts", this->Parts);
    if (this->Codes)
    {
      program->SetUniformi("codedLine", this->CodedLine);
    }
    if (this->Common && ofPatches)
    {
      program->SetUniformi("commonLine", this->CommonLine);
      program->SetUniformi("commonRounds", this->CommonRounds);
      program->SetUniformi("linesOfRound", this->Patches.Lines);
    }
  }
  return used;
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
