// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubsurfaceScatteringPass
 * @brief draws translucent surfaces: light that enters, is scattered inside and leaves elsewhere,
 * added to what the surface reflects at once
 *
 * Actors that have a material (SetMaterial) are scattered in while they are drawn, on the GPU, in
 * three steps, each a class of its own: what enters is drawn into the surface's atlas in the light
 * of the renderer (vtkOpenGLTransmittedMap); links are applied to it (vtkOpenGLScatteredMap); the
 * picture samples the result pixel by pixel, with mip-maps that no chart leaks into. Nothing is
 * computed again where only the camera moves; a light that moves, an environment that turns, or a
 * headlight with the camera, costs the first step and the application of the links; points that
 * move new links. Actors without
 * a material pay nothing. A surface that fails is drawn as usual, and an error tells why, once.
 *
 * Other actors with the point array "ScatteredIrradiance" of vtkSubsurfaceScattering draw that.
 *
 * Radiance = VTK's own shading of the actor under the renderer's lights (the direct part: usually
 * specular reflection alone, with the property's diffuse and ambient coefficients 0) + w
 * ScatteredIrradiance / pi, where
 *
 *   w = F_t(cos theta, n) / (1 - external 2C1),
 *
 * F_t is the Fresnel transmittance of a smooth boundary of relative index n towards the eye, for
 * unpolarised light, and external 2C1 = 2 Int_0^1 (1 - F_t(mu)) mu dmu its mean reflectance for
 * diffuse light from outside. So the pass shares out the exitance over the directions and keeps its
 * sum: the cosine-weighted mean of w over the hemisphere is 1.
 *
 * Colour = encoded(Exposure * radiance). VTK's shading has no unit; it is added as it is.
 * Physically based shading (vtkProperty::SetInterpolationToPBR) is decoded before it is added, with
 * the power of 2.2 that VTK encodes it with. See vtkTransportPass for what is drawn how.
 *
 * After H. W. Jensen, S. R. Marschner, M. Levoy, P. Hanrahan, A practical model for subsurface
 * light transport, SIGGRAPH 2001, eq. 5, whose exitant Fresnel factor is normalised here.
 */
#ifndef vtkSubsurfaceScatteringPass_h
#define vtkSubsurfaceScatteringPass_h

#include "vtkSmartPointer.h" // for members
#include "vtkTransportPass.h"

#include <map>    // for std::map
#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

namespace LightTransport
{
class ExactShadows;
class MarchedScattering;
class Outcome;
class SceneTree;
class SceneTrees;
class StandIns;
} // namespace LightTransport

class vtkActor;
class vtkOpenGLScatteredMap;
class vtkOpenGLTransmittedMap;
class vtkRenderer;
class vtkSubsurfaceScattering;
class vtkSurfaceLighting;

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkSubsurfaceScatteringPass : public vtkTransportPass
{
public:
  static vtkSubsurfaceScatteringPass* New();
  vtkTypeMacro(vtkSubsurfaceScatteringPass, vtkTransportPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Index of refraction of the material relative to what surrounds it. Default 1.3, range 1 to 10;
  /// 1 switches the weight off.
  void SetRefractiveIndex(double index);
  vtkGetMacro(RefractiveIndex, double);
  ///@}

  /// The weight w towards a direction that makes an angle of this cosine (0 to 1) with the normal.
  static double GetOutgoingWeight(double cosine, double refractiveIndex);

  ///@{
  /**
   * Makes an actor translucent: the scattering of its surface is computed while it is drawn. The
   * surface is one that vtkSurfaceAtlas made, the mapper a vtkPolyDataMapper of its own, or one of
   * composite data: each block with polygons is then a body of its own, which scatters no light
   * into others, and is drawn with the property of the actor and what the mapper's attributes say
   * of it. The filter has the coefficients and says which links there are; nothing need be
   * connected to it, and actors of one material may share it. MillimetersPerUnit is that of the
   * mapper's input: the actor's matrix moves and turns it. nullptr takes the material away.
   */
  void SetMaterial(vtkActor* actor, vtkSubsurfaceScattering* material);
  vtkSubsurfaceScattering* GetMaterial(vtkActor* actor);
  ///@}

  /// Actors that have one.
  int GetNumberOfMaterials();

  ///@{
  /**
   * Texels a side of the maps of what enters, and of what leaves; powers of two. Default 512, range
   * 128 to 4096, and 16 to 2048. The larger the more exact: what enters takes 21 bytes a texel and
   * a drawing for each light; what leaves takes besides the time to make its links.
   */
  vtkSetClampMacro(IrradianceMapSize, int, 128, 4096);
  vtkGetMacro(IrradianceMapSize, int);
  vtkSetClampMacro(ScatteredMapSize, int, 16, 2048);
  vtkGetMacro(ScatteredMapSize, int);
  ///@}

  ///@{
  /// See vtkOpenGLTransmittedMap. Defaults 2, on, 4096.
  vtkSetClampMacro(IrradianceSamples, int, 1, 8);
  vtkGetMacro(IrradianceSamples, int);
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  vtkSetClampMacro(ShadowMapSize, int, 16, 8192);
  vtkGetMacro(ShadowMapSize, int);
  ///@}

  ///@{
  /**
   * Whether what VTK shades, of all actors that are drawn, has shadows: of each light only what a
   * ray from the fragment reaches it by. Their edges are those of the triangles, whatever the
   * distance, where those of shadow maps are smeared; nothing nearer than 1e-5 of the scene casts
   * one. What casts shadows is what does in the maps; a facet that turns away from a light is dark,
   * also where smooth normals are not. Goes with depth peeling, passes that smooth edges, cameras
   * anywhere, open sheets. Costs a ray through a tree of all triangles for each fragment and light,
   * and the making of the tree (80 bytes a triangle or so) where a surface has another shape or
   * place; each renderer has its own. A light that is nowhere (its position is not finite) casts
   * none, which an error tells once; an actor in whose shaders there is no place for them, since
   * its own code replaces VTK's lighting, is drawn without, which a warning tells. Default off.
   */
  vtkSetMacro(DirectShadows, bool);
  vtkGetMacro(DirectShadows, bool);
  vtkBooleanMacro(DirectShadows, bool);
  ///@}

  ///@{
  /**
   * Light that is scattered exactly once in actors with a material, from the renderer's lights (not
   * environments and arrays), marched pixel by pixel for the shape as it is: along the refracted
   * way of what the eye sees up to where it leaves the body (the surface must be closed; a sheet
   * that is open is a half space), and from each place on it straight to each light, through the
   * body, also through other parts of it, which dim it, and other actors, which block it. Fresnel's
   * equations at each surface, extinction with the coefficients that are not reduced, Henyey and
   * Greenstein's phase function with the material's Anisotropy, three bands. Exact for an index of
   * 1, and for distant lights on flat surfaces; elsewhere light is not focused, as in Jensen and
   * others, 2001; reflections inside are not followed (vtkSingleScattering does both, as an array).
   *
   * - Off (the default): the map of what leaves has it as in a flat body.
   * - Only: in place of that map, which is not made; surfaces need no atlas. All that there is in a
   *   body that is thin or clear.
   * - Added: to that map. Every model has light that is scattered once in its profile already, so
   * it is counted twice then: Jensen's model with Model Dipole, and more light than energy allows
   *   with any where little is absorbed.
   *
   * Steps are those of each pixel's way, all of the same loss in the clearest band: default 8,
   * range 1 to 256. Costs two rays for each step and light, and the tree of DirectShadows. A mean
   * free path must be longer than 1e-4 of the scene; where it is short, facets are seen. Lights or
   * a material that are no good leave it away, with an error that is told once.
   */
  enum SingleScatteringType
  {
    SINGLE_SCATTERING_OFF = 0,
    SINGLE_SCATTERING_ONLY = 1,
    SINGLE_SCATTERING_ADDED = 2
  };
  vtkSetClampMacro(SingleScattering, int, SINGLE_SCATTERING_OFF, SINGLE_SCATTERING_ADDED);
  vtkGetMacro(SingleScattering, int);
  void SetSingleScatteringToOff() { this->SetSingleScattering(SINGLE_SCATTERING_OFF); }
  void SetSingleScatteringToOnly() { this->SetSingleScattering(SINGLE_SCATTERING_ONLY); }
  void SetSingleScatteringToAdded() { this->SetSingleScattering(SINGLE_SCATTERING_ADDED); }
  vtkSetClampMacro(SingleScatteringSteps, int, 1, 256);
  vtkGetMacro(SingleScatteringSteps, int);
  ///@}

  ///@{
  /// What lights the surfaces: the renderer's lights (the default), environments, arrays.
  void SetLighting(vtkSurfaceLighting* lighting);
  vtkSurfaceLighting* GetLighting();
  ///@}

  ///@{
  /// How often the steps have been computed, over all actors: what enters was drawn, links were
  /// made, links were applied.
  vtkIdType GetNumberOfIrradianceRuns();
  vtkIdType GetNumberOfLinkRuns();
  vtkIdType GetNumberOfScatteringRuns();
  ///@}

  /// How often the tree of DirectShadows and SingleScattering has been made.
  vtkIdType GetNumberOfShadowRuns();

  ///@{
  /// The maps of an actor that has a material: their textures can be read
  /// (vtkOpenGLAtlasTexture::ReadImage). nullptr for others. They follow the properties above. Of
  /// composite data, those of the block of that number among those with polygons, from the first
  /// frame on.
  vtkOpenGLTransmittedMap* GetTransmittedMap(vtkActor* actor, int block = 0);
  vtkOpenGLScatteredMap* GetScatteredMap(vtkActor* actor, int block = 0);
  ///@}

  void ReleaseGraphicsResources(vtkWindow* window) override;

  ///@{
  /// Called by mappers.
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override;
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* vao = nullptr) override;
  ///@}

protected:
  vtkSubsurfaceScatteringPass();
  ~vtkSubsurfaceScatteringPass() override;

  bool UpdateMaps(const vtkRenderState* state) override;
  void ReplaceProps(const vtkRenderState* state, std::vector<vtkProp*>& props) override;
  LightTransport::RadianceShader::Source GetSource(vtkProp* prop) override;
  void SetMap(vtkShaderProgram* program, vtkProp* prop,
    LightTransport::RadianceShader::Uniforms& uniforms) override;
  void LetGoOfMaps() override;

  const char* GetFragmentShader() override;
  double GetFresnelIndex() override { return this->RefractiveIndex; }
  double GetMeanTransmittance() override { return this->MeanTransmittance; }

private:
  vtkSubsurfaceScatteringPass(const vtkSubsurfaceScatteringPass&) = delete;
  void operator=(const vtkSubsurfaceScatteringPass&) = delete;

  struct Body;

  Body* FindBody(vtkProp* drawn);
  Body* FindBody(vtkActor* actor, int block);
  Body& AddBody(vtkActor* actor, int block, vtkSubsurfaceScattering* material);
  void RemoveBodies(vtkActor* actor, int firstBlock);
  void FindDrawn(vtkActor* actor);
  bool Update(Body& body, vtkRenderer* renderer);
  void TellOnce(const LightTransport::Outcome& done, std::string& told);
  void UpdateTree(vtkRenderer* renderer);
  void UpdateMarched(Body& body, bool isMapped);
  void WarnOfUnshadowed();
  void LetGoOfBody();

  vtkSmartPointer<vtkSurfaceLighting> Lighting;
  std::vector<std::unique_ptr<Body>> Bodies;
  const std::unique_ptr<LightTransport::StandIns> Blocks;
  const std::unique_ptr<LightTransport::SceneTrees> Trees;
  const std::unique_ptr<LightTransport::ExactShadows> Shadowed;
  const std::unique_ptr<LightTransport::MarchedScattering> Marched;
  Body* Bound = nullptr; ///< whose textures are active
  int IrradianceMapSize = 512;
  int IrradianceSamples = 2;
  bool Shadows = true;
  bool DirectShadows = false;
  LightTransport::SceneTree* Tree = nullptr; ///< of the frame that is drawn, where it is needed
  bool IsTreeActive = false;
  std::map<vtkActor*, bool> Shadowable; ///< those whose shaders were made: whether any has shadows
  int SingleScattering = SINGLE_SCATTERING_OFF;
  int SingleScatteringSteps = 8;
  int MarchedLights = 0; ///< of the frame that is drawn
  bool AreShadowsDrawn = false;
  bool WarnedOfUnshadowed = false;
  int ShadowMapSize = 4096;
  int ScatteredMapSize = 512;
  double RefractiveIndex = 0.0;
  double MeanTransmittance = 1.0;
};

#endif
