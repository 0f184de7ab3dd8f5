// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeviceShooter.h"

#include "vtkObjectFactory.h"

//------------------------------------------------------------------------------
// Quiet where no factory answers, as in vtkDeviceLinkOperator.
vtkDeviceShooter* vtkDeviceShooter::New()
{
  return static_cast<vtkDeviceShooter*>(vtkObjectFactory::CreateInstance("vtkDeviceShooter"));
}

//------------------------------------------------------------------------------
vtkDeviceShooter::vtkDeviceShooter() = default;

//------------------------------------------------------------------------------
vtkDeviceShooter::~vtkDeviceShooter() = default;

//------------------------------------------------------------------------------
void vtkDeviceShooter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
