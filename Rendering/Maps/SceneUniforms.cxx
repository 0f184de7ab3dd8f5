// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/SceneUniforms.h"

#include "vtkMath.h"
#include "vtkShaderProgram.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
void SceneUniforms::SetVector(vtkShaderProgram* program, const char* name, const Vector3& vector)
{
  const float values[3] = { static_cast<float>(vector[0]), static_cast<float>(vector[1]),
    static_cast<float>(vector[2]) };
  program->SetUniform3f(name, values);
}

//------------------------------------------------------------------------------
std::array<float, 16> SceneUniforms::MakeMove(const double matrix[16], const Vector3& center,
  const Vector3& origin)
{
  std::array<float, 16> move = {};
  for (int row = 0; row < 3; ++row)
  {
    double shift = matrix[4 * row + 3] - origin[row];
    for (int column = 0; column < 3; ++column)
    {
      move[4 * column + row] = static_cast<float>(matrix[4 * row + column]);
      shift += matrix[4 * row + column] * center[column];
    }
    move[12 + row] = static_cast<float>(shift);
  }
  move[15] = 1.0f;
  return move;
}

//------------------------------------------------------------------------------
void SceneUniforms::SetLight(vtkShaderProgram* program, const SceneLight& light,
  const Vector3& origin)
{
  Vector3 position = light.Position;
  for (int axis = 0; axis < 3; ++axis)
  {
    position[axis] -= origin[axis];
  }
  program->SetUniformi("isPositional", light.IsPositional ? 1 : 0);
  SetVector(program, "lightPosition", position);
  SetVector(program, "lightAxis", light.Axis);
  SetVector(program, "color", light.Color);
  SetVector(program, "attenuation", light.Attenuation);
  program->SetUniformf("coneCosine", static_cast<float>(light.ConeCosine));
  program->SetUniformf("exponent", static_cast<float>(light.Exponent));
}

//------------------------------------------------------------------------------
void SceneUniforms::SetView(vtkShaderProgram* program, const LightView& view, const Vector3& origin)
{
  Vector3 from;
  vtkMath::Subtract(view.Origin.data(), origin.data(), from.data());
  SetVector(program, "viewOrigin", from);
  SetVector(program, "viewRight", view.Axes[0]);
  SetVector(program, "viewUp", view.Axes[1]);
  SetVector(program, "viewAhead", view.Axes[2]);
  const float frame[4] = { static_cast<float>(view.Middle[0]), static_cast<float>(view.Middle[1]),
    static_cast<float>(view.Half[0]), static_cast<float>(view.Half[1]) };
  program->SetUniform4f("frame", frame);
  program->SetUniformi("face", view.Face);
  program->SetUniformi("isPerspective", view.IsPerspective ? 1 : 0);
  const float range[2] = { static_cast<float>(view.Near), static_cast<float>(view.Far) };
  program->SetUniform2f("range", range);
}
} // namespace LightTransport
