// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Atlas/AtlasTexels.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace LightTransport
{
namespace
{
//------------------------------------------------------------------------------
Outcome SumAreas(double& sum, vtkDataArray* areas)
{
  sum = 0.0;
  bool good = true;
  for (vtkIdType texel = 0; texel < areas->GetNumberOfTuples() && good; ++texel)
  {
    const double area = areas->GetComponent(texel, 0);
    good = area >= 0.0 && std::isfinite(area);
    sum += area;
  }
  return good && sum > 0.0 ? Outcome::Done()
                           : Outcome::Failed(std::string("The areas in \"") + areas->GetName() +
                               "\" must be finite, not negative, and not all 0.");
}
} // namespace

//------------------------------------------------------------------------------
Outcome MakeAtlasTexels(std::vector<float>& rgba, vtkDataArray* values, vtkDataArray* areas)
{
  double sum = 0.0;
  if (Outcome summed = SumAreas(sum, areas); !summed)
  {
    return summed;
  }
  const vtkIdType texels = values->GetNumberOfTuples();
  const double meanArea = sum / static_cast<double>(texels);
  const int last = values->GetNumberOfComponents() - 1;
  rgba.resize(static_cast<std::size_t>(4 * texels));
  for (vtkIdType index = 0; index < texels; ++index)
  {
    float* texel = &rgba[static_cast<std::size_t>(4 * index)];
    texel[3] = static_cast<float>(areas->GetComponent(index, 0) / meanArea);
    for (int k = 0; k < 3; ++k)
    {
      texel[k] = static_cast<float>(values->GetComponent(index, std::min(k, last)) * texel[3]);
      if (!std::isfinite(texel[k]))
      {
        return Outcome::Failed(std::string("A value of \"") + values->GetName() +
          "\" is not finite in single precision.");
      }
    }
  }
  return Outcome::Done();
}
} // namespace LightTransport
