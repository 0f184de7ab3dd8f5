// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLLinkOperator
 * @brief the links applied on the GPU, by fragment shaders over floating-point textures
 *
 * What OpenGL 3.2 offers is enough. The links are put into textures once and stay there: a
 * vtkExchangeMatrix expanded to full rows, a vtkExchangeHierarchy as its tables. Vectors are RGBA
 * textures, a texel per patch and a texture per four bands, up to 32 bands, which are all drawn in
 * one pass over the links. A product is a few passes without a way back to the CPU. With a
 * matrix: partial sums over ranges of columns, so that a GPU has enough to do at once, then their
 * compensated sum. With a hierarchy: the up-sweep, a draw per level, sums over pieces of the rows
 * of links, and the down-sweep. Only GetVector, and one number per band in Dot and MaxNorm, are
 * read back.
 *
 * Links that are more than one texture holds are cut into tiles.
 *
 * The context is the one of SetRenderWindow, if given, else that of an off-screen window
 * (vtkOffScreenOpenGLRenderWindow) shared by all operators of the process. Calls leave the context
 * that was current before them current again.
 *
 * Values are single precision. A matrix takes 4 bytes per pair of patches for one kernel, 16 bytes
 * per pair and four bands for one kernel per band; a hierarchy 16 bytes per link.
 *
 * Method of ping-pong textures: N. A. Carr, J. D. Hall, J. C. Hart, GPU algorithms for radiosity
 * and subsurface scattering, Graphics Hardware 2003.
 */
#ifndef vtkOpenGLLinkOperator_h
#define vtkOpenGLLinkOperator_h

#include "vtkDeviceLinkOperator.h"
#include "vtkLightTransportRenderingModule.h" // for export macro

#include <memory> // for std::unique_ptr

class vtkRenderWindow;
class vtkTextureObject;
class vtkWindow;

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLLinkOperator : public vtkDeviceLinkOperator
{
public:
  static vtkOpenGLLinkOperator* New();
  vtkTypeMacro(vtkOpenGLLinkOperator, vtkDeviceLinkOperator);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Most bands that vectors can have.
  static constexpr int MaximumNumberOfBands = 32;

  bool Open(std::string& reason) override;
  bool IsHardware() override;
  bool Initialize(vtkExchange* exchange, int numberOfBands) override;
  void Release() override;
  /// "OpenGL", and after Open() the name of the device, such as "OpenGL (llvmpipe (LLVM 15.0.6, 256
  /// bits))".
  const char* GetDeviceName() override;
  bool IsSinglePrecision() override { return true; }
  bool SetVector(int slot, const double* values) override;
  bool GetVector(int slot, double* values) override;
  bool Multiply(int y, int x) override;
  bool Combine(int z, const double* a, int x, const double* b, int y) override;
  bool Scale(int z, int x, int y) override;
  bool Dot(int x, int y, double* result) override;
  /// Not finite where x is not.
  bool MaxNorm(int x, double* result) override;

  /**
   * Compute in the context of this window instead of an off-screen one of our own; nullptr
   * (default) goes back. Whatever the operator holds is released. The window is not kept alive:
   * when it goes, or releases its graphics resources, so does everything the operator holds, and
   * Initialize() must be called again.
   */
  void SetRenderWindow(vtkRenderWindow* window);
  vtkRenderWindow* GetRenderWindow();

  /// Drop everything that lives in this window's context. Windows call it when they close.
  void ReleaseGraphicsResources(vtkWindow* window);

  /**
   * The texture of the first four bands of a slot, for those who draw into it, or from it, in the
   * same context: patch p is the texel (p % width, p / width). A slot that is not there yet is
   * made, of undefined contents; texels without a patch must be 0. Multiply and Combine may give a
   * slot another texture. Returns nullptr, with an error, before Initialize().
   */
  vtkTextureObject* GetVectorTexture(int slot);

  ///@{
  /**
   * Largest width and height of textures, at least 4. Default 0: what the context offers. Takes
   * effect at the next Initialize(); meant for tests, which force the links into tiles with it.
   */
  vtkSetClampMacro(MaximumTextureSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumTextureSize, int);
  ///@}

  ///@{
  /// Bytes read back from the context since the last Initialize(), textures that hold the links,
  /// and their bytes, each of which a product reads once.
  vtkTypeInt64 GetNumberOfBytesRead();
  int GetNumberOfLinkTextures();
  vtkTypeInt64 GetNumberOfLinkBytes();
  ///@}

protected:
  vtkOpenGLLinkOperator();
  ~vtkOpenGLLinkOperator() override;

private:
  vtkOpenGLLinkOperator(const vtkOpenGLLinkOperator&) = delete;
  void operator=(const vtkOpenGLLinkOperator&) = delete;

  bool Check(vtkExchange* exchange, int numberOfBands);
  bool IsReady();
  bool IsReady(int slot);

  int MaximumTextureSize = 0;

  struct DeviceParts;
  std::unique_ptr<DeviceParts> Device;
};

#endif
