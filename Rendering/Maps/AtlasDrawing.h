// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Draws a surface into its atlas, sample by sample. All calls but the constructor and the
/// destructor within a DeviceSession.
#ifndef AtlasDrawing_h
#define AtlasDrawing_h

#include "Maps/ChartedSurface.h"
#include "Maps/TriangleBuffer.h"
#include "Textures/FloatTextures.h"

#include <array>

class vtkActor;

namespace LightTransport
{
class AtlasDrawing
{
public:
  /// What an actor draws: its mapper's input, brought up to date. A failure where there is none, or
  /// its mapper takes composite data.
  static Outcome FindSurface(vtkActor* actor, vtkPolyData*& surface);

  /// `engine` must outlive this.
  explicit AtlasDrawing(FloatTextures& engine) : Engine(engine), Triangles(engine) {}

  Outcome SetSurface(vtkPolyData* data);
  const ChartedSurface& GetSurface() const { return this->Surface; }

  /// The point table of the surface (ChartedSurface::Points) as a texture.
  vtkTextureObject* GetPoints() const { return this->Points[0]; }
  /// Texels of a line of it: a power of two.
  static constexpr int PointWidthBits = 10;

  /// A failure where charts have no texel of their own in a map of `size` texels a side, or that is
  /// no power of two.
  Outcome CheckSize(int size, const char* name) const;

  /// A program whose fragment shader is `body`, behind the common part, for `outputs` textures. It
  /// draws the surface where it is, unless SetMove moves it (`move` as MakeMove has it).
  Outcome Use(vtkShaderProgram*& program, const char* body, int outputs);
  static void SetMove(vtkShaderProgram* program, std::array<float, 16> move);

  /// Adds samples x samples of each texel, one drawing for each, to what is in `target`.
  Outcome AddSamples(vtkShaderProgram* program, const FloatTextures::Group& target, int samples);

private:
  Outcome UploadPoints();

  FloatTextures& Engine;
  ChartedSurface Surface;
  TriangleBuffer Triangles;
  FloatTextures::Group Points;
};
} // namespace LightTransport

#endif
