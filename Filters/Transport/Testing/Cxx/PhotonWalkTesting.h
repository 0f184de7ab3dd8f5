// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What tests of photon walks share: sums of what leaves, and how far they are from what they
/// should be.
#ifndef PhotonWalkTesting_h
#define PhotonWalkTesting_h

#include "LightTransportTesting.h"
#include "Photons/PhotonListener.h"
#include "Shared/Fresnel.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace LightTransportTesting
{
constexpr int Seeds = 20;
constexpr int PhotonsPerSeed = 4000;
// Deviations that one of a few hundred comparisons exceeds by chance with 1 %.
constexpr double MostDeviations = 4.0;

//------------------------------------------------------------------------------
/// What leaves patch 0 and patch 1, and unscattered through anywhere, of up to three bands.
class Sums : public LightTransport::PhotonListener
{
public:
  double Left[2][3] = {};
  double Squares[2][3] = {};
  double Unscattered[3] = {};
  double Lost = 0.0;

  void Leave(vtkIdType patch, const Eigen::Vector3d&, const double* weights) override
  {
    for (int band = 0; band < this->Bands; ++band)
    {
      this->Left[patch != 0][band] += weights[band];
      this->Squares[patch != 0][band] += weights[band] * weights[band];
    }
  }
  void Escape(bool isScattered, const double* weights) override
  {
    for (int band = 0; band < this->Bands && !isScattered; ++band)
    {
      this->Unscattered[band] += weights[band];
    }
  }
  void Lose(const Eigen::Vector3d&, const double* weights) override { this->Lost += weights[0]; }

  explicit Sums(int bands) : Bands(bands) {}

private:
  int Bands;
};

//------------------------------------------------------------------------------
struct Light
{
  bool IsDiffuse; ///< or along the normal
  double Index;

  /// Of what falls on the surface.
  double GetEntering() const
  {
    return 1.0 -
      (this->IsDiffuse ? LightTransport::Fresnel::GetMeanExternalReflectance(this->Index)
                       : LightTransport::Fresnel::GetReflectance(1.0, this->Index));
  }
};

//------------------------------------------------------------------------------
/// How far the means of seeds are from what they should be, in their own standard errors: these
/// must be standard normal, else the errors or the means are wrong.
class Deviations
{
public:
  void Add(double sum, double squares, int photons, double expected)
  {
    const double mean = sum / photons;
    const double error = std::sqrt(std::max(squares / photons - mean * mean, 0.0) / photons);
    if (error == 0.0)
    {
      CheckClose(mean, expected, 1e-5, "what is the same in all walks");
      return;
    }
    this->AddMean(mean, error, expected);
  }
  void AddMean(double mean, double error, double expected)
  {
    const double deviation = (mean - expected) / error;
    this->Sum += deviation;
    this->Squares += deviation * deviation;
    ++this->Count;
  }
  void CheckNormal(const std::string& what) const
  {
    if (this->Count == 0)
    {
      return;
    }
    const double mean = this->Sum / std::sqrt(double(this->Count));
    Check(std::abs(mean) < MostDeviations,
      what + " is off by " + std::to_string(mean) + " standard errors");
    // Wilson and Hilferty: the cube root of chi square is about normal.
    const double spread = 2.0 / (9.0 * this->Count);
    const double chi =
      (std::cbrt(this->Squares / this->Count) - (1.0 - spread)) / std::sqrt(spread);
    Check(std::abs(chi) < MostDeviations,
      what + " varies " + std::to_string(this->Squares / this->Count) +
        " times as much as its errors say");
  }

private:
  double Sum = 0.0;
  double Squares = 0.0;
  int Count = 0;
};
} // namespace LightTransportTesting

#endif
