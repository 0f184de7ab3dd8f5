// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where light is, for links that are refined by it.
#ifndef Brightness_h
#define Brightness_h

#include <vector>

namespace LightTransport
{
namespace Brightness
{
/**
 * The largest radiosity of each patch over its bands. Nothing counts as darker than the root mean
 * square over `mostContrast`: links for dark patches would tell too little of row sums, which rows
 * are closed by.
 */
std::vector<double> Find(const std::vector<double>& radiosity, const std::vector<double>& areas,
  double mostContrast);
} // namespace Brightness
} // namespace LightTransport

#endif
