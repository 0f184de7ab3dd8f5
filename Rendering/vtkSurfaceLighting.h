// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSurfaceLighting
 * @brief what lights translucent surfaces while they are drawn: the renderer's lights, an
 * environment, and irradiance that is in an array; their sum
 *
 * Belongs to the first of the three steps of vtkSubsurfaceScatteringPass (GetLighting) and to
 * vtkOpenGLTransmittedMap (SetLighting). What changes here costs that step, and the application of
 * the links.
 *
 * An *environment* is radiance from afar as vtkDirectIrradiance takes it. It lights by one of three
 * methods (EnvironmentMethod):
 * - Harmonics: spherical harmonics of degree 2, each weighted by what of it enters through the
 *   boundary (Fresnel); one drawing, no shadows. Of a bunny off by 0.6 % in a soft sky and 3 % with
 *   a sun of 20 degrees, more with a smaller one; the missing shadows are 10 %.
 * - Directions: the picture is divided into NumberOfEnvironmentDirections regions of much the same
 *   brightness (median cut); each is a directional light with a shadow map (where Shadows are on),
 *   and costs as much. The more directions, the nearer to the sum over all pixels, which as many
 *   directions as pixels are: 64 are off by 2 %, 16 by 6 %.
 * - Transfer: the surface has the array "RadianceTransfer" of vtkRadianceTransfer, made for the
 *   same refractive index, with shadows of what was in its input: soft light with self-shadowing
 *   for a dot product at each corner: off by 0.6 to 2 %. Cell values are taken where there are
 *   some, else point values, which are smoother and further off (4 %). The actor may be turned,
 *   moved and scaled evenly.
 *
 * An *array* (IrradianceArray) of the surface is taken as it is: a radiosity solution, Monte Carlo,
 * or measurements. It has 1 or 3 components, in cells (which are taken first) or points. What
 * vtkRadiosity calls "Irradiance" has the scene's lights in it: switch RendererLights off then.
 *
 * The surface may have *bumps*: the property's normal texture (vtkProperty::SetNormalTexture,
 * NormalScale), where the surface has active texture coordinates (those of its atlas, unless others
 * are made active) and tangents, turns the normals that lights, Harmonics and Directions see.
 * Triangles that face away from a light stay dark.
 */
#ifndef vtkSurfaceLighting_h
#define vtkSurfaceLighting_h

#include "vtkLightTransportRenderingModule.h" // for export macro
#include "vtkObject.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string

class vtkImageData;

namespace LightTransport
{
class EnvironmentLight;
class Outcome;
} // namespace LightTransport

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkSurfaceLighting : public vtkObject
{
public:
  static vtkSurfaceLighting* New();
  vtkTypeMacro(vtkSurfaceLighting, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EnvironmentMethodType
  {
    ENVIRONMENT_METHOD_HARMONICS = 0,
    ENVIRONMENT_METHOD_DIRECTIONS = 1,
    ENVIRONMENT_METHOD_TRANSFER = 2
  };

  /// As vtkSubsurfaceScattering::IncidenceType.
  enum IncidenceType
  {
    INCIDENCE_DIFFUSE = 0,
    INCIDENCE_TRANSMITTED = 1
  };

  ///@{
  /// Whether the lights of the renderer light surfaces. Default on. A renderer without lights makes
  /// a headlight: switch this off for an environment alone.
  vtkSetMacro(RendererLights, bool);
  vtkGetMacro(RendererLights, bool);
  vtkBooleanMacro(RendererLights, bool);
  ///@}

  ///@{
  /// Radiance from afar, or nullptr (the default): a picture in longitude and latitude, as
  /// vtkLightingAlgorithm::SetEnvironment and vtkOpenEXRReader have it.
  void SetEnvironment(vtkImageData* environment);
  vtkImageData* GetEnvironment();
  ///@}

  ///@{
  /// Where in the scene the picture's +z and +x are, as vtkRenderer::SetEnvironmentUp has it; need
  /// not be of length 1. Default (0, 0, 1) and (1, 0, 0).
  vtkSetVector3Macro(EnvironmentUp, double);
  vtkGetVector3Macro(EnvironmentUp, double);
  vtkSetVector3Macro(EnvironmentRight, double);
  vtkGetVector3Macro(EnvironmentRight, double);
  ///@}

  ///@{
  /// How the environment lights: see above. Default Harmonics.
  vtkSetClampMacro(EnvironmentMethod, int, ENVIRONMENT_METHOD_HARMONICS,
    ENVIRONMENT_METHOD_TRANSFER);
  vtkGetMacro(EnvironmentMethod, int);
  void SetEnvironmentMethodToHarmonics()
  {
    this->SetEnvironmentMethod(ENVIRONMENT_METHOD_HARMONICS);
  }
  void SetEnvironmentMethodToDirections()
  {
    this->SetEnvironmentMethod(ENVIRONMENT_METHOD_DIRECTIONS);
  }
  void SetEnvironmentMethodToTransfer() { this->SetEnvironmentMethod(ENVIRONMENT_METHOD_TRANSFER); }
  ///@}

  ///@{
  /// Directional lights that Directions makes of the picture, at most. Default 64, range 1 to
  /// 65536.
  vtkSetClampMacro(NumberOfEnvironmentDirections, int, 1, 65536);
  vtkGetMacro(NumberOfEnvironmentDirections, int);
  ///@}

  ///@{
  /// Array of the surface that has light in it, by its name. Default "": none.
  void SetIrradianceArray(const std::string& name);
  std::string GetIrradianceArray();
  ///@}

  ///@{
  /// Whether the array is light from all directions outside (the default; times 1 minus the mean
  /// external Fresnel reflectance it enters), or what has entered.
  vtkSetClampMacro(Incidence, int, INCIDENCE_DIFFUSE, INCIDENCE_TRANSMITTED);
  vtkGetMacro(Incidence, int);
  void SetIncidenceToDiffuse() { this->SetIncidence(INCIDENCE_DIFFUSE); }
  void SetIncidenceToTransmitted() { this->SetIncidence(INCIDENCE_TRANSMITTED); }
  ///@}

  ///@{
  /// Whether lights and environments are computed at the corners of triangles alone, and linear
  /// between them: cheaper where triangles are larger than texels, without bumps, and without
  /// edges of shadows within a triangle. Default off.
  vtkSetMacro(AtCorners, bool);
  vtkGetMacro(AtCorners, bool);
  vtkBooleanMacro(AtCorners, bool);
  ///@}

  ///@{
  /// Whether normal textures count. Default on.
  vtkSetMacro(Bumps, bool);
  vtkGetMacro(Bumps, bool);
  vtkBooleanMacro(Bumps, bool);
  ///@}

  /// Includes the environment.
  vtkMTimeType GetMTime() override;

protected:
  vtkSurfaceLighting();
  ~vtkSurfaceLighting() override;

private:
  vtkSurfaceLighting(const vtkSurfaceLighting&) = delete;
  void operator=(const vtkSurfaceLighting&) = delete;

  friend class vtkOpenGLTransmittedMap;
  struct Parts;

  /// The environment, read when it has changed.
  LightTransport::Outcome ReadEnvironment(const LightTransport::EnvironmentLight*& light);
  /// The picture's axes, row by row, in the scene.
  LightTransport::Outcome GetTurn(double turn[9]) const;

  const std::unique_ptr<Parts> Private;
  bool RendererLights = true;
  double EnvironmentUp[3] = { 0.0, 0.0, 1.0 };
  double EnvironmentRight[3] = { 1.0, 0.0, 0.0 };
  int EnvironmentMethod = ENVIRONMENT_METHOD_HARMONICS;
  int NumberOfEnvironmentDirections = 64;
  std::string IrradianceArray;
  int Incidence = INCIDENCE_DIFFUSE;
  bool AtCorners = false;
  bool Bumps = true;
};

#endif
