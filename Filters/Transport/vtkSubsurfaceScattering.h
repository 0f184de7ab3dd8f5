// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubsurfaceScattering
 * @brief light that enters a translucent object, is scattered inside and leaves elsewhere
 *
 * The surface is cut into the input's patches (polygons of any shape). What enters patch j leaves
 * patch i in proportion to the diffuse reflectance profile R_d(r) of a semi-infinite medium,
 * integrated over both patches, with r the straight distance between the points:
 *
 *   M_i = 1/A_i sum_j G_ij E_j,   G_ij = integral over patch i and patch j of R_d(|x - y|)
 *
 * for all pairs, adaptively near by and by simple rules far away (see LinkTolerance), or for
 * clusters of patches in place of the far ones (see LinkMethod). The energy that stays within the
 * patch it entered comes from the profile's exact moments, so patches may be any number of mean
 * free paths wide.
 *
 * With MODEL_MONTE_CARLO photons walk in the body itself instead: they start on the patches that
 * light enters, as diffuse light under either Incidence (cosine outside, refracted), are scattered
 * by the phase function of Henyey and Greenstein, reflected and refracted at the patches as at
 * smooth facets, and enter again where the body is not convex. The surface must be closed, its
 * fronts outside; there may be several bodies, and cavities. All three components share their
 * photons where their Anisotropy is the same. MODEL_TABULATED is in between: a profile, from
 * photons that walk in a flat medium, as diffuse light, too.
 *
 * The input may be the texels of an atlas as well: a vtkImageData of one layer with the point
 * arrays "Position", "Normal", "Area" and "ChartId", as vtkSurfaceToAtlas makes it, or composite
 * data of such images (one scene, as with surfaces; not both kinds). A texel is a patch then: a
 * parallelogram around its position, in the plane of its normal, along the steps to its neighbours
 * in the same chart, of exactly its area. Arrays are point arrays, in and out, and the output is
 * the image; texels without surface get 0. What looks into the body (MODEL_MONTE_CARLO,
 * ComputeThickness, DropLinksThroughAir) needs the surface, and "LinksThroughAir" is not told. On
 * several ranks each may have all of an image, a part, or nothing: texels that two have alike count
 * once.
 *
 * Port 1, optional, for MODEL_MONTE_CARLO: the medium where it varies, a vtkImageData placed in the
 * unit of the surface (origin, spacing, direction matrix), with the arrays "Scattering" (the
 * reduced coefficient, as the property is) and "Absorption", per mm, 1 component (the same in all
 * bands) or 3. Cell arrays are constant in each voxel, and go before point arrays of the same name,
 * which are trilinear. Around the image, and for an array that it does not have, the filter's own
 * coefficients hold. Each band has photons of its own then. RefractiveIndex and Anisotropy do not
 * vary.
 *
 * Input arrays (cells, float or double, 1 component = the same in all bands, 3 = red, green, blue,
 * or 3 for each of several lights, one light after another; choose others with
 * SetInputArrayToProcess(0, ...)):
 * - "Irradiance" when Incidence is Diffuse, incident flux per unit area;
 * - "TransmittedIrradiance" when Incidence is Transmitted, flux per unit area that has entered the
 *   surface already; vtkDirectIrradiance writes it. Array 1, where one is chosen, comes before
 * array 0 then, so that both choices can be kept.
 *
 * Several lights share the links, and passes over them: they cost less than as many runs, and each
 * comes out as if it were alone. MODEL_MONTE_CARLO needs links for them (LINK_METHOD_DENSE).
 *
 * Output arrays (cells and points, double):
 * - "ScatteredIrradiance" (3 components for each light, in their order): radiant exitance that
 * leaves the surface by scattering, in all directions, per unit area, without a factor 1/pi; in the
 * unit of the input array. What was scattered once or more: light that runs through the body
 * unscattered is not in it;
 * - "ScatteredIrradianceError" (MODEL_MONTE_CARLO): one standard error of it; of a patch that no
 * photon has reached that of one photon;
 * - with ComputeThickness "Thickness" (mm) and "DiffusionThickness" (3 components).
 *
 * Output field data: "NumberOfLinks", "LinksPerReceiver", "LinksLeftOut", "LinkMethodUsed",
 * "LinkErrorBound" (Dense) or "LinkError" and "LinksLimitedBy" (others), "LinkBytes",
 * "LinkSeconds", "ApplySeconds", "EnteringFlux" and "LeavingFlux" (3 components for each light;
 * irradiance times the square of the input's length unit), "DeviceUsed", "DeviceExplanation". Port
 * 1 is a vtkTable with one row: "Links", "LinksLeftOut", "LinkSeconds", "ApplySeconds",
 * "ErrorBound". "LinksReused" is 1 where links of an earlier run were taken, and of a body that has
 * moved the share of links from the clusters that were chosen before, see ReuseLinks.
 * "LinksThroughAir" (models that are profiles, 3 components for each light; not of texels): of the
 * light that links carry, those that are dropped included, the share that goes through the air
 * between parts of the body, see DropLinksThroughAir; estimated from some 64 links of each patch,
 * with one standard error "LinksThroughAirError", exact where they are dropped and for one convex
 * body (0). "ProfileTotal" (those models, 3 components): what a flat surface gives back of the
 * light that enters; a body may give back more or less, and a warning tells where it is more than
 * enters. "ProfileError" (MODEL_TABULATED, 3 components): standard error of that, relative; more
 * where less than 1e-4 is absorbed. Light that Monte Carlo lets enter again counts in LeavingFlux
 * each time it leaves. Monte Carlo without links has in their place "PhotonsTraced",
 * "RelativeError" (of each band, as TargetError), "LeavingShare" (of what enters, what goes away
 * for good after scattering) with "LeavingShareError", "UnscatteredShare", "LostShare" (0 but for
 * surfaces that cross themselves and very large bodies), "ScatteringsPerPhoton", "EntriesPerPhoton"
 * and "WalkSeconds", and in the table "Photons", "WalkSeconds", "Error". With ComputeThickness
 * "ThinShare" (3 components: the part of the surface that is thinner than two diffusion lengths).
 *
 * Errors: coefficients that are negative or not finite, a band without scattering and absorption, a
 * refractive index below 1, MillimetersPerUnit not above 0, irradiance that is missing, not
 * finite or of any other number of components, links that do not fit into memory. Monte Carlo: a
 * surface that is open, inside out, has no inside or crosses itself; irradiance below 0, or of
 * several lights, without links; Anisotropy out of its range; a medium without any of its arrays,
 * that is flat, or has values below 0 or not finite. A medium with another Model. Texels: an image
 * that has not all their arrays, values that are not finite or areas below 0, images beside
 * surfaces, what looks into the body.
 *
 * H. W. Jensen, S. R. Marschner, M. Levoy, P. Hanrahan, "A Practical Model for Subsurface Light
 * Transport", SIGGRAPH 2001; H. W. Jensen, J. Buhler, "A Rapid Hierarchical Rendering Technique for
 * Translucent Materials", SIGGRAPH 2002; N. A. Carr, J. D. Hall, J. C. Hart, "GPU Algorithms for
 * Radiosity and Subsurface Scattering", Graphics Hardware 2003; L. Wang, S. L. Jacques, L. Zheng,
 * "MCML - Monte Carlo modeling of light transport in multi-layered tissues", 1995.
 *
 * @sa vtkDirectIrradiance, vtkRadiosity, vtkSurfaceToAtlas, vtkAtlasToSurface
 */
#ifndef vtkSubsurfaceScattering_h
#define vtkSubsurfaceScattering_h

#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace LightTransport
{
class LinkCache;
}
class vtkExchange;
class vtkImageData;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkSubsurfaceScattering : public vtkTransportAlgorithm
{
public:
  static vtkSubsurfaceScattering* New();
  vtkTypeMacro(vtkSubsurfaceScattering, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Diffuse reflectance profiles of a flat body, and photons in the body itself.
  enum ModelType
  {
    MODEL_DIPOLE = 0,
    MODEL_BETTER_DIPOLE = 1,
    MODEL_PHOTON_BEAM_DIFFUSION = 2,
    MODEL_CHRISTENSEN_BURLEY = 3,
    MODEL_MONTE_CARLO = 4,
    MODEL_TABULATED = 5
  };

  /// How the model is applied.
  enum LinkMethodType
  {
    LINK_METHOD_AUTO = 0,
    LINK_METHOD_DENSE = 1,
    LINK_METHOD_UNIFORM = 2,
    LINK_METHOD_ADAPTIVE = 3
  };

  /// Fits of the model of Christensen and Burley.
  enum BurleyFitType
  {
    BURLEY_FIT_SEARCHLIGHT = 0,
    BURLEY_FIT_DIFFUSE_SURFACE = 1,
    BURLEY_FIT_DIFFUSE_MEAN_FREE_PATH = 2
  };

  /// What the input array holds.
  enum IncidenceType
  {
    INCIDENCE_DIFFUSE = 0,
    INCIDENCE_TRANSMITTED = 1
  };

  ///@{
  /**
   * The material. A preset brings its own coefficients and refractive index; they win over the
   * properties of that name when the filter runs. Default MATERIAL_CUSTOM.
   */
  vtkSetClampMacro(Material, int, MATERIAL_CUSTOM, MATERIAL_WHOLEMILK);
  vtkGetMacro(Material, int);
  void SetMaterialToCustom() { this->SetMaterial(MATERIAL_CUSTOM); }
  void SetMaterialToApple() { this->SetMaterial(MATERIAL_APPLE); }
  void SetMaterialToChicken1() { this->SetMaterial(MATERIAL_CHICKEN1); }
  void SetMaterialToChicken2() { this->SetMaterial(MATERIAL_CHICKEN2); }
  void SetMaterialToCream() { this->SetMaterial(MATERIAL_CREAM); }
  void SetMaterialToKetchup() { this->SetMaterial(MATERIAL_KETCHUP); }
  void SetMaterialToMarble() { this->SetMaterial(MATERIAL_MARBLE); }
  void SetMaterialToPotato() { this->SetMaterial(MATERIAL_POTATO); }
  void SetMaterialToSkimmilk() { this->SetMaterial(MATERIAL_SKIMMILK); }
  void SetMaterialToSkin1() { this->SetMaterial(MATERIAL_SKIN1); }
  void SetMaterialToSkin2() { this->SetMaterial(MATERIAL_SKIN2); }
  void SetMaterialToSpectralon() { this->SetMaterial(MATERIAL_SPECTRALON); }
  void SetMaterialToWholemilk() { this->SetMaterial(MATERIAL_WHOLEMILK); }
  ///@}

  ///@{
  /**
   * Coefficients and refractive index of a preset. Returns false, and leaves the arguments alone,
   * for MATERIAL_CUSTOM and unknown values. GetMaterialName returns nullptr for unknown values.
   */
  static bool GetMaterialProperties(int material, double scattering[3], double absorption[3],
    double& refractiveIndex);
  static const char* GetMaterialName(int material);
  ///@}

  ///@{
  /**
   * Reduced scattering coefficient, (1 - g) sigma_s, of red, green and blue, per millimetre.
   * Default 1, 1, 1; range 0 and up. Used when Material is MATERIAL_CUSTOM.
   */
  vtkSetVector3Macro(ScatteringCoefficient, double);
  vtkGetVector3Macro(ScatteringCoefficient, double);
  ///@}

  ///@{
  /**
   * Absorption coefficient of red, green and blue, per millimetre. Default 0.01, 0.01, 0.01; range
   * 0 and up. Used when Material is MATERIAL_CUSTOM.
   */
  vtkSetVector3Macro(AbsorptionCoefficient, double);
  vtkGetVector3Macro(AbsorptionCoefficient, double);
  ///@}

  ///@{
  /**
   * Refractive index of the object relative to its surroundings. Default 1.3, range 1 and up. Used
   * when Material is MATERIAL_CUSTOM.
   */
  vtkSetMacro(RefractiveIndex, double);
  vtkGetMacro(RefractiveIndex, double);
  ///@}

  ///@{
  /// Length of the input's unit in millimetres: 10 for centimetres. Default 1, range above 0.
  vtkSetMacro(MillimetersPerUnit, double);
  vtkGetMacro(MillimetersPerUnit, double);
  ///@}

  ///@{
  /**
   * The profile. Light is taken to enter along the normal; errors are those of the total and, in
   * brackets, of the profile, weighted by energy, against exact transport at index 1.4 and reduced
   * albedos of 0.8 to 0.99:
   * - MODEL_DIPOLE, of Jensen et al. 2001: 21 % (65 %);
   * - MODEL_BETTER_DIPOLE, of d'Eon 2012, with exact single scattering: 8 % (17 %);
   * - MODEL_PHOTON_BEAM_DIFFUSION (the default), of Habel et al. 2013, with exact single
   * scattering: 6 % (6 %);
   * - MODEL_CHRISTENSEN_BURLEY, of 2015, a fit for index 1, see BurleyFit: RefractiveIndex has no
   * influence on it. At index 1 as Searchlight: 0 % (6 %), the best there; at 1.4 81 % (82 %).
   * At index 1 the better dipole and photon beam diffusion are 18 % and 14 % off, and may give back
   * up to 1.15 and 1.09 of what enters where nothing is absorbed.
   * MODEL_TABULATED is the exact profile for light that enters from all directions, and for
   * anisotropic scattering, but for errors of chance: 0.1 to 0.2 % (1 %). It takes one to two
   * seconds of CPU time for each band that is new; tables are kept by the process.
   * MODEL_MONTE_CARLO is none: photons walk in the body itself, which must be closed, as light that
   * enters from all directions. Its errors are those of chance, see TargetError.
   */
  vtkSetClampMacro(Model, int, MODEL_DIPOLE, MODEL_TABULATED);
  vtkGetMacro(Model, int);
  void SetModelToDipole() { this->SetModel(MODEL_DIPOLE); }
  void SetModelToBetterDipole() { this->SetModel(MODEL_BETTER_DIPOLE); }
  void SetModelToPhotonBeamDiffusion() { this->SetModel(MODEL_PHOTON_BEAM_DIFFUSION); }
  void SetModelToChristensenBurley() { this->SetModel(MODEL_CHRISTENSEN_BURLEY); }
  void SetModelToMonteCarlo() { this->SetModel(MODEL_MONTE_CARLO); }
  void SetModelToTabulated() { this->SetModel(MODEL_TABULATED); }
  ///@}

  ///@{
  /**
   * What the model of Christensen and Burley is fitted to: a thin beam along the normal, by the
   * mean free path (Searchlight) or by the diffuse mean free path (DiffuseMeanFreePath, which needs
   * absorption), or a surface in diffuse light (DiffuseSurface, the default). Other models do not
   * look at it.
   */
  vtkSetClampMacro(BurleyFit, int, BURLEY_FIT_SEARCHLIGHT, BURLEY_FIT_DIFFUSE_MEAN_FREE_PATH);
  vtkGetMacro(BurleyFit, int);
  void SetBurleyFitToSearchlight() { this->SetBurleyFit(BURLEY_FIT_SEARCHLIGHT); }
  void SetBurleyFitToDiffuseSurface() { this->SetBurleyFit(BURLEY_FIT_DIFFUSE_SURFACE); }
  void SetBurleyFitToDiffuseMeanFreePath()
  {
    this->SetBurleyFit(BURLEY_FIT_DIFFUSE_MEAN_FREE_PATH);
  }
  ///@}

  ///@{
  /**
   * From whom a patch receives light:
   * - Dense: all pairs of patches, n^2 of them;
   * - Uniform: the same NumberOfLinks clusters of patches for every receiver, chosen so that each
   *   adds alike to the error, but that the cluster which holds the receiver is divided down to it;
   * - Adaptive: clusters of each receiver's own, small near by and where the profile is steep.
   *   They are refined until LinkTolerance holds, or a receiver would have more than NumberOfLinks
   *   on average, whichever is first (field data "LinksLimitedBy");
   * - Auto (the default): the cheaper one of Adaptive without a limit on the links, and Dense, with
   *   the tolerance of each.
   * A link from a cluster takes its light for the mean (Jensen and Buhler 2002; Carr, Hall and Hart
   * 2003).
   *
   * With MODEL_MONTE_CARLO Auto follows the light as it is, which is the fastest way to one result;
   * Dense makes links of photons that start everywhere, which are kept, so that new light on the
   * same body costs one product; the others are refused.
   */
  vtkSetClampMacro(LinkMethod, int, LINK_METHOD_AUTO, LINK_METHOD_ADAPTIVE);
  vtkGetMacro(LinkMethod, int);
  void SetLinkMethodToAuto() { this->SetLinkMethod(LINK_METHOD_AUTO); }
  void SetLinkMethodToDense() { this->SetLinkMethod(LINK_METHOD_DENSE); }
  void SetLinkMethodToUniform() { this->SetLinkMethod(LINK_METHOD_UNIFORM); }
  void SetLinkMethodToAdaptive() { this->SetLinkMethod(LINK_METHOD_ADAPTIVE); }
  ///@}

  ///@{
  /**
   * Clusters of Uniform, and links of a receiver of Adaptive, on average, at most. Default 64,
   * range 1 to 65536.
   */
  vtkSetClampMacro(NumberOfLinks, int, 1, 65536);
  vtkGetMacro(NumberOfLinks, int);
  ///@}

  ///@{
  /**
   * Keep the choice of links from clusters for a body that moves: when points have other
   * coordinates, but polygons the same point ids in the same blocks (or the same texels of an image
   * other positions, normals and areas), only the factors of links are evaluated anew, for the
   * clusters that were chosen for an earlier position. Links are refined where that is not enough.
   * They are chosen afresh, clusters and all, where otherwise their error, as told, would
   * exceed 1.2 times what it was when they were chosen (or, where NumberOfLinks is what limits
   * them, what new ones of these clusters would tell), or their number 1.2 times that, or
   * NumberOfLinks. So results within a movement differ from those of a new filter, within 1.2 times
   * the error of links. They depend on the position for which links were chosen last, and on none
   * since: a body that comes back there has its links back. Rigid movements keep all links. Field
   * data "LinksReused" is the share of links that were kept. Links are chosen afresh as well after
   * any property of links has been changed. Switched off, each result is that of a new filter, to
   * the bit. Links between all pairs have nothing to be kept: all of them are evaluated anew. Those
   * of RefineByIrradiance, which are for one light, are chosen anew, too. Default on.
   */
  vtkSetMacro(ReuseLinks, bool);
  vtkGetMacro(ReuseLinks, bool);
  vtkBooleanMacro(ReuseLinks, bool);
  ///@}

  ///@{
  /**
   * Choose clusters by the light that is there, too: they are divided where both the profile and
   * the irradiance differ within them, and are large where it is even. Fewer links, or a smaller
   * error, for this light: half of either, about; of several lights the worst one counts in each
   * cluster. LinkTolerance and field data "LinkError" are then what links miss of this light,
   * relative to what leaves, both root mean square over the surface, of the worst component. Links
   * are made again for each new light, and none are kept (ReuseLinks): for a series give all lights
   * together, or leave this off. Links between all pairs do not look at it. Default off.
   */
  vtkSetMacro(RefineByIrradiance, bool);
  vtkGetMacro(RefineByIrradiance, bool);
  vtkBooleanMacro(RefineByIrradiance, bool);
  ///@}

  ///@{
  /**
   * Keep links from clusters in one byte (Uniform) or two, by a code book of 256 values that is
   * trained on them, as Carr, Hall and Hart did: an eighth of the memory, and of what a product
   * reads. Auto then takes Adaptive; links between all pairs cannot be. Field data
   * "CompressionError": the relative error (root mean square) of the links, as they act in light
   * that comes from anywhere; in even light the result is less off. Default off.
   */
  vtkSetMacro(CompressLinks, bool);
  vtkGetMacro(CompressLinks, bool);
  vtkBooleanMacro(CompressLinks, bool);
  ///@}

  ///@{
  /**
   * Bound on the error of compressed links, relative to what a patch receives in even light: links
   * that the code book misses by too much are kept exact. Default 0, which is no bound: none are.
   * Range 0 to 1.
   */
  vtkSetClampMacro(CompressionTolerance, double, 0.0, 1.0);
  vtkGetMacro(CompressionTolerance, double);
  ///@}

  ///@{
  /**
   * Mean cosine of the angle by which photons are scattered (Henyey and Greenstein), of red, green
   * and blue, for MODEL_MONTE_CARLO and MODEL_TABULATED. ScatteringCoefficient stays the reduced
   * one: photons are scattered 1 / (1 - Anisotropy) times as often. Default 0, 0, 0; range -0.99 to
   * 0.99.
   */
  vtkSetVector3Macro(Anisotropy, double);
  vtkGetVector3Macro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Photons of MODEL_MONTE_CARLO, all walks together; 0 (the default) for as many as TargetError
   * asks. Of MODEL_TABULATED those of each band; 0 for as many as a second or two allow.
   */
  vtkSetClampMacro(NumberOfPhotons, vtkIdType, 0, vtkIdType(1) << 30);
  vtkGetMacro(NumberOfPhotons, vtkIdType);
  ///@}

  ///@{
  /**
   * Standard error of the result of MODEL_MONTE_CARLO, relative, root mean square over the surface;
   * the band where it is largest counts. Default 1e-2, range 1e-5 to 1.
   */
  vtkSetClampMacro(TargetError, double, 1e-5, 1.0);
  vtkGetMacro(TargetError, double);
  ///@}

  ///@{
  /// Of the random numbers of MODEL_MONTE_CARLO and MODEL_TABULATED: the same seed gives the same
  /// result, on any number of threads and ranks. Default 1.
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Tell how thick the body is: the way along the inward normal to its far side, in mm
   * ("Thickness") and in diffusion lengths of each band ("DiffusionThickness", 0 where nothing is
   * absorbed; by the filter's own coefficients, also where a medium varies); the diagonal of the
   * bounding box where an open surface has no far side. Models stand for a medium without end: a
   * warning tells where more than a tenth of the surface is thinner than two diffusion lengths.
   * Default off.
   */
  vtkSetMacro(ComputeThickness, bool);
  vtkGetMacro(ComputeThickness, bool);
  vtkBooleanMacro(ComputeThickness, bool);
  ///@}

  ///@{
  /**
   * Leave out links of profiles that go through the air between two parts of the body, or between
   * two bodies ("LinksThroughAir" tells what they would have carried, exactly then). A link does
   * where the straight segment between the centroids of its patches leaves the body through one
   * polygon and enters it through another, and these are turned towards each other: their normals
   * differ by more than a right angle. The inside of corners and dents that are less does not
   * count. The light of such links is lost, not given to others: MODEL_MONTE_CARLO, which does not
   * look at this, follows it. Default off.
   */
  vtkSetMacro(DropLinksThroughAir, bool);
  vtkGetMacro(DropLinksThroughAir, bool);
  vtkBooleanMacro(DropLinksThroughAir, bool);
  ///@}

  ///@{
  /**
   * Error that links may have together, relative to all that a unit of entering light gives back
   * (the profile's total): for Dense of each patch; for Adaptive the root mean square over the
   * surface, of light that differs from its mean over each cluster by .6 of it (see
   * RefineByIrradiance). Default 0: 1e-4 for Dense, 1e-2 for Adaptive. Range 0, or 1e-8, to 0.1.
   */
  vtkSetClampMacro(LinkTolerance, double, 0.0, 0.1);
  vtkGetMacro(LinkTolerance, double);
  ///@}

  ///@{
  /**
   * What the input array holds. Diffuse (the default): incident irradiance from all directions; the
   * mean external Fresnel reflectance is taken off. Transmitted: what has entered the surface.
   */
  vtkSetClampMacro(Incidence, int, INCIDENCE_DIFFUSE, INCIDENCE_TRANSMITTED);
  vtkGetMacro(Incidence, int);
  void SetIncidenceToDiffuse() { this->SetIncidence(INCIDENCE_DIFFUSE); }
  void SetIncidenceToTransmitted() { this->SetIncidence(INCIDENCE_TRANSMITTED); }
  ///@}

  ///@{
  /// Where the links are applied, and those from clusters chosen (field data "LinksChosenOn").
  /// Default DEVICE_AUTO: OpenGL on a real GPU, else the CPU.
  vtkSetClampMacro(Device, int, DEVICE_AUTO, DEVICE_OPENGL);
  vtkGetMacro(Device, int);
  void SetDeviceToAuto() { this->SetDevice(DEVICE_AUTO); }
  void SetDeviceToCPU() { this->SetDevice(DEVICE_CPU); }
  void SetDeviceToOpenGL() { this->SetDevice(DEVICE_OPENGL); }
  ///@}

  /**
   * The links of a texel image alone, for those who apply them elsewhere
   * (vtkSubsurfaceScatteringPass): no light is needed, and input connections do not matter. `rows`
   * becomes a copy of `texels` with the point array "LinkRow": which row of the exchange a texel
   * is, from 1 on; 0 for texels without surface. Returns nullptr, with an error, where there are
   * none, and after an abort. The filter keeps the links until a run needs others.
   */
  vtkExchange* MakeTexelLinks(vtkImageData* texels, vtkImageData* rows);

protected:
  vtkSubsurfaceScattering();
  ~vtkSubsurfaceScattering() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkSubsurfaceScattering(const vtkSubsurfaceScattering&) = delete;
  void operator=(const vtkSubsurfaceScattering&) = delete;

  /// Kept for as long as what they depend on stays the same.
  std::unique_ptr<LightTransport::LinkCache> Links;

  int Material = MATERIAL_CUSTOM;
  double ScatteringCoefficient[3] = { 1.0, 1.0, 1.0 };
  double AbsorptionCoefficient[3] = { 0.01, 0.01, 0.01 };
  double RefractiveIndex = 1.3;
  double MillimetersPerUnit = 1.0;
  int Model = MODEL_PHOTON_BEAM_DIFFUSION;
  int BurleyFit = BURLEY_FIT_DIFFUSE_SURFACE;
  int LinkMethod = LINK_METHOD_AUTO;
  double Anisotropy[3] = { 0.0, 0.0, 0.0 };
  vtkIdType NumberOfPhotons = 0;
  double TargetError = 1e-2;
  int Seed = 1;
  bool ComputeThickness = false;
  bool DropLinksThroughAir = false;
  int NumberOfLinks = 64;
  bool ReuseLinks = true;
  bool RefineByIrradiance = false;
  bool CompressLinks = false;
  double CompressionTolerance = 0.0;
  double LinkTolerance = 0.0;
  int Incidence = INCIDENCE_DIFFUSE;
  int Device = DEVICE_AUTO;
};

#endif
