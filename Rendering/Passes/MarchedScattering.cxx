// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/MarchedScattering.h"

#include "Maps/SceneUniforms.h"
#include "Tracing/SceneTree.h"
#include "vtkLightTransportPassesMarchFS.h"
#include "vtkLightTransportTracingTree.h"

#include "vtkMatrix4x4.h"
#include "vtkShaderProgram.h"
#include "vtkSubsurfaceScattering.h"

#include <cmath>
#include <cstddef>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
bool IsGood(const MarchedScattering::Medium& medium)
{
  bool isGood = medium.RefractiveIndex >= 1.0 && std::isfinite(medium.RefractiveIndex);
  for (std::size_t band = 0; band < medium.Extinction.size(); ++band)
  {
    isGood = isGood && medium.Scattering[band] >= 0.0 && medium.Extinction[band] > 0.0 &&
      medium.Extinction[band] >= medium.Scattering[band] &&
      std::isfinite(medium.Extinction[band]) && std::abs(medium.Anisotropy[band]) <= 0.99;
  }
  return isGood;
}

//------------------------------------------------------------------------------
void Add(std::vector<float>& floats, const Vector3& vector, double fourth)
{
  for (const double number : vector)
  {
    floats.push_back(static_cast<float>(number));
  }
  floats.push_back(static_cast<float>(fourth));
}
} // namespace

//------------------------------------------------------------------------------
Outcome MarchedScattering::MakeMedium(vtkSubsurfaceScattering* material, vtkMatrix4x4* matrix,
  Medium& medium)
{
  Vector3 scattering;
  Vector3 absorption;
  material->GetScatteringCoefficient(scattering.data());
  material->GetAbsorptionCoefficient(absorption.data());
  material->GetAnisotropy(medium.Anisotropy.data());
  medium.RefractiveIndex = material->GetRefractiveIndex();
  vtkSubsurfaceScattering::GetMaterialProperties(material->GetMaterial(), scattering.data(),
    absorption.data(), medium.RefractiveIndex);
  const double scale =
    material->GetMillimetersPerUnit() / std::cbrt(std::abs(matrix->Determinant()));
  for (std::size_t band = 0; band < scattering.size(); ++band)
  {
    medium.Scattering[band] = scale * scattering[band] / (1.0 - medium.Anisotropy[band]);
    medium.Extinction[band] = medium.Scattering[band] + scale * absorption[band];
  }
  return IsGood(medium)
    ? Outcome::Done()
    : Outcome::Failed("Without SingleScattering: a material has a coefficient, Anisotropy, "
                      "RefractiveIndex or MillimetersPerUnit that is out of its range. Correct "
                      "it.");
}

//------------------------------------------------------------------------------
Outcome MarchedScattering::Update(vtkRenderer* renderer, const SceneTree& tree)
{
  this->Lights.clear();
  std::vector<SceneLight> lights;
  if (Outcome read = SceneLights::Read(renderer, lights); !read)
  {
    return Outcome::Failed("Without SingleScattering: " + read.GetMessage());
  }
  for (const SceneLight& light : lights)
  {
    Vector3 place;
    for (std::size_t axis = 0; axis < place.size(); ++axis)
    {
      place[axis] =
        light.IsPositional ? light.Position[axis] - tree.GetOrigin()[axis] : -light.Axis[axis];
    }
    Add(this->Lights, place, light.IsPositional ? 1.0 : 0.0);
    Add(this->Lights, light.Axis, light.ConeCosine);
    Add(this->Lights, light.Color, light.Exponent);
    Add(this->Lights, light.Attenuation, 0.0);
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void MarchedScattering::Write(std::string& fragmentShader) const
{
  vtkShaderProgram::Substitute(fragmentShader, "void main()",
    "#define LIGHT_TRANSPORT_MARCHED_LIGHTS " + std::to_string(this->GetNumberOfLights()) + "\n" +
      vtkLightTransportTracingTree + vtkLightTransportPassesMarchFS + "void main()",
    false);
}

//------------------------------------------------------------------------------
void MarchedScattering::SetUniforms(vtkShaderProgram* program, const Medium& medium, int body,
  int steps) const
{
  program->SetUniform4fv("lightTransportSources", static_cast<int>(this->Lights.size() / 4),
    reinterpret_cast<const float(*)[4]>(this->Lights.data()));
  SceneUniforms::SetVector(program, "lightTransportScattering", medium.Scattering);
  SceneUniforms::SetVector(program, "lightTransportExtinction", medium.Extinction);
  SceneUniforms::SetVector(program, "lightTransportAnisotropy", medium.Anisotropy);
  program->SetUniformf("lightTransportMediumIndex", static_cast<float>(medium.RefractiveIndex));
  program->SetUniformi("lightTransportBody", body);
  program->SetUniformi("lightTransportSteps", steps);
}
} // namespace LightTransport
