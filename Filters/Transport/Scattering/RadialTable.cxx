// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/RadialTable.h"

#include <algorithm>
#include <cstddef>

namespace LightTransport
{
namespace
{
/// Above the longest distance, for rounding.
constexpr double Margin = 1.01;
/// What is smaller counts as nothing: denormal numbers would be slow.
constexpr double SmallestValue = 1e-30;
} // namespace

//------------------------------------------------------------------------------
RadialTable::RadialTable(double squaredCore, double maximumDistance, const Function& function)
{
  const auto pieceOf = [](double value) { return BitsOf(static_cast<float>(value)) >> PlaceBits; };
  this->FirstPiece = pieceOf(squaredCore);
  // The table starts at the beginning of a piece, so that no piece reaches below distance zero.
  this->SquaredCore = FloatOf(this->FirstPiece << PlaceBits);
  const std::uint32_t lastPiece =
    pieceOf(Margin * (maximumDistance * maximumDistance + this->SquaredCore)) + 1;
  this->Pieces.resize(lastPiece - this->FirstPiece + 1);
  for (std::size_t i = 0; i < this->Pieces.size(); ++i)
  {
    const std::uint32_t bits = static_cast<std::uint32_t>(i + this->FirstPiece) << PlaceBits;
    const double begin = FloatOf(bits);
    const double length = FloatOf(bits + (1u << PlaceBits)) - begin;
    Lane* const coefficients = this->Pieces[i].Coefficients;
    std::fill_n(coefficients, 3, Lane::Zero());
    for (int band = 0; band < NumberOfBands; ++band)
    {
      double values[3];
      for (int k = 0; k < 3; ++k)
      {
        const double value = function(band, begin + 0.5 * k * length - this->SquaredCore);
        values[k] = value > SmallestValue ? value : 0.0;
      }
      coefficients[0][band] = static_cast<float>(values[0]);
      coefficients[1][band] = static_cast<float>(4.0 * values[1] - 3.0 * values[0] - values[2]);
      coefficients[2][band] = static_cast<float>(2.0 * (values[0] + values[2] - 2.0 * values[1]));
    }
  }
}
} // namespace LightTransport
