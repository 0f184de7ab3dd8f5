// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Vectors with one value per patch and band in RGBA textures, a texel per patch and a texture per
 * four bands, and the algebra on them that solvers need. All calls within a
 * FloatTextures::Session.
 */
#ifndef FloatVectors_h
#define FloatVectors_h

#include "Textures/FloatTextures.h"

#include <vtkType.h>

#include <map>
#include <string>
#include <vector>

namespace LightTransport
{
class FloatVectors
{
public:
  using Group = FloatTextures::Group;

  /// How a vector lies in its textures: patch p is the texel (p % Width, p / Width).
  struct Layout
  {
    int Patches = 0;
    int Bands = 0;
    int Groups = 0; ///< textures per vector
    int Width = 0;  ///< a power of two
    int Height = 0;
    int MaximumSize = 0; ///< width and height that no texture may exceed

    /// Definitions for shaders that write `outputs` textures; see
    /// vtkLightTransportTexturesCommonFS.glsl.
    std::string GetDefines(int outputs) const;
  };

  explicit FloatVectors(FloatTextures& engine);

  /// `maximumSize` bounds the size of textures, 0 for what the context offers. When false, `reason`
  /// is what is wrong, without a full stop.
  bool Initialize(vtkIdType patches, int bands, int maximumSize, std::string& reason);

  const Layout& GetLayout() const { return this->Shape; }

  /// Bytes that all reading has taken from the device.
  vtkTypeInt64 GetNumberOfBytesRead() const { return this->NumberOfBytesRead; }

  bool Has(int slot) const { return this->Slots.count(slot) > 0; }

  /// Comes into being with the first call; empty when the memory is not there.
  Group& Get(int slot);

  ///@{
  /// values[patch * Bands + band]
  bool Set(int slot, const double* values);
  void Read(int slot, double* values);
  ///@}

  ///@{
  /// Draw z = a x + b y and z = x y; z may be x or y, which must be there. False when a shader does
  /// not compile, or the memory for z is not there.
  bool Combine(int z, const double* a, int x, const double* b, int y);
  bool Scale(int z, int x, int y);
  ///@}

  ///@{
  /// One number per band, read back.
  bool Dot(int x, int y, double* result);
  bool MaxNorm(int x, double* result);
  ///@}

private:
  bool DrawReduction(const Group& x, const Group& y, const char* name, const char* nextName,
    double* result);
  bool DrawReductionStep(const Group& target, const Group& x, const Group& y, const char* name);
  vtkShaderProgram* Use(const char* name, const char* body, const Group& x, const Group& y,
    const std::string& extra = "");
  void DrawIntoSlot(int slot);
  void Read(const Group& vector, double* values);

  FloatTextures& Engine;
  Layout Shape;
  vtkTypeInt64 NumberOfBytesRead = 0;
  std::map<int, Group> Slots;
  Group Spare;
  std::vector<Group> Reductions;
};
} // namespace LightTransport

#endif
