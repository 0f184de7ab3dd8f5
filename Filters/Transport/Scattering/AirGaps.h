// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Links that go through the air between two parts of a body, or between two bodies: those whose
 * straight segment, from centroid to centroid, leaves the body through one patch and enters it
 * through another one, and these two are turned towards each other: their normals differ by more
 * than a right angle. What crosses the air of a shallow dent or the inside of a corner is no such
 * link: light goes nearly the same way in the body, and the noise of a scan would make many.
 *
 * The body is behind its patches. Nothing else is asked of the surface: it may be open, and where
 * bodies touch there is no air.
 */
#ifndef AirGaps_h
#define AirGaps_h

#include "Geometry/SceneRayCaster.h"
#include "Links/LinksThroughAir.h"
#include "Scattering/ScatteringProfile.h"
#include "Support/SplitMix.h"

#include <vector>

namespace LightTransport
{
class AirGaps
{
public:
  /// Links of a patch that are looked at where not all of them are; a little more of small patches
  /// and where bands differ.
  static constexpr double SampleSize = 64.0;
  static constexpr double AllLinks = 0.0;

  /// The scene must outlive this. Fails where rays cannot be cast (no memory). Texels do not
  /// enclose a body, and rays would find air in their gaps: none is looked for there.
  Outcome Build(const PatchScene& scene);

  /// False where the scene is one convex body: all of it is behind the plane of each patch. Then no
  /// ray is ever cast.
  bool MayBeThere() const { return this->HasHollows; }

  /// Nothing yet, for patches of these areas, of samples of so many links of each patch, or
  /// AllLinks.
  LinksThroughAir StartSums(const std::vector<double>& areas, const ScatteringProfiles& profiles,
    double sampleSize) const;

  /// Whether a link that is to be looked at with some probability is, by a number of its own.
  static bool IsInSample(SplitMix& number, double probability)
  {
    return number.GetNextHalf() < probability * 0x1p32;
  }

  /// Whether there is such air between two patches. Thread-safe.
  bool AreBetween(vtkIdType i, vtkIdType j) const;

private:
  const PatchScene* Scene = nullptr;
  bool HasHollows = false;
  /// Of patches with something in front of them: no segment goes through others.
  SceneRayCaster Hollows;
};
} // namespace LightTransport

#endif
