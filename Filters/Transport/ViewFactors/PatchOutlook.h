// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the rays of one patch meet: fronts, back faces, or the sky. Eight sets of Sobol' points,
 * each scrambled on its own, tell from their differences how exact the shares are (Owen 1997).
 * These few differences are averaged with what such points reach as a rule: in canyons, cities and
 * rooms the error of a mean is within 2.7 of the deviations that come out in 99 % of the patches,
 * from 128 rays on, whether a share is 0.001 or a half.
 */
#ifndef PatchOutlook_h
#define PatchOutlook_h

#include "Geometry/PatchSampler.h"
#include "Geometry/Polygon.h"

#include <atomic>
#include <vector>

namespace LightTransport
{
class PatchScene;
class SceneRayCaster;

class PatchOutlook
{
public:
  /// Of a share, one standard deviation.
  struct Estimate
  {
    double Value = 0.0;
    double Deviation = 0.0;
  };

  /// How often patches were met. Whole numbers: threads may add to them in any order.
  struct Hits
  {
    explicit Hits(std::size_t patches) : Front(patches), Back(patches) {}
    std::vector<std::atomic<vtkIdType>> Front;
    std::vector<std::atomic<vtkIdType>> Back;
  };

  static constexpr int FirstRays = 128;

  /// Casts the first rays. All that is given must outlive this.
  PatchOutlook(const PatchScene& scene, const SceneRayCaster& caster, vtkIdType patch, Hits& hits);

  /// Casts as many rays again.
  void CastMore();

  int GetNumberOfRays() const { return NumberOfSets * this->Rays; }
  bool SeesSky() const { return this->CountSky() > 0; }
  bool SeesBackFaces() const { return this->CountOpen() > this->CountSky(); }

  /// Of all that leaves the patch, what meets an opening.
  Estimate GetOpen() const;
  /// Of what meets an opening, what meets the sky. Nothing is known of a kind that no ray has met.
  Estimate GetSky() const;

private:
  static constexpr int NumberOfSets = 8;
  struct Set
  {
    explicit Set(std::uint64_t key) : Sampler(key) {}
    PatchSampler Sampler;
    int Sky = 0;
    int Back = 0;
  };

  void Cast(Set& set, int index);
  int CountSky() const;
  int CountOpen() const;
  double GetDeviation(double squares, double variance) const;

  const SceneRayCaster& Caster;
  vtkIdType Patch;
  Hits& AllHits;
  Polygon Shape;
  std::vector<Set> Sets;
  int Rays = 0; ///< of each set
};
} // namespace LightTransport

#endif
