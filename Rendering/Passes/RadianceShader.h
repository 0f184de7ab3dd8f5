// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What is written into a mapper's shaders so that they draw an array as radiance. Places are marked
 * before the mapper writes its own code, and filled after it: what is written there depends on what
 * the mapper writes around them.
 */
#ifndef RadianceShader_h
#define RadianceShader_h

#include <string>

class vtkShaderProgram;

namespace LightTransport
{
namespace RadianceShader
{
/// The attribute of vertices that holds the array.
constexpr const char* Attribute = "lightTransportMC";

void MarkPlaces(std::string& vertexShader, std::string& geometryShader,
  std::string& fragmentShader);

/// Where radiance comes from.
enum class Source
{
  Array,  ///< of points
  Map,    ///< of the surface's atlas
  Groups, ///< a texture, of which the array has the number of the texel
  Empty,  ///< none; for what the last step has of its own
  None
};

/// `lastStep` writes gl_FragData[0]; see glsl/vtkLightTransportPassesDecFS.glsl.
void FillPlaces(std::string& vertexShader, std::string& fragmentShader, const char* lastStep,
  Source source);

struct Uniforms
{
  int Components = 0;            ///< of the array
  bool Parallel = false;         ///< the camera's projection
  bool EncodeSRGB = false;       ///< the result, else linear
  bool ShadingIsEncoded = false; ///< what VTK's own shading has drawn
  double Exposure = 1.0;
  double RefractiveIndex = 1.0;
  double MeanTransmittance = 1.0;
};
void SetUniforms(vtkShaderProgram* program, const Uniforms& uniforms);
} // namespace RadianceShader
} // namespace LightTransport

#endif
