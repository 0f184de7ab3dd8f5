// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the filters of this module share while they run: how they stop, and how they say how far
/// they are.
#ifndef MeshingRun_h
#define MeshingRun_h

#include "Shared/AbortCheck.h"
#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace LightTransport
{
namespace MeshingRun
{
/// A problem with the input or the properties: what it is and what to do about it.
class InputError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Thrown where somebody asked the filter to abort.
struct Aborted
{
};

//------------------------------------------------------------------------------
/// Tell the observers of the filter, on its own thread, and throw when one of them aborts it.
inline void Report(vtkAlgorithm* algorithm, double progress)
{
  algorithm->UpdateProgress(progress);
  if (AbortCheck::IsAborted(algorithm))
  {
    throw Aborted();
  }
}

//------------------------------------------------------------------------------
/// How the work of a filter ended: done; or not, with an error to report; or not, and without one,
/// because somebody aborted it.
struct Outcome
{
  bool Done = false;
  std::string Error;
};

/// What to say when memory runs out, and when a library gives up.
struct Advice
{
  const char* WithoutMemory;
  const char* Failure;
  const char* Remedy;
};

//------------------------------------------------------------------------------
/// Do the work of a filter, which may throw.
template <typename Work>
Outcome Try(const Advice& advice, const Work& work)
{
  Outcome outcome;
  try
  {
    work();
    outcome.Done = true;
  }
  catch (const Aborted&)
  {
  }
  catch (const InputError& problem)
  {
    outcome.Error = problem.what();
  }
  catch (const std::bad_alloc&)
  {
    outcome.Error = std::string("Not enough memory: ") + advice.WithoutMemory + ".";
  }
  catch (const std::exception& problem)
  {
    outcome.Error =
      std::string(advice.Failure) + " (" + problem.what() + "): " + advice.Remedy + ".";
  }
  return outcome;
}

//------------------------------------------------------------------------------
/// Of data distributed over several processes a piece may be empty, which is no error.
inline bool IsEmptyPiece(vtkDataSet* input, vtkInformation* output)
{
  vtkInformationIntegerKey* pieces = vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES();
  return input->GetNumberOfCells() == 0 && output->Has(pieces) && output->Get(pieces) > 1;
}
} // namespace MeshingRun
} // namespace LightTransport

#endif
