// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityEquation.h"

#include <algorithm>
#include <cstddef>

namespace LightTransport
{
//------------------------------------------------------------------------------
std::vector<double> RadiosityEquation::FindAmbientIrradiance(const std::vector<double>& areas) const
{
  const auto bands = static_cast<std::size_t>(this->NumberOfBands);
  std::vector<double> emitted(bands, 0.0);
  std::vector<double> absorbed(bands, 0.0);
  for (std::size_t k = 0; k < this->Emission.size(); ++k)
  {
    emitted[k % bands] += areas[k / bands] * this->Emission[k];
    absorbed[k % bands] += areas[k / bands] * (1.0 - this->Reflectance[k]);
  }
  std::transform(emitted.begin(), emitted.end(), absorbed.begin(), emitted.begin(),
    [](double power, double loss) { return loss > 0.0 ? power / loss : 0.0; });
  return emitted;
}
} // namespace LightTransport
