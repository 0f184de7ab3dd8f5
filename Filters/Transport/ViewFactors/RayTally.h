// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// How often some rays of one patch have met which others; a visitor of RayHits.
#ifndef RayTally_h
#define RayTally_h

#include "Geometry/PatchRays.h"
#include "vtkType.h"

#include <utility>
#include <vector>

namespace LightTransport
{
class RayTally
{
public:
  /// Before anything else.
  void SetNumberOfPatches(vtkIdType number) { this->Counts.resize(number, 0); }

  void operator()(PatchRays::Hit hit)
  {
    if (hit >= 0)
    {
      if (this->Counts[hit]++ == 0)
      {
        this->Met.push_back(hit);
      }
    }
    else if (hit == PatchRays::Sky)
    {
      ++this->Sky;
    }
    else
    {
      this->Behind.push_back(PatchRays::FromBehind(hit));
    }
  }

  /// Calls visitor(patch, count) for what was met, in the order of Met, and begins anew.
  template <typename Visitor>
  void Finish(Visitor&& visitor)
  {
    for (const int patch : this->Met)
    {
      visitor(patch, std::exchange(this->Counts[patch], 0));
    }
    this->Met.clear();
    this->Behind.clear();
    this->Sky = 0;
  }

  std::vector<int> Met;    ///< as each was met first
  std::vector<int> Behind; ///< one for each ray that met a back
  int Sky = 0;

private:
  std::vector<int> Counts; ///< of all patches
};
} // namespace LightTransport

#endif
