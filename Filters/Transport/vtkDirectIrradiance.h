// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkDirectIrradiance
 * @brief irradiance on the patches of a surface straight from lights and from an environment
 *
 * Output arrays (cells and points, double, 3 components):
 * - "DirectIrradiance": incident flux per unit area, the mean over the patch, with shadows;
 * - "TransmittedIrradiance", only with a RefractiveIndex above 1: the part that enters the surface
 *   by Fresnel's equations for unpolarised light, each direction by its own angle. The index is
 *   recorded in the field data array "RefractiveIndex", for vtkSubsurfaceScattering;
 * - "DirectIrradianceError": what "DirectIrradiance" may be off by, one standard error, in its
 *   unit. It is an estimate; it does not know of things that all rays to an environment have
 *   missed.
 *
 * Lights are vtkLight objects of type scene light. Irradiance on a surface facing the light is
 * Intensity x DiffuseColor / attenuation(d), with d the distance in the input's length unit
 * (positional lights; attenuation values as vtkLight has them: constant, linear, quadratic), times
 * cos^Exponent of the angle from the axis within a cone narrower than 90 degrees. Directional
 * lights shine from Position to FocalPoint, both through the light's transform matrix. The angle of
 * incidence weighs it; back faces get nothing. A light that touches a surface is in front of it.
 * Lights that are switched off are left out.
 *
 * Shadows of lights are cut out of the patches exactly, however thin light or shadow are; rays
 * decide only where more lies before a patch than it may be cut for (ShadowSamples). An environment
 * is looked at by rays: over the sky, and straight to what is much brighter than the rest (a sun,
 * lamps, windows).
 *
 * Output field data: "DirectIrradianceError" (of all patches together: root mean square over the
 * area, as a part of that of the irradiance), "LargestDirectIrradianceError" (of one patch, as
 * Tolerance counts it), "DirectIrradianceRays" (shadow rays cast), "DirectIrradianceSeconds",
 * "DirectFlux" (3 components: irradiance times area, in the input's length unit squared).
 *
 * A warning tells on how many polygons Tolerance was not reached, and how far the worst is off.
 *
 * Errors: a headlight or camera light (they follow a camera, and a filter has none), a negative or
 * non-finite attenuation or intensity, attenuation that is zero, a refractive index below 1, an
 * environment that is not a two-dimensional image of 1 or 3 components.
 *
 * @sa vtkSubsurfaceScattering, vtkRadiosity
 */
#ifndef vtkDirectIrradiance_h
#define vtkDirectIrradiance_h

#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkDataObject;
class vtkImageData;
class vtkLight;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkDirectIrradiance : public vtkTransportAlgorithm
{
public:
  static vtkDirectIrradiance* New();
  vtkTypeMacro(vtkDirectIrradiance, vtkTransportAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The lights. A light is in the list at most once.
  void AddLight(vtkLight* light);
  void RemoveLight(vtkLight* light);
  void RemoveAllLights();
  int GetNumberOfLights();
  vtkLight* GetLight(int index);
  ///@}

  ///@{
  /**
   * Radiance from afar in all directions, or nullptr (the default). A picture in longitude and
   * latitude with +z up, 1 or 3 components in its point scalars: the columns start at longitude 0
   * (+x) and go counter-clockwise seen from +z (through +y); the rows go from -z (first) to +z. It
   * is input port 1, which a reader may be connected to as well.
   */
  void SetEnvironment(vtkImageData* environment);
  vtkImageData* GetEnvironment();
  ///@}

  ///@{
  /**
   * What the irradiance of a patch may be off by, one standard error, as a part of what the patch
   * would get with nothing in the way (or of a quarter of that on a patch that faces the light,
   * where that is more). The work for a patch grows until that holds: to at most 16 times the rays
   * of EnvironmentSamples, 64 times the directions and 256 times the pieces of ShadowSamples. A
   * warning tells where it does not hold even then. Default 1e-2, range 1e-6 to 1.
   */
  vtkSetClampMacro(Tolerance, double, 1e-6, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Rays of a patch to the environment at first, stratified over the cosine-weighted hemisphere and
   * over the patch; a quarter as many go to what is much brighter than the rest of the picture. At
   * least 8 are taken. Default 256, range 1 to 65536; powers of two spread best.
   */
  vtkSetClampMacro(EnvironmentSamples, int, 1, 65536);
  vtkGetMacro(EnvironmentSamples, int);
  ///@}

  ///@{
  /**
   * How finely shadows of lights are looked at, at first, where a patch is partly lit: pieces of a
   * patch with more than 32 others before them are divided down to 1/16 of the patch over this
   * number, and this many directions (at least 8) go to a light with an angular diameter. Default
   * 16, range 1 to 4096; powers of two spread best.
   */
  vtkSetClampMacro(ShadowSamples, int, 1, 4096);
  vtkGetMacro(ShadowSamples, int);
  ///@}

  ///@{
  /**
   * Angle that directional lights take in the sky, in degrees: their shadows get soft edges. The
   * sun's is 0.53. Each light is a disc then, evenly bright. Default 0 (sharp shadows), range 0 to
   * 180.
   */
  vtkSetClampMacro(LightAngularDiameter, double, 0.0, 180.0);
  vtkGetMacro(LightAngularDiameter, double);
  ///@}

  ///@{
  /// Whether patches cast shadows on others. Default on.
  vtkSetMacro(Shadows, bool);
  vtkGetMacro(Shadows, bool);
  vtkBooleanMacro(Shadows, bool);
  ///@}

  ///@{
  /**
   * Refractive index of the surface relative to its surroundings. Default 1: opaque, and no
   * "TransmittedIrradiance". Range 1 and up.
   */
  vtkSetMacro(RefractiveIndex, double);
  vtkGetMacro(RefractiveIndex, double);
  ///@}

  ///@{
  /**
   * Whether light falls on the backs of polygons, too: on the sheets that most models are made of.
   * Each output array then has a second one for the backs, with the suffix "Back", and "DirectFlux"
   * is the sum of both. Default off: backs are in the dark.
   */
  vtkSetMacro(TwoSided, bool);
  vtkGetMacro(TwoSided, bool);
  vtkBooleanMacro(TwoSided, bool);
  ///@}

  /// Includes the lights.
  vtkMTimeType GetMTime() override;

protected:
  vtkDirectIrradiance();
  ~vtkDirectIrradiance() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;
  std::unique_ptr<LightTransport::TransportRun> MakeRun(
    const LightTransport::RunPorts& ports) override;

private:
  vtkDirectIrradiance(const vtkDirectIrradiance&) = delete;
  void operator=(const vtkDirectIrradiance&) = delete;

  class Run;
  struct LightList;

  std::unique_ptr<LightList> Lights;
  double Tolerance = 1e-2;
  int EnvironmentSamples = 256;
  int ShadowSamples = 16;
  double LightAngularDiameter = 0.0;
  bool Shadows = true;
  bool TwoSided = false;
  double RefractiveIndex = 1.0;
};

#endif
