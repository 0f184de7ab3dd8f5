// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The solvers that there are.
#ifndef SolverTable_h
#define SolverTable_h

#include "Radiosity/SolverEntry.h"

#include <string>
#include <vector>

namespace LightTransport
{
namespace SolverTable
{
/// All entries; of two that cost the same Auto takes the first.
std::vector<const SolverEntry*> GetAll();

/**
 * The solver with a number (vtkRadiosity::SolverType) for a device (vtkTransportAlgorithm::
 * DeviceType): where there is one that finds links on this device while it goes, that one.
 * SOLVER_AUTO has an entry too, which runs nothing. nullptr where no solver has this number.
 */
const SolverEntry* Find(int type, int device);

/// "Jacobi", "GaussSeidel", ...; "unknown" where no solver has this number.
const char* GetName(int type);

/// That no solver has this number, and which there are.
std::string ExplainUnknown(int type);
} // namespace SolverTable
} // namespace LightTransport

#endif
