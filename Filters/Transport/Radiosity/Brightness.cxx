// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/Brightness.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
std::vector<double> Brightness::Find(const std::vector<double>& radiosity,
  const std::vector<double>& areas, double mostContrast)
{
  const std::size_t bands = radiosity.size() / areas.size();
  std::vector<double> brightness(areas.size(), 0.0);
  for (std::size_t k = 0; k < radiosity.size(); ++k)
  {
    brightness[k / bands] = std::max(brightness[k / bands], std::abs(radiosity[k]));
  }
  double squared = 0.0;
  for (std::size_t patch = 0; patch < areas.size(); ++patch)
  {
    squared += areas[patch] * brightness[patch] * brightness[patch];
  }
  const double darkest =
    std::sqrt(squared / std::accumulate(areas.begin(), areas.end(), 0.0)) / mostContrast;
  for (double& value : brightness)
  {
    value = std::max(value, darkest);
  }
  return brightness;
}
} // namespace LightTransport
