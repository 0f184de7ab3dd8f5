// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Deterministic, well spread sample points in up to four dimensions: Sobol' points (direction
 * numbers of Joe and Kuo, 2008) with their digits flipped by a hash, so that different pairs or
 * patches do not repeat each other's errors. The first 2^k points fill space evenly for every k.
 * The same key and index give the same point, on any thread.
 */
#ifndef PatchSampler_h
#define PatchSampler_h

#include "Geometry/Polygon.h"
#include "Support/SplitMix.h"
#include "vtkMath.h"

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>

namespace LightTransport
{
class PatchSampler
{
public:
  explicit PatchSampler(std::uint64_t key)
  {
    SplitMix bits(key);
    for (std::uint32_t& flips : this->Flips)
    {
      flips = bits.GetNextHalf();
    }
  }

  /// Coordinate `dimension` (0 to 3) of point `index`, in (0, 1).
  double Get(int index, int dimension) const
  {
    return ((this->Flips[dimension] ^ GetDigits(index, dimension)) + 0.5) * 0x1.0p-32;
  }

  /// Coordinate `dimension` of Sobol's point `index`, as binary digits, none of them flipped.
  static std::uint32_t GetDigits(int index, int dimension)
  {
    std::uint32_t digits = 0;
    const std::uint32_t* direction = GetDirections().Numbers[dimension];
    for (auto bits = static_cast<std::uint32_t>(index); bits != 0; bits >>= 1, ++direction)
    {
      digits ^= bits & 1u ? *direction : 0u;
    }
    return digits;
  }

  /// A uniformly distributed point of a polygon, from dimensions `first` and `first` + 1 of point
  /// `index`.
  Polygon::Vector GetPoint(const Polygon& polygon, int index, int first) const
  {
    double u = this->Get(index, first);
    double v = this->Get(index, first + 1);
    const Polygon::Vector& origin = polygon.Corners[0];
    if (IsParallelogram(polygon))
    {
      return origin + u * (polygon.Corners[1] - origin) + v * (polygon.Corners[3] - origin);
    }
    const int corner = polygon.Count > 3 ? ChooseTriangle(polygon, u) : 1;
    if (u + v > 1.0)
    {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    return origin + u * (polygon.Corners[corner] - origin) +
      v * (polygon.Corners[corner + 1] - origin);
  }

  /// A unit vector around a normal, even in projected (cosine-weighted) solid angle.
  Polygon::Vector GetDirection(const Polygon::Vector& normal, int index, int first) const
  {
    const double squared = this->Get(index, first);
    const double angle = 2.0 * vtkMath::Pi() * this->Get(index, first + 1);
    const Polygon::Vector tangent = normal.unitOrthogonal();
    return std::sqrt(squared) *
      (std::cos(angle) * tangent + std::sin(angle) * normal.cross(tangent)) +
      std::sqrt(1.0 - squared) * normal;
  }

private:
  // The most frequent polygon besides triangles; on it the points stay as even as they are in the
  // unit square.
  static bool IsParallelogram(const Polygon& polygon)
  {
    if (polygon.Count != 4)
    {
      return false;
    }
    const auto& corners = polygon.Corners;
    return (corners[0] - corners[1] + corners[2] - corners[3]).norm() <=
      1e-9 * (corners[2] - corners[0]).norm();
  }

  // A triangle of the fan by its share of the area; u is stretched so that it is uniform within it.
  static int ChooseTriangle(const Polygon& polygon, double& u)
  {
    const auto getTwiceArea = [&](int corner)
    {
      const Polygon::Vector a = polygon.Corners[corner] - polygon.Corners[0];
      const Polygon::Vector b = polygon.Corners[corner + 1] - polygon.Corners[0];
      return a.cross(b).dot(polygon.Normal);
    };
    const int last = polygon.Count - 2;
    double left = 0.0;
    for (int corner = 1; corner <= last; ++corner)
    {
      left += getTwiceArea(corner);
    }
    left *= u;
    for (int corner = 1;; ++corner)
    {
      const double area = getTwiceArea(corner);
      if (left < area || corner == last)
      {
        u = area > 0.0 ? std::fmin(left / area, 1.0) : 0.0;
        return corner;
      }
      left -= area;
    }
  }

  struct Directions
  {
    std::uint32_t Numbers[4][32];

    Directions()
    {
      // Degree and inner coefficients of the primitive polynomials, and the first odd numbers.
      constexpr int degrees[4] = { 0, 1, 2, 3 };
      constexpr std::uint32_t coefficients[4] = { 0, 0, 1, 1 };
      constexpr std::uint32_t first[4][3] = { {}, { 1 }, { 1, 3 }, { 1, 3, 1 } };
      for (int bit = 0; bit < 32; ++bit)
      {
        this->Numbers[0][bit] = 1u << (31 - bit);
      }
      for (int dimension = 1; dimension < 4; ++dimension)
      {
        const int degree = degrees[dimension];
        std::uint32_t* numbers = this->Numbers[dimension];
        for (int bit = 0; bit < 32; ++bit)
        {
          if (bit < degree)
          {
            numbers[bit] = first[dimension][bit] << (31 - bit);
            continue;
          }
          numbers[bit] = numbers[bit - degree] ^ (numbers[bit - degree] >> degree);
          for (int k = 1; k < degree; ++k)
          {
            const bool used = (coefficients[dimension] >> (degree - 1 - k)) & 1u;
            numbers[bit] ^= used ? numbers[bit - k] : 0u;
          }
        }
      }
    }
  };

  static const Directions& GetDirections()
  {
    static const Directions directions;
    return directions;
  }

  std::uint32_t Flips[4];
};

/// Owen's scrambling of numbers by a hash: each binary digit is flipped or not by those before it
/// (B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9, 2020; S. Laine, T. Karras,
/// "Stratified Sampling for Stochastic Transparency", EGSR 2011). What shares its first digits
/// still does.
namespace OwenScrambling
{
/// The digits from the last to the first.
inline std::uint32_t Reverse(std::uint32_t bits)
{
  bits = (bits >> 16) | (bits << 16);
  bits = ((bits & 0xFF00FF00u) >> 8) | ((bits & 0x00FF00FFu) << 8);
  bits = ((bits & 0xF0F0F0F0u) >> 4) | ((bits & 0x0F0F0F0Fu) << 4);
  bits = ((bits & 0xCCCCCCCCu) >> 2) | ((bits & 0x33333333u) << 2);
  return ((bits & 0xAAAAAAAAu) >> 1) | ((bits & 0x55555555u) << 1);
}

/// Of digits in reverse order, which it leaves so.
inline std::uint32_t ScrambleReversed(std::uint32_t bits, std::uint32_t seed)
{
  bits += seed;
  bits ^= bits * 0x6C50B47Cu;
  bits ^= bits * 0xB82F1E52u;
  bits ^= bits * 0xC7AFE638u;
  bits ^= bits * 0x8D22F6E6u;
  return bits;
}
} // namespace OwenScrambling

/// Points of a PatchSampler with the same key in another order, so that both together are points in
/// more dimensions: every 2^k that follow each other are a permutation of some that do.
class ShuffledSampler
{
public:
  explicit ShuffledSampler(std::uint64_t key)
    : Sampler(~key), Seed(static_cast<std::uint32_t>(key * 0x9E3779B9u + 0x85EBCA6Bu))
  {
  }

  /// Coordinate `dimension` (0 to 3) of point `index`, in (0, 1).
  double Get(int index, int dimension) const
  {
    return this->Sampler.Get(static_cast<int>(this->Shuffle(index)), dimension);
  }

private:
  std::uint32_t Shuffle(int index) const
  {
    using namespace OwenScrambling;
    return Reverse(ScrambleReversed(Reverse(static_cast<std::uint32_t>(index)), this->Seed));
  }

  PatchSampler Sampler;
  std::uint32_t Seed;
};
} // namespace LightTransport

#endif
