// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the filters of this module share while they run: how they stop, and how they say how far
/// they are.
#ifndef vtkMeshingRun_h
#define vtkMeshingRun_h

#include "vtkAbortCheck.h"
#include "vtkAlgorithm.h"

#include <stdexcept>

namespace vtkMeshingRun
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
  if (vtkAbortCheck::IsAborted(algorithm))
  {
    throw Aborted();
  }
}
} // namespace vtkMeshingRun

#endif
