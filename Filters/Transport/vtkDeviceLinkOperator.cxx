// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeviceLinkOperator.h"

#include "Shared/Pulse.h"
#include "vtkObjectFactory.h"

//------------------------------------------------------------------------------
// Not vtkAbstractObjectFactoryNewMacro: that one warns when no factory answers, and no answer is
// normal here.
vtkDeviceLinkOperator* vtkDeviceLinkOperator::New()
{
  vtkObject* instance = vtkObjectFactory::CreateInstance("vtkDeviceLinkOperator");
  return static_cast<vtkDeviceLinkOperator*>(instance);
}

//------------------------------------------------------------------------------
vtkDeviceLinkOperator::vtkDeviceLinkOperator() = default;

//------------------------------------------------------------------------------
vtkDeviceLinkOperator::~vtkDeviceLinkOperator() = default;

//------------------------------------------------------------------------------
void vtkDeviceLinkOperator::Beat()
{
  LightTransport::Pulse::Beat();
}

//------------------------------------------------------------------------------
void vtkDeviceLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
