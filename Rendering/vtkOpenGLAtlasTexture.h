// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLAtlasTexture
 * @brief a texel map of an atlas on the GPU, with levels of detail that no chart leaks into
 *
 * The atlas is one of vtkSurfaceAtlas: each chart fills a square block of texels, whose size is a
 * power of two and whose place is a multiple of it, so that a texel of any level down to one texel
 * per chart belongs to one chart. Texels hold (value x area, area), as RGBA in single precision: an
 * average of four that knows no areas is then the mean over the surface, once the one is divided by
 * the other. So the levels that OpenGL makes are the area-weighted means over the nodes of the
 * quadtree. Areas are stored relative to their mean.
 *
 * SampleAtlas (GetShaderCode()) is what a shader samples with: it keeps to the block of the chart,
 * shrunk by half a texel of the level, in each of the two levels between which it interpolates.
 *
 * The class owns the OpenGL objects and draws nothing on a screen; render passes use it, and
 * filters through Sample().
 *
 * Source: N. A. Carr, J. D. Hall, J. C. Hart, GPU algorithms for radiosity and subsurface
 * scattering, Graphics Hardware 2003, section 4.
 */
#ifndef vtkOpenGLAtlasTexture_h
#define vtkOpenGLAtlasTexture_h

#include "vtkLightTransportRenderingModule.h" // for export macro
#include "vtkObject.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkDataArray;
class vtkDoubleArray;
class vtkFloatArray;
class vtkImageData;
class vtkRenderWindow;
class vtkShaderProgram;

namespace LightTransport
{
class AtlasTexture;
}

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLAtlasTexture : public vtkObject
{
public:
  static vtkOpenGLAtlasTexture* New();
  vtkTypeMacro(vtkOpenGLAtlasTexture, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Makes the texture of point arrays of `maps`: `valueName` with 1 or 3 components and `areaName`
   * with 1, the area of the surface in each texel. `maps` is square, 2-D (any plane's first two
   * axes), with a power of two texels a side; row 0 is the bottom of the atlas. The context is that
   * of `window`, which has it already and is not kept alive, or, without one, that of the
   * off-screen window that all filters of this process share.
   *
   * Returns false with an error, and is empty, where the image or an array is not as above, a value
   * is not finite, an area is negative or all are 0, there is no context, or the texture does not
   * fit; the texture of a map (vtkOpenGLTransmittedMap, vtkOpenGLScatteredMap) stays as it is.
   */
  bool Build(vtkImageData* maps, const char* valueName, const char* areaName = "Area",
    vtkRenderWindow* window = nullptr);

  /// Texels a side, 0 before Build.
  int GetResolution();

  /// Components of the values: 1 or 3; 0 before Build.
  int GetNumberOfComponents();

  /// Levels of detail, 1 + log2(resolution); the last has one texel. 0 before Build.
  int GetNumberOfLevels();

  /// Reads a level: four components, value x area (a single component three times) and area, the
  /// area relative to the mean over the texels of level 0. Returns false with an error before
  /// Build and where there is no such level.
  bool ReadLevel(int level, vtkFloatArray* texels);

  /// Reads level 0 as an image that vtkAtlasToSurface takes: point arrays `valueName`, with the
  /// components that the texture has, and "Area", relative to the mean. Returns false with an error
  /// before Build.
  bool ReadImage(vtkImageData* image, const char* valueName);

  /**
   * Samples at many points at once, in a fragment shader. `coordinates`: two components, in
   * [0,1]^2; `blocks`: three, the x, y and size of the point's chart in texels of level 0;
   * `levels`: one, level 0 the finest; levels above the chart's single texel are that texel.
   * `values` gets the mean of the values around each point, weighted by area; 0 where there is no
   * area. Returns false with an error before Build and where arrays do not fit.
   */
  bool Sample(vtkDataArray* coordinates, vtkDataArray* blocks, vtkDataArray* levels,
    vtkDoubleArray* values);

  /**
   * GLSL for fragment shaders: `vec4 SampleAtlas(sampler2D atlas, vec2 place, vec3 block, float
   * level)` returns the mean of the values in rgb and the relative area in a. `place` in atlas
   * coordinates, `block` as in Sample().
   */
  static std::string GetShaderCode();

  ///@{
  /// Lets a program of the same window, which is in use, sample the texture as the sampler2D
  /// `name` until Deactivate(). Returns false before Build and after the window has gone.
  bool Activate(vtkShaderProgram* program, const char* name);
  void Deactivate();
  ///@}

  /// Gives all memory on the device back; Build() makes it again.
  void ReleaseGraphicsResources();

protected:
  vtkOpenGLAtlasTexture();
  ~vtkOpenGLAtlasTexture() override;

private:
  vtkOpenGLAtlasTexture(const vtkOpenGLAtlasTexture&) = delete;
  void operator=(const vtkOpenGLAtlasTexture&) = delete;

  bool CheckMaps(vtkImageData* maps, const char* valueName, const char* areaName);
  bool CheckPoints(vtkDataArray* coordinates, vtkDataArray* blocks, vtkDataArray* levels,
    vtkDoubleArray* values);
  bool IsReady();

  /// These draw into it.
  friend class vtkOpenGLScatteredMap;
  friend class vtkOpenGLTransmittedMap;
  friend class vtkSubsurfaceScatteringPass;

  const std::unique_ptr<LightTransport::AtlasTexture> Texture;
  bool IsDrawnInto = false; ///< by a map, whose it is
};

#endif
