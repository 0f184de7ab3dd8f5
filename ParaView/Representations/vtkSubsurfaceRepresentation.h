// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSubsurfaceRepresentation
 * @brief draws a surface in ParaView's render view as a translucent body in the lights of the view
 *
 * The surface, or each block of it, is one that vtkSurfaceAtlas made. Scattering is computed while
 * it is drawn, by vtkSubsurfaceScatteringPass: turning the view costs nothing but where lights
 * follow the camera, other coefficients cost new links. Of the surface's colours specular
 * reflection stays.
 *
 * Rendering by several ranks, each of which has a part of a surface, draws the surface as usual,
 * and a warning says so.
 */
#ifndef vtkSubsurfaceRepresentation_h
#define vtkSubsurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkLightTransportRepresentationsModule.h" // for export macro
#include "vtkNew.h"                                 // for members
#include "vtkSmartPointer.h"                        // for members
#include "vtkWeakPointer.h"                         // for members

class vtkRenderer;
class vtkSubsurfaceScattering;
class vtkSubsurfaceScatteringPass;

class VTKLIGHTTRANSPORTREPRESENTATIONS_EXPORT vtkSubsurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkSubsurfaceRepresentation* New();
  vtkTypeMacro(vtkSubsurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Mean free path of light inside, in millimetres, by reduced scattering and absorption together.
  /// Default 0.5, range 1e-3 to 1e3.
  void SetMeanFreePath(double length);
  vtkGetMacro(MeanFreePath, double);
  ///@}

  ///@{
  /// What of the light is scattered and not absorbed after each such path: Albedo times AlbedoColor
  /// for red, green and blue. Defaults 0.999 and white, range 0 to 0.99999.
  void SetAlbedo(double albedo);
  vtkGetMacro(Albedo, double);
  void SetAlbedoColor(double red, double green, double blue);
  vtkGetVector3Macro(AlbedoColor, double);
  ///@}

  ///@{
  /// As vtkSubsurfaceScattering has them: 1, 1.3, 64 (adaptive links).
  void SetMillimetersPerUnit(double millimeters);
  void SetRefractiveIndex(double index);
  void SetNumberOfLinks(int links);
  ///@}

  ///@{
  /// As vtkSubsurfaceScatteringPass has them, for the whole view: 512, 128 (there: 512), 1, on,
  /// off.
  void SetIrradianceMapSize(int size);
  void SetScatteredMapSize(int size);
  void SetExposure(double exposure);
  void SetCastShadows(bool shadows);
  void SetDirectShadows(bool shadows);
  ///@}

  /// The pass that draws it; nullptr before the first frame.
  vtkSubsurfaceScatteringPass* GetPass();

  void SetVisibility(bool visible) override;
  int ProcessViewRequest(vtkInformationRequestKey* request, vtkInformation* input,
    vtkInformation* output) override;

protected:
  vtkSubsurfaceRepresentation();
  ~vtkSubsurfaceRepresentation() override;

  bool AddToView(vtkView* view) override;
  bool RemoveFromView(vtkView* view) override;

private:
  vtkSubsurfaceRepresentation(const vtkSubsurfaceRepresentation&) = delete;
  void operator=(const vtkSubsurfaceRepresentation&) = delete;

  class ViewPass;

  void SetCoefficients();
  void WarnOnce(const char* message);
  void Attach();
  void Detach();
  void TakeColors();

  const vtkNew<vtkSubsurfaceScattering> Scattering;
  vtkSmartPointer<ViewPass> Pass;
  vtkWeakPointer<vtkRenderer> Renderer;
  double MeanFreePath = 0.5;
  double Albedo = 0.999;
  double AlbedoColor[3] = { 1.0, 1.0, 1.0 };
  int IrradianceMapSize = 512;
  int ScatteredMapSize = 128;
  double Exposure = 1.0;
  bool CastShadows = true;
  bool DirectShadows = false;
  ///@{ Of the property, before scattered light took their place.
  double UsualAmbient = 0.0;
  double UsualDiffuse = 1.0;
  ///@}
  bool HasWarned = false;
};

#endif
