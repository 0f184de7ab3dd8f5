// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/ConvergenceTable.h"

#include "Shared/TransportMemory.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <cmath>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
template <typename Array>
vtkSmartPointer<Array> AddColumn(vtkTable* table, const char* name)
{
  auto column = vtkSmartPointer<Array>::New();
  column->SetName(name);
  table->AddColumn(column);
  return column;
}
} // namespace

//------------------------------------------------------------------------------
ConvergenceTable::ConvergenceTable(vtkTable* table, double begin) : Begin(begin)
{
  TransportMemory::RequireMargin();
  table->Initialize();
  this->Iterations = AddColumn<vtkIntArray>(table, "Iteration");
  this->Seconds = AddColumn<vtkDoubleArray>(table, "Seconds");
  this->Residuals = AddColumn<vtkDoubleArray>(table, "Residual");
  this->ErrorBounds = AddColumn<vtkDoubleArray>(table, "ErrorBound");
}

//------------------------------------------------------------------------------
double ConvergenceTable::Add(int iteration, double residual, double errorBound, double tolerance)
{
  this->Iterations->InsertNextValue(iteration);
  this->Seconds->InsertNextValue(vtkTimerLog::GetUniversalTime() - this->Begin);
  this->Residuals->InsertNextValue(residual);
  this->ErrorBounds->InsertNextValue(errorBound);
  double& first = this->FirstResidual;
  first = first > 0.0 ? first : residual;
  const double gained = residual > 0.0 && first > 0.0 ? std::log(first / residual) : 0.0;
  return gained / -std::log(tolerance);
}
} // namespace LightTransport
