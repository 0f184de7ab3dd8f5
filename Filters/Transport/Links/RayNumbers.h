// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How many rays patches cast: all as many, and some, which send much of the light, twice that some
 * times over. Links of these are known better than those of others (IsBright).
 */
#ifndef RayNumbers_h
#define RayNumbers_h

#include "vtkType.h"

#include <vector>

namespace LightTransport
{
struct RayNumbers
{
  int Each = 0;                         ///< of a patch, at least
  std::vector<unsigned char> Doublings; ///< of each patch beyond that; empty: none

  bool IsBright(vtkIdType patch) const
  {
    return !this->Doublings.empty() && this->Doublings[patch] > 0;
  }
  /// By which a patch casts more than others.
  int GetTimes(vtkIdType patch) const
  {
    return this->Doublings.empty() ? 1 : 1 << this->Doublings[patch];
  }
  int Get(vtkIdType patch) const { return this->Each * this->GetTimes(patch); }

  /// Rays that say what two patches exchange, of both together, for each part of both areas: their
  /// counts over this are the exchange over both areas.
  double GetDensity(vtkIdType a, vtkIdType b, const std::vector<double>& areas) const
  {
    return this->Each * (this->GetTimes(a) * areas[b] + this->GetTimes(b) * areas[a]);
  }

  /// Of so many patches.
  double Sum(vtkIdType patches) const
  {
    double times = static_cast<double>(patches);
    for (const unsigned char doublings : this->Doublings)
    {
      times += (1 << doublings) - 1;
    }
    return times * this->Each;
  }

  bool operator==(const RayNumbers& other) const
  {
    return this->Each == other.Each && this->Doublings == other.Doublings;
  }
};
} // namespace LightTransport

#endif
