// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/RadiosityVectors.h"

#include "Radiosity/RadiosityEquation.h"
#include "vtkLinkOperator.h"

#include <cmath>
#include <limits>

namespace LightTransport
{
namespace
{
// Roundings of one residual: the product, the scaling and two sums.
constexpr int RoundingsOfResidual = 4;
} // namespace

//------------------------------------------------------------------------------
RadiosityVectors::RadiosityVectors(const RadiosityEquation& equation, vtkLinkOperator* links,
  const double* source)
  : Equation(equation), Links(links), Ones(equation.NumberOfBands, 1.0),
    MinusOnes(equation.NumberOfBands, -1.0), Zeros(equation.NumberOfBands, 0.0)
{
  const std::size_t size = equation.Reflectance.size();
  std::vector<double> reflection(size), symmetric(size);
  for (std::size_t k = 0; k < size; ++k)
  {
    reflection[k] = equation.Reflectance[k] / (*equation.Areas)[k / equation.NumberOfBands];
    symmetric[k] = std::sqrt(reflection[k]);
  }
  this->Ok = links->SetVector(SOURCE, source) && links->SetVector(SOLUTION, source) &&
    links->SetVector(REFLECTION, reflection.data()) &&
    links->SetVector(SYMMETRIC, symmetric.data());
}

//------------------------------------------------------------------------------
bool RadiosityVectors::ComputeResidual()
{
  return this->Links->Multiply(RESIDUAL, SOLUTION) &&
    this->Links->Scale(RESIDUAL, REFLECTION, RESIDUAL) &&
    this->Links->Combine(RESIDUAL, this->Ones.data(), RESIDUAL, this->MinusOnes.data(), SOLUTION) &&
    this->Links->Combine(RESIDUAL, this->Ones.data(), RESIDUAL, this->Ones.data(), SOURCE);
}

//------------------------------------------------------------------------------
double RadiosityVectors::GetRounding(bool isSinglePrecision, double size, int steps)
{
  const double epsilon = isSinglePrecision ? std::numeric_limits<float>::epsilon()
                                           : std::numeric_limits<double>::epsilon();
  return epsilon * (RoundingsOfResidual + steps) * size;
}
} // namespace LightTransport
