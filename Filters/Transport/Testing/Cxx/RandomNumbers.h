// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Random numbers that are the same on every platform, for tests.
#ifndef RandomNumbers_h
#define RandomNumbers_h

#include <Eigen/Geometry>

#include <cmath>
#include <cstdint>
#include <vector>

namespace LightTransportTesting
{
using Vector = Eigen::Vector3d;
using Corners = std::vector<Vector>;

//------------------------------------------------------------------------------
/// Bits that have nothing to do with each other for numbers that follow each other.
inline std::uint64_t MixBits(std::uint64_t bits)
{
  bits = (bits ^ bits >> 30) * 0xBF58476D1CE4E5B9ull;
  bits = (bits ^ bits >> 27) * 0x94D049BB133111EBull;
  return bits ^ bits >> 31;
}

//------------------------------------------------------------------------------
class Random
{
public:
  explicit Random(std::uint64_t seed) : State(seed) {}
  double Uniform(double low = 0.0, double high = 1.0)
  {
    this->State = this->State * 6364136223846793005ull + 1442695040888963407ull;
    const auto bits =
      static_cast<double>((this->State ^ this->State >> 29) >> 11 & 0xFFFFFFFFFFull);
    return low + (high - low) * bits / static_cast<double>(0x10000000000ull);
  }
  /// 0 to count - 1.
  int Index(int count) { return static_cast<int>(this->Uniform(0.0, count)); }
  /// Between two numbers above 0, each order of magnitude alike.
  double Scale(double low, double high) { return low * std::pow(high / low, this->Uniform()); }
  bool Chance(double share) { return this->Uniform() < share; }
  Vector Point(double size = 1.0)
  {
    const double x = this->Uniform(-size, size), y = this->Uniform(-size, size);
    return { x, y, this->Uniform(-size, size) };
  }
  Corners Triangle(const Vector& middle, double size)
  {
    const Vector a = this->Point(size), b = this->Point(size), c = this->Point(size);
    return { middle + a, middle + b, middle + c };
  }
  Eigen::Matrix3d Rotation()
  {
    const Vector axis = this->Point().normalized();
    return Eigen::AngleAxisd(this->Uniform(0.0, 6.0), axis).toRotationMatrix();
  }

private:
  std::uint64_t State;
};
} // namespace LightTransportTesting

#endif
