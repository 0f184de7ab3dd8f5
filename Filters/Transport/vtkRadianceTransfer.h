// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRadianceTransfer
 * @brief how much of any environment enters each patch of a surface, with its shadows, computed
 * once: precomputed radiance transfer
 *
 * Output array (cells and points, double, (Degree + 1)^2 components):
 * - "RadianceTransfer": component l (l + 1) + m is
 *
 *     T_lm = Int V(w) F_t(n w) (n w) Y_lm(w) dw
 *
 *   over the hemisphere, the mean over the patch: V what is not hidden, F_t Fresnel's transmittance
 *   (1 with RefractiveIndex 1), Y_lm the real, orthonormal spherical harmonics (without the phase
 *   of Condon and Shortley).
 *
 * An environment with coefficients L_lm (ProjectEnvironment) so gives the irradiance sum L_lm T_lm:
 * that of vtkDirectIrradiance, for the part of the environment that harmonics up to Degree hold. It
 * may turn as it likes; nothing is looked for again. Directions are those of the input: a body that
 * is turned sees an environment that turns the other way. vtkSurfaceLighting does all that while
 * drawing (EnvironmentMethod Transfer).
 *
 * Patches with nothing in front have exact values. Where something is, rays tell what is hidden of
 * the exact value: as many as Samples on each patch, the same for the same input. The index is
 * recorded in the field data array "RefractiveIndex", the number of rays in "RadianceTransferRays",
 * the time in "RadianceTransferSeconds".
 *
 * Errors: a refractive index below 1, and those of vtkTransportAlgorithm.
 *
 * Source: P.-P. Sloan, J. Kautz, J. Snyder, Precomputed radiance transfer for real-time rendering
 * in dynamic, low-frequency lighting environments, SIGGRAPH 2002.
 *
 * @sa vtkDirectIrradiance, vtkSurfaceLighting
 */
#ifndef vtkRadianceTransfer_h
#define vtkRadianceTransfer_h

#include "vtkTransportAlgorithm.h"

class vtkDoubleArray;
class vtkImageData;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkRadianceTransfer : public vtkTransportAlgorithm
{
public:
  static vtkRadianceTransfer* New();
  vtkTypeMacro(vtkRadianceTransfer, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// What vtkSurfaceLighting can draw.
  static constexpr int LargestDegree = 5;

  ///@{
  /**
   * Degree of the spherical harmonics. What varies faster over the sky than over about 180 degrees
   * by Degree is lost; a sun is smeared out. Default 4 (25 components), range 0 to 5.
   */
  vtkSetClampMacro(Degree, int, 0, LargestDegree);
  vtkGetMacro(Degree, int);
  ///@}

  ///@{
  /**
   * Rays of a patch that something is in front of, stratified over the cosine-weighted hemisphere
   * and over the patch. Default 256, range 1 to 65536; powers of two spread best.
   */
  vtkSetClampMacro(Samples, int, 1, 65536);
  vtkGetMacro(Samples, int);
  ///@}

  ///@{
  /// Whether patches cast shadows on others. Default on.
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * Whether light falls on the backs of polygons, too: on the sheets that most models are made of.
   * The output has "RadianceTransferBack" then. Default off.
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  ///@{
  /**
   * Refractive index of the surface relative to its surroundings. Default 1: opaque, and the
   * integral is that of irradiance. Range 1 and up.
   */
  vtkSetMacro(RefractiveIndex, double);
  vtkGetMacro(RefractiveIndex, double);
  ///@}

  /**
   * Coefficients L_lm of an environment (see vtkLightingAlgorithm::SetEnvironment) up to Degree: a
   * tuple of three bands for each harmonic. Returns false, with an error, where the picture is none
   * of 1 or 3 components, or not finite.
   */
  bool ProjectEnvironment(vtkImageData* environment, vtkDoubleArray* coefficients);

protected:
  vtkRadianceTransfer();
  ~vtkRadianceTransfer() override;

  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkRadianceTransfer(const vtkRadianceTransfer&) = delete;
  void operator=(const vtkRadianceTransfer&) = delete;

  class Run;

  int Degree = 4;
  int Samples = 256;
  bool Shadows = true;
  bool TwoSided = false;
  double RefractiveIndex = 1.0;
};

#endif
