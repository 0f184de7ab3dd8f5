// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The exact exchange of a few patches with all others, in the rows of both: what rays need not
/// find. Of several ranks each holds a part, which add up.
#ifndef BrightRows_h
#define BrightRows_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <cstdint>
#include <vector>

class vtkExchangeMatrix;

namespace LightTransport
{
class PatchScene;
class Ranks;

class BrightRows
{
public:
  struct Entry
  {
    int Column;
    float Exchange;
  };

  /// None: nothing is exact.
  BrightRows() = default;

  /// The rows of `patches` (one flag for each patch of the scene, or none), to a tolerance of each
  /// row, unless they are there already. Collective.
  Outcome Fill(const PatchScene& scene, const std::vector<bool>& patches, double tolerance,
    const Ranks& ranks, const Monitor& monitor);

  bool IsEmpty() const { return this->IsBright.empty(); }
  /// Whether all of a patch's exchange is here.
  bool Has(vtkIdType patch) const { return !this->IsEmpty() && this->IsBright[patch]; }

  ///@{ What this rank has of a row, by ascending columns.
  const Entry* Begin(vtkIdType patch) const
  {
    return this->Entries.data() + (this->IsEmpty() ? 0 : this->Offsets[patch]);
  }
  const Entry* End(vtkIdType patch) const
  {
    return this->Entries.data() + (this->IsEmpty() ? 0 : this->Offsets[patch + 1]);
  }
  ///@}
  std::int64_t GetNumberOfEntries() const
  {
    return static_cast<std::int64_t>(this->Entries.size());
  }
  /// Of each row, of all ranks: what is exact in its sum of view factors.
  const std::vector<double>& GetSums() const { return this->Sums; }

private:
  bool IsFilledFor(const PatchScene& scene, const std::vector<bool>& patches, double tolerance,
    const Ranks& ranks) const;
  void TakeRows(const PatchScene& scene, const vtkExchangeMatrix& matrix);

  ///@{ What rows are there.
  std::uint64_t Fingerprint = 0;
  double Tolerance = 0.0;
  int NumberOfRanks = 0;
  ///@}
  std::vector<bool> IsBright;
  std::vector<std::int64_t> Offsets;
  std::vector<Entry> Entries;
  std::vector<double> Sums;
};
} // namespace LightTransport

#endif
