// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkRadiosityPass
 * @brief draws the point array "Radiosity" of vtkRadiosity as the light that a scene gives off
 *
 * Colour = encoded(Exposure * Radiosity / pi), without VTK's lights: radiosity already holds all
 * light. See vtkTransportPass for what is drawn how; the pass draws an array and solves nothing.
 */
#ifndef vtkRadiosityPass_h
#define vtkRadiosityPass_h

#include "vtkTransportPass.h"

class VTKLIGHTTRANSPORTRENDERING_EXPORT vtkRadiosityPass : public vtkTransportPass
{
public:
  static vtkRadiosityPass* New();
  vtkTypeMacro(vtkRadiosityPass, vtkTransportPass);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkRadiosityPass();
  ~vtkRadiosityPass() override;

  const char* GetFragmentShader() override;

private:
  vtkRadiosityPass(const vtkRadiosityPass&) = delete;
  void operator=(const vtkRadiosityPass&) = delete;
};

#endif
