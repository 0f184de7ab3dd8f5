// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Scene/PatchScene.h"
#include "Shared/AbortCheck.h"
#include "Support/TransportMemory.h"
#include "vtkCPULinkOperator.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDeviceLinkOperator.h"
#include "vtkDoubleArray.h"
#include "vtkExchangeMatrix.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTimerLog.h"

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace LightTransport;

namespace
{
// Seconds from which on a user wants to know how long it takes.
constexpr double LongTime = 2.0;
} // namespace

//------------------------------------------------------------------------------
vtkTransportAlgorithm::vtkTransportAlgorithm()
{
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

//------------------------------------------------------------------------------
vtkTransportAlgorithm::~vtkTransportAlgorithm()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
vtkCxxSetObjectMacro(vtkTransportAlgorithm, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::RequestDataObject(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  const vtkDataObject* input = vtkDataObject::GetData(inputs[0], 0);
  if (!input)
  {
    return 0;
  }
  if (vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
      !output || !output->IsA(input->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> copy;
    copy.TakeReference(input->NewInstance());
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), copy);
  }
  if (this->GetNumberOfOutputPorts() > 1 && !vtkTable::GetData(outputs, 1))
  {
    vtkNew<vtkTable> table;
    outputs->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), table);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::GetNumberOfRanks() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

//------------------------------------------------------------------------------
bool vtkTransportAlgorithm::UsesAtlas(vtkDataObject* input, int clusterTree)
{
  return clusterTree == CLUSTER_TREE_ATLAS ||
    (clusterTree == CLUSTER_TREE_AUTO && PatchScene::HasAtlas(input, this->Controller));
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::SetProgressStage(double begin, double end)
{
  this->StageBegin = begin;
  this->StageEnd = end;
  if (begin == 0.0)
  {
    this->StartTime = vtkTimerLog::GetUniversalTime();
    this->SetProgressText(nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::SetTimeLeft(double done)
{
  const double elapsed = vtkTimerLog::GetUniversalTime() - this->StartTime;
  if (elapsed < LongTime || done <= 0.0)
  {
    return;
  }
  const double left = elapsed * (1.0 - done) / done;
  std::ostringstream text;
  text << this->GetClassName() << ": about "
       << (left < 120.0 ? std::ceil(left) : std::ceil(left / 60.0))
       << (left < 120.0 ? " s left" : " min left");
  this->SetProgressText(text.str().c_str());
}

//------------------------------------------------------------------------------
bool vtkTransportAlgorithm::ReportProgress(double fraction)
{
  const double within = std::min(std::max(fraction, 0.0), 1.0);
  const double done = this->StageBegin + within * (this->StageEnd - this->StageBegin);
  this->SetTimeLeft(done);
  this->UpdateProgress(done);
  int aborted = AbortCheck::IsAborted(this) ? 1 : 0;
  if (this->GetNumberOfRanks() > 1)
  {
    // One rank that leaves alone would let the others wait for it for ever.
    const int mine = aborted;
    this->Controller->AllReduce(&mine, &aborted, 1, vtkCommunicator::MAX_OP);
  }
  return aborted == 0;
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::GetRank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

//------------------------------------------------------------------------------
// A matrix that `allocate` returns true for, where `bytes` are there on every rank; `remedy` is
// what else than fewer patches helps.
template <typename Allocation>
vtkSmartPointer<vtkExchangeMatrix> vtkTransportAlgorithm::AllocateExchange(
  std::size_t numberOfPatches, double bytes, const std::string& remedy, Allocation&& allocate)
{
  const double available = TransportMemory::GetAvailableBytes();
  vtkSmartPointer<vtkExchangeMatrix> exchange = vtkSmartPointer<vtkExchangeMatrix>::New();
  std::string error;
  if (bytes > available || !allocate(exchange))
  {
    error = "The links between " + std::to_string(numberOfPatches) + " patches need " +
      TransportMemory::Format(bytes) + " of memory" +
      (this->GetNumberOfRanks() > 1 ? " in one process" : "") + " and " +
      TransportMemory::Format(available) + " are free: " + remedy +
      "use fewer patches (a larger TargetEdgeLength in vtkPatchMesher) or "
      "processes on more machines (each holds a part).";
  }
  if (!PatchScene::Agree(this->Controller, error.empty(), error))
  {
    vtkErrorMacro(<< error);
    return nullptr;
  }
  return exchange;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkExchangeMatrix> vtkTransportAlgorithm::MakeExchange(
  const std::vector<double>& areas, int numberOfKernels)
{
  const int ranks = this->GetNumberOfRanks();
  const double bytes = vtkExchangeMatrix::GetEstimatedBytes(static_cast<vtkIdType>(areas.size()),
    numberOfKernels, ranks);
  return this->AllocateExchange(areas.size(), bytes, "",
    [&](vtkExchangeMatrix* exchange)
    { return exchange->Allocate(areas, numberOfKernels, this->GetRank(), ranks); });
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkExchangeMatrix> vtkTransportAlgorithm::MakeSparseExchange(
  const std::vector<double>& areas, vtkIdType numberOfTiles)
{
  const int ranks = this->GetNumberOfRanks();
  const double bytes = vtkExchangeMatrix::GetEstimatedSparseBytes(
    static_cast<vtkIdType>(areas.size()), 1, numberOfTiles, ranks);
  return this->AllocateExchange(areas.size(), bytes,
    "set LinkMethod to Hierarchical (in vtkViewFactors switch Hierarchical on), or ",
    [&](vtkExchangeMatrix* exchange)
    {
      exchange->AllocateSparse(areas, 1, this->GetRank(), ranks);
      return true;
    });
}

//------------------------------------------------------------------------------
bool vtkTransportAlgorithm::CheckDevice(int device)
{
  std::string reason;
  if (device == DEVICE_OPENGL && !this->OpenDevice(device, reason))
  {
    vtkErrorMacro("Device is OpenGL, but " << reason << " Or set Device to Auto or CPU.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkLinkOperator> vtkTransportAlgorithm::MakeLinkOperator(int device,
  vtkExchange* exchange, int numberOfBands, std::string& explanation)
{
  explanation = "CPU: asked for";
  if (device != DEVICE_CPU)
  {
    std::string reason;
    vtkSmartPointer<vtkDeviceLinkOperator> found = this->OpenDevice(device, reason);
    if (found && found->Initialize(exchange, numberOfBands))
    {
      explanation = device == DEVICE_AUTO ? "OpenGL: a GPU is there" : "OpenGL: asked for";
      return found;
    }
    reason = found ? "the links could not be put on it (see the message before this one)." : reason;
    if (device == DEVICE_OPENGL)
    {
      vtkErrorMacro("Device is OpenGL, but " << reason << " Or set Device to Auto or CPU.");
      return nullptr;
    }
    explanation = "CPU: " + reason;
  }
  return this->MakeCPULinkOperator(exchange, numberOfBands);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkCPULinkOperator> vtkTransportAlgorithm::MakeCPULinkOperator(
  vtkExchange* exchange, int numberOfBands)
{
  vtkSmartPointer<vtkCPULinkOperator> links = vtkCPULinkOperator::NewFor(exchange);
  links->SetController(this->Controller);
  return links->Initialize(exchange, numberOfBands) ? links : nullptr;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkDeviceLinkOperator> vtkTransportAlgorithm::OpenDevice(int device,
  std::string& reason)
{
  if (this->GetNumberOfRanks() > 1)
  {
    reason = "the run has several ranks, which share the links on their CPUs.";
    return nullptr;
  }
  auto found = vtkSmartPointer<vtkDeviceLinkOperator>::Take(vtkDeviceLinkOperator::New());
  if (!found)
  {
    reason = "no loaded module computes on OpenGL: load vtkLightTransportRendering (in Python, "
             "import vtklighttransport).";
    return nullptr;
  }
  if (!found->Open(reason))
  {
    return nullptr;
  }
  if (device == DEVICE_AUTO && !found->IsHardware())
  {
    reason = std::string("OpenGL is a software renderer here (") + found->GetDeviceName() +
      "), which is slower.";
    return nullptr;
  }
  return found;
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::AddSummary(vtkFieldData* fields, const char* name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::AddSummary(vtkFieldData* fields, const char* name,
  const double values[3])
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->InsertNextTuple(values);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::AddSummary(vtkFieldData* fields, const char* name,
  const std::string& value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
