// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/SlotErrors.h"

#include "Support/Ranks.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace LightTransport
{
namespace
{
// Whole numbers of these parts are summed.
constexpr double DeviationParts = 0x1.0p40;
constexpr double SquareParts = 0x1.0p50;
} // namespace

//------------------------------------------------------------------------------
void SlotErrors::Clear(int slots)
{
  this->NumberOfSlots = slots;
  this->Deviations = std::make_unique<std::atomic<std::int64_t>[]>(Points * this->NumberOfSlots);
  this->Squares = std::make_unique<std::atomic<std::int64_t>[]>(this->NumberOfSlots);
  for (std::size_t k = 0; k < Points * this->NumberOfSlots; ++k)
  {
    this->Deviations[k] = 0;
    this->Squares[k / Points] = 0;
  }
}

//------------------------------------------------------------------------------
void SlotErrors::Add(int slot, double squaredError, const double* deviations)
{
  for (int k = 0; k < Points; ++k)
  {
    this->Deviations[Points * slot + k] += std::llround(deviations[k] * DeviationParts);
  }
  this->Squares[slot] += std::llround(squaredError * SquareParts);
}

//------------------------------------------------------------------------------
void SlotErrors::AddUp(const Ranks& ranks)
{
  const auto addUp = [&ranks](Sums& sums, std::size_t count)
  {
    std::vector<vtkTypeInt64> all(sums.get(), sums.get() + count);
    ranks.Sum(all);
    std::copy(all.begin(), all.end(), sums.get());
  };
  addUp(this->Deviations, Points * this->NumberOfSlots);
  addUp(this->Squares, this->NumberOfSlots);
}

//------------------------------------------------------------------------------
double SlotErrors::GetCoherent(int slot) const
{
  double coherent = 0.0;
  for (int k = 0; k < Points; ++k)
  {
    const double deviation =
      static_cast<double>(this->Deviations[Points * slot + k]) / DeviationParts;
    coherent += deviation * deviation / Points;
  }
  return coherent;
}

//------------------------------------------------------------------------------
double SlotErrors::GetApart(int slot) const
{
  return static_cast<double>(this->Squares[slot]) / SquareParts;
}
} // namespace LightTransport
