// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/FeedbackPass.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Textures/FloatTextures.h"
#include "vtkLightTransportRefinementNothingFS.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkShaderProgram.h"

#include <cstdint>
#include <cstring>
#include <utility>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
/// OpenGL takes places in a buffer as pointers.
const void* AsPointer(std::uintptr_t offset)
{
  const void* pointer = nullptr;
  static_assert(sizeof(pointer) == sizeof(offset));
  std::memcpy(&pointer, &offset, sizeof(pointer));
  return pointer;
}
} // namespace

//------------------------------------------------------------------------------
FeedbackPass::FeedbackPass(vtkOpenGLRenderWindow* window, std::string vertexShader,
  std::string geometryShader, std::vector<std::string> attributes,
  const std::vector<std::string>& outputs)
  : Window(window), VertexShader(std::move(vertexShader)),
    GeometryShader(std::move(geometryShader)), Attributes(std::move(attributes)),
    Outputs(vtkSmartPointer<vtkTransformFeedback>::New())
{
  for (const std::string& output : outputs)
  {
    // Four floats, whatever they are.
    this->Outputs->AddVarying(vtkTransformFeedback::Color_RGBA_F, output);
  }
}

//------------------------------------------------------------------------------
void FeedbackPass::Release()
{
  if (this->VertexArray != 0)
  {
    glDeleteVertexArrays(1, &this->VertexArray);
    glDeleteQueries(2, this->Queries);
  }
  this->VertexArray = 0;
}

//------------------------------------------------------------------------------
Outcome FeedbackPass::Use(vtkShaderProgram*& program)
{
  this->Program = this->Window->GetShaderCache()->ReadyShaderProgram(this->VertexShader.c_str(),
    vtkLightTransportRefinementNothingFS, this->GeometryShader.c_str(), this->Outputs);
  program = this->Program;
  return FloatTextures::CheckProgram(program);
}

//------------------------------------------------------------------------------
// Where the target is too small all is done again, now that its size is known.
Outcome FeedbackPass::Run(const VectorBuffer& source, vtkIdType count, VectorBuffer& target,
  vtkIdType kept, vtkIdType& written)
{
  vtkIdType expected = count;
  while (true)
  {
    // Half as much again as is needed: what grows little by little is copied seldom.
    const vtkIdType needed = kept + expected;
    Outcome done =
      needed > target.GetCapacity() ? target.Reserve(needed + needed / 2, kept) : Outcome::Done();
    vtkIdType generated = 0;
    done = done ? this->Capture(source, count, target, kept, written, generated) : done;
    if (!done || written == generated)
    {
      return done;
    }
    if (generated <= expected)
    {
      return Outcome::Failed("links that it does not capture");
    }
    expected = generated;
  }
}

//------------------------------------------------------------------------------
Outcome FeedbackPass::Capture(const VectorBuffer& source, vtkIdType count,
  const VectorBuffer& target, vtkIdType kept, vtkIdType& written, vtkIdType& generated)
{
  if (this->VertexArray == 0)
  {
    glGenVertexArrays(1, &this->VertexArray);
    glGenQueries(2, this->Queries);
  }
  glBindVertexArray(this->VertexArray);
  this->SetAttributes(source);
  glBindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.GetHandle(),
    kept * target.GetBytesPerRecord(), (target.GetCapacity() - kept) * target.GetBytesPerRecord());
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, this->Queries[0]);
  glBeginQuery(GL_PRIMITIVES_GENERATED, this->Queries[1]);
  glBeginTransformFeedback(GL_POINTS);
  glDrawArrays(GL_POINTS, 0, static_cast<int>(count));
  glEndTransformFeedback();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  glEndQuery(GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN);
  glDisable(GL_RASTERIZER_DISCARD);
  glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
  glBindVertexArray(0);
  GLuint counts[2] = {};
  glGetQueryObjectuiv(this->Queries[0], GL_QUERY_RESULT, &counts[0]);
  glGetQueryObjectuiv(this->Queries[1], GL_QUERY_RESULT, &counts[1]);
  written = counts[0];
  generated = counts[1];
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
void FeedbackPass::SetAttributes(const VectorBuffer& source)
{
  glBindBuffer(GL_ARRAY_BUFFER, source.GetHandle());
  for (std::size_t vector = 0; vector < this->Attributes.size(); ++vector)
  {
    const int location =
      glGetAttribLocation(this->Program->GetHandle(), this->Attributes[vector].c_str());
    // The compiler drops what no output needs.
    if (location >= 0)
    {
      const std::size_t offset = vector * VectorBuffer::FloatsPerVector * sizeof(float);
      glEnableVertexAttribArray(static_cast<GLuint>(location));
      glVertexAttribPointer(static_cast<GLuint>(location), VectorBuffer::FloatsPerVector, GL_FLOAT,
        GL_FALSE, static_cast<GLsizei>(source.GetBytesPerRecord()), AsPointer(offset));
    }
  }
  glBindBuffer(GL_ARRAY_BUFFER, 0);
}
} // namespace LightTransport
