// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Products/CommonGatherGL.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceSession.h"
#include "vtkLightTransportProductsHierarchyGatherCommonFS.h"
#include "vtkLightTransportProductsHierarchyHearEntriesFS.h"

#include "vtkShaderProgram.h"

#include <string>

namespace LightTransport
{
namespace
{
/// Each round begins at a multiple of what it may have, whatever it has: ranges of buffers must.
constexpr int LinksOfRound = CommonLinks::MostLinksPerRound;
} // namespace

//------------------------------------------------------------------------------
CommonGatherGL::CommonGatherGL(FloatTextures& engine, const FloatVectors::Layout& layout)
  : Engine(engine), Vectors(layout)
{
}

//------------------------------------------------------------------------------
CommonGatherGL::~CommonGatherGL()
{
  if (this->Engine.IsAlive())
  {
    const OpenGLContextGuard guard(this->Engine.GetWindow());
    this->Constants.Release();
  }
}

//------------------------------------------------------------------------------
double CommonGatherGL::GetNumberOfBytes(const CommonLinks& links, int width)
{
  double bytes = 0.0;
  for (const CommonLinks::Part& part : links.GetParts())
  {
    bytes += static_cast<double>(part.Lines) * links.GetHeight(part.Round) * width *
      FloatTextures::BytesPerTexel;
  }
  return bytes;
}

//------------------------------------------------------------------------------
Outcome CommonGatherGL::Initialize(const HierarchyLayout& tables, int kernels,
  const ProductGL::Pause& pause)
{
  const CommonLinks& links = tables.GetCommon();
  const int width = this->Vectors.Width;
  const int slotLines = FloatTextures::DivideUp(links.GetNumberOfRounds() * LinksOfRound, width);
  this->Kernels = kernels;
  Outcome allocated =
    this->Engine.Allocate(this->Slots, 1, width, slotLines, FloatTextures::Texel::Word);
  allocated = allocated ? this->Engine.Allocate(this->Heard,
                            static_cast<std::size_t>(this->Vectors.Groups), width, slotLines)
                        : allocated;
  allocated = allocated
    ? this->Constants.Reserve(vtkIdType(this->Vectors.Groups) * width * slotLines, 0)
    : allocated;
  for (const CommonLinks::Part& part : links.GetParts())
  {
    const int height = links.GetHeight(part.Round);
    this->Parts.push_back({ part.Round, part.Round * tables.GetPatches().Lines + part.FirstLine,
      part.Lines, height / kernels });
    this->Values.emplace_back();
    allocated = allocated
      ? this->Engine.Allocate(this->Values.back(), 1, width, part.Lines * height)
      : allocated;
  }
  if (allocated)
  {
    this->Upload(tables, pause);
  }
  return allocated;
}

//------------------------------------------------------------------------------
void CommonGatherGL::Upload(const HierarchyLayout& tables, const ProductGL::Pause& pause)
{
  const CommonLinks& links = tables.GetCommon();
  std::vector<std::uint32_t> slots(
    std::size_t(this->Slots[0]->GetWidth()) * this->Slots[0]->GetHeight(), 0);
  auto link = links.GetSlots().begin();
  for (int round = 0; round < links.GetNumberOfRounds(); ++round)
  {
    std::uint32_t* texel = slots.data() + std::size_t(LinksOfRound) * round;
    for (int k = 0; k < links.GetNumberOfLinks(round); ++k)
    {
      *texel++ = static_cast<std::uint32_t>(tables.GetSlotTexel(*link++));
    }
  }
  this->Engine.UploadTable(this->Slots, slots);
  for (std::size_t index = 0; index < this->Values.size(); ++index)
  {
    const CommonLinks::Part& part = links.GetParts()[index];
    this->Engine.UploadLines(
      this->Values[index][0], part.FirstLine, part.FirstLine + part.Lines,
      [&](int line) { return links.MakeValues(part.Round, line); }, pause);
  }
}

//------------------------------------------------------------------------------
Outcome CommonGatherGL::Draw(const Group& target, int firstLine, const Group& sent)
{
  if (Outcome heard = this->Hear(sent); !heard)
  {
    return heard;
  }
  Outcome used = Outcome::Done();
  for (std::size_t index = 0; used && index < this->Parts.size(); ++index)
  {
    const Part& part = this->Parts[index];
    vtkShaderProgram* program = nullptr;
    used = this->Use(program, part.TexelsOfKernel);
    if (!used)
    {
      break;
    }
    this->Engine.SetTextures(program, "values", this->Values[index]);
    this->SetConstants(program, part.Round);
    program->SetUniformi("firstLine", firstLine + part.Line);
    const int region[4] = { 0, firstLine + part.Line, this->Vectors.Width, part.Lines };
    this->Engine.Draw(target, region);
    // As in HierarchicalProductGL::GatherLinks.
    glFlush();
  }
  this->LetGoOfConstants();
  return used;
}

//------------------------------------------------------------------------------
Outcome CommonGatherGL::Use(vtkShaderProgram*& program, int texelsOfKernel)
{
  const std::string texels = std::to_string(texelsOfKernel);
  return this->Engine.Use(program, "GatherCommon" + texels,
    vtkLightTransportProductsHierarchyGatherCommonFS,
    this->Vectors.GetDefines(this->Vectors.Groups) + "#define KERNELS " +
      std::to_string(this->Kernels) + "\n#define MOST_LINKS " + std::to_string(LinksOfRound) +
      "\n#define TEXELS " + texels + "\n");
}

//------------------------------------------------------------------------------
// From texels into the buffer, both on the device.
Outcome CommonGatherGL::Hear(const Group& sent)
{
  vtkShaderProgram* program = nullptr;
  Outcome used =
    this->Engine.Use(program, "HearEntries", vtkLightTransportProductsHierarchyHearEntriesFS,
      this->Vectors.GetDefines(this->Vectors.Groups));
  if (used)
  {
    const int width = static_cast<int>(this->Slots[0]->GetWidth());
    const int lines = static_cast<int>(this->Slots[0]->GetHeight());
    this->Engine.SetTextures(program, "entries", this->Slots);
    this->Engine.SetTextures(program, "sent", sent);
    const int region[4] = { 0, 0, width, lines };
    this->Engine.Draw(this->Heard, region);
    this->Engine.Copy(this->Constants, this->Heard);
  }
  return used;
}

//------------------------------------------------------------------------------
void CommonGatherGL::SetConstants(vtkShaderProgram* program, int round)
{
  const auto handle = static_cast<GLuint>(program->GetHandle());
  const vtkIdType bytes = LinksOfRound * this->Constants.GetBytesPerRecord();
  const vtkIdType bytesOfGroup =
    this->Constants.GetCapacity() / this->Vectors.Groups * this->Constants.GetBytesPerRecord();
  for (int group = 0; group < this->Vectors.Groups; ++group)
  {
    const std::string name = "Common[" + std::to_string(group) + "]";
    const auto binding = static_cast<GLuint>(group);
    glUniformBlockBinding(handle, glGetUniformBlockIndex(handle, name.c_str()), binding);
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, this->Constants.GetHandle(),
      group * bytesOfGroup + round * bytes, bytes);
  }
}

//------------------------------------------------------------------------------
// Other programs of this context begin with the same places.
void CommonGatherGL::LetGoOfConstants()
{
  for (int group = 0; group < this->Vectors.Groups; ++group)
  {
    glBindBufferBase(GL_UNIFORM_BUFFER, static_cast<GLuint>(group), 0);
  }
}
} // namespace LightTransport
