// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Radiosity/ConjugateGradients.h"

#include "Radiosity/RadiosityEquation.h"
#include "Radiosity/RadiosityVectors.h"
#include "vtkLinkOperator.h"

#include <algorithm>
#include <functional>

namespace LightTransport
{
//------------------------------------------------------------------------------
ConjugateGradients::ConjugateGradients(RadiosityVectors& vectors)
  : Vectors(vectors), Squares(vectors.Equation.NumberOfBands), Indefinite(vectors.Zeros)
{
}

//------------------------------------------------------------------------------
// y = 0, r = p = s G E
bool ConjugateGradients::Begin()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  const double* zeros = this->Vectors.Zeros.data();
  const int image = RadiosityVectors::IMAGE;
  return links->Multiply(image, RadiosityVectors::SOURCE) &&
    links->Scale(image, RadiosityVectors::SYMMETRIC, image) &&
    links->Combine(RadiosityVectors::DIRECTION, ones, image, zeros, image) &&
    links->Combine(RadiosityVectors::UNKNOWN, zeros, image, zeros, image) &&
    links->Combine(RadiosityVectors::GRADIENT, ones, image, zeros, image) &&
    links->Dot(RadiosityVectors::GRADIENT, RadiosityVectors::GRADIENT, this->Squares.data()) &&
    this->Translate();
}

//------------------------------------------------------------------------------
// IMAGE = (I - s G s) p, and how far to go along p in each band.
bool ConjugateGradients::ComputeSteps(std::vector<double>& steps)
{
  vtkLinkOperator* links = this->Vectors.Links;
  RadiosityVectors::Bands curvatures(steps.size());
  if (!links->Apply(RadiosityVectors::IMAGE, RadiosityVectors::SYMMETRIC,
        RadiosityVectors::SYMMETRIC, RadiosityVectors::DIRECTION, RadiosityVectors::SCRATCH) ||
    !links->Combine(RadiosityVectors::IMAGE, this->Vectors.Ones.data(), RadiosityVectors::DIRECTION,
      this->Vectors.MinusOnes.data(), RadiosityVectors::IMAGE) ||
    !links->Dot(RadiosityVectors::DIRECTION, RadiosityVectors::IMAGE, curvatures.data()))
  {
    return false;
  }
  for (std::size_t band = 0; band < steps.size(); ++band)
  {
    const bool idle = this->Squares[band] == 0.0;
    const bool positive = curvatures[band] > 0.0;
    this->Indefinite[band] = idle || positive ? 0.0 : 1.0;
    steps[band] = positive ? this->Squares[band] / curvatures[band] : 0.0;
  }
  return true;
}

//------------------------------------------------------------------------------
bool ConjugateGradients::Step()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  const std::size_t bands = this->Squares.size();
  RadiosityVectors::Bands steps(bands), back(bands), next(bands), ratios(bands);
  if (!this->ComputeSteps(steps) || this->IsIndefinite())
  {
    return this->IsIndefinite();
  }
  std::transform(steps.begin(), steps.end(), back.begin(), std::negate<double>());
  if (!links->Combine(RadiosityVectors::UNKNOWN, ones, RadiosityVectors::UNKNOWN, steps.data(),
        RadiosityVectors::DIRECTION) ||
    !links->Combine(RadiosityVectors::GRADIENT, ones, RadiosityVectors::GRADIENT, back.data(),
      RadiosityVectors::IMAGE) ||
    !links->Dot(RadiosityVectors::GRADIENT, RadiosityVectors::GRADIENT, next.data()))
  {
    return false;
  }
  for (std::size_t band = 0; band < bands; ++band)
  {
    ratios[band] = this->Squares[band] > 0.0 ? next[band] / this->Squares[band] : 0.0;
  }
  this->Squares = next;
  return links->Combine(RadiosityVectors::DIRECTION, ones, RadiosityVectors::GRADIENT,
           ratios.data(), RadiosityVectors::DIRECTION) &&
    this->Translate();
}

//------------------------------------------------------------------------------
bool ConjugateGradients::IsIndefinite() const
{
  return std::any_of(this->Indefinite.begin(), this->Indefinite.end(),
    [](double band) { return band > 0.0; });
}

//------------------------------------------------------------------------------
bool ConjugateGradients::GetIndefiniteDirection(double* direction)
{
  vtkLinkOperator* links = this->Vectors.Links;
  return links->Scale(RadiosityVectors::SCRATCH, RadiosityVectors::SYMMETRIC,
           RadiosityVectors::DIRECTION) &&
    links->Combine(RadiosityVectors::SCRATCH, this->Indefinite.data(), RadiosityVectors::SCRATCH,
      this->Vectors.Zeros.data(), RadiosityVectors::SCRATCH) &&
    links->GetVector(RadiosityVectors::SCRATCH, direction);
}

//------------------------------------------------------------------------------
// B = E + s y, and its residual s r.
bool ConjugateGradients::Translate()
{
  vtkLinkOperator* links = this->Vectors.Links;
  const double* ones = this->Vectors.Ones.data();
  return links->Scale(RadiosityVectors::SOLUTION, RadiosityVectors::SYMMETRIC,
           RadiosityVectors::UNKNOWN) &&
    links->Combine(RadiosityVectors::SOLUTION, ones, RadiosityVectors::SOURCE, ones,
      RadiosityVectors::SOLUTION) &&
    links->Scale(RadiosityVectors::RESIDUAL, RadiosityVectors::SYMMETRIC,
      RadiosityVectors::GRADIENT);
}
} // namespace LightTransport
