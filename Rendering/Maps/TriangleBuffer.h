// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Triangles on the device, corner after corner. All calls but the destructor within a
/// DeviceSession.
#ifndef TriangleBuffer_h
#define TriangleBuffer_h

#include "Textures/FloatTextures.h"

#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLVertexArrayObject;

namespace LightTransport
{
class TriangleBuffer
{
public:
  /// Floats of a corner that a shader takes under a name.
  struct Attribute
  {
    const char* Name;
    int First;
    int Count;
  };

  /// `engine` must outlive this.
  explicit TriangleBuffer(FloatTextures& engine);
  ~TriangleBuffer();
  TriangleBuffer(const TriangleBuffer&) = delete;
  void operator=(const TriangleBuffer&) = delete;

  Outcome Upload(const std::vector<float>& corners, int floatsPerCorner);

  /// With a program that is in use, into what is bound. It need not take all attributes.
  Outcome Draw(vtkShaderProgram* program, const std::vector<Attribute>& attributes);

private:
  FloatTextures& Engine;
  vtkSmartPointer<vtkOpenGLBufferObject> Corners;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Array;
  int FloatsPerCorner = 0;
  int NumberOfCorners = 0;
};
} // namespace LightTransport

#endif
