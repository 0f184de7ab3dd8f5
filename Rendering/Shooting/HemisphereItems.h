// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What points on patches see of a scene, found by drawing it, and handed out: an item buffer holds
 * the number of the patch that each pixel sees, and the pixels are then drawn as points into a
 * texture with one texel per patch, each adding what it carries.
 *
 * The hemisphere is projected onto three faces of a cube whose diagonal is the shooter's normal,
 * continued down to the horizon (M. J. Beran-Koehn, M. J. Pavicic, A cubic tetrahedral adaptation
 * of the hemi-cube algorithm, Graphics Gems II, 1991, and Delta form-factor calculation for the
 * cubic tetrahedral algorithm, Graphics Gems III, 1992): three drawings instead of the hemicube's
 * five, and pixels that differ less in their weights. Those of an eye point sum to 1.
 */
#ifndef HemisphereItems_h
#define HemisphereItems_h

#include "Textures/FloatVectors.h"

#include <vector>

class vtkOpenGLBufferObject;
class vtkOpenGLVertexArrayObject;

namespace LightTransport
{
class HemisphereItems
{
public:
  /// Eye points that are drawn at once.
  static constexpr int MostEyes = 8;

  /// Where a shooter is seen from.
  struct Eye
  {
    float Position[3];
    /// Perpendicular to each other, and right-handed; the normal is their sum over sqrt(3).
    float Axes[3][3];
    /// Points lower than this over the shooter's plane, plus the slope times the distance, are on
    /// it.
    float Rounding;
    float Slope;
    int Shooter;  ///< the patch
    double Power; ///< what the eye point hands out of one unit of the shooter's radiosity
  };

  explicit HemisphereItems(FloatTextures* engine);
  /// Within the life of the context, or after it; not within a session.
  ~HemisphereItems();
  HemisphereItems(const HemisphereItems&) = delete;
  void operator=(const HemisphereItems&) = delete;

  /**
   * Points (three coordinates each, within a sphere of diameter 1), triangles (three points each)
   * and the patch that each triangle belongs to. `resolution` is the number of pixels along a side
   * of a face, even. Of two sides nearer to each other than `rounding` the front is seen.
   */
  Outcome Allocate(const std::vector<float>& points, const std::vector<unsigned int>& triangles,
    const std::vector<int>& patches, int resolution, double rounding);

  /**
   * Draw what eye points (at most MostEyes) see, and add what their shooters hold in `unshot` times
   * Power to the texels of the patches that they see in `received`, both vectors of this layout.
   */
  Outcome Shoot(const std::vector<Eye>& eyes, const FloatVectors::Layout& layout,
    const FloatTextures::Group& unshot, const FloatTextures::Group& received);

private:
  Outcome AllocateItems();
  Outcome AllocateScene(const std::vector<float>& points,
    const std::vector<unsigned int>& triangles, const std::vector<int>& patches);
  Outcome DrawItems(const std::vector<Eye>& eyes);
  Outcome DrawPoints(const std::vector<Eye>& eyes, const FloatVectors::Layout& layout,
    const FloatTextures::Group& unshot, const FloatTextures::Group& received);
  void UploadPatches(const std::vector<int>& patches);
  Outcome Use(vtkShaderProgram*& program, const char* vertexShader,
    const std::string& fragmentShader);

  FloatTextures* Engine;
  int Resolution = 0;
  int NumberOfIndices = 0;
  double WeightOfAllPixels = 0.0;
  float BackRounding = 0.0f;
  int TriangleWidth = 0;
  FloatTextures::Group TrianglePatches;
  vtkSmartPointer<vtkTextureObject> Items;
  vtkSmartPointer<vtkTextureObject> Depth;
  vtkSmartPointer<vtkOpenGLFramebufferObject> ItemBuffer;
  vtkSmartPointer<vtkOpenGLBufferObject> Points;
  vtkSmartPointer<vtkOpenGLBufferObject> Triangles;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Scene;
  vtkSmartPointer<vtkOpenGLVertexArrayObject> Nothing;
};
} // namespace LightTransport

#endif
