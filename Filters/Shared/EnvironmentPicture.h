// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Radiance from afar as vtkLightingAlgorithm takes it: a picture in longitude and latitude, the
/// columns from +x counter-clockwise seen from +z, the rows from -z to +z.
#ifndef EnvironmentPicture_h
#define EnvironmentPicture_h

#include "Shared/InputArrays.h"
#include "Shared/Outcome.h"
#include "Shared/Pulse.h"
#include "Shared/SphericalHarmonics.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkPointData.h"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace LightTransport
{
struct EnvironmentPicture
{
  /// Red, green and blue, also of a grey picture.
  static constexpr int Bands = 3;

  int Width = 0;
  int Height = 0;
  std::vector<double> Values;

  //----------------------------------------------------------------------------
  /// Fails where it is none of 1 or 3 components, or not finite.
  Outcome Read(vtkImageData* picture)
  {
    const int* size = picture->GetDimensions();
    vtkDataArray* scalars = picture->GetPointData()->GetScalars();
    const int components = scalars ? scalars->GetNumberOfComponents() : 0;
    if (size[0] < 1 || size[1] < 1 || size[2] != 1 || (components != 1 && components != Bands))
    {
      std::ostringstream text;
      text << "The environment must be a two-dimensional image with point scalars of 1 or 3 "
              "components, but its size is "
           << size[0] << " x " << size[1] << " x " << size[2] << " with " << components
           << " components.";
      return Outcome::Failed(text.str());
    }
    if (const std::string problem = InputArrays::DescribeLengths(picture); !problem.empty())
    {
      return Outcome::Failed("In the environment " + problem + ".");
    }
    this->Width = size[0];
    this->Height = size[1];
    return this->ReadValues(scalars);
  }

  //----------------------------------------------------------------------------
  /// From where the middle of a pixel shines.
  void GetDirection(int column, int row, double direction[3]) const
  {
    const double longitude = (column + 0.5) * 2.0 * vtkMath::Pi() / this->Width;
    const double angle = (row + 0.5) * vtkMath::Pi() / this->Height; // from -z
    direction[0] = std::sin(angle) * std::cos(longitude);
    direction[1] = std::sin(angle) * std::sin(longitude);
    direction[2] = -std::cos(angle);
  }

  /// Solid angle of each pixel of a row.
  double GetPixelSize(int row) const
  {
    const double height = vtkMath::Pi() / this->Height;
    return 2.0 * vtkMath::Pi() / this->Width *
      (std::cos(row * height) - std::cos((row + 1) * height));
  }

  const double* GetValue(int column, int row) const
  {
    return &this->Values[(static_cast<std::size_t>(row) * this->Width + column) * Bands];
  }

  //----------------------------------------------------------------------------
  /// Coefficients of radiance, all bands of a harmonic side by side.
  std::vector<double> Project(int degree) const
  {
    const std::size_t count = SphericalHarmonics::GetCount(degree);
    std::vector<double> coefficients(count * Bands, 0.0);
    std::vector<double> harmonics(count);
    for (int row = 0; row < this->Height; ++row)
    {
      Pulse::Beat();
      const double size = this->GetPixelSize(row);
      for (int column = 0; column < this->Width; ++column)
      {
        double direction[3];
        this->GetDirection(column, row, direction);
        SphericalHarmonics::Evaluate(degree, direction, harmonics.data());
        const double* value = this->GetValue(column, row);
        for (std::size_t k = 0; k < count * Bands; ++k)
        {
          coefficients[k] += size * harmonics[k / Bands] * value[k % Bands];
        }
      }
    }
    return coefficients;
  }

private:
  //----------------------------------------------------------------------------
  Outcome ReadValues(vtkDataArray* scalars)
  {
    const bool isGrey = scalars->GetNumberOfComponents() == 1;
    this->Values.clear();
    this->Values.reserve(static_cast<std::size_t>(this->Width) * this->Height * Bands);
    for (vtkIdType pixel = 0; pixel < scalars->GetNumberOfTuples(); ++pixel)
    {
      Pulse::Beat(pixel);
      for (int band = 0; band < Bands; ++band)
      {
        const double value = scalars->GetComponent(pixel, isGrey ? 0 : band);
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
};
} // namespace LightTransport

#endif
