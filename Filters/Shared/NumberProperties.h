// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// VTK's macros that clamp a property to its range let NaN pass, and work that is to go on until an
/// error is below NaN does not end: filters refuse it before they begin.
#ifndef NumberProperties_h
#define NumberProperties_h

#include "Shared/Outcome.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace NumberProperties
{
/// Names and values.
using List = std::vector<std::pair<const char*, double>>;

inline Outcome Check(const List& properties)
{
  for (const auto& [name, value] : properties)
  {
    if (std::isnan(value))
    {
      return Outcome::Failed(std::string(name) + " is not a number: give one.");
    }
  }
  return Outcome::Done();
}
} // namespace NumberProperties
} // namespace LightTransport

#endif
