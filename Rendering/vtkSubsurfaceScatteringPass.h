// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubsurfaceScatteringPass
 * @brief draws the point array "ScatteredIrradiance" of vtkSubsurfaceScattering, added to what the
 * surface reflects at once
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
 * the power of 2.2 that VTK encodes it with. See vtkTransportPass for what is drawn how; the pass
 * draws an array and computes no scattering.
 *
 * After H. W. Jensen, S. R. Marschner, M. Levoy, P. Hanrahan, A practical model for subsurface
 * light transport, SIGGRAPH 2001, eq. 5, whose exitant Fresnel factor is normalised here.
 */
#ifndef vtkSubsurfaceScatteringPass_h
#define vtkSubsurfaceScatteringPass_h

#include "vtkTransportPass.h"

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

protected:
  vtkSubsurfaceScatteringPass();
  ~vtkSubsurfaceScatteringPass() override;

  const char* GetFragmentShader() override;
  double GetFresnelIndex() override { return this->RefractiveIndex; }
  double GetMeanTransmittance() override { return this->MeanTransmittance; }

private:
  vtkSubsurfaceScatteringPass(const vtkSubsurfaceScatteringPass&) = delete;
  void operator=(const vtkSubsurfaceScatteringPass&) = delete;

  double RefractiveIndex = 0.0;
  double MeanTransmittance = 1.0;
};

#endif
