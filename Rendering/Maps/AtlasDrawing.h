// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Draws a surface into its atlas, sample by sample. All calls but the constructor and the
/// destructor within a DeviceSession.
#ifndef AtlasDrawing_h
#define AtlasDrawing_h

#include "Maps/ChartedSurface.h"
#include "Maps/TriangleBuffer.h"
#include "Maps/TupleTable.h"
#include "Textures/FloatTextures.h"

#include <array>
#include <string>

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
  vtkTextureObject* GetPoints() const { return this->Points.Get(); }

  /// A failure where charts have no texel of their own in a map of `size` texels a side, or that is
  /// no power of two.
  Outcome CheckSize(int size, const char* name) const;

  /// What a program computes light with: GLSL that defines GetEntering, in the vertex shader or in
  /// the fragment shader.
  struct Light
  {
    std::string Code;
    bool IsAtCorners = false;
    bool HasBumps = false;
    int ValueEntries = 1; ///< texels of a tuple that it reads
  };

  /// A program whose fragment shader is `body`, behind the common part, for `outputs` textures. It
  /// draws the surface where it is, unless SetMove moves it (`move` as MakeMove has it).
  Outcome Use(vtkShaderProgram*& program, const char* body, int outputs, const Light& light);
  static void SetMove(vtkShaderProgram* program, std::array<float, 16> move);

  /// Adds samples x samples of each texel, one drawing for each, to what is in `target`.
  Outcome AddSamples(vtkShaderProgram* program, const FloatTextures::Group& target, int samples);

private:
  FloatTextures& Engine;
  ChartedSurface Surface;
  TriangleBuffer Triangles;
  TupleTable Points;
};
} // namespace LightTransport

#endif
