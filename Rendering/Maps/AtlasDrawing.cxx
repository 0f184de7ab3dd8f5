// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/AtlasDrawing.h"

#include "Context/OpenGLFunctions.h"
#include "Passes/PlainMapper.h"
#include "vtkLightTransportMapsAtlasVS.h"
#include "vtkLightTransportTexturesCommonFS.h"

#include "vtkActor.h"
#include "vtkMatrix3x3.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPolyData.h"
#include "vtkShaderProgram.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome AtlasDrawing::FindSurface(vtkActor* actor, vtkPolyData*& surface)
{
  vtkPolyDataMapper* mapper = actor ? FindPlainMapper(actor->GetMapper()) : nullptr;
  if (!mapper)
  {
    return Outcome::Failed("An actor with a material needs a vtkPolyDataMapper with a surface that "
                           "vtkSurfaceAtlas made, or one of composite data with such blocks.");
  }
  mapper->Update();
  surface = mapper->GetInput();
  return surface ? Outcome::Done()
                 : Outcome::Failed("The mapper of an actor with a material has no surface: connect "
                                   "one that vtkSurfaceAtlas made.");
}

//------------------------------------------------------------------------------
Outcome AtlasDrawing::SetSurface(vtkPolyData* data)
{
  Outcome set = this->Surface.Read(data);
  set = set ? this->Triangles.Upload(this->Surface.Corners, ChartedSurface::FloatsPerCorner) : set;
  return set ? this->Points.Upload(this->Engine, this->Surface.Points) : set;
}

//------------------------------------------------------------------------------
Outcome AtlasDrawing::CheckSize(int size, const char* name) const
{
  if ((size & (size - 1)) != 0)
  {
    return Outcome::Failed(std::string(name) + " is " + std::to_string(size) +
      ", which is no power of two: choose one.");
  }
  return size >= this->Surface.SmallestMap
    ? Outcome::Done()
    : Outcome::Failed(std::string(name) + " is " + std::to_string(size) +
        ", and the smallest chart has a texel of its own from " +
        std::to_string(this->Surface.SmallestMap) + " on: choose at least that.");
}

//------------------------------------------------------------------------------
Outcome AtlasDrawing::Use(vtkShaderProgram*& program, const char* body, int outputs,
  const Light& light)
{
  const std::string choices = std::string(light.IsAtCorners ? "#define IS_LIT_AT_CORNERS\n" : "") +
    (light.HasBumps ? "#define HAS_BUMPS\n" : "") + "#define TABLE_WIDTH_BITS " +
    std::to_string(TupleTable::WidthBits) + "\n#define VALUE_ENTRIES " +
    std::to_string(light.ValueEntries) + "\n";
  std::string vertices = vtkLightTransportMapsAtlasVS;
  vtkShaderProgram::Substitute(vertices, "//VTK::LightTransport::Define", choices);
  vtkShaderProgram::Substitute(vertices, "//VTK::LightTransport::Light", light.Code);
  std::string source = vtkLightTransportTexturesCommonFS;
  vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Define",
    FloatTextures::GetDefines(1, outputs, 2) + choices);
  source += body;
  vtkShaderProgram::Substitute(source, "//VTK::LightTransport::Light", light.Code);
  program = this->Engine.GetWindow()->GetShaderCache()->ReadyShaderProgram(vertices.c_str(),
    source.c_str(), "");
  const Outcome compiled = FloatTextures::CheckProgram(program);
  if (compiled)
  {
    SetMove(program, { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  }
  return compiled;
}

//------------------------------------------------------------------------------
// Normals turn with the inverse transpose.
void AtlasDrawing::SetMove(vtkShaderProgram* program, std::array<float, 16> move)
{
  program->SetUniformMatrix4x4("toScene", move.data());
  double turn[9];
  for (int k = 0; k < 9; ++k)
  {
    turn[k] = move[4 * (k / 3) + k % 3];
  }
  const double sense = vtkMatrix3x3::Determinant(turn) < 0.0 ? -1.0 : 1.0;
  vtkMatrix3x3::Invert(turn, turn);
  vtkMatrix3x3::Transpose(turn, turn);
  float values[9];
  for (int k = 0; k < 9; ++k)
  {
    values[k] = static_cast<float>(sense * turn[k]);
  }
  program->SetUniformMatrix3x3("turn", values);
}

//------------------------------------------------------------------------------
Outcome AtlasDrawing::AddSamples(vtkShaderProgram* program, const FloatTextures::Group& target,
  int samples)
{
  vtkOpenGLState* state = this->Engine.GetWindow()->GetState();
  const vtkOpenGLState::ScopedglBlendFuncSeparate blending(state);
  const vtkOpenGLState::ScopedglEnableDisable enabled(state, GL_BLEND);
  const int size = static_cast<int>(target[0]->GetWidth());
  this->Engine.Bind(target);
  state->vtkglViewport(0, 0, size, size);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendEquation(GL_FUNC_ADD);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  program->SetUniformf("weight", 1.0f / static_cast<float>(samples * samples));
  Outcome drawn = Outcome::Done();
  for (int sample = 0; drawn && sample < samples * samples; ++sample)
  {
    const auto place = [&](int step)
    { return static_cast<float>(((step + 0.5) / samples - 0.5) / size); };
    const float shift[2] = { place(sample % samples), place(sample / samples) };
    program->SetUniform2f("shift", shift);
    drawn = this->Triangles.Draw(program,
      { { "position", 0, 3 }, { "normal", 3, 3 }, { "place", 6, 2 }, { "share", 8, 3 } });
  }
  return drawn;
}
} // namespace LightTransport
