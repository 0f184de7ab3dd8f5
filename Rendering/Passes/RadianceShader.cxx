// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Passes/RadianceShader.h"

#include "vtkLightTransportAtlasSampleFS.h"
#include "vtkLightTransportPassesDecFS.h"
#include "vtkLightTransportPassesDecGS.h"
#include "vtkLightTransportPassesDecVS.h"
#include "vtkLightTransportPassesFacetNormalFS.h"
#include "vtkLightTransportPassesFresnelFS.h"
#include "vtkLightTransportPassesImplGS.h"
#include "vtkLightTransportPassesImplVS.h"

#include "vtkShaderProgram.h"

namespace LightTransport
{
namespace
{
constexpr const char* Declaration = "//VTK::LightTransport::Dec";
constexpr const char* Implementation = "//VTK::LightTransport::Impl";

/// Put `text` before the first `tag` of a shader, which stays.
void InsertBefore(std::string& shader, const std::string& tag, const std::string& text)
{
  vtkShaderProgram::Substitute(shader, tag, text + "\n" + tag, false);
}
} // namespace

//------------------------------------------------------------------------------
void RadianceShader::MarkPlaces(std::string& vertexShader, std::string& geometryShader,
  std::string& fragmentShader)
{
  InsertBefore(vertexShader, "//VTK::PositionVC::Dec", Declaration);
  InsertBefore(vertexShader, "//VTK::PositionVC::Impl", Implementation);
  InsertBefore(geometryShader, "//VTK::PositionVC::Dec", vtkLightTransportPassesDecGS);
  InsertBefore(geometryShader, "//VTK::PositionVC::Impl", vtkLightTransportPassesImplGS);
  InsertBefore(fragmentShader, "//VTK::PositionVC::Dec", Declaration);
  InsertBefore(fragmentShader, "//VTK::DepthPeeling::Impl", Implementation);
}

//------------------------------------------------------------------------------
void RadianceShader::FillPlaces(std::string& vertexShader, std::string& fragmentShader,
  const char* lastStep, Source source)
{
  const std::string choice = std::string("#define LIGHT_TRANSPORT_IS_MAPPED ") +
    (source == Source::Map ? "1" : "0") + "\n#define LIGHT_TRANSPORT_IS_GROUPED " +
    (source == Source::Groups ? "1" : "0") + "\n#define LIGHT_TRANSPORT_IS_EMPTY " +
    (source == Source::Empty ? "1" : "0") + "\n";
  std::string declarations = choice + vtkLightTransportPassesDecVS;
  if (vertexShader.find("uniform mat4 MCVCMatrix;") == std::string::npos)
  {
    declarations += "uniform mat4 MCVCMatrix;\n";
  }
  vtkShaderProgram::Substitute(vertexShader, Declaration, declarations);
  vtkShaderProgram::Substitute(vertexShader, Implementation, vtkLightTransportPassesImplVS);

  const bool hasNormal = fragmentShader.find("vec3 normalVCVSOutput =") != std::string::npos;
  std::string steps = hasNormal ? "  vec3 lightTransportNormal = normalVCVSOutput;\n"
                                : vtkLightTransportPassesFacetNormalFS;
  steps += lastStep;
  vtkShaderProgram::Substitute(fragmentShader, Declaration,
    choice + vtkLightTransportAtlasSampleFS + vtkLightTransportPassesFresnelFS +
      vtkLightTransportPassesDecFS);
  vtkShaderProgram::Substitute(fragmentShader, Implementation, steps);
}

//------------------------------------------------------------------------------
void RadianceShader::SetUniforms(vtkShaderProgram* program, const Uniforms& uniforms)
{
  program->SetUniformi("lightTransportComponents", uniforms.Components);
  program->SetUniformi("lightTransportParallel", uniforms.Parallel ? 1 : 0);
  program->SetUniformi("lightTransportEncodeSRGB", uniforms.EncodeSRGB ? 1 : 0);
  program->SetUniformi("lightTransportShadingIsEncoded", uniforms.ShadingIsEncoded ? 1 : 0);
  program->SetUniformf("lightTransportExposure", static_cast<float>(uniforms.Exposure));
  program->SetUniformf("lightTransportRefractiveIndex",
    static_cast<float>(uniforms.RefractiveIndex));
  program->SetUniformf("lightTransportTransmittance",
    static_cast<float>(uniforms.MeanTransmittance));
}
} // namespace LightTransport
