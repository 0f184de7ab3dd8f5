// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/BrightRows.h"

#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Support/Ranks.h"
#include "ViewFactors/DenseViewFactors.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
bool BrightRows::IsFilledFor(const PatchScene& scene, const std::vector<bool>& patches,
  double tolerance, const Ranks& ranks) const
{
  return this->Fingerprint == scene.GetFingerprint() && this->Tolerance == tolerance &&
    this->NumberOfRanks == ranks.GetNumber() && this->IsBright == patches;
}

//------------------------------------------------------------------------------
Outcome BrightRows::Fill(const PatchScene& scene, const std::vector<bool>& patches,
  double tolerance, const Ranks& ranks, const Monitor& monitor)
{
  if (!patches.empty() && this->IsFilledFor(scene, patches, tolerance, ranks))
  {
    return Outcome::Done();
  }
  *this = BrightRows();
  if (patches.empty())
  {
    return Outcome::Done();
  }
  vtkSmartPointer<vtkExchangeMatrix> matrix;
  Outcome filled = DenseViewFactors::FillRows(scene, tolerance, patches, ranks, monitor, matrix);
  if (!filled)
  {
    return filled;
  }
  this->IsBright = patches;
  this->TakeRows(scene, *matrix);
  ranks.Sum(this->Sums);
  this->Fingerprint = scene.GetFingerprint();
  this->Tolerance = tolerance;
  this->NumberOfRanks = ranks.GetNumber();
  return filled;
}

//------------------------------------------------------------------------------
void BrightRows::TakeRows(const PatchScene& scene, const vtkExchangeMatrix& matrix)
{
  const vtkIdType count = scene.GetNumberOfPatches();
  std::vector<int> bright;
  std::vector<int> all(count);
  std::iota(all.begin(), all.end(), 0);
  std::copy_if(all.begin(), all.end(), std::back_inserter(bright),
    [this](int patch) { return this->IsBright[patch]; });
  this->Offsets.assign(1, 0);
  this->Sums.assign(count, 0.0);
  for (vtkIdType row = 0; row < count; ++row)
  {
    Pulse::Beat(row);
    for (const int column : this->IsBright[row] ? all : bright)
    {
      const double exchange = matrix.GetValue(row, column);
      if (exchange > 0.0)
      {
        this->Entries.push_back({ column, static_cast<float>(exchange) });
        this->Sums[row] += exchange / scene.GetAreas()[row];
      }
    }
    this->Offsets.push_back(this->GetNumberOfEntries());
  }
}
} // namespace LightTransport
