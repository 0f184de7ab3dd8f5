// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Computing with fragment shaders over RGBA32F textures in the context of one window: textures,
 * programs, and quads drawn with the former by the latter. All work happens while a
 * DeviceSession lives.
 */
#ifndef FloatTextures_h
#define FloatTextures_h

#include "Shared/Outcome.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkTextureObject.h"
#include "vtkType.h"
#include "vtkWeakPointer.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkShaderProgram;

namespace LightTransport
{
class VectorBuffer;

class FloatTextures
{
public:
  /// Textures of one size that are read and written together.
  using Group = std::vector<vtkSmartPointer<vtkTextureObject>>;

  /// What a texel holds: four floats, or unsigned integers of 32 bits, for tables.
  enum class Texel
  {
    Floats,
    Word,
    TwoWords,
    FourWords
  };

  static constexpr int BytesPerTexel = 4 * sizeof(float);
  /// No texture for large tables has more: drivers refuse huge ones long before the memory is full.
  /// Also what single precision counts exactly.
  static constexpr vtkIdType MaximumTexels = vtkIdType(1) << 24;

  static constexpr int DivideUp(vtkIdType dividend, vtkIdType divisor)
  {
    return static_cast<int>((dividend + divisor - 1) / divisor);
  }

  explicit FloatTextures(vtkOpenGLRenderWindow* window);
  /// Within the life of the context, or after it; not within a session.
  ~FloatTextures();
  FloatTextures(const FloatTextures&) = delete;
  void operator=(const FloatTextures&) = delete;

  /// False after the window has gone or has released its resources: nothing is left then.
  bool IsAlive() const;

  vtkOpenGLRenderWindow* GetWindow() const { return this->Window; }

  /// The renderer's own name, such as "llvmpipe (LLVM 15.0.6, 256 bits)".
  std::string GetDeviceName() const;

  /// Width and height that the context offers.
  int GetMaximumTextureSize() const;

  /// Most textures in a group.
  int GetMaximumGroupSize() const;

  /// Textures of undefined contents. Where the memory is not there, the group is empty.
  Outcome Allocate(Group& group, std::size_t count, int width, int height,
    Texel texel = Texel::Floats);

  /// Set all texels of a group to zero.
  void Clear(const Group& group);

  /// Write a region (x, y, width, height) of a texture; `rowLength` texels lie between the starts
  /// of two rows of `rgba`.
  void Upload(vtkTextureObject* texture, const int region[4], int rowLength, const float* rgba);
  void Upload(vtkTextureObject* texture, const int region[4], int rowLength,
    const std::uint32_t* words);

  /// Write all of a table, the first texture of a group.
  template <typename Value>
  void UploadTable(const Group& table, const std::vector<Value>& values)
  {
    const int width = static_cast<int>(table[0]->GetWidth());
    const int all[4] = { 0, 0, width, static_cast<int>(table[0]->GetHeight()) };
    this->Upload(table[0], all, width, values.data());
  }

  /// Write lines [first, last) of a table below each other into a texture: make(line) has whole
  /// rows of texels, of four values each. `pause` is called after each.
  template <typename Make, typename Pause>
  void UploadLines(vtkTextureObject* texture, int first, int last, const Make& make,
    const Pause& pause)
  {
    const int width = static_cast<int>(texture->GetWidth());
    int at = 0;
    for (int line = first; line < last; ++line)
    {
      const auto values = make(line);
      const int height = static_cast<int>(values.size() / 4) / width;
      const int region[4] = { 0, at, width, height };
      this->Upload(texture, region, width, values.data());
      at += height;
      pause();
    }
  }

  /// Copy a region (x, y, width, height) to (x, line) between groups of as many textures.
  void Copy(const Group& target, int line, const Group& source, const int region[4]);

  /// Copy all texels of a group, one texture after the other, into a buffer with room for them.
  void Copy(const VectorBuffer& target, const Group& source);

  /// Read the left lower width x height texels of one texture of a group.
  void Download(const Group& group, std::size_t index, int width, int height, float* rgba);

  ///@{
  /**
   * Draw: Use a program (compiled at the first use of a name; the common part is put before
   * `body`), set its textures and uniforms, then Draw into a region (x, y, width, height) of a
   * group. Use fails when the program does not compile.
   */
  Outcome Use(vtkShaderProgram*& program, const std::string& name, const char* body,
    const std::string& defines);
  /// `defines` for groups of textures read, textures drawn into, and lines of `width` texels.
  static std::string GetDefines(int groups, int outputs, int width);
  void SetTextures(vtkShaderProgram* program, const char* name, const Group& group);
  void Draw(const Group& target, const int region[4]);
  ///@}

  ///@{
  /// For programs that draw something else than quads: write into a group from now on; let go of
  /// the textures of SetTextures.
  void Bind(const Group& target);
  void ReleaseTextures();
  ///@}

  /// A failure where a program has not been compiled.
  static Outcome CheckProgram(vtkShaderProgram* program);

private:
  void Attach(const Group& group);
  void Upload(vtkTextureObject* texture, const int region[4], int rowLength, unsigned int format,
    unsigned int type, const void* values);

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  vtkSmartPointer<vtkTextureObject> Witness;
  vtkSmartPointer<vtkOpenGLFramebufferObject> Framebuffer;
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> Quads;
  vtkOpenGLQuadHelper* CurrentQuad = nullptr;
  std::vector<vtkTextureObject*> ActiveTextures;
};
} // namespace LightTransport

#endif
