// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Makes what links take: the memory of a matrix, and an operator on the device that was asked for
/// or that is faster.
#ifndef LinkOperators_h
#define LinkOperators_h

#include "Shared/Outcome.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <string>
#include <vector>

class vtkCPULinkOperator;
class vtkDeviceLinkRefiner;
class vtkExchange;
class vtkExchangeMatrix;
class vtkLinkOperator;

namespace LightTransport
{
class Ranks;

/// Values of vtkTransportAlgorithm::DeviceType.
enum class LinkDevice
{
  Auto,
  CPU,
  OpenGL
};

namespace LinkOperators
{
/// An empty exchange matrix for these patch areas, or this rank's part of it. Fails, on all ranks
/// alike, where the memory is not there; `remedy` is what helps beside fewer patches, "do this, or
/// ".
Outcome AllocateMatrix(const std::vector<double>& areas, int numberOfKernels,
  const std::string& remedy, const Ranks& ranks, vtkSmartPointer<vtkExchangeMatrix>& matrix);

/// Likewise with one kernel and no tile stored yet. `numberOfTiles` is the most that this rank will
/// store; the memory for them must be there.
Outcome AllocateSparseMatrix(const std::vector<double>& areas, vtkIdType numberOfTiles,
  const Ranks& ranks, vtkSmartPointer<vtkExchangeMatrix>& matrix);

/// Fails, on all ranks alike, where there is no memory for rows of a vtkExchangeHierarchy.
/// `numberOfLinks` is that of all ranks.
Outcome CheckRows(double numberOfLinks, int numberOfKernels, const Ranks& ranks);

/// Fails when the device is OpenGL and cannot be had. Asked before any work starts: a user who
/// insists on a device does not want to wait for the links to hear that it is not there.
Outcome CheckDevice(LinkDevice device, const Ranks& ranks);

/**
 * The operator for a device, initialised. Auto takes OpenGL on a real GPU and the CPU otherwise;
 * `explanation` says which one and why.
 */
Outcome Make(LinkDevice device, vtkExchange* exchange, int numberOfBands, const Ranks& ranks,
  vtkSmartPointer<vtkLinkOperator>& links, std::string& explanation);

/// What chooses links on a device, open, or nullptr for the CPU; as Make.
Outcome FindRefiner(LinkDevice device, const Ranks& ranks,
  vtkSmartPointer<vtkDeviceLinkRefiner>& refiner);

/// The operator on the CPU, initialised; nullptr after an error, which has been reported.
vtkSmartPointer<vtkCPULinkOperator> MakeOnCPU(vtkExchange* exchange, int numberOfBands,
  const Ranks& ranks);
} // namespace LinkOperators
} // namespace LightTransport

#endif
