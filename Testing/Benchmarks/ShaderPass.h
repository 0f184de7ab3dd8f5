// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What benchmarks need to run shaders of their own: a fragment shader that is drawn into a part of
/// a texture, and textures with values.
#ifndef ShaderPass_h
#define ShaderPass_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

class ShaderPass
{
public:
  using Uniforms = std::function<void(vtkShaderProgram*)>;

  /// A texture and the name of its sampler.
  struct Input
  {
    const char* Name;
    vtkTextureObject* Texture;
  };

  /// Without its head, which gives gl_FragData and sampler types. The window must outlive this.
  ShaderPass(vtkOpenGLRenderWindow* window, const std::string& fragmentShader);
  ~ShaderPass();
  ShaderPass(const ShaderPass&) = delete;
  void operator=(const ShaderPass&) = delete;

  /// Between these lie passes; End waits for them.
  void Begin(vtkTextureObject* target);
  void End(bool waits = true);

  /// Into the rectangle that begins at x, 0 of the target.
  void Draw(std::initializer_list<Input> inputs, int x, int width, int height,
    const Uniforms& setUniforms);

  /// Single precision, 1 or 4 components; `values` may be nullptr: 0.
  static vtkSmartPointer<vtkTextureObject> MakeTexture(vtkOpenGLRenderWindow* window, int width,
    int height, int components, const float* values);

private:
  vtkOpenGLRenderWindow* Window;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
};

#endif
