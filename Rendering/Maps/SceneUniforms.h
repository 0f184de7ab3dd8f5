// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Places of a scene as shaders get them: in single precision, from an origin near by.
#ifndef SceneUniforms_h
#define SceneUniforms_h

#include "Maps/SceneLights.h"

#include <array>

class vtkShaderProgram;

namespace LightTransport
{
namespace SceneUniforms
{
void SetVector(vtkShaderProgram* program, const char* name, const Vector3& vector);

/// From coordinates relative to `center`, moved by `matrix` (row by row), to those relative to
/// `origin`, column by column.
std::array<float, 16> MakeMove(const double matrix[16], const Vector3& center,
  const Vector3& origin);

/// A light, and a view from it, for vtkLightTransportMapsLight.glsl and
/// vtkLightTransportMapsLightView.glsl.
void SetLight(vtkShaderProgram* program, const SceneLight& light, const Vector3& origin);
void SetView(vtkShaderProgram* program, const LightView& view, const Vector3& origin);
} // namespace SceneUniforms
} // namespace LightTransport

#endif
