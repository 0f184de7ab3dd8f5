// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/ExactShadows.h"

#include "Passes/PlainMapper.h"
#include "Tracing/SceneTree.h"
#include "vtkLightTransportPassesShadowsFS.h"
#include "vtkLightTransportTracingTree.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
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

std::string GetColor(int light)
{
  return "lightColor" + std::to_string(light);
}
} // namespace

//------------------------------------------------------------------------------
// All lights that are on have their place in the list, since VTK's shaders number them.
Outcome ExactShadows::Update(vtkRenderer* renderer, const SceneTree& tree)
{
  this->Lights.clear();
  std::string nowhere;
  for (const SceneLight& light : SceneLights::Find(renderer))
  {
    const bool isSomewhere = light.IsSomewhere();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double coordinate =
        light.IsPositional ? light.Position[axis] - tree.GetOrigin()[axis] : -light.Axis[axis];
      this->Lights.push_back(isSomewhere ? static_cast<float>(coordinate) : 0.0f);
    }
    if (!isSomewhere)
    {
      nowhere += (nowhere.empty() ? "" : ", ") + std::to_string(this->Lights.size() / 4);
    }
    this->Lights.push_back(!isSomewhere ? -1.0f : (light.IsPositional ? 1.0f : 0.0f));
  }
  return nowhere.empty()
    ? Outcome::Done()
    : Outcome::Failed("Without the shadows of light " + nowhere +
        " of those that are on: it has a position that is not finite, or its focal point at its "
        "position. Correct it.");
}

//------------------------------------------------------------------------------
void ExactShadows::MarkPlace(std::string& fragmentShader)
{
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
    std::string(Place) + "\n//VTK::Light::Impl", false);
}

//------------------------------------------------------------------------------
// VTK's code multiplies all that a light gives by its color, a uniform of the light's number.
bool ExactShadows::FillPlace(std::string& fragmentShader)
{
  int lights = 0;
  while (fragmentShader.find("uniform vec3 " + GetColor(lights) + ";") != std::string::npos)
  {
    ++lights;
  }
  const bool isLit = lights > 0 && fragmentShader.find(Fragment) != std::string::npos &&
    fragmentShader.find(Place) != std::string::npos;
  vtkShaderProgram::Substitute(fragmentShader, Place,
    isLit ? "  LightTransportFindLitLights(vertexVC.xyz);" : "");
  if (!isLit)
  {
    return false;
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
  return true;
}

//------------------------------------------------------------------------------
bool ExactShadows::IsShaded(vtkActor* actor) const
{
  vtkPolyDataMapper* mapper = actor ? FindPlainMapper(actor->GetMapper()) : nullptr;
  vtkPolyData* surface = mapper ? mapper->GetInput() : nullptr;
  return !this->Lights.empty() && surface && surface->GetNumberOfPolys() > 0 &&
    actor->GetProperty()->GetLighting() && actor->GetProperty()->GetRepresentation() == VTK_SURFACE;
}

//------------------------------------------------------------------------------
bool ExactShadows::IsUsedBy(vtkShaderProgram* program)
{
  return program->IsUniformUsed("lightTransportLights");
}

//------------------------------------------------------------------------------
void ExactShadows::SetUniforms(vtkShaderProgram* program) const
{
  program->SetUniform4fv("lightTransportLights", static_cast<int>(this->Lights.size() / 4),
    reinterpret_cast<const float(*)[4]>(this->Lights.data()));
}
} // namespace LightTransport
