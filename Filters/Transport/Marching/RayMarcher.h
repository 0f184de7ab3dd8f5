// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered exactly once in a body and leaves at a point in a direction: the ray is
 * refracted inwards, a point on it chosen (InsidePath), and from there light is looked for: of
 * lights and of what is bright in an environment where it enters (EntrySearch), of the rest of the
 * environment along rays that are chosen by the phase function. One sample for one set of numbers;
 * a ray of a camera needs no more than that, nor does a patch.
 *
 * Both rays are reflected inside as often as it is worth, but for light that comes straight from
 * lights or peaks: what of that is reflected before it is scattered is left out, as is what has
 * passed through a body before.
 */
#ifndef RayMarcher_h
#define RayMarcher_h

#include "Lighting/Panorama.h"
#include "Lighting/PunctualLight.h"
#include "Marching/EntrySearch.h"
#include "Marching/InsidePath.h"
#include "Photons/MeshBoundary.h"

#include <vector>

namespace LightTransport
{
class RayMarcher
{
public:
  using Vector = Eigen::Vector3d;

  /// Where light comes from. Directional lights are discs of a radius in radians.
  struct Lights
  {
    std::vector<PunctualLight> Punctual;
    double Radius = 0.0;
    const Panorama* Environment = nullptr; ///< none
    bool HasShadows = true;
  };

  /// A ray and the numbers, evenly spread in (0, 1), of one sample.
  struct Sample
  {
    Vector Point; ///< on the surface
    vtkIdType Patch;
    Vector Outwards; ///< the direction outside, away from the surface
    double Place;    ///< on the ray
    double Sky[2];   ///< where in the environment, or in the disc of a light
    int Band;        ///< 0 to 2: whose phase function chooses
  };

  /// Media are those of LightBands bands, lengths in scene units. The scene must outlive this.
  RayMarcher(const PatchScene& scene, const std::vector<PhotonMedium>& media,
    double refractiveIndex, const Lights& lights);

  Outcome Build() { return this->Boundary.Build(this->Scene, 0.0); }

  /// Add the radiance outside.
  void March(const Sample& sample, double radiance[LightBands]) const;

private:
  /// Where light is scattered.
  struct Scattering
  {
    Vector Position;
    Vector Direction; ///< against the light that leaves
    double Weights[LightBands];
  };

  void AddPoint(const PunctualLight& light, const Scattering& place, double* radiance) const;
  void AddDistant(const Vector& towards, const double* irradiance, const Scattering& place,
    double* radiance) const;
  void AddBackground(const Sample& sample, const Scattering& place, double* radiance) const;
  void AddEntry(const EntrySearch::Entry& entry, const double* irradiance, double distance,
    const Scattering& place, double* radiance) const;
  Vector ChooseDirection(const Sample& sample, const Vector& axis, double* weights) const;
  bool IsVisible(const Vector& point, const EntrySearch::Entry& entry) const;
  bool IsLit(const Vector& point, const Vector& towards, double distance, vtkIdType patch) const;

  const PatchScene& Scene;
  std::vector<PhotonMedium> Media;
  double Index;
  Lights Sources;
  PhotonInterface Interface;
  EntrySearch Search;
  MeshBoundary Boundary;
  double Reach; ///< beyond which next to nothing arrives
};
} // namespace LightTransport

#endif
