// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeviceLinkRefiner.h"

#include "Shared/Pulse.h"
#include "vtkObjectFactory.h"

//------------------------------------------------------------------------------
// Quiet where no factory answers, as in vtkDeviceLinkOperator.
vtkDeviceLinkRefiner* vtkDeviceLinkRefiner::New()
{
  return static_cast<vtkDeviceLinkRefiner*>(
    vtkObjectFactory::CreateInstance("vtkDeviceLinkRefiner"));
}

//------------------------------------------------------------------------------
vtkDeviceLinkRefiner::vtkDeviceLinkRefiner() = default;

//------------------------------------------------------------------------------
vtkDeviceLinkRefiner::~vtkDeviceLinkRefiner() = default;

//------------------------------------------------------------------------------
void vtkDeviceLinkRefiner::Beat()
{
  LightTransport::Pulse::Beat();
}

//------------------------------------------------------------------------------
void vtkDeviceLinkRefiner::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
