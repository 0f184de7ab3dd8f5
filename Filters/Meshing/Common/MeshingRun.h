// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How the filters of this module run: their steps, and the border to the libraries that throw.
#ifndef MeshingRun_h
#define MeshingRun_h

#include "Common/Heartbeat.h"
#include "Shared/Outcome.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <exception>
#include <new>
#include <string>

namespace LightTransport
{
namespace MeshingRun
{
/// What to say when memory runs out, and when a library gives up.
struct Advice
{
  const char* WithoutMemory;
  const char* Failure;
  const char* Remedy;
};

/// Takes the steps of a filter, each of which returns an Outcome, as long as all before are done.
/// What CGAL, Eigen and a lack of memory throw ends here and becomes a failure.
class Steps
{
public:
  explicit Steps(const Advice& advice) : WhatToDo(advice) {}

  template <typename Step>
  void Take(const Step& step)
  {
    if (this->Result)
    {
      this->Result = this->Try(step);
    }
  }

  const Outcome& GetOutcome() const { return this->Result; }

private:
  template <typename Step>
  Outcome Try(const Step& step) const
  {
    try
    {
      return step();
    }
    catch (const Heartbeat::Stopped&)
    {
      return Outcome::Aborted();
    }
    catch (const std::bad_alloc&)
    {
      return Outcome::Failed(
        std::string("Not enough memory: ") + this->WhatToDo.WithoutMemory + ".");
    }
    catch (const std::exception& problem)
    {
      return Outcome::Failed(std::string(this->WhatToDo.Failure) + " (" + problem.what() +
        "): " + this->WhatToDo.Remedy + ".");
    }
  }

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
