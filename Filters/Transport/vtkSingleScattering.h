// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSingleScattering
 * @brief light that is scattered exactly once inside a translucent object and leaves
 *
 * Output arrays (cells and points, double, 3 components):
 * - "SingleScatteredIrradiance": radiant exitance, in all directions, per unit area, without a
 *   factor 1/pi, of light that was scattered exactly once; the mean over the patch. It is a part of
 *   the "ScatteredIrradiance" of vtkSubsurfaceScattering (all its models have single scattering in
 *   them) and must never be added to it;
 * - "SingleScatteredIrradianceError": what it may be off by, one standard error of the samples.
 *
 * Directional, positional (with a cone) and environment light are those of vtkLightingAlgorithm,
 * and need no array on the input. Rays are marched from the surface: refracted inwards, reflected
 * inside as often as it is worth, to a point where light is scattered by the phase function of
 * Henyey and Greenstein. From there
 * - lights, and what is bright in an environment (a sun), are searched on all polygons through
 * which their light can come to the point, refracted there by Snell's law: exact for the facets as
 * they are, with the light that they focus, and shadows outside;
 * - the rest of an environment is looked at along a ray, and its reflections.
 * Light of lights and suns that is reflected inside before it is scattered, or comes by a detour,
 * is followed from where it meets the surface first, by as many rays.
 *
 * Polygons are smooth facets for Fresnel's equations and refraction. The input must be a closed
 * surface, its fronts outside; there may be several bodies, and cavities.
 *
 * It agrees with photons that were scattered once to their errors, also where light passes through
 * the body, or is reflected outside, before it enters, and where it enters again when it has left.
 *
 * Output field data: "SingleScatteredFlux" (3 components: exitance times area, in the input's
 * length unit squared), "SingleScatteredIrradianceError" (of all patches together: root mean square
 * over the area, relative), "SingleScatteringSeconds".
 *
 * Errors: coefficients that are negative or not finite, a band without scattering and absorption, a
 * refractive index below 1, MillimetersPerUnit not above 0, Anisotropy out of its range, a surface
 * that is open, inside out or has no inside; those of vtkLightingAlgorithm.
 *
 * H. W. Jensen, S. R. Marschner, M. Levoy, P. Hanrahan, "A Practical Model for Subsurface Light
 * Transport", SIGGRAPH 2001; B. Walter, S. Zhao, N. Holzschuch, K. Bala, "Single Scattering in
 * Refractive Media with Triangle Mesh Boundaries", SIGGRAPH 2009.
 *
 * @sa vtkSubsurfaceScattering, vtkDirectIrradiance
 */
#ifndef vtkSingleScattering_h
#define vtkSingleScattering_h

#include "vtkLightingAlgorithm.h"

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkSingleScattering : public vtkLightingAlgorithm
{
public:
  static vtkSingleScattering* New();
  vtkTypeMacro(vtkSingleScattering, vtkLightingAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The material. A preset brings its own coefficients
   * and refractive index; they win over the properties of that name when the filter runs. Default
   * MATERIAL_CUSTOM.
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
   * Reduced scattering coefficient, (1 - g) sigma_s, of red, green and blue, per millimetre.
   * Default 1, 1, 1; range 0 and up. Used when Material is custom.
   */
  vtkSetVector3Macro(ScatteringCoefficient, double);
  vtkGetVector3Macro(ScatteringCoefficient, double);
  ///@}

  ///@{
  /**
   * Absorption coefficient of red, green and blue, per millimetre. Default 0.01, 0.01, 0.01; range
   * 0 and up. Used when Material is custom.
   */
  vtkSetVector3Macro(AbsorptionCoefficient, double);
  vtkGetVector3Macro(AbsorptionCoefficient, double);
  ///@}

  ///@{
  /**
   * Refractive index of the object relative to its surroundings. Default 1.3, range 1 and up. Used
   * when Material is custom.
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
   * Mean cosine of the angle by which light is scattered (Henyey and Greenstein), of red, green and
   * blue. ScatteringCoefficient stays the reduced one: light is scattered 1 / (1 - Anisotropy)
   * times as often. Default 0, 0, 0; range -0.99 to 0.99.
   */
  vtkSetVector3Macro(Anisotropy, double);
  vtkGetVector3Macro(Anisotropy, double);
  ///@}

  ///@{
  /**
   * Rays of a patch, well spread over its area and its directions; at least 8 are taken. Default
   * 256, range 1 to 1048576; powers of two spread best. Four times as many leave a little less
   * than half the error; "SingleScatteredIrradianceError" tells them.
   */
  vtkSetClampMacro(NumberOfSamples, int, 1, 1 << 20);
  vtkGetMacro(NumberOfSamples, int);
  ///@}

  ///@{
  /**
   * What a ray inside must be worth to be followed on: the part of it that reflections and the
   * medium have left, on average over the bands. So much may be missing. Default 1e-4, range 1e-8
   * to 0.1.
   */
  vtkSetClampMacro(MinimumContribution, double, 1e-8, 0.1);
  vtkGetMacro(MinimumContribution, double);
  ///@}

protected:
  vtkSingleScattering();
  ~vtkSingleScattering() override;

  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkSingleScattering(const vtkSingleScattering&) = delete;
  void operator=(const vtkSingleScattering&) = delete;

  class Run;

  int Material = MATERIAL_CUSTOM;
  double ScatteringCoefficient[3] = { 1.0, 1.0, 1.0 };
  double AbsorptionCoefficient[3] = { 0.01, 0.01, 0.01 };
  double RefractiveIndex = 1.3;
  double MillimetersPerUnit = 1.0;
  double Anisotropy[3] = { 0.0, 0.0, 0.0 };
  int NumberOfSamples = 256;
  double MinimumContribution = 1e-4;
};

#endif
