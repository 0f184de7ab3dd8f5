// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkExchange.h"

//------------------------------------------------------------------------------
vtkExchange::vtkExchange() = default;

//------------------------------------------------------------------------------
vtkExchange::~vtkExchange() = default;

//------------------------------------------------------------------------------
void vtkExchange::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPatches: " << this->GetNumberOfPatches() << "\n";
  os << indent << "NumberOfKernels: " << this->NumberOfKernels << "\n";
  os << indent << "Part: " << this->Part << " of " << this->NumberOfParts << "\n";
}
