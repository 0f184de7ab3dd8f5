// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransportAlgorithm.h"

#include "Run/TransportRun.h"
#include "Shared/AbortCheck.h"
#include "Shared/Outcome.h"
#include "Shared/OutputLikeInput.h"
#include "Support/Ranks.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkTable.h"

using namespace LightTransport;

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
  if (!OutputLikeInput::Make(inputs, outputs))
  {
    return 0;
  }
  if (this->GetNumberOfOutputPorts() > 1 && !vtkTable::GetData(outputs, 1))
  {
    vtkNew<vtkTable> table;
    outputs->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), table);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::RequestUpdateExtent(vtkInformation* request,
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  AbortCheck::Forget(this);
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

//------------------------------------------------------------------------------
int vtkTransportAlgorithm::RequestData(vtkInformation*, vtkInformationVector** inputs,
  vtkInformationVector* outputs)
{
  RunPorts ports;
  ports.Filter = this;
  ports.Input = vtkDataObject::GetData(inputs[0], 0);
  ports.Output = vtkDataObject::GetData(outputs, 0);
  ports.Table = this->GetNumberOfOutputPorts() > 1 ? vtkTable::GetData(outputs, 1) : nullptr;
  ports.ProgressInterval = this->ProgressInterval;
  const Outcome outcome = this->Run(ports);
  if (!outcome)
  {
    ports.Output->Initialize();
    if (ports.Table)
    {
      ports.Table->Initialize();
    }
  }
  if (!outcome.GetMessage().empty())
  {
    vtkErrorMacro(<< outcome.GetMessage());
  }
  // VTK tells a failure as an error of its own; an abort is none.
  return outcome.HasFailed() ? 0 : 1;
}

//------------------------------------------------------------------------------
// All that the run holds is given back before its outcome is reported.
Outcome vtkTransportAlgorithm::Run(const RunPorts& ports)
{
  std::unique_ptr<TransportRun> run;
  const auto make = [&]()
  {
    run = this->MakeRun(ports);
    return Outcome::Done();
  };
  const Outcome made = Ranks(this->Controller).Attempt(make, TransportRun::GetAdvice());
  return made ? run->Go() : made;
}

//------------------------------------------------------------------------------
void vtkTransportAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FeatureAngle: " << this->FeatureAngle << "\n";
  os << indent << "ProgressInterval: " << this->ProgressInterval << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
