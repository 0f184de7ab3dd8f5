// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLinkOperator.h"

//------------------------------------------------------------------------------
vtkLinkOperator::vtkLinkOperator() = default;

//------------------------------------------------------------------------------
vtkLinkOperator::~vtkLinkOperator() = default;

//------------------------------------------------------------------------------
bool vtkLinkOperator::Apply(int y, int left, int right, int x, int scratch)
{
  return this->Scale(scratch, right, x) && this->Multiply(y, scratch) && this->Scale(y, left, y);
}

//------------------------------------------------------------------------------
void vtkLinkOperator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPatches: " << this->NumberOfPatches << "\n";
  os << indent << "NumberOfBands: " << this->NumberOfBands << "\n";
}
