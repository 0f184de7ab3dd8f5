// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors counted by brute force, in double precision and apart from all geometry of the
 * filters: random points of a polygon, and from each the first polygon met along half-planes.
 *
 * A ray from a random point in a direction of density cos / pi, of which the point, the half-plane
 * (one of those around an axis in the polygon) and the angle in it are independent. The angle is
 * not drawn: what is met along a whole half-plane is found by looking at all triangles, so that
 * each sample counts all directions in it exactly. Half-planes are drawn evenly in angle and
 * weighted by their cosine, so that what is seen near the horizon is met often. (With 1 / y over x
 * / y as coordinates triangles are straight pieces in the half-plane, and the nearest is the
 * highest of them.) The three other numbers are a scrambled Sobol sequence; independent scramblings
 * tell the standard error.
 *
 * Surfaces in one place: what a ray meets within the worth of coordinates of the nearest is one
 * place, measured across the surfaces. Of several there the ray meets one that faces it, of those
 * that of the lowest number. What lies in the place where a ray starts is not met: surfaces within
 * that worth of its start, hit within that worth of the plane that it leaves.
 */
#ifndef BruteForce_h
#define BruteForce_h

#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace LightTransportTesting
{
//------------------------------------------------------------------------------
/// Three-dimensional Sobol sequences scrambled in independent ways (Owen 1995: each binary digit is
/// turned depending on those before it).
class ScrambledSobol
{
public:
  static constexpr int Scramblings = 16;
  static constexpr int Points = 1 << 12;
  using Digits = std::array<std::uint32_t, 3>;

  static const Digits& Get(int scrambling, int point)
  {
    static const std::vector<Digits> all = ScrambledSobol::MakeAll();
    return all[static_cast<std::size_t>(scrambling) * Points + point];
  }

private:
  static Digits Sobol(int point)
  {
    // The directions of the polynomials 1, x + 1 and x^2 + x + 1 with the first numbers 1, and
    // 1, 3.
    Digits digits = { 0, 0, 0 };
    std::uint32_t directions[3][32];
    for (int bit = 0; bit < 32; ++bit)
    {
      auto& [first, second, third] = directions;
      first[bit] = 1u << (31 - bit);
      second[bit] = bit == 0 ? 1u << 31 : second[bit - 1] ^ second[bit - 1] >> 1;
      third[bit] = bit == 0 ? 1u << 31
        : bit == 1          ? 3u << 30
                            : third[bit - 1] ^ third[bit - 2] ^ third[bit - 2] >> 2;
    }
    for (int bit = 0; bit < 32; ++bit)
    {
      for (int axis = 0; axis < 3 && (point >> bit & 1) != 0; ++axis)
      {
        digits[axis] ^= directions[axis][bit];
      }
    }
    return digits;
  }

  static std::uint32_t Scramble(std::uint32_t digits, std::uint64_t seed)
  {
    std::uint32_t scrambled = 0;
    for (int bit = 0; bit < 32; ++bit)
    {
      // The digits before this one, with a 1 in front, so that 01 and 1 differ.
      const std::uint64_t before = (1ull << bit) | (bit == 0 ? 0u : digits >> (32 - bit));
      const std::uint32_t turn = MixBits(seed + before * 0x9E3779B97F4A7C15ull) & 1u;
      scrambled |= ((digits >> (31 - bit) & 1u) ^ turn) << (31 - bit);
    }
    return scrambled;
  }

  static std::vector<Digits> MakeAll()
  {
    std::vector<Digits> all(static_cast<std::size_t>(Scramblings) * Points);
    for (int point = 0; point < Points; ++point)
    {
      const Digits digits = ScrambledSobol::Sobol(point);
      for (int k = 0; k < Scramblings; ++k)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          all[static_cast<std::size_t>(k) * Points + point][axis] =
            ScrambledSobol::Scramble(digits[axis], MixBits(3 * k + axis + 1));
        }
      }
    }
    return all;
  }
};

//------------------------------------------------------------------------------
/// Shares of a polygon's view with their standard errors; after the polygons the sky and back
/// faces.
struct BruteForceRow
{
  std::vector<double> Shares;
  std::vector<double> Errors;
  double Sum = 0.0;      ///< of all polygons
  double SumError = 0.0; ///< its standard error
  std::size_t GetSky() const { return this->Shares.size() - 2; }
  std::size_t GetBack() const { return this->Shares.size() - 1; }
};

//------------------------------------------------------------------------------
class BruteForce
{
public:
  /// The polygons as they are stored, convex, and the worth of their coordinates: surfaces nearer
  /// than that are in one place.
  BruteForce(const std::vector<Corners>& polygons, double worth);

  /// A row with standard errors of at most `error` (of each share and of the sum), or of the
  /// largest number of samples. The same seed gives the same row.
  BruteForceRow Count(std::size_t polygon, double error, std::uint64_t seed = 0) const;

  /// What coordinates are worth: what rounding to their type, after a calculation in double
  /// precision, may move two surfaces apart.
  static double GetWorth(const std::vector<Corners>& polygons, bool single);

private:
  struct Triangle
  {
    std::size_t Owner;
    Eigen::Index Corners[3]; ///< columns of Points
    Vector Normal;
    double Area;
  };
  /// Where a triangle crosses a half-plane: over x / y.
  struct Piece
  {
    double From, To;
    double Start, Slope;  ///< 1 / y = Start + Slope x / y
    double Across, Along; ///< normal times the ray x / y axis + e
    std::size_t Owner;
    bool Touching; ///< within the worth of coordinates of the start
    double Inverse(double t) const { return this->Start + this->Slope * t; }
    double Facing(double t) const { return this->Along + this->Across * t; }
  };
  struct Workspace
  {
    Eigen::RowVectorXd Heights; ///< of all points over the plane of the half-plane
    double Lift = 1.0;          ///< height over the start's plane per y
    std::vector<Piece> Pieces;
    std::vector<double> Breaks;
  };
  /// A ray's start and half-plane: x along Axis, y along Up.
  struct HalfPlane
  {
    Vector Origin, Axis, Up;
    double Lift; ///< height over the polygon per y, and the weight of the half-plane
    std::size_t Owner;
  };

  HalfPlane Draw(std::size_t polygon, const ScrambledSobol::Digits& digits) const;
  void Cut(const HalfPlane& half, const Triangle& triangle, Workspace& work) const;
  void FindBreaks(Workspace& work) const;
  bool IsMet(const Workspace& work, const Piece& piece, double t) const;
  std::size_t GetMet(const Workspace& work, double t) const;
  void Sweep(const HalfPlane& half, Workspace& work, std::vector<double>& sums) const;
  static double GetMiddle(double from, double to);
  static double GetShareBefore(double t);
  BruteForceRow Summarise(const std::vector<std::vector<double>>& sums, int samples) const;

  Eigen::Matrix3Xd Points;         ///< corners of all polygons
  std::vector<Triangle> Triangles; ///< in the order of their polygons
  std::vector<std::size_t> First;  ///< of each polygon; one more at the end
  std::size_t Sky = 0;             ///< number of the sky's column; that of back faces is one more
  double Worth = 0.0;
  double Nearest = 0.0; ///< y below which nothing is looked at
};

//------------------------------------------------------------------------------
inline double BruteForce::GetWorth(const std::vector<Corners>& polygons, bool single)
{
  double largest = 0.0;
  for (const Corners& polygon : polygons)
  {
    for (const Vector& corner : polygon)
    {
      largest = std::max(largest, corner.cwiseAbs().maxCoeff());
    }
  }
  return largest *
    (single ? 2.0 * std::numeric_limits<float>::epsilon()
            : 8.0 * std::numeric_limits<double>::epsilon());
}

//------------------------------------------------------------------------------
inline BruteForce::BruteForce(const std::vector<Corners>& polygons, double worth)
  : Sky(polygons.size()), Worth(worth)
{
  // Differences of coordinates are exact, products of large coordinates are not.
  const Vector& middle = polygons.front().front();
  for (std::size_t owner = 0; owner < polygons.size(); ++owner)
  {
    const Corners& polygon = polygons[owner];
    const Eigen::Index begin = this->Points.cols();
    this->Points.conservativeResize(3, begin + static_cast<Eigen::Index>(polygon.size()));
    for (std::size_t k = 0; k < polygon.size(); ++k)
    {
      this->Points.col(begin + static_cast<Eigen::Index>(k)) = polygon[k] - middle;
    }
    this->First.push_back(this->Triangles.size());
    for (Eigen::Index k = begin + 1; k + 1 < this->Points.cols(); ++k)
    {
      // Slivers lose digits of their normals.
      using Precise = Eigen::Matrix<long double, 3, 1>;
      const Precise from = this->Points.col(begin).cast<long double>();
      const Precise twice = (this->Points.col(k).cast<long double>() - from)
                              .cross(this->Points.col(k + 1).cast<long double>() - from);
      const auto area = static_cast<double>(0.5L * twice.norm());
      if (area > 0.0)
      {
        this->Triangles.push_back(
          { owner, { begin, k, k + 1 }, twice.normalized().cast<double>(), area });
      }
    }
  }
  this->First.push_back(this->Triangles.size());
  this->Nearest = 1e-13 * this->Points.cwiseAbs().maxCoeff();
}

//------------------------------------------------------------------------------
inline BruteForce::HalfPlane BruteForce::Draw(std::size_t polygon,
  const ScrambledSobol::Digits& digits) const
{
  const double unit = 1.0 / 4294967296.0;
  double place = (digits[0] + 0.5) * unit;
  const Triangle* triangle = &this->Triangles[this->First[polygon]];
  double area = 0.0;
  for (std::size_t k = this->First[polygon]; k < this->First[polygon + 1]; ++k)
  {
    area += this->Triangles[k].Area;
  }
  place *= area;
  for (; place > triangle->Area && triangle + 1 < &this->Triangles[0] + this->First[polygon + 1];
       ++triangle)
  {
    place -= triangle->Area;
  }
  const double across = std::sqrt(std::min(place / triangle->Area, 1.0));
  const double along = (digits[1] + 0.5) * unit;
  HalfPlane half;
  half.Owner = polygon;
  const Vector from = this->Points.col(triangle->Corners[0]);
  const Vector to = (1.0 - along) * this->Points.col(triangle->Corners[1]) +
    along * this->Points.col(triangle->Corners[2]);
  half.Origin = from + across * (to - from);
  // An axis that no edge is likely to be parallel to.
  const Vector& normal = triangle->Normal;
  half.Axis = normal.cross(Vector(0.5377, -0.2181, 0.8144));
  if (half.Axis.norm() < 0.1)
  {
    half.Axis = normal.cross(Vector(-0.2181, 0.8144, 0.5377));
  }
  half.Axis.normalize();
  const double angle = 3.14159265358979323846 * ((digits[2] + 0.5) * unit - 0.5);
  half.Lift = std::cos(angle);
  half.Up = half.Lift * normal + std::sin(angle) * normal.cross(half.Axis);
  return half;
}

//------------------------------------------------------------------------------
inline void BruteForce::Cut(const HalfPlane& half, const Triangle& triangle, Workspace& work) const
{
  Vector ends[2];
  int found = 0;
  for (int k = 0; k < 3 && found < 2; ++k)
  {
    const Eigen::Index here = triangle.Corners[k];
    const Eigen::Index next = triangle.Corners[(k + 1) % 3];
    const double height = work.Heights[here];
    const double nextHeight = work.Heights[next];
    if ((height > 0.0) != (nextHeight > 0.0))
    {
      ends[found++] = this->Points.col(here) - half.Origin +
        height / (height - nextHeight) * (this->Points.col(next) - this->Points.col(here));
    }
  }
  const double distance =
    found < 2 ? 0.0 : (this->Points.col(triangle.Corners[0]) - half.Origin).dot(triangle.Normal);
  if (distance == 0.0)
  {
    return; // not crossed, or seen from its edge
  }
  double y[2] = { ends[0].dot(half.Up), ends[1].dot(half.Up) };
  double x[2] = { ends[0].dot(half.Axis), ends[1].dot(half.Axis) };
  if (std::max(y[0], y[1]) <= this->Nearest)
  {
    return;
  }
  for (int k = 0; k < 2; ++k)
  {
    if (y[k] < this->Nearest)
    {
      x[k] += (this->Nearest - y[k]) / (y[1 - k] - y[k]) * (x[1 - k] - x[k]);
      y[k] = this->Nearest;
    }
  }
  Piece piece;
  piece.Owner = triangle.Owner;
  piece.Touching = std::abs(distance) <= this->Worth;
  piece.From = std::min(x[0] / y[0], x[1] / y[1]);
  piece.To = std::max(x[0] / y[0], x[1] / y[1]);
  piece.Across = triangle.Normal.dot(half.Axis);
  piece.Along = triangle.Normal.dot(half.Up);
  piece.Start = piece.Along / distance;
  piece.Slope = piece.Across / distance;
  work.Pieces.push_back(piece);
}

//------------------------------------------------------------------------------
// Between these the same piece is the nearest: ends of pieces, and where they cross.
inline void BruteForce::FindBreaks(Workspace& work) const
{
  work.Breaks.clear();
  for (std::size_t k = 0; k < work.Pieces.size(); ++k)
  {
    const Piece& piece = work.Pieces[k];
    work.Breaks.push_back(piece.From);
    work.Breaks.push_back(piece.To);
    if (piece.Touching && piece.Slope != 0.0)
    {
      // Where its height over the start's plane is the worth of coordinates.
      const double t = (work.Lift / this->Worth - piece.Start) / piece.Slope;
      work.Breaks.push_back(std::clamp(t, piece.From, piece.To));
    }
    for (std::size_t l = 0; l < k; ++l)
    {
      const Piece& other = work.Pieces[l];
      const double low = std::max(piece.From, other.From);
      const double high = std::min(piece.To, other.To);
      const double before = piece.Inverse(low) - other.Inverse(low);
      const double after = piece.Inverse(high) - other.Inverse(high);
      if (low < high && before * after < 0.0)
      {
        work.Breaks.push_back(low + before / (before - after) * (high - low));
      }
    }
  }
  std::sort(work.Breaks.begin(), work.Breaks.end());
}

//------------------------------------------------------------------------------
/// Whether a ray hits a piece elsewhere than in the place where it starts.
inline bool BruteForce::IsMet(const Workspace& work, const Piece& piece, double t) const
{
  const double inverse = piece.Inverse(t);
  return t >= piece.From && t <= piece.To && inverse > 0.0 &&
    !(piece.Touching && work.Lift <= this->Worth * inverse);
}

//------------------------------------------------------------------------------
inline std::size_t BruteForce::GetMet(const Workspace& work, double t) const
{
  const Piece* nearest = nullptr;
  double largest = 0.0;
  for (const Piece& piece : work.Pieces)
  {
    if (piece.Inverse(t) > largest && this->IsMet(work, piece, t))
    {
      largest = piece.Inverse(t);
      nearest = &piece;
    }
  }
  if (!nearest)
  {
    return this->Sky;
  }
  const double across = std::abs(nearest->Facing(t));
  std::size_t met = this->Sky + 1;
  for (const Piece& piece : work.Pieces)
  {
    const double inverse = piece.Inverse(t);
    if (piece.Facing(t) < 0.0 && this->IsMet(work, piece, t) &&
      (largest - inverse) * std::max(-piece.Facing(t), across) <= this->Worth * largest * inverse)
    {
      met = met == this->Sky + 1 ? piece.Owner : std::min(met, piece.Owner);
    }
  }
  return met;
}

//------------------------------------------------------------------------------
/// x / y half-way in angle: on the way to the horizon, where surfaces may come together, the mean
/// of two x / y would be almost there.
inline double BruteForce::GetMiddle(double from, double to)
{
  const double before = std::sqrt(1.0 + from * from);
  const double after = std::sqrt(1.0 + to * to);
  return (from * after + to * before) / (before + after);
}

//------------------------------------------------------------------------------
/// Share of the rays of a half-plane with x / y below a value (density 2 sin^2 of the angle / pi).
inline double BruteForce::GetShareBefore(double t)
{
  return 0.5 + (std::atan(t) + t / (1.0 + t * t)) / 3.14159265358979323846;
}

//------------------------------------------------------------------------------
inline void BruteForce::Sweep(const HalfPlane& half, Workspace& work,
  std::vector<double>& sums) const
{
  work.Pieces.clear();
  work.Lift = half.Lift;
  const Vector side = half.Axis.cross(half.Up);
  work.Heights.noalias() = side.transpose() * this->Points;
  work.Heights.array() -= side.dot(half.Origin);
  for (const Triangle& triangle : this->Triangles)
  {
    if (triangle.Owner != half.Owner)
    {
      this->Cut(half, triangle, work);
    }
  }
  this->FindBreaks(work);
  std::size_t current = this->Sky;
  double begin = 0.0;
  for (std::size_t k = 0; k < work.Breaks.size(); ++k)
  {
    const bool last = k + 1 == work.Breaks.size();
    const std::size_t met = last
      ? this->Sky
      : this->GetMet(work, BruteForce::GetMiddle(work.Breaks[k], work.Breaks[k + 1]));
    if (met != current)
    {
      const double here = BruteForce::GetShareBefore(work.Breaks[k]);
      sums[current] += half.Lift * (here - begin);
      begin = here;
      current = met;
    }
  }
  sums[current] += half.Lift * (1.0 - begin);
}

//------------------------------------------------------------------------------
inline BruteForceRow BruteForce::Summarise(const std::vector<std::vector<double>>& sums,
  int samples) const
{
  const auto count = static_cast<double>(sums.size());
  std::vector<double> weights;
  for (const std::vector<double>& sum : sums)
  {
    weights.push_back(std::accumulate(sum.begin(), sum.end(), 0.0));
  }
  const auto measure = [&](const auto& get, double& mean, double& error)
  {
    double first = 0.0, second = 0.0;
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      first += get(sums[k]) / weights[k] / count;
    }
    for (std::size_t k = 0; k < sums.size(); ++k)
    {
      second += std::pow(get(sums[k]) / weights[k] - first, 2);
    }
    mean = first;
    // What no sample has met is as large as this at times.
    error = std::sqrt(second / (count * (count - 1.0))) + 0.1 / (count * samples);
  };
  BruteForceRow row;
  row.Shares.resize(this->Sky + 2);
  row.Errors.resize(this->Sky + 2);
  for (std::size_t k = 0; k < row.Shares.size(); ++k)
  {
    measure([k](const std::vector<double>& sum) { return sum[k]; }, row.Shares[k], row.Errors[k]);
  }
  measure([](const std::vector<double>& sum)
    { return std::accumulate(sum.begin(), sum.end() - 2, 0.0); },
    row.Sum, row.SumError);
  return row;
}

//------------------------------------------------------------------------------
inline BruteForceRow BruteForce::Count(std::size_t polygon, double error, std::uint64_t seed) const
{
  std::vector<std::vector<double>> sums(ScrambledSobol::Scramblings,
    std::vector<double>(this->Sky + 2, 0.0));
  Workspace work;
  BruteForceRow row;
  int done = 0;
  for (int samples = 64; samples <= ScrambledSobol::Points; samples *= 2)
  {
    for (int k = 0; k < ScrambledSobol::Scramblings; ++k)
    {
      for (int point = done; point < samples; ++point)
      {
        ScrambledSobol::Digits digits = ScrambledSobol::Get(k, point);
        for (int axis = 0; axis < 3; ++axis)
        {
          digits[axis] ^= static_cast<std::uint32_t>(
            MixBits(MixBits(seed + 1) + 97 * polygon + 7 * (3 * k + axis) + 1) >> 32);
        }
        this->Sweep(this->Draw(polygon, digits), work, sums[k]);
      }
    }
    done = samples;
    row = this->Summarise(sums, samples);
    if (row.SumError <= error && *std::max_element(row.Errors.begin(), row.Errors.end()) <= error)
    {
      break;
    }
  }
  return row;
}
} // namespace LightTransportTesting

#endif
