// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/SolverTable.h"

#include "vtkRadiosity.h"

#include <iterator>

namespace LightTransport
{
// Each in the file of its name.
namespace Solvers
{
extern const SolverEntry Jacobi;
extern const SolverEntry GaussSeidel;
extern const SolverEntry Southwell;
extern const SolverEntry SouthwellOnDevice;
extern const SolverEntry Chebyshev;
extern const SolverEntry ConjugateGradient;
} // namespace Solvers

namespace
{
using namespace Solvers;

// The one to choose another.
constexpr SolverEntry Auto = { vtkRadiosity::SOLVER_AUTO, "Auto", SolverEntry::Order::AllAtOnce,
  SolverEntry::Links::AnyForm };

constexpr const SolverEntry* Table[] = {
  &Auto,
  &Jacobi,
  &GaussSeidel,
  &Southwell,
  &SouthwellOnDevice,
  &Chebyshev,
  &ConjugateGradient,
};
} // namespace

//------------------------------------------------------------------------------
std::vector<const SolverEntry*> SolverTable::GetAll()
{
  return { std::begin(Table), std::end(Table) };
}

//------------------------------------------------------------------------------
const SolverEntry* SolverTable::Find(int type, int device)
{
  const bool mayFindLinks = device == vtkTransportAlgorithm::DEVICE_OPENGL;
  const SolverEntry* found = nullptr;
  for (const SolverEntry* entry : Table)
  {
    if (entry->Type == type && (entry->NeedsLinks() ? !found : mayFindLinks))
    {
      found = entry;
    }
  }
  return found;
}

//------------------------------------------------------------------------------
const char* SolverTable::GetName(int type)
{
  const SolverEntry* entry = Find(type, vtkTransportAlgorithm::DEVICE_CPU);
  return entry ? entry->Name : "unknown";
}

//------------------------------------------------------------------------------
std::string SolverTable::ExplainUnknown(int type)
{
  std::string text = "There is no solver " + std::to_string(type) + ": set Solver to one of";
  for (const SolverEntry* entry : Table)
  {
    text += entry->NeedsLinks() ? " " + std::to_string(entry->Type) + " (" + entry->Name + ")" : "";
  }
  return text + ".";
}
} // namespace LightTransport
