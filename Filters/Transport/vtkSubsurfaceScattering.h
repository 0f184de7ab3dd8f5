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
 * for all pairs, adaptively near by and by simple rules far away (see LinkTolerance). The energy
 * that stays within the patch it entered comes from the profile's exact moments, so patches may be
 * any number of mean free paths wide.
 *
 * Input arrays (cells, float or double, 1 component = the same in all bands or 3 = red, green,
 * blue; choose others with SetInputArrayToProcess(0, ...)):
 * - "Irradiance" when Incidence is Diffuse, incident flux per unit area;
 * - "TransmittedIrradiance" when Incidence is Transmitted, flux per unit area that has entered the
 *   surface already; vtkDirectIrradiance writes it. Array 1, where one is chosen, comes before
 * array 0 then, so that both choices can be kept.
 *
 * Output arrays (cells and points, double):
 * - "ScatteredIrradiance" (3 components): radiant exitance that leaves the surface by scattering,
 * in all directions, per unit area, without a factor 1/pi; in the unit of the input array.
 *
 * Output field data: "NumberOfLinks", "LinksLeftOut", "LinkErrorBound", "LinkSeconds",
 * "ApplySeconds", "EnteringFlux" and "LeavingFlux" (3 components each; irradiance times the square
 * of the input's length unit), "DeviceUsed", "DeviceExplanation". Port 1 is a vtkTable with one
 * row: "Links", "LinksLeftOut", "LinkSeconds", "ApplySeconds", "ErrorBound".
 *
 * Errors: coefficients that are negative or not finite, a band without scattering and absorption, a
 * refractive index below 1, MillimetersPerUnit not above 0, irradiance that is missing or not
 * finite, links that do not fit into memory.
 *
 * H. W. Jensen, S. R. Marschner, M. Levoy, P. Hanrahan, "A Practical Model for Subsurface Light
 * Transport", SIGGRAPH 2001; H. W. Jensen, J. Buhler, "A Rapid Hierarchical Rendering Technique for
 * Translucent Materials", SIGGRAPH 2002; N. A. Carr, J. D. Hall, J. C. Hart, "GPU Algorithms for
 * Radiosity and Subsurface Scattering", Graphics Hardware 2003.
 *
 * @sa vtkDirectIrradiance, vtkRadiosity
 */
#ifndef vtkSubsurfaceScattering_h
#define vtkSubsurfaceScattering_h

#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr

namespace LightTransport
{
class LinkCache;
}

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkSubsurfaceScattering : public vtkTransportAlgorithm
{
public:
  static vtkSubsurfaceScattering* New();
  vtkTypeMacro(vtkSubsurfaceScattering, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Measured materials of Jensen et al. 2001.
  enum MaterialType
  {
    MATERIAL_CUSTOM = 0,
    MATERIAL_APPLE = 1,
    MATERIAL_CHICKEN1 = 2,
    MATERIAL_CHICKEN2 = 3,
    MATERIAL_CREAM = 4,
    MATERIAL_KETCHUP = 5,
    MATERIAL_MARBLE = 6,
    MATERIAL_POTATO = 7,
    MATERIAL_SKIMMILK = 8,
    MATERIAL_SKIN1 = 9,
    MATERIAL_SKIN2 = 10,
    MATERIAL_SPECTRALON = 11,
    MATERIAL_WHOLEMILK = 12
  };

  /// Diffuse reflectance profiles.
  enum ModelType
  {
    MODEL_DIPOLE = 0
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
  /// The profile. Default MODEL_DIPOLE, the classical dipole of Jensen et al. 2001.
  vtkSetClampMacro(Model, int, MODEL_DIPOLE, MODEL_DIPOLE);
  vtkGetMacro(Model, int);
  void SetModelToDipole() { this->SetModel(MODEL_DIPOLE); }
  ///@}

  ///@{
  /**
   * Error that the links of one patch may have together, relative to all that a unit of entering
   * light gives back (the profile's total). Default 1e-4, range 1e-8 to 0.1.
   */
  vtkSetClampMacro(LinkTolerance, double, 1e-8, 0.1);
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
  /// Where the links are applied. Default DEVICE_AUTO: OpenGL on a real GPU, else the CPU.
  vtkSetClampMacro(Device, int, DEVICE_AUTO, DEVICE_OPENGL);
  vtkGetMacro(Device, int);
  void SetDeviceToAuto() { this->SetDevice(DEVICE_AUTO); }
  void SetDeviceToCPU() { this->SetDevice(DEVICE_CPU); }
  void SetDeviceToOpenGL() { this->SetDevice(DEVICE_OPENGL); }
  ///@}

protected:
  vtkSubsurfaceScattering();
  ~vtkSubsurfaceScattering() override;

  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkSubsurfaceScattering(const vtkSubsurfaceScattering&) = delete;
  void operator=(const vtkSubsurfaceScattering&) = delete;

  class Run;

  /// Kept for as long as what they depend on stays the same.
  std::unique_ptr<LightTransport::LinkCache> Links;

  int Material = MATERIAL_CUSTOM;
  double ScatteringCoefficient[3] = { 1.0, 1.0, 1.0 };
  double AbsorptionCoefficient[3] = { 0.01, 0.01, 0.01 };
  double RefractiveIndex = 1.3;
  double MillimetersPerUnit = 1.0;
  int Model = MODEL_DIPOLE;
  double LinkTolerance = 1e-4;
  int Incidence = INCIDENCE_DIFFUSE;
  int Device = DEVICE_AUTO;
};

#endif
