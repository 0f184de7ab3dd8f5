// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/ExactShadows.h"

#include "Maps/SceneLights.h"
#include "Maps/SceneUniforms.h"
#include "vtkLightTransportPassesShadowsFS.h"
#include "vtkLightTransportTracingTree.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <cstddef>
#include <sstream>

namespace LightTransport
{
namespace
{
constexpr const char* Place = "//VTK::LightTransport::Shadows";
/// Where VTK's own code has the place of a fragment.
constexpr const char* Fragment = "vertexVCVSOutput;";
/// Of the scene: nothing nearer casts a shadow.
constexpr double Bias = 1e-5;

std::string GetColor(int light)
{
  return "lightColor" + std::to_string(light);
}
} // namespace

//------------------------------------------------------------------------------
Outcome ExactShadows::Update(vtkRenderer* renderer)
{
  std::vector<SceneLight> lights;
  Outcome done = SceneLights::Read(renderer, lights);
  done = done ? this->Tree.Update(renderer) : done;
  this->Lights.clear();
  for (const SceneLight& light : lights)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Lights.push_back(
        static_cast<float>(light.IsPositional ? light.Position[axis] - this->Tree.GetOrigin()[axis]
                                              : -light.Axis[axis]));
    }
    this->Lights.push_back(light.IsPositional ? 1.0f : 0.0f);
  }
  vtkNew<vtkMatrix4x4> back;
  vtkMatrix4x4::Invert(renderer->GetActiveCamera()->GetModelViewTransformMatrix(), back);
  this->ToScene =
    SceneUniforms::MakeMove(back->GetData(), { 0.0, 0.0, 0.0 }, this->Tree.GetOrigin());
  return done;
}

//------------------------------------------------------------------------------
void ExactShadows::MarkPlace(std::string& fragmentShader)
{
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
    std::string(Place) + "\n//VTK::Light::Impl", false);
}

//------------------------------------------------------------------------------
// VTK's code multiplies all that a light gives by its color, a uniform of the light's number.
void ExactShadows::FillPlace(std::string& fragmentShader)
{
  int lights = 0;
  while (fragmentShader.find("uniform vec3 " + GetColor(lights) + ";") != std::string::npos)
  {
    ++lights;
  }
  const bool isLit = lights > 0 && fragmentShader.find(Fragment) != std::string::npos;
  vtkShaderProgram::Substitute(fragmentShader, Place,
    isLit ? "  LightTransportFindLitLights(vertexVC.xyz);" : "");
  if (!isLit)
  {
    return;
  }
  std::ostringstream code;
  code << "#define LIGHT_TRANSPORT_LIGHTS " << lights << "\n"
       << vtkLightTransportTracingTree << vtkLightTransportPassesShadowsFS;
  for (int light = 0; light < lights; ++light)
  {
    const std::string color = GetColor(light);
    code << "vec3 LightTransportColor" << light << "() { return lightTransportLit[" << light
         << "] * " << color << "; }\n#define " << color << " LightTransportColor" << light
         << "()\n";
  }
  code << "void main()";
  vtkShaderProgram::Substitute(fragmentShader, "void main()", code.str(), false);
}

//------------------------------------------------------------------------------
void ExactShadows::SetUniforms(vtkShaderProgram* program)
{
  if (!this->AreThere() || !program->IsUniformUsed("lightTransportLights"))
  {
    return;
  }
  this->Tree.Activate(program);
  this->IsActive = true;
  program->SetUniform4fv("lightTransportLights", static_cast<int>(this->Lights.size() / 4),
    reinterpret_cast<const float(*)[4]>(this->Lights.data()));
  program->SetUniformMatrix4x4("lightTransportToScene", this->ToScene.data());
  program->SetUniformf("lightTransportShadowBias", static_cast<float>(Bias * this->Tree.GetSize()));
}

//------------------------------------------------------------------------------
void ExactShadows::LetGo()
{
  if (this->IsActive)
  {
    this->Tree.Deactivate();
    this->IsActive = false;
  }
}

//------------------------------------------------------------------------------
void ExactShadows::Clear()
{
  this->LetGo();
  this->Tree.Clear();
}
} // namespace LightTransport
