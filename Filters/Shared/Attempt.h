// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The border to what throws: memory that is refused, libraries, and work that is stopped. No
/// exception leaves a filter, since hosts do not expect any.
#ifndef Attempt_h
#define Attempt_h

#include "Shared/Outcome.h"
#include "Shared/Stopped.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace LightTransport
{
/// What to say when memory runs out, and when a library gives up.
struct Advice
{
  const char* WithoutMemory;
  const char* Failure;
  const char* Remedy;
};

/// Take a step, which returns an Outcome; what it throws becomes a failure, or an abort.
template <typename Step>
Outcome Attempt(const Step& step, const Advice& advice)
{
  // Made before, since there is none for a message when memory has run out.
  Outcome withoutMemory = Outcome::Failed("No memory left.");
  try
  {
    withoutMemory =
      Outcome::Failed(std::string("Not enough memory: ") + advice.WithoutMemory + ".");
    return step();
  }
  catch (const Stopped&)
  {
    return Outcome::Aborted();
  }
  catch (const std::bad_alloc&)
  {
    return withoutMemory;
  }
  catch (const std::length_error&)
  {
    return withoutMemory;
  }
  catch (const std::exception& problem)
  {
    return Outcome::Failed(
      std::string(advice.Failure) + " (" + problem.what() + "): " + advice.Remedy + ".");
  }
}
} // namespace LightTransport

#endif
