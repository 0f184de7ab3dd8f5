// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Functions of distance, one of each band, tabulated over the squared distance d^2: parabolas
 * between so many values per octave of d^2 + core^2, which is what all within the core has in
 * common. The top bits of a float are the piece, the rest is the place in it.
 */
#ifndef RadialTable_h
#define RadialTable_h

#include <Eigen/Core>

#include <cstdint>
#include <cstring>
#include <functional>
#include <vector>

namespace LightTransport
{
class RadialTable
{
public:
  static constexpr int NumberOfBands = 3;
  static constexpr int MantissaBits = 23;
  /// 2^6 pieces per octave.
  static constexpr int PieceBits = 6;
  /// One value per band; the fourth is padding and stays 0.
  using Lane = Eigen::Array4f;
  /// Asked from the centre outwards, at the end of one piece and at the beginning of the next.
  using Function = std::function<double(int band, double squaredDistance)>;

  /// A parabola in its local coordinate, all bands at a time.
  struct Piece
  {
    Lane Coefficients[3];
  };

  RadialTable() = default;
  /// Up to a distance. Values below 1e-30 become 0.
  RadialTable(double squaredCore, double maximumDistance, const Function& function);

  /// Where in the table a squared distance is: the same place of all tables of the same core.
  struct Place
  {
    std::uint32_t Index;
    float At;     ///< 0 to 1
    float Length; ///< of the piece
  };
  Place Find(double squaredDistance) const
  {
    const std::uint32_t bits = BitsOf(static_cast<float>(squaredDistance + this->SquaredCore));
    constexpr std::uint32_t mask = (1u << PlaceBits) - 1u;
    constexpr std::uint32_t exponent = ~((1u << MantissaBits) - 1u);
    return { (bits >> PlaceBits) - this->FirstPiece,
      static_cast<float>(bits & mask) * (1.0f / (1u << PlaceBits)),
      FloatOf(bits & exponent) * (1.0f / (1u << PieceBits)) };
  }
  Lane Evaluate(const Place& place) const
  {
    const Lane* const c = this->Pieces[place.Index].Coefficients;
    return c[0] + place.At * (c[1] + place.At * c[2]);
  }
  Lane Evaluate(double squaredDistance) const
  {
    return this->Evaluate(this->Find(squaredDistance));
  }
  /// The derivative by the squared distance.
  Lane GetDerivative(const Place& place) const
  {
    const Lane* const c = this->Pieces[place.Index].Coefficients;
    return (c[1] + 2.0f * place.At * c[2]) / place.Length;
  }

  const std::vector<Piece>& GetPieces() const { return this->Pieces; }
  std::uint32_t GetFirstPiece() const { return this->FirstPiece; }
  /// Rounded to the beginning of a piece.
  double GetSquaredCore() const { return this->SquaredCore; }

private:
  static constexpr int PlaceBits = MantissaBits - PieceBits;

  static std::uint32_t BitsOf(float value)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    return bits;
  }
  static float FloatOf(std::uint32_t bits)
  {
    float value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  double SquaredCore = 0.0;
  std::uint32_t FirstPiece = 0;
  std::vector<Piece> Pieces;
};
} // namespace LightTransport

#endif
