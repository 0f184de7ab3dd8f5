// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRadiosityPass.h"

#include "vtkLightTransportPassesRadiosityFS.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRadiosityPass);

//------------------------------------------------------------------------------
vtkRadiosityPass::vtkRadiosityPass() : vtkTransportPass("Radiosity") {}

//------------------------------------------------------------------------------
vtkRadiosityPass::~vtkRadiosityPass() = default;

//------------------------------------------------------------------------------
const char* vtkRadiosityPass::GetFragmentShader()
{
  return ::vtkLightTransportPassesRadiosityFS;
}

//------------------------------------------------------------------------------
void vtkRadiosityPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
