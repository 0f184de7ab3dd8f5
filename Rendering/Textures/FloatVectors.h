// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Vectors with one value per patch and band in RGBA textures, a texel per patch and a texture per
 * four bands, and the algebra on them that solvers need. All calls within a DeviceSession.
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

  /// `maximumSize` bounds the size of textures, 0 for what the context offers. The message of a
  /// failure has no full stop.
  Outcome Initialize(vtkIdType patches, int bands, int maximumSize);

  const Layout& GetLayout() const { return this->Shape; }

  /// Bytes that all reading has taken from the device.
  vtkTypeInt64 GetNumberOfBytesRead() const { return this->NumberOfBytesRead; }

  bool Has(int slot) const { return this->Slots.count(slot) > 0; }

  /// Gives a slot its textures, unless it has them. What is written needs that, except by the
  /// calls below.
  Outcome Allocate(int slot);
  Group& Get(int slot) { return this->Slots[slot]; }

  ///@{
  /// values[patch * Bands + band]
  Outcome Set(int slot, const double* values);
  void Read(int slot, double* values);
  ///@}

  ///@{
  /// Draw z = a x + b y and z = x y; z may be x or y, which must be there.
  Outcome Combine(int z, const double* a, int x, const double* b, int y);
  Outcome Scale(int z, int x, int y);
  ///@}

  ///@{
  /// One number per band, read back.
  Outcome Dot(int x, int y, double* result);
  Outcome MaxNorm(int x, double* result);
  ///@}

private:
  bool ChooseSizes(vtkIdType patches, int bands, int maximumSize);
  Outcome AllocateReductions();
  Outcome DrawReduction(const Group& x, const Group& y, const char* name, const char* nextName,
    double* result);
  Outcome DrawReductionStep(const Group& target, const Group& x, const Group& y, const char* name);
  Outcome Use(vtkShaderProgram*& program, const char* name, const char* body, const Group& x,
    const Group& y, const std::string& extra = "");
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
