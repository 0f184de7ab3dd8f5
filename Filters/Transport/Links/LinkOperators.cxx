// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/LinkOperators.h"

#include "Shared/TransportMemory.h"
#include "Support/Ranks.h"
#include "vtkCPULinkOperator.h"
#include "vtkDeviceLinkOperator.h"
#include "vtkDeviceLinkRefiner.h"
#include "vtkExchangeHierarchy.h"
#include "vtkExchangeMatrix.h"

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
// A matrix that `allocate` returns true for, where `bytes` are there on every rank; `remedy` is
// what else than fewer patches helps.
template <typename Allocation>
Outcome Allocate(std::size_t numberOfPatches, double bytes, const std::string& remedy,
  const Ranks& ranks, vtkSmartPointer<vtkExchangeMatrix>& matrix, Allocation&& allocate)
{
  const double available = TransportMemory::GetAvailableBytes();
  matrix = vtkSmartPointer<vtkExchangeMatrix>::New();
  Outcome allocated = Outcome::Done();
  if (bytes > available || !allocate(matrix))
  {
    allocated = Outcome::Failed("The links between " + std::to_string(numberOfPatches) +
      " patches need " + TransportMemory::Format(bytes) + " of memory" +
      (ranks.AreSeveral() ? " in one process" : "") + " and " + TransportMemory::Format(available) +
      " are free: " + remedy +
      "use fewer patches (a larger TargetEdgeLength in vtkPatchMesher) or "
      "processes on more machines (each holds a part).");
  }
  return ranks.Agree(allocated);
}

//------------------------------------------------------------------------------
// What computes on a device. Why it cannot be had where the outcome is a failure.
template <typename OnDevice>
Outcome OpenDevice(LinkDevice device, const Ranks& ranks, vtkSmartPointer<OnDevice>& found)
{
  if (ranks.AreSeveral())
  {
    return Outcome::Failed("the run has several ranks, which share the links on their CPUs.");
  }
  found = vtkSmartPointer<OnDevice>::Take(OnDevice::New());
  if (!found)
  {
    return Outcome::Failed(
      "no loaded module computes on OpenGL: load vtkLightTransportRendering (in Python, "
      "import vtklighttransport).");
  }
  std::string reason;
  if (!found->Open(reason))
  {
    return Outcome::Failed(reason);
  }
  if (device == LinkDevice::Auto && !found->IsHardware())
  {
    return Outcome::Failed(std::string("OpenGL is a software renderer here (") +
      found->GetDeviceName() + "), which is slower.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
Outcome RefuseOpenGL(const std::string& reason)
{
  return Outcome::Failed("Device is OpenGL, but " + reason + " Or set Device to Auto or CPU.");
}
} // namespace

//------------------------------------------------------------------------------
Outcome LinkOperators::AllocateMatrix(const std::vector<double>& areas, int numberOfKernels,
  const std::string& remedy, const Ranks& ranks, vtkSmartPointer<vtkExchangeMatrix>& matrix)
{
  const double bytes = vtkExchangeMatrix::GetEstimatedBytes(static_cast<vtkIdType>(areas.size()),
    numberOfKernels, ranks.GetNumber());
  return Allocate(areas.size(), bytes, remedy, ranks, matrix,
    [&](vtkExchangeMatrix* empty)
    { return empty->Allocate(areas, numberOfKernels, ranks.GetMine(), ranks.GetNumber()); });
}

//------------------------------------------------------------------------------
Outcome LinkOperators::AllocateSparseMatrix(const std::vector<double>& areas,
  vtkIdType numberOfTiles, const Ranks& ranks, vtkSmartPointer<vtkExchangeMatrix>& matrix)
{
  const double bytes = vtkExchangeMatrix::GetEstimatedSparseBytes(
    static_cast<vtkIdType>(areas.size()), 1, numberOfTiles, ranks.GetNumber());
  return Allocate(areas.size(), bytes,
    "set LinkMethod to Hierarchical (in vtkViewFactors switch Hierarchical on), or ", ranks, matrix,
    [&](vtkExchangeMatrix* empty)
    {
      empty->AllocateSparse(areas, 1, ranks.GetMine(), ranks.GetNumber());
      return true;
    });
}

//------------------------------------------------------------------------------
// While they are put into one table they are there twice.
Outcome LinkOperators::CheckRows(double numberOfLinks, int numberOfKernels, const Ranks& ranks)
{
  const double bytes =
    2.0 * vtkExchangeHierarchy::GetEstimatedBytesOfRows(numberOfLinks, numberOfKernels);
  const double available = TransportMemory::GetAvailableBytes();
  return ranks.Agree(bytes / ranks.GetNumber() <= available
      ? Outcome::Done()
      : Outcome::Failed("The links between clusters need " + TransportMemory::Format(bytes) +
          " of memory and " + TransportMemory::Format(available) +
          " are free: raise LinkTolerance, lower NumberOfLinks, use fewer patches or processes on "
          "more machines (each holds a part)."));
}

//------------------------------------------------------------------------------
Outcome LinkOperators::CheckDevice(LinkDevice device, const Ranks& ranks)
{
  if (device != LinkDevice::OpenGL)
  {
    return Outcome::Done();
  }
  vtkSmartPointer<vtkDeviceLinkOperator> found;
  Outcome opened = OpenDevice(device, ranks, found);
  return opened ? opened : RefuseOpenGL(opened.GetMessage());
}

//------------------------------------------------------------------------------
Outcome LinkOperators::Make(LinkDevice device, vtkExchange* exchange, int numberOfBands,
  const Ranks& ranks, vtkSmartPointer<vtkLinkOperator>& links, std::string& explanation)
{
  explanation = "CPU: asked for";
  if (device != LinkDevice::CPU)
  {
    vtkSmartPointer<vtkDeviceLinkOperator> found;
    Outcome opened = OpenDevice(device, ranks, found);
    if (opened && found->Initialize(exchange, numberOfBands))
    {
      explanation = device == LinkDevice::Auto ? "OpenGL: a GPU is there" : "OpenGL: asked for";
      links = found;
      return opened;
    }
    const std::string reason = opened
      ? "the links could not be put on it (see the message before this one)."
      : opened.GetMessage();
    if (device == LinkDevice::OpenGL)
    {
      return RefuseOpenGL(reason);
    }
    explanation = "CPU: " + reason;
  }
  links = MakeOnCPU(exchange, numberOfBands, ranks);
  return links ? Outcome::Done() : Outcome::FailedAsReported();
}

//------------------------------------------------------------------------------
Outcome LinkOperators::FindRefiner(LinkDevice device, const Ranks& ranks,
  vtkSmartPointer<vtkDeviceLinkRefiner>& refiner)
{
  if (device == LinkDevice::CPU)
  {
    return Outcome::Done();
  }
  Outcome opened = OpenDevice(device, ranks, refiner);
  if (!opened)
  {
    refiner = nullptr;
  }
  return opened || device == LinkDevice::Auto ? Outcome::Done() : RefuseOpenGL(opened.GetMessage());
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCPULinkOperator> LinkOperators::MakeOnCPU(vtkExchange* exchange,
  int numberOfBands, const Ranks& ranks)
{
  vtkSmartPointer<vtkCPULinkOperator> links = vtkCPULinkOperator::NewFor(exchange);
  links->SetController(ranks.GetController());
  return links->Initialize(exchange, numberOfBands) ? links : nullptr;
}
} // namespace LightTransport
