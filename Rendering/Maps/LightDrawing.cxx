// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/LightDrawing.h"

#include "Maps/SceneUniforms.h"
#include "Maps/ShadowMap.h"
#include "vtkLightTransportMapsHarmonics.h"
#include "vtkLightTransportMapsIrradianceFS.h"
#include "vtkLightTransportMapsLight.h"
#include "vtkLightTransportMapsLightView.h"
#include "vtkLightTransportMapsValues.h"
#include "vtkLightTransportPassesFresnelFS.h"

#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

namespace LightTransport
{
namespace
{
constexpr std::size_t Bands = 3;
/// Weights of a texel of a table.
constexpr int Texel = 4 * Bands;

//------------------------------------------------------------------------------
void Activate(vtkShaderProgram* program, const char* name, vtkTextureObject* texture,
  std::vector<vtkTextureObject*>& active)
{
  texture->Activate();
  program->SetUniformi(name, texture->GetTextureUnit());
  active.push_back(texture);
}
} // namespace

//------------------------------------------------------------------------------
Outcome LightDrawing::Begin(vtkShaderProgram*& program, const AtlasDrawing::Light& light)
{
  Outcome ready = this->Drawing.Use(program, vtkLightTransportMapsIrradianceFS, 1, light);
  if (ready)
  {
    AtlasDrawing::SetMove(program,
      SceneUniforms::MakeMove(this->With.Matrix, this->Drawing.GetSurface().Center,
        this->With.Origin));
    program->SetUniformf("countsArea", this->IsFirst ? 1.0f : 0.0f);
    this->IsFirst = false;
  }
  return ready;
}

//------------------------------------------------------------------------------
Outcome LightDrawing::Draw(vtkShaderProgram* program, const std::vector<vtkTextureObject*>& active)
{
  const Outcome drawn = this->Drawing.AddSamples(program, this->Target, this->With.Samples);
  for (vtkTextureObject* texture : active)
  {
    texture->Deactivate();
  }
  return drawn;
}

//------------------------------------------------------------------------------
Outcome LightDrawing::AddLight(const SceneLight& light, const LightView& view)
{
  AtlasDrawing::Light code;
  code.Code = std::string(vtkLightTransportPassesFresnelFS) + vtkLightTransportMapsLightView +
    vtkLightTransportMapsLight;
  code.IsAtCorners = this->With.IsAtCorners;
  code.HasBumps = !code.IsAtCorners && this->With.Bumps.TextureUnit >= 0;
  vtkShaderProgram* program = nullptr;
  Outcome ready = this->Shadows ? this->Shadows->Draw(view, this->With.Origin) : Outcome::Done();
  ready = ready ? this->Begin(program, code) : ready;
  if (!ready)
  {
    return ready;
  }
  SceneUniforms::SetLight(program, light, this->With.Origin);
  SceneUniforms::SetView(program, view, this->With.Origin);
  program->SetUniformi("hasShadows", this->Shadows ? 1 : 0);
  program->SetUniformf("bias", static_cast<float>(this->With.ShadowBias));
  program->SetUniformf("refractiveIndex", static_cast<float>(this->With.RefractiveIndex));
  std::vector<vtkTextureObject*> active;
  if (this->Shadows)
  {
    Activate(program, "shadows", this->Shadows->GetTexture(), active);
  }
  this->SetBumps(program, code, active);
  return this->Draw(program, active);
}

//------------------------------------------------------------------------------
void LightDrawing::SetBumps(vtkShaderProgram* program, const AtlasDrawing::Light& code,
  std::vector<vtkTextureObject*>& active) const
{
  if (code.HasBumps)
  {
    program->SetUniformi("bumps", this->With.Bumps.TextureUnit);
    program->SetUniformf("bumpScale", static_cast<float>(this->With.Bumps.Scale));
    Activate(program, "tangents", this->With.Bumps.Tangents, active);
  }
}

//------------------------------------------------------------------------------
Outcome LightDrawing::AddHarmonics(const std::vector<double>& entering)
{
  AtlasDrawing::Light code;
  code.Code = vtkLightTransportMapsHarmonics;
  code.IsAtCorners = this->With.IsAtCorners;
  code.HasBumps = !code.IsAtCorners && this->With.Bumps.TextureUnit >= 0;
  vtkShaderProgram* program = nullptr;
  if (Outcome ready = this->Begin(program, code); !ready)
  {
    return ready;
  }
  const std::vector<float> values(entering.begin(), entering.end());
  program->SetUniform3fv("entering", static_cast<int>(values.size() / Bands), values.data());
  std::vector<vtkTextureObject*> active;
  this->SetBumps(program, code, active);
  return this->Draw(program, active);
}

//------------------------------------------------------------------------------
Outcome LightDrawing::AddValues(const Values& values)
{
  AtlasDrawing::Light code;
  code.Code = vtkLightTransportMapsValues;
  code.IsAtCorners = true;
  code.ValueEntries = FloatTextures::DivideUp(static_cast<vtkIdType>(values.Weights.size()), Texel);
  std::vector<float> weights = values.Weights;
  weights.resize(static_cast<std::size_t>(Texel) * code.ValueEntries, 0.0f);
  vtkShaderProgram* program = nullptr;
  if (Outcome ready = this->Begin(program, code); !ready)
  {
    return ready;
  }
  program->SetUniform3fv("weights", static_cast<int>(weights.size() / Bands), weights.data());
  program->SetUniformi("areOfPoints", values.AreOfPoints ? 1 : 0);
  std::vector<vtkTextureObject*> active;
  Activate(program, "values", values.Table, active);
  return this->Draw(program, active);
}

//------------------------------------------------------------------------------
Outcome LightDrawing::Finish()
{
  return this->IsFirst ? this->AddHarmonics(std::vector<double>(9 * Bands, 0.0)) : Outcome::Done();
}
} // namespace LightTransport
