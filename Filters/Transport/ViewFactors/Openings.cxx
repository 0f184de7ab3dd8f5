// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/Openings.h"

#include "Geometry/PatchSampler.h"
#include "Geometry/Polygon.h"
#include "Geometry/SceneRayCaster.h"
#include "Links/Links.h"
#include "Scene/PatchScene.h"
#include "Shared/Threads.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace LightTransport
{
namespace
{
// Rays per patch that tell sky from back faces; more where none of them finds either.
constexpr int OpeningRays = 128;
constexpr int MostOpeningRays = 4096;
// Rays per patch that sees an opening where nothing else tells how large it is.
constexpr int SamplingRays = 512;
// Patches that tell whether a scene has openings at all.
constexpr vtkIdType PatchesThatLook = 2000;

//------------------------------------------------------------------------------
// The rays of a patch that meet no front.
class Lookout
{
public:
  Lookout(const PatchScene& scene, const SceneRayCaster& caster, vtkIdType patch)
    : Caster(caster), Patch(patch), Sampler(static_cast<std::uint64_t>(patch))
  {
    this->Shape.Set(scene, patch);
  }

  void Cast()
  {
    bool front = false;
    const vtkIdType hit = this->Caster.FindHit(this->Sampler.GetPoint(this->Shape, this->Rays, 0),
      this->Sampler.GetDirection(this->Shape.Normal, this->Rays, 2), this->Patch, front);
    this->Sky += hit < 0 ? 1 : 0;
    this->Back += hit >= 0 && !front ? 1 : 0;
    ++this->Rays;
  }

  int GetOpen() const { return this->Sky + this->Back; }

  int Rays = 0;
  int Sky = 0;
  int Back = 0;

private:
  const SceneRayCaster& Caster;
  vtkIdType Patch;
  PatchSampler Sampler;
  Polygon Shape;
};
} // namespace

//------------------------------------------------------------------------------
bool Openings::Exist() const
{
  const vtkIdType patches = this->Scene.GetNumberOfPatches();
  const vtkIdType step = std::max<vtkIdType>(patches / PatchesThatLook, 1);
  for (vtkIdType patch = 0; patch < patches; patch += step)
  {
    Lookout lookout(this->Scene, this->Caster, patch);
    while (lookout.Rays < OpeningRays)
    {
      lookout.Cast();
    }
    if (lookout.GetOpen() > 0)
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
void Openings::Clear(Links& links)
{
  links.SkyFractions.assign(links.RowSums.size(), 0.0);
  links.BackFaceFractions.assign(links.RowSums.size(), 0.0);
}

//------------------------------------------------------------------------------
// `lookOut` casts the rays of a patch and returns which part of what leaves it meets an opening.
template <typename LookOut>
void Openings::CastRays(Links& links, const LookOut& lookOut) const
{
  Clear(links);
  std::vector<int> rays(links.RowSums.size(), 0);
  const auto work = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      Lookout lookout(this->Scene, this->Caster, patch);
      const double open = lookOut(patch, lookout);
      rays[patch] = lookout.Rays;
      if (lookout.GetOpen() > 0)
      {
        links.SkyFractions[patch] = open * lookout.Sky / lookout.GetOpen();
        links.BackFaceFractions[patch] = open * lookout.Back / lookout.GetOpen();
      }
    }
  };
  Threads::For(0, this->Scene.GetNumberOfPatches(), 64, work);
  links.Summaries.emplace_back("RaysCast", std::accumulate(rays.begin(), rays.end(), 0.0));
}

//------------------------------------------------------------------------------
void Openings::Divide(Links& links) const
{
  this->CastRays(links,
    [&](vtkIdType patch, Lookout& lookout)
    {
      const double missing = 1.0 - links.RowSums[patch];
      const bool misses = missing > links.RowErrors[patch];
      while (misses &&
        (lookout.Rays < OpeningRays || (lookout.GetOpen() == 0 && lookout.Rays < MostOpeningRays)))
      {
        lookout.Cast();
      }
      return missing;
    });
}

//------------------------------------------------------------------------------
void Openings::Sample(Links& links) const
{
  this->CastRays(links,
    [](vtkIdType, Lookout& lookout)
    {
      while (lookout.Rays < OpeningRays || (lookout.GetOpen() > 0 && lookout.Rays < SamplingRays))
      {
        lookout.Cast();
      }
      return static_cast<double>(lookout.GetOpen()) / lookout.Rays;
    });
}
} // namespace LightTransport
