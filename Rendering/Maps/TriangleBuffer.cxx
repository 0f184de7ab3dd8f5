// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Maps/TriangleBuffer.h"

#include "Context/OpenGLContextGuard.h"
#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkShaderProgram.h"

namespace LightTransport
{
//------------------------------------------------------------------------------
TriangleBuffer::TriangleBuffer(FloatTextures& engine)
  : Engine(engine), Corners(vtkSmartPointer<vtkOpenGLBufferObject>::New()),
    Array(vtkSmartPointer<vtkOpenGLVertexArrayObject>::New())
{
}

//------------------------------------------------------------------------------
TriangleBuffer::~TriangleBuffer()
{
  if (this->Engine.IsAlive())
  {
    const OpenGLContextGuard guard(this->Engine.GetWindow());
    this->Array->ReleaseGraphicsResources();
    this->Corners->ReleaseGraphicsResources();
  }
}

//------------------------------------------------------------------------------
Outcome TriangleBuffer::Upload(const std::vector<float>& corners, int floatsPerCorner)
{
  this->FloatsPerCorner = floatsPerCorner;
  this->NumberOfCorners = static_cast<int>(corners.size() / floatsPerCorner);
  this->Corners->Upload(corners, vtkOpenGLBufferObject::ArrayBuffer);
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
Outcome TriangleBuffer::Draw(vtkShaderProgram* program, const std::vector<Attribute>& attributes)
{
  // Another program may have other places for them.
  this->Array->ShaderProgramChanged();
  this->Array->Bind();
  bool added = true;
  for (const Attribute& attribute : attributes)
  {
    if (!program->IsAttributeUsed(attribute.Name))
    {
      continue;
    }
    added = this->Array->AddAttributeArray(program, this->Corners, attribute.Name,
              static_cast<int>(attribute.First * sizeof(float)),
              this->FloatsPerCorner * sizeof(float), VTK_FLOAT, attribute.Count, false) &&
      added;
  }
  if (added)
  {
    glDrawArrays(GL_TRIANGLES, 0, this->NumberOfCorners);
  }
  this->Array->Release();
  return added ? Outcome::Done() : Outcome::Failed("corners that a shader does not take");
}
} // namespace LightTransport
