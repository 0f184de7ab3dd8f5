// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Skies for tests.
#ifndef EnvironmentTesting_h
#define EnvironmentTesting_h

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cmath>
#include <functional>

namespace EnvironmentTesting
{
using Direction = std::array<double, 3>;
using Radiance = std::function<Direction(const Direction&)>;

/// A picture in longitude and latitude, +z up, twice as wide as high.
inline vtkSmartPointer<vtkImageData> MakeSky(int height, const Radiance& radiance)
{
  auto sky = vtkSmartPointer<vtkImageData>::New();
  sky->SetDimensions(2 * height, height, 1);
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfComponents(3);
  for (int row = 0; row < height; ++row)
  {
    const double latitude = ((row + 0.5) / height - 0.5) * vtkMath::Pi();
    for (int column = 0; column < 2 * height; ++column)
    {
      const double longitude = (column + 0.5) / height * vtkMath::Pi();
      values->InsertNextTuple(
        radiance({ std::cos(latitude) * std::cos(longitude),
                   std::cos(latitude) * std::sin(longitude), std::sin(latitude) })
          .data());
    }
  }
  sky->GetPointData()->SetScalars(values);
  return sky;
}

inline double Dot(const Direction& a, const Direction& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Soft, of degree 4, never negative, other in each direction and band.
inline Direction GetSoftSky(const Direction& w)
{
  const Direction sun = { 0.36, 0.48, 0.8 };
  const double lobe = std::pow(0.5 * (1.0 + Dot(w, sun)), 4);
  return { 0.2 + 2.0 * lobe, 0.3 + lobe + 0.2 * w[0], 0.5 + 0.4 * w[2] + 0.3 * w[0] * w[1] };
}

/// The same, with a sun that takes about 20 degrees.
inline Direction GetSunnySky(const Direction& w)
{
  const Direction sun = { 0.36, 0.48, 0.8 };
  const double lobe = 20.0 * std::exp(60.0 * (Dot(w, sun) - 1.0));
  return { 0.2 + lobe, 0.3 + 0.8 * lobe + 0.2 * w[0], 0.5 + 0.4 * w[2] + 0.6 * lobe };
}
} // namespace EnvironmentTesting

#endif
