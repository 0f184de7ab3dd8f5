// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/HalfSpaceTable.h"

#include "Photons/FlatBoundaries.h"
#include "Photons/PhotonUnits.h"
#include "Photons/PhotonWalk.h"
#include "Photons/UniformPath.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "vtkMath.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <deque>
#include <mutex>
#include <tuple>
#include <utility>

namespace LightTransport
{
namespace
{
///@{ Rings, over the logarithm of the radius: 8 for a factor e, from exp(-9) to exp(8).
constexpr int RingsPerUnit = 8;
constexpr double FirstLogarithm = -9.0;
constexpr int NumberOfRings = RingsPerUnit * 17;
constexpr int PointsPerRing = 4;
///@}

// Where the shape turns from 1/r to 1/r^3.
constexpr double Turn = 3.0;
// Of photons that would count as much if all weighed the same: a ring with fewer is not looked at.
constexpr double FewestPhotons = 30.0;
///@{ Penalties of the spline, as inverse squares of what differences of its controls are about.
/// Third ones keep it smooth, first ones make it go on as a constant where hardly any photons are,
/// and near the centre, where it changes in proportion to the radius in mean free paths.
constexpr double SmoothPenalty = 2.5e5;
constexpr double LevelPenalty = 100.0;
constexpr double CentrePenalty = 2.0;
///@}

///@{ Scatterings that a walk may have in all, and what a photon costs beside.
constexpr double MostWork = 5e7;
constexpr double WorkPerPhoton = 10.0;
///@}
constexpr long long PhotonsPerTurn = 64;
///@{ Between two looks at the work.
constexpr double WorkPerLook = 4e6;
constexpr long long FirstPhotons = 512;
///@}
// Moments of the angle in which the decay is sought.
constexpr int NumberOfMoments = 128;

constexpr std::size_t MostTables = 64;

/// What is kept, of the whole process.
struct Shelf
{
  std::mutex Mutex;
  std::deque<std::pair<HalfSpaceTable::Settings, std::shared_ptr<const HalfSpaceTable>>> Tables;
};

//------------------------------------------------------------------------------
Shelf& GetShelf()
{
  static Shelf shelf;
  return shelf;
}

//------------------------------------------------------------------------------
double GetFall(double x)
{
  return (1.0 + x) * std::exp(-x);
}

//------------------------------------------------------------------------------
double GetRadius(double position)
{
  return std::exp(FirstLogarithm + position / RingsPerUnit);
}

//------------------------------------------------------------------------------
PhotonMedium MakeMedium(double absorption, double anisotropy)
{
  return { (1.0 - absorption) / (1.0 - anisotropy), absorption, anisotropy };
}

//------------------------------------------------------------------------------
bool operator==(const HalfSpaceTable::Settings& a, const HalfSpaceTable::Settings& b)
{
  const auto tie = [](const HalfSpaceTable::Settings& s)
  {
    return std::tie(s.Albedo, s.RefractiveIndex, s.Anisotropy, s.NumberOfPhotons, s.Seed,
      s.IsNormal);
  };
  return tie(a) == tie(b);
}
} // namespace

//------------------------------------------------------------------------------
/// What left through each ring, and the squares of what each photon did. In whole numbers of a
/// small unit, so that sums are the same in whichever order photons come.
class HalfSpaceTable::Rings : public PhotonListener
{
public:
  PhotonWalk::Counts Counts;

  Rings() : Left(NumberOfRings, 0), Squares(NumberOfRings, 0) {}

  /// Of all ranks.
  double GetScatterings(const Ranks& ranks) const
  {
    auto scatterings = static_cast<double>(this->Counts.Scatterings);
    ranks.Sum(&scatterings, 1);
    return scatterings;
  }

  void Leave(vtkIdType, const Eigen::Vector3d& position, const double* weights) override
  {
    const double radius = std::hypot(position.x(), position.y());
    const double ring = RingsPerUnit * (std::log(radius) - FirstLogarithm);
    const int k = static_cast<int>(std::clamp(ring, 0.0, NumberOfRings - 1.0));
    this->Left[k] += PhotonUnits::Count(weights[0]);
    this->Squares[k] += PhotonUnits::Count(weights[0] * weights[0]);
  }
  void Escape(bool, const double*) override {}
  void Lose(const Eigen::Vector3d&, const double*) override {}

  void Add(const Rings& other)
  {
    for (int k = 0; k < NumberOfRings; ++k)
    {
      this->Left[k] += other.Left[k];
      this->Squares[k] += other.Squares[k];
    }
    this->Counts.Add(other.Counts);
  }
  void Sum(const Ranks& ranks)
  {
    ranks.Sum(this->Left);
    ranks.Sum(this->Squares);
  }

  double GetLeft(int ring) const { return double(this->Left[ring]) / PhotonUnits::PerPhoton; }
  double GetSquares(int ring) const { return double(this->Squares[ring]) / PhotonUnits::PerPhoton; }

private:
  // The type that ranks exchange.
  std::vector<vtkIdType> Left;
  std::vector<vtkIdType> Squares;
};

//------------------------------------------------------------------------------
HalfSpaceTable::HalfSpaceTable(const Settings& settings, const Ranks& ranks)
  : Controls(NumberOfRings, 0.0)
{
  const double absorption = std::max(1.0 - settings.Albedo, LeastAbsorption);
  const double decay = GetDecay(absorption, settings.Anisotropy);
  const HalfSpaceBoundary boundary;
  const PhotonMedium medium = MakeMedium(absorption, settings.Anisotropy);
  const PhotonWalk walk(boundary, settings.RefractiveIndex, settings.Anisotropy);
  const UniformBands bands({ medium });
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Rings all;
  std::mutex mutex;
  const auto follow = [&](vtkIdType begin, vtkIdType end)
  {
    Rings rings;
    for (vtkIdType k = begin; k < end; ++k)
    {
      if (k / PhotonsPerTurn % ranks.GetNumber() != ranks.GetMine())
      {
        continue;
      }
      Pulse::Beat();
      PhotonRandom random(settings.Seed, k);
      UniformPath path(bands, 0);
      const Eigen::Vector3d direction = settings.IsNormal ? -up : walk.Enter(up, random);
      walk.Follow({ Eigen::Vector3d::Zero(), direction, 0 }, true, path, random, rings,
        rings.Counts);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    all.Add(rings);
  };
  double scatterings = 0.0;
  const auto isDone = [&]()
  {
    return settings.NumberOfPhotons > 0 ? this->Photons >= settings.NumberOfPhotons
                                        : scatterings + WorkPerPhoton * this->Photons >= MostWork;
  };
  long long count = FirstPhotons;
  while (!isDone())
  {
    if (settings.NumberOfPhotons > 0)
    {
      count = std::min(count, settings.NumberOfPhotons - this->Photons);
    }
    Threads::For(this->Photons, this->Photons + count, PhotonsPerTurn, follow);
    this->Photons += count;
    scatterings = all.GetScatterings(ranks);
    const double work = WorkPerPhoton + scatterings / this->Photons;
    count = std::max(static_cast<long long>(WorkPerLook / work), PhotonsPerTurn);
  }
  all.Sum(ranks);
  this->Fit(all, medium.GetExtinction(), decay);
}

//------------------------------------------------------------------------------
void HalfSpaceTable::Fit(const Rings& rings, double extinction, double decay)
{
  std::vector<double> logarithms(NumberOfRings, 0.0);
  std::vector<double> weights(NumberOfRings, 0.0);
  double left = 0.0;
  double squares = 0.0;
  for (int ring = 0; ring < NumberOfRings; ++ring)
  {
    const double here = rings.GetLeft(ring);
    left += here;
    squares += rings.GetSquares(ring);
    const double photons = here > 0.0 ? here * here / rings.GetSquares(ring) : 0.0;
    if (photons >= FewestPhotons)
    {
      // With controls of 0 the sum is that of the shape.
      logarithms[ring] = std::log(here / (this->Photons * this->SumRing(ring, decay)));
      weights[ring] = photons;
    }
  }
  const double count = static_cast<double>(this->Photons);
  this->Error = left > 0.0 ? std::sqrt(std::max(squares - left * left / count, 0.0)) / left : 0.0;
  this->Smooth(logarithms, weights, extinction);
  this->LimitRise();
  // Within the first ring it goes like 1/r.
  const double first = GetRadius(0.0);
  double sum = 2.0 * vtkMath::Pi() * first * first * this->Evaluate(first, decay);
  for (int ring = 0; ring < NumberOfRings; ++ring)
  {
    sum += this->SumRing(ring, decay);
  }
  const double shift = std::log(left / count / sum);
  for (double& control : this->Controls)
  {
    control += shift;
  }
}

//------------------------------------------------------------------------------
// The smallest kappa for which light that falls like exp(-kappa z) keeps itself going: the inverse
// of the largest eigenvalue of the equations for the Legendre moments of its angles.
double HalfSpaceTable::GetDecay(double absorption, double anisotropy)
{
  if (absorption == 0.0)
  {
    return 0.0;
  }
  const PhotonMedium medium = MakeMedium(absorption, anisotropy);
  const auto lose = [&medium](int moment)
  {
    // Of the first one only what is absorbed, without a difference of almost equal numbers.
    const double loss = medium.Absorption +
      (moment > 0 ? medium.Scattering * (1.0 - std::pow(medium.Anisotropy, moment)) : 0.0);
    return (2.0 * moment + 1.0) * loss;
  };
  Eigen::VectorXd beside(NumberOfMoments - 1);
  for (int moment = 0; moment + 1 < NumberOfMoments; ++moment)
  {
    beside[moment] = (moment + 1.0) / std::sqrt(lose(moment) * lose(moment + 1));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::VectorXd::Zero(NumberOfMoments), beside,
    Eigen::EigenvaluesOnly);
  return 1.0 / solver.eigenvalues().maxCoeff();
}

//------------------------------------------------------------------------------
/// Where no control is it is that at the end.
double HalfSpaceTable::Interpolate(double position) const
{
  // Each control is in the middle of its ring.
  const double last = NumberOfRings - 1.0;
  const double place = std::clamp(position - 0.5, 0.0, last);
  const int i = std::min(static_cast<int>(place), NumberOfRings - 2);
  const double t = place - i;
  const double s = 1.0 - t;
  const double weights[4] = { s * s * s, 4.0 - 3.0 * t * t * (2.0 - t),
    4.0 - 3.0 * s * s * (2.0 - s), t * t * t };
  double sum = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    sum += weights[k] / 6.0 * this->Controls[std::clamp(i - 1 + k, 0, NumberOfRings - 1)];
  }
  return sum;
}

//------------------------------------------------------------------------------
double HalfSpaceTable::Evaluate(double radius, double decay, double walkDecay, double gain) const
{
  double fall = GetFall(radius * decay);
  if (gain != 1.0)
  {
    const double walked = GetFall(radius * walkDecay);
    fall = walked + gain * (fall - walked);
  }
  const double turned = radius / Turn;
  const double shape = fall / (radius * (1.0 + turned * turned));
  const double position = RingsPerUnit * (std::log(radius) - FirstLogarithm);
  return shape * std::exp(this->Interpolate(position));
}

//------------------------------------------------------------------------------
double HalfSpaceTable::SumRing(int ring, double decay) const
{
  double sum = 0.0;
  for (int k = 0; k < PointsPerRing; ++k)
  {
    const double radius = GetRadius(ring + (k + 0.5) / PointsPerRing);
    sum += radius * radius * this->Evaluate(radius, decay);
  }
  return 2.0 * vtkMath::Pi() / (RingsPerUnit * PointsPerRing) * sum;
}

//------------------------------------------------------------------------------
void HalfSpaceTable::Smooth(const std::vector<double>& logarithms,
  const std::vector<double>& weights, double extinction)
{
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(NumberOfRings, NumberOfRings);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(NumberOfRings);
  // Add that a combination of neighbouring controls should have a value.
  const auto ask = [&](int first, const std::vector<double>& factors, double value, double weight)
  {
    const auto clamp = [first](std::size_t k)
    { return std::clamp(first + static_cast<int>(k), 0, NumberOfRings - 1); };
    for (std::size_t i = 0; i < factors.size(); ++i)
    {
      right[clamp(i)] += weight * factors[i] * value;
      for (std::size_t k = 0; k < factors.size(); ++k)
      {
        matrix(clamp(i), clamp(k)) += weight * factors[i] * factors[k];
      }
    }
  };
  for (int ring = 0; ring < NumberOfRings; ++ring)
  {
    ask(ring - 1, { 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0 }, logarithms[ring], weights[ring]);
    const double paths = extinction * GetRadius(ring);
    ask(ring - 1, { -1.0, 1.0 }, 0.0, LevelPenalty + CentrePenalty / (paths * paths));
    ask(ring - 2, { -1.0, 3.0, -3.0, 1.0 }, 0.0, SmoothPenalty);
  }
  const Eigen::VectorXd controls = matrix.ldlt().solve(right);
  this->Controls.assign(controls.begin(), controls.end());
}

//------------------------------------------------------------------------------
// Slopes of the spline lie between those of its controls: where none of these rises by more than
// the shape falls the profile never rises.
void HalfSpaceTable::LimitRise()
{
  for (int k = 1; k < NumberOfRings; ++k)
  {
    this->Controls[k] = std::min(this->Controls[k], this->Controls[k - 1] + 1.0 / RingsPerUnit);
  }
}

//------------------------------------------------------------------------------
std::shared_ptr<const HalfSpaceTable> HalfSpaceTable::Find(const Settings& settings)
{
  Shelf& shelf = GetShelf();
  const std::lock_guard<std::mutex> lock(shelf.Mutex);
  const auto found = std::find_if(shelf.Tables.begin(), shelf.Tables.end(),
    [&settings](const auto& kept) { return kept.first == settings; });
  return found != shelf.Tables.end() ? found->second : nullptr;
}

//------------------------------------------------------------------------------
void HalfSpaceTable::Keep(const Settings& settings,
  const std::shared_ptr<const HalfSpaceTable>& table)
{
  Shelf& shelf = GetShelf();
  const std::lock_guard<std::mutex> lock(shelf.Mutex);
  shelf.Tables.emplace_back(settings, table);
  if (shelf.Tables.size() > MostTables)
  {
    shelf.Tables.pop_front();
  }
}

//------------------------------------------------------------------------------
std::shared_ptr<const HalfSpaceTable> HalfSpaceTable::Get(const Settings& settings,
  const Ranks& ranks)
{
  // Media that absorb less share their walk.
  Settings wanted = settings;
  wanted.Albedo = std::min(settings.Albedo, 1.0 - LeastAbsorption);
  auto table = Find(wanted);
  // What one rank lacks all of them make.
  if (ranks.GetLargest(table ? 0 : 1) > 0)
  {
    table = std::make_shared<const HalfSpaceTable>(wanted, ranks);
    Keep(wanted, table);
  }
  return table;
}
} // namespace LightTransport
