// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLLinkRefiner
 * @brief links of scattered light chosen on the GPU, level by level
 *
 * Pairs of a receiver and a sender, clusters or patches both, begin at the root of the body's tree.
 * A vertex shader decides what becomes of each: whether the sender is near, left out, divided or
 * linked to, which is the CPU's test for a patch and a bound for all patches of a cluster; where
 * these do not agree the receiver is divided. Geometry shaders make the pairs that follow.
 * Everything is captured by transform feedback of OpenGL 3.2 (and GL_ARB_shader_bit_encoding, which
 * later versions have), and counts alone are read back until all is done.
 *
 * Values and deviations are single precision, their differences from the CPU's some 1e-6: patches
 * get the CPU's links but where a deviation is that close to the limit.
 */
#ifndef vtkOpenGLLinkRefiner_h
#define vtkOpenGLLinkRefiner_h

#include "vtkDeviceLinkRefiner.h"
#include "vtkLightTransportRenderingModule.h" // for export macro

#include <memory> // for std::shared_ptr and std::unique_ptr

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLLinkRefiner : public vtkDeviceLinkRefiner
{
public:
  static vtkOpenGLLinkRefiner* New();
  vtkTypeMacro(vtkOpenGLLinkRefiner, vtkDeviceLinkRefiner);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  bool Open(std::string& reason) override;
  bool IsHardware() override;
  /// "OpenGL", and after Open() the name of the device, such as "OpenGL (llvmpipe (LLVM 15.0.6, 256
  /// bits))".
  const char* GetDeviceName() override;
  bool Initialize(std::shared_ptr<const Body> body, std::string& reason) override;
  bool Refine(vtkIdType first, vtkIdType last, std::vector<Part>& parts,
    std::string& reason) override;

  /// Pairs that have been tested since Initialize().
  vtkTypeInt64 GetNumberOfTests();

protected:
  vtkOpenGLLinkRefiner();
  ~vtkOpenGLLinkRefiner() override;

private:
  vtkOpenGLLinkRefiner(const vtkOpenGLLinkRefiner&) = delete;
  void operator=(const vtkOpenGLLinkRefiner&) = delete;

  struct DeviceParts;
  std::unique_ptr<DeviceParts> Device;
};

#endif
