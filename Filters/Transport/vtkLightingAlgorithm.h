// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkLightingAlgorithm
 * @brief what filters share that take light from vtkLights and from an environment
 *
 * Lights are vtkLight objects of type scene light. Irradiance on a surface facing the light is
 * Intensity x DiffuseColor / attenuation(d), with d the distance in the input's length unit
 * (positional lights; attenuation values as vtkLight has them: constant, linear, quadratic), times
 * cos^Exponent of the angle from the axis within a cone narrower than 90 degrees. Directional
 * lights shine from Position to FocalPoint, both through the light's transform matrix. A light that
 * touches a surface is in front of it. Lights that are switched off are left out.
 *
 * Errors: a headlight or camera light (they follow a camera, and a filter has none), a negative or
 * non-finite attenuation or intensity, attenuation that is zero, an environment that is not a
 * two-dimensional image of 1 or 3 components.
 *
 * @sa vtkDirectIrradiance, vtkSingleScattering
 */
#ifndef vtkLightingAlgorithm_h
#define vtkLightingAlgorithm_h

#include "vtkTransportAlgorithm.h"

#include <memory> // for std::unique_ptr

class vtkImageData;
class vtkLight;

class VTKLIGHTTRANSPORTFILTERS_EXPORT vtkLightingAlgorithm : public vtkTransportAlgorithm
{
public:
  vtkTypeMacro(vtkLightingAlgorithm, vtkTransportAlgorithm);
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

  /// Includes the lights.
  vtkMTimeType GetMTime() override;

protected:
  vtkLightingAlgorithm();
  ~vtkLightingAlgorithm() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs) override;

  double LightAngularDiameter = 0.0;
  bool Shadows = true;

private:
  vtkLightingAlgorithm(const vtkLightingAlgorithm&) = delete;
  void operator=(const vtkLightingAlgorithm&) = delete;

  struct LightList;
  std::unique_ptr<LightList> Lights;
};

#endif
