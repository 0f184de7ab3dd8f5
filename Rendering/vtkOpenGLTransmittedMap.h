// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkOpenGLTransmittedMap
 * @brief what enters a surface of the light of a scene, drawn into its atlas on the GPU
 *
 * First of the three steps of vtkSubsurfaceScatteringPass, usable alone. The triangles of an
 * actor's surface are drawn where they lie in the atlas that vtkSurfaceAtlas gave it. A texel gets
 *
 *   sum over lights of (Intensity x DiffuseColor / attenuation(d)) cos(theta) F_t(theta, n) V
 *
 * in the unit of "TransmittedIrradiance" of vtkDirectIrradiance, against which it is tested:
 * directional, point and spot lights of the renderer; headlights and camera lights where the camera
 * has them. An environment or an array may light it as well (vtkSurfaceLighting). theta is the
 * angle to the normal of the triangle, F_t Fresnel's transmittance, V what is not in the shadow.
 * Backs get nothing.
 *
 * Shadows are those of all visible actors that are drawn as surfaces, wherever the camera looks,
 * also of what is translucent; a part of a vtkAssembly where it is itself; glyphs cast none. They
 * come from shadow
 * maps of ShadowMapSize texels over what is lit: one for each light, or six where a point light has
 * the surface all about. A sample is compared with the map where the plane of its triangle is seen
 * at the map's own texel, so triangles cast no shadow on themselves however slanted, and the bias
 * is only 1e-5 of the scene: nothing so near casts a shadow. What else it costs: edges of shadows
 * are smeared over a texel of the shadow map, and within one of it the inside of corners and dents
 * may be dark; of a bunny in one light 0.2 % of what enters is lost so (0.4 % at 2048).
 *
 * Texels hold (irradiance x area, area), so that the levels of detail are means over the surface;
 * see vtkOpenGLAtlasTexture.
 *
 * Source: N. A. Carr, J. D. Hall, J. C. Hart, GPU algorithms for radiosity and subsurface
 * scattering, Graphics Hardware 2003, section 4.
 */
#ifndef vtkOpenGLTransmittedMap_h
#define vtkOpenGLTransmittedMap_h

#include "vtkLightTransportRenderingModule.h" // for export macro
#include "vtkNew.h"                           // for members
#include "vtkObject.h"

#include <array>  // for std::array
#include <memory> // for std::unique_ptr

class vtkActor;
class vtkOpenGLAtlasTexture;
class vtkRenderer;
class vtkSurfaceLighting;

namespace LightTransport
{
class AtlasDrawing;
class EnvironmentLight;
class Outcome;
} // namespace LightTransport

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkOpenGLTransmittedMap : public vtkObject
{
public:
  static vtkOpenGLTransmittedMap* New();
  vtkTypeMacro(vtkOpenGLTransmittedMap, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Texels a side, a power of two. Default 512, range 1 to 4096.
  vtkSetClampMacro(Resolution, int, 1, 4096);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /// Samples of a texel in each direction. Default 2, range 1 to 8.
  vtkSetClampMacro(Samples, int, 1, 8);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /// Whether surfaces cast shadows. Default on.
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /// Texels a side of a shadow map. Default 4096, range 16 to 8192.
  vtkSetClampMacro(ShadowMapSize, int, 16, 8192);
  vtkGetMacro(ShadowMapSize, int);
  ///@}

  ///@{
  /// Index of refraction relative to what surrounds the surface. Default 1.3, range 1 to 10; at 1
  /// all light enters, and the map is that of irradiance.
  vtkSetClampMacro(RefractiveIndex, double, 1.0, 10.0);
  vtkGetMacro(RefractiveIndex, double);
  ///@}

  ///@{
  /**
   * What lights the surface. Default: one of its own, with the renderer's lights alone. Maps may
   * share one, which then reads an environment once.
   */
  void SetLighting(vtkSurfaceLighting* lighting);
  vtkSurfaceLighting* GetLighting();
  ///@}

  /**
   * Brings the map up to date, in the context of the renderer's window, which has one already
   * (render once). Nothing is drawn where neither the surface, the actor's place, the lights, what
   * casts shadows nor a property has changed: a camera that moves changes only headlights and
   * camera lights. Returns false, with an error, where the map cannot be made, such as for a
   * surface without "AtlasCoordinates"; called again, it says so again only when something has
   * changed.
   */
  bool Update(vtkActor* actor, vtkRenderer* renderer);

  /// The map: three components.
  vtkOpenGLAtlasTexture* GetTexture();

  /// How often Update has drawn the map.
  vtkGetMacro(NumberOfRuns, vtkIdType);

  /// When it was drawn last.
  vtkMTimeType GetRunTime();

  /// When the surface last had another shape or atlas.
  vtkMTimeType GetSurfaceTime();

  /// Gives all memory on the device back; Update makes it again.
  void ReleaseGraphicsResources();

protected:
  vtkOpenGLTransmittedMap();
  ~vtkOpenGLTransmittedMap() override;

private:
  vtkOpenGLTransmittedMap(const vtkOpenGLTransmittedMap&) = delete;
  void operator=(const vtkOpenGLTransmittedMap&) = delete;

  friend class vtkOpenGLScatteredMap;
  friend class vtkSubsurfaceScatteringPass;
  struct Parts;
  struct State;
  struct Sum;

  /// nullptr before Update.
  LightTransport::AtlasDrawing* GetDrawing();
  /// One shadow map for both.
  void ShareShadows(vtkOpenGLTransmittedMap* other);
  bool TakesTransfer();

  LightTransport::Outcome Look(vtkActor* actor, vtkRenderer* renderer, State& state);
  LightTransport::Outcome Open(vtkRenderer* renderer);
  LightTransport::Outcome Refresh(vtkActor* actor, vtkRenderer* renderer);
  LightTransport::Outcome Draw(const State& state);
  LightTransport::Outcome ReadLighting(const State& state, Sum& sum);
  LightTransport::Outcome ReadEnvironment(const State& state, Sum& sum);
  LightTransport::Outcome ReadTransfer(const State& state,
    const LightTransport::EnvironmentLight& light, const double axes[9], Sum& sum);
  LightTransport::Outcome ReadIrradiance(const State& state, Sum& sum);
  void WarnOfIndex(const State& state);
  LightTransport::Outcome AddLights(const State& state, const Sum& sum);
  /// xmin, xmax, ... of what is lit and of what casts shadows.
  using Box = std::array<double, 6>;
  Box GetSceneBounds(const State& state) const;

  vtkNew<vtkOpenGLAtlasTexture> Texture;
  const std::unique_ptr<Parts> Device;
  int Resolution = 512;
  int Samples = 2;
  bool Shadows = true;
  int ShadowMapSize = 4096;
  double RefractiveIndex = 1.3;
  vtkIdType NumberOfRuns = 0;
};

#endif
