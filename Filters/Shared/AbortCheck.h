// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Whether somebody asked a filter to abort, whatever the version of VTK.
#ifndef AbortCheck_h
#define AbortCheck_h

#include "vtkAlgorithm.h"

namespace LightTransport
{
namespace AbortCheck
{
//------------------------------------------------------------------------------
// vtkAlgorithm::CheckAbort appeared after VTK 9.2; before it there is the flag alone.
template <typename Algorithm>
auto IsAborted(Algorithm* algorithm, int) -> decltype(algorithm->CheckAbort())
{
  return algorithm->CheckAbort();
}
template <typename Algorithm>
bool IsAborted(Algorithm* algorithm, long)
{
  return algorithm->GetAbortExecute() != 0;
}

//------------------------------------------------------------------------------
inline bool IsAborted(vtkAlgorithm* algorithm)
{
  return IsAborted(algorithm, 0);
}

//------------------------------------------------------------------------------
// Versions of VTK with CheckAbort remember what it has said, until a pipeline runs.
template <typename Algorithm>
auto ForgetOutput(Algorithm* algorithm, int) -> decltype(algorithm->SetAbortOutput(false))
{
  algorithm->SetAbortOutput(false);
}
template <typename Algorithm>
void ForgetOutput(Algorithm*, long)
{
}

//------------------------------------------------------------------------------
/// A wish counts for the run in which it was made: to be called before the first progress of
/// another. Not all versions of VTK do it by themselves.
inline void Forget(vtkAlgorithm* algorithm)
{
  algorithm->SetAbortExecute(0);
  ForgetOutput(algorithm, 0);
}
} // namespace AbortCheck
} // namespace LightTransport

#endif
