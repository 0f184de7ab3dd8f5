// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The mean of samples of one sequence of a PatchSampler, and its error: the spread between the
 * means of equal blocks that follow each other in the sequence. Each block is evenly spread itself,
 * so that the spread falls as the error does; together they are more even still, and the spread is
 * taken times a factor that was measured. Where something is in the way of a part of them, one more
 * sample of the other kind counts, too.
 */
#ifndef SampleMean_h
#define SampleMean_h

#include "Lighting/LightSource.h"

#include <algorithm>
#include <array>

namespace LightTransport
{
class SampleMean
{
public:
  /// At least 8 samples at first, rounded up to a multiple of 8; none where `isEmpty`.
  explicit SampleMean(int samples, bool isEmpty = false)
    : PerBlock(std::max(1, (samples + Blocks - 1) / Blocks)), IsEmpty(isEmpty)
  {
  }

  /// Samples that there are or, after Double, will be.
  int GetCount() const { return this->IsEmpty ? 0 : Blocks * this->PerBlock; }
  /// Add those that there are not yet: `sample(k, sum)` adds sample k to a sum.
  template <typename Sample>
  void Fill(const Sample& sample)
  {
    for (int k = this->First; k < this->GetCount(); ++k)
    {
      sample(k, this->Sums[k / this->PerBlock]);
    }
    this->First = this->GetCount();
  }

  /// Make room for as many samples again.
  void Double()
  {
    for (int block = 0; block < Blocks / 2; ++block)
    {
      LightSum pair = this->Sums[2 * block];
      pair.Add(this->Sums[2 * block + 1]);
      this->Sums[block] = pair;
    }
    std::fill(this->Sums.begin() + Blocks / 2, this->Sums.end(), LightSum());
    this->PerBlock *= 2;
  }

  // Errors over spreads, root mean squares over the patches of scenes with little and with much in
  // the way: 0.6 to 0.8.
  static constexpr double Evenness = 0.75;

  /// `isPartial`: something may be in the way of samples, although none has met it. `evenness` is
  /// the factor for samples of other kinds than light that falls on patches.
  LightSum GetMean(bool isPartial = false, double evenness = Evenness) const
  {
    LightSum mean;
    for (const LightSum& sum : this->Sums)
    {
      mean.AddScaled(sum, 1.0 / (Blocks * this->PerBlock));
    }
    for (int band = 0; band < LightBands; ++band)
    {
      double squares = 0.0;
      for (const LightSum& sum : this->Sums)
      {
        const double off = sum.Incident[band] / this->PerBlock - mean.Incident[band];
        squares += off * off;
      }
      const bool isMixed =
        mean.Incident[band] != 0.0 && mean.Incident[band] != mean.Unshadowed[band];
      const double unmet = isPartial || isMixed ? mean.Unshadowed[band] / this->GetCount() : 0.0;
      mean.Variance[band] = evenness * evenness * squares / (Blocks * (Blocks - 1)) + unmet * unmet;
    }
    return mean;
  }

private:
  static constexpr int Blocks = 8;

  int PerBlock;
  bool IsEmpty;
  int First = 0; ///< of those that there are not yet
  std::array<LightSum, Blocks> Sums;
};
} // namespace LightTransport

#endif
