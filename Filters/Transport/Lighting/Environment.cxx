// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/Environment.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace LightTransport
{
//------------------------------------------------------------------------------
Outcome Environment::Read(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  vtkDataArray* scalars = picture->GetPointData()->GetScalars();
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 || (components != 1 && components != LightBands))
  {
    std::ostringstream text;
    text << "The environment must be a two-dimensional image with point scalars of 1 or 3 "
            "components, but its size is "
         << size[0] << " x " << size[1] << " x " << size[2] << " with " << components
         << " components.";
    return Outcome::Failed(text.str());
  }
  this->Width = size[0];
  this->Height = size[1];
  this->Values.reserve(static_cast<std::size_t>(size[0]) * size[1] * LightBands);
  for (vtkIdType pixel = 0; pixel < scalars->GetNumberOfTuples(); ++pixel)
  {
    for (int band = 0; band < LightBands; ++band)
    {
      const double value = scalars->GetComponent(pixel, components == 1 ? 0 : band);
      if (!std::isfinite(value))
      {
        return Outcome::Failed("The environment has a value that is not finite at pixel " +
          std::to_string(pixel) + ": replace such values.");
      }
      this->Values.push_back(value);
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Bilinear between the centres of pixels.
void Environment::Evaluate(const LitPatch::Vector& direction, double radiance[LightBands]) const
{
  const double longitude = std::atan2(direction.y(), direction.x()) / (2.0 * vtkMath::Pi());
  const double latitude =
    std::asin(std::min(1.0, std::max(-1.0, direction.z()))) / vtkMath::Pi() + 0.5;
  const double x = (longitude < 0.0 ? longitude + 1.0 : longitude) * this->Width - 0.5;
  const double y = std::min(std::max(latitude * this->Height - 0.5, 0.0), this->Height - 1.0);
  const int column = static_cast<int>(std::floor(x));
  const int row = std::min(static_cast<int>(y), std::max(0, this->Height - 2));
  const double right = x - column;
  const double up = y - row;
  const int columns[2] = { (column + this->Width) % this->Width,
    (column + 1 + this->Width) % this->Width };
  const int rows[2] = { row, std::min(row + 1, this->Height - 1) };
  for (int band = 0; band < LightBands; ++band)
  {
    const auto at = [&](int i, int j)
    { return this->Values[(rows[j] * this->Width + columns[i]) * LightBands + band]; };
    radiance[band] = (1.0 - up) * ((1.0 - right) * at(0, 0) + right * at(1, 0)) +
      up * ((1.0 - right) * at(0, 1) + right * at(1, 1));
  }
}

//------------------------------------------------------------------------------
double Environment::Light(const LitPatch& patch, LightSum& sum) const
{
  const double weight = vtkMath::Pi() / this->Samples;
  for (int k = 0; k < this->Samples; ++k)
  {
    const LitPatch::Vector direction = patch.GetDirection(k);
    const double cosine = direction.dot(patch.GetNormal());
    const LitPatch::Vector point = patch.GetPoint(k);
    if (!patch.IsBlocked(point, point + OutOfScene * direction))
    {
      double radiance[LightBands];
      this->Evaluate(direction, radiance);
      sum.Add(radiance, weight, patch.GetTransmittance(cosine));
    }
  }
  return this->Samples;
}
} // namespace LightTransport
