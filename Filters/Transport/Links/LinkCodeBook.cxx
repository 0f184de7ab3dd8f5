// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Links/LinkCodeBook.h"

#include "Shared/Threads.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace LightTransport
{
namespace
{
// More hardly change a book.
constexpr int Rounds = 16;
constexpr vtkIdType SamplesPerTask = 512;
} // namespace

//------------------------------------------------------------------------------
LinkCodeBook::LinkCodeBook(int dimensions, int entries, const std::vector<float>& points,
  const std::vector<double>& weights)
  : Dimensions(dimensions), Entries(std::min(entries, static_cast<int>(weights.size()))),
    Book(static_cast<std::size_t>(dimensions) * this->Entries), Nearest(weights.size()),
    Errors(weights.size(), 0.0f)
{
  if (this->Entries > 0)
  {
    this->Spread(points, weights);
    this->Train(points, weights);
  }
}

//------------------------------------------------------------------------------
// The first guess: samples in the order of their size, cut where the cube roots of what each would
// add to the error sum to equal parts, which is best in one dimension (P. F. Panter, W. Dite, Proc.
// IRE 39, 44, 1951). Factors of a profile are mostly a curve.
void LinkCodeBook::Spread(const std::vector<float>& points, const std::vector<double>& weights)
{
  const std::size_t samples = weights.size();
  std::vector<double> sizes(samples, 0.0);
  for (std::size_t value = 0; value < points.size(); ++value)
  {
    sizes[value / this->Dimensions] += static_cast<double>(points[value]) * points[value];
  }
  std::vector<std::size_t> order(samples);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::vector<double> sums;
  double sum = 0.0;
  for (const std::size_t sample : order)
  {
    sum += std::cbrt(weights[sample] * sizes[sample]);
    sums.push_back(sum);
  }
  // Each entry has a sample at least, whatever the weights.
  const double each = sum / this->Entries;
  int entry = 0;
  std::size_t first = 0;
  for (std::size_t place = 0; place < samples; ++place)
  {
    const std::size_t left = samples - place;
    const bool isFull = place > first && sums[place] > each * (entry + 1);
    const bool mustGoOn = left <= static_cast<std::size_t>(this->Entries - 1 - entry);
    if (entry + 1 < this->Entries && place > 0 && (isFull || mustGoOn))
    {
      ++entry;
      first = place;
    }
    this->Nearest[order[place]] = entry;
  }
  this->Center(points, weights);
}

//------------------------------------------------------------------------------
void LinkCodeBook::Train(const std::vector<float>& points, const std::vector<double>& weights)
{
  for (int round = 0; round < Rounds; ++round)
  {
    const auto find = [&](vtkIdType begin, vtkIdType end)
    {
      std::vector<float> distances(static_cast<std::size_t>(this->Entries));
      for (vtkIdType sample = begin; sample < end; ++sample)
      {
        const int nearest = this->Find(points.data() + sample * this->Dimensions, distances.data());
        this->Nearest[sample] = nearest;
        this->Errors[sample] = distances[nearest];
      }
    };
    Threads::For(0, static_cast<vtkIdType>(weights.size()), SamplesPerTask, find);
    this->Center(points, weights);
    if (round + 1 < Rounds)
    {
      this->MoveIdle(points, weights);
    }
  }
}

//------------------------------------------------------------------------------
// Entries without samples go to the worst sample each of those that are furthest off.
void LinkCodeBook::MoveIdle(const std::vector<float>& points, const std::vector<double>& weights)
{
  struct Entry
  {
    int Number = 0;
    int Samples = 0;
    double Error = 0.0;
    double LargestError = 0.0;
    std::size_t WorstSample = 0;
  };
  std::vector<Entry> entries(static_cast<std::size_t>(this->Entries));
  for (int entry = 0; entry < this->Entries; ++entry)
  {
    entries[entry].Number = entry;
  }
  for (std::size_t sample = 0; sample < weights.size(); ++sample)
  {
    Entry& entry = entries[this->Nearest[sample]];
    const double error = weights[sample] * static_cast<double>(this->Errors[sample]);
    ++entry.Samples;
    entry.Error += error;
    if (error > entry.LargestError)
    {
      entry.LargestError = error;
      entry.WorstSample = sample;
    }
  }
  std::stable_sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return a.Error > b.Error; });
  auto worst = entries.begin();
  for (const Entry& idle : entries)
  {
    if (idle.Samples == 0 && worst->Error > 0.0)
    {
      for (int dimension = 0; dimension < this->Dimensions; ++dimension)
      {
        this->Book[static_cast<std::size_t>(dimension) * this->Entries + idle.Number] =
          points[worst->WorstSample * this->Dimensions + dimension];
      }
      ++worst;
    }
  }
}

//------------------------------------------------------------------------------
// Each entry to the mean of its samples.
void LinkCodeBook::Center(const std::vector<float>& points, const std::vector<double>& weights)
{
  std::vector<double> sums(this->Book.size(), 0.0);
  std::vector<double> totals(static_cast<std::size_t>(this->Entries), 0.0);
  for (std::size_t sample = 0; sample < weights.size(); ++sample)
  {
    const int entry = this->Nearest[sample];
    totals[entry] += weights[sample];
    for (int dimension = 0; dimension < this->Dimensions; ++dimension)
    {
      sums[static_cast<std::size_t>(dimension) * this->Entries + entry] +=
        weights[sample] * static_cast<double>(points[sample * this->Dimensions + dimension]);
    }
  }
  for (std::size_t value = 0; value < sums.size(); ++value)
  {
    const double total = totals[value % this->Entries];
    this->Book[value] = total > 0.0 ? static_cast<float>(sums[value] / total) : this->Book[value];
  }
}

//------------------------------------------------------------------------------
int LinkCodeBook::Find(const float* point, float* distances) const
{
  std::fill(distances, distances + this->Entries, 0.0f);
  for (int dimension = 0; dimension < this->Dimensions; ++dimension)
  {
    const float* coordinates =
      this->Book.data() + static_cast<std::size_t>(dimension) * this->Entries;
    const float value = point[dimension];
    for (int entry = 0; entry < this->Entries; ++entry)
    {
      const float difference = value - coordinates[entry];
      distances[entry] += difference * difference;
    }
  }
  return static_cast<int>(std::min_element(distances, distances + this->Entries) - distances);
}
} // namespace LightTransport
