// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef FeedbackPass_h
#define FeedbackPass_h

#include "Shared/Outcome.h"
#include "Textures/VectorBuffer.h"
#include "vtkSmartPointer.h"
#include "vtkTransformFeedback.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;

namespace LightTransport
{
/// A program that makes records of others: a vertex shader, and perhaps a geometry shader, whose
/// outputs are captured (transform feedback of OpenGL 3.2) and not drawn. In one context, which is
/// current in all calls.
class FeedbackPass
{
public:
  /// Attributes are the vectors of a record that is read, outputs those of one that is written.
  FeedbackPass(vtkOpenGLRenderWindow* window, std::string vertexShader, std::string geometryShader,
    std::vector<std::string> attributes, const std::vector<std::string>& outputs);
  FeedbackPass(const FeedbackPass&) = delete;
  void operator=(const FeedbackPass&) = delete;

  /// Before the context goes.
  void Release();

  /// The program, ready for its uniforms.
  Outcome Use(vtkShaderProgram*& program);

  /// After Use. Write what comes of `count` records behind the first `kept` of the target, which
  /// grows where it is too small; `written` is how many came.
  Outcome Run(const VectorBuffer& source, vtkIdType count, VectorBuffer& target, vtkIdType kept,
    vtkIdType& written);

private:
  Outcome Capture(const VectorBuffer& source, vtkIdType count, const VectorBuffer& target,
    vtkIdType kept, vtkIdType& written, vtkIdType& generated);
  void SetAttributes(const VectorBuffer& source);

  vtkOpenGLRenderWindow* Window;
  std::string VertexShader;
  std::string GeometryShader;
  std::vector<std::string> Attributes;
  vtkSmartPointer<vtkTransformFeedback> Outputs;
  vtkShaderProgram* Program = nullptr; ///< the window's
  unsigned int VertexArray = 0;
  unsigned int Queries[2] = {};
};
} // namespace LightTransport

#endif
