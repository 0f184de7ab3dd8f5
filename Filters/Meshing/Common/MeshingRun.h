// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How the filters of this module run: their steps, and the border to the libraries that throw.
#ifndef MeshingRun_h
#define MeshingRun_h

#include "Shared/Attempt.h"
#include "Shared/Outcome.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

namespace LightTransport
{
namespace MeshingRun
{
using LightTransport::Advice;

/// Takes the steps of a filter, each of which returns an Outcome, as long as all before are done.
/// What CGAL, Eigen, a lack of memory and a Heartbeat throw ends here.
class Steps
{
public:
  explicit Steps(const Advice& advice) : WhatToDo(advice) {}

  template <typename Step>
  void Take(const Step& step)
  {
    if (this->Result)
    {
      this->Result = Attempt(step, this->WhatToDo);
    }
  }

  const Outcome& GetOutcome() const { return this->Result; }

private:
  Advice WhatToDo;
  Outcome Result = Outcome::Done();
};

//------------------------------------------------------------------------------
/// Of data distributed over several processes a piece may be empty, which is no error.
inline bool IsEmptyPiece(vtkDataObject* input, vtkInformation* output)
{
  vtkInformationIntegerKey* pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return input->GetNumberOfElements(vtkDataObject::CELL) == 0 && output->Has(pieces) &&
    output->Get(pieces) > 1;
}
} // namespace MeshingRun
} // namespace LightTransport

#endif
