// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Functions of direction as sums of spherical harmonics: real, orthonormal over the sphere, without
 * the phase of Condon and Shortley. Y_lm is number l (l + 1) + m.
 */
#ifndef SphericalHarmonics_h
#define SphericalHarmonics_h

#include "Shared/Fresnel.h"
#include "Shared/GaussLegendre.h"

#include "vtkMath.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace LightTransport
{
namespace SphericalHarmonics
{
/// A matrix, row by row.
using Matrix = std::array<double, 9>;

/// How many there are up to a degree.
inline std::size_t GetCount(int degree)
{
  return static_cast<std::size_t>(degree + 1) * static_cast<std::size_t>(degree + 1);
}

//------------------------------------------------------------------------------
/// All of them up to a degree, at a direction of length 1. Order by order m, each from degree to
/// degree by Legendre's recursion; the powers of (x + i y) have the cosines and sines.
inline void Evaluate(int degree, const double direction[3], double* values)
{
  const double z = direction[2];
  double cosine = 1.0;
  double sine = 0.0;
  double sectorial = 1.0; // P_mm over sin^m
  double factor = 1.0;    // (l - m)! / (l + m)! at l = m
  for (int m = 0; m <= degree; ++m)
  {
    double before = 0.0;
    double legendre = sectorial;
    double ratio = factor;
    for (int l = m; l <= degree; ++l)
    {
      const double scale =
        std::sqrt((2 * l + 1) / (4.0 * vtkMath::Pi()) * ratio * (m > 0 ? 2.0 : 1.0)) * legendre;
      const int middle = l * (l + 1);
      values[middle + m] = scale * cosine;
      values[middle - m] = m > 0 ? scale * sine : scale;
      const double next = ((2 * l + 1) * z * legendre - (l + m) * before) / (l - m + 1);
      before = legendre;
      legendre = next;
      ratio *= (l + 1.0 - m) / (l + 1.0 + m);
    }
    const double real = cosine * direction[0] - sine * direction[1];
    sine = cosine * direction[1] + sine * direction[0];
    cosine = real;
    sectorial *= 2 * m + 1;
    factor /= (2.0 * m + 1.0) * (2.0 * m + 2.0);
  }
}

//------------------------------------------------------------------------------
/**
 * What of the harmonics of each degree enters a surface that looks at the whole hemisphere, by its
 * normal: A_l = 2 pi Int_0^1 F_t(mu) mu P_l(mu) dmu, so that irradiance that enters is
 * sum A_l L_lm Y_lm(normal) (R. Ramamoorthi, P. Hanrahan, SIGGRAPH 2001, eq. 7, with Fresnel's
 * transmittance: pi, 2 pi / 3, pi / 4, 0, ... at an index of 1).
 */
inline std::vector<double> GetCosineKernel(int degree, double refractiveIndex)
{
  std::vector<double> kernel(static_cast<std::size_t>(degree + 1), 0.0);
  const GaussLegendre rule(64);
  for (std::size_t k = 0; k < rule.Nodes.size(); ++k)
  {
    // As Fresnel::GetMeanExternalReflectance does: it changes fast at grazing angles.
    const double t = rule.Nodes[k];
    const double cosine = t * t * t * t;
    const double entering = 2.0 * vtkMath::Pi() * rule.Weights[k] * 4.0 * t * t * t * cosine *
      Fresnel::GetTransmittance(cosine, refractiveIndex);
    double before = 0.0;
    double legendre = 1.0;
    for (int l = 0; l <= degree; ++l)
    {
      kernel[static_cast<std::size_t>(l)] += entering * legendre;
      const double next = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
      before = legendre;
      legendre = next;
    }
  }
  return kernel;
}

//------------------------------------------------------------------------------
/**
 * Coefficients of g(w) = f(M w) from those of f, for an orthogonal matrix M, `bands` of them at
 * each harmonic: projected again by a rule that is exact up to the degree.
 */
inline std::vector<double> Turn(int degree, const std::vector<double>& coefficients, int bands,
  const Matrix& matrix)
{
  const std::size_t count = GetCount(degree);
  std::vector<double> turned(count * bands, 0.0);
  std::vector<double> from(count);
  std::vector<double> to(count);
  const GaussLegendre heights(degree + 1);
  const int columns = 2 * degree + 1;
  for (std::size_t row = 0; row < heights.Nodes.size(); ++row)
  {
    const double z = 2.0 * heights.Nodes[row] - 1.0;
    const double radius = std::sqrt(1.0 - z * z);
    const double weight = 2.0 * heights.Weights[row] * 2.0 * vtkMath::Pi() / columns;
    for (int column = 0; column < columns; ++column)
    {
      const double angle = 2.0 * vtkMath::Pi() * column / columns;
      const double direction[3] = { radius * std::cos(angle), radius * std::sin(angle), z };
      double moved[3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        moved[k] = matrix[3 * k] * direction[0] + matrix[3 * k + 1] * direction[1] +
          matrix[3 * k + 2] * direction[2];
      }
      Evaluate(degree, moved, from.data());
      Evaluate(degree, direction, to.data());
      for (int band = 0; band < bands; ++band)
      {
        double value = 0.0;
        for (std::size_t k = 0; k < count; ++k)
        {
          value += from[k] * coefficients[k * bands + band];
        }
        for (std::size_t k = 0; k < count; ++k)
        {
          turned[k * bands + band] += weight * value * to[k];
        }
      }
    }
  }
  return turned;
}
} // namespace SphericalHarmonics
} // namespace LightTransport

#endif
