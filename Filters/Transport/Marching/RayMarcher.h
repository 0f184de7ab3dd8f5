// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered exactly once in a body and leaves at a point in a direction: the ray is
 * refracted inwards, a point on it chosen (InsidePath), and from there light is looked for: of
 * lights and of what is bright in an environment where it enters (EntrySearch), of the rest of the
 * environment along rays that are chosen by the phase function. One sample for one set of numbers;
 * a ray of a camera needs no more than that, nor does a patch.
 *
 * Both rays are reflected inside as often as it is worth, but the search knows the straight way
 * only. What of the light of lights and peaks is reflected inside before it is scattered is
 * followed from where it enters, the way of the light: Shine. Left out is what has passed through a
 * body before, or was reflected outside.
 */
#ifndef RayMarcher_h
#define RayMarcher_h

#include "Lighting/Panorama.h"
#include "Lighting/PunctualLight.h"
#include "Marching/EntrySearch.h"
#include "Marching/InsidePath.h"
#include "Photons/MeshBoundary.h"

#include <functional>
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

  /// A place where light enters, and the numbers, evenly spread in (0, 1), of one sample.
  struct Entrance
  {
    Vector Point; ///< on the surface
    vtkIdType Patch;
    double Area;    ///< what it stands for
    double Number;  ///< how often it is scattered, rounded up or down by that
    double Place;   ///< on the reflected ray
    double Sky[2];  ///< where among the peaks of the environment, or in the disc of a light
    double Turn[2]; ///< by which it is scattered
    int Band;       ///< 0 to 2: whose phase function chooses
  };
  using Receive = std::function<void(vtkIdType patch, const double flux[LightBands])>;

  /// Media are those of LightBands bands, lengths in scene units. Rays inside are followed until
  /// less than a part `leastWeight` of them is left. The scene must outlive this.
  RayMarcher(const PatchScene& scene, const std::vector<PhotonMedium>& media,
    double refractiveIndex, const Lights& lights, double leastWeight);

  Outcome Build() { return this->Boundary.Build(this->Scene, 0.0); }

  /// Add the radiance outside.
  void March(const Sample& sample, double radiance[LightBands]) const;

  /// Whether there is light that is reflected before it is scattered, and not found by March.
  bool HasReflections() const;
  /// Follow that light from where it enters, and tell what leaves which patch of it.
  void Shine(const Entrance& entrance, const Receive& receive) const;

private:
  /// Where light is scattered.
  struct Scattering
  {
    Vector Position;
    Vector Direction; ///< against the light that leaves; in Shine of the light that comes
    double Weights[LightBands];
  };

  Vector GetTowards(const PunctualLight& light, const double* disc, double* irradiance) const;
  void AddPoint(const PunctualLight& light, const Scattering& place, double* radiance) const;
  void AddDistant(const Vector& towards, const double* irradiance, const Scattering& place,
    double* radiance) const;
  void AddBackground(const Sample& sample, const Scattering& place, double* radiance) const;
  void AddEntry(const EntrySearch::Entry& entry, const double* irradiance, double distance,
    const Scattering& place, double* radiance) const;
  void ShineFrom(const Vector& towards, double distance, const double* irradiance,
    const Entrance& entrance, const Receive& receive) const;
  void SendOut(const Scattering& place, int band, const double* turn, const Receive& receive) const;
  Vector ChooseDirection(int band, const double* turn, const Vector& axis, double* weights) const;
  InsidePath Follow(const Vector& origin, const Vector& direction, vtkIdType from) const
  {
    return { this->Boundary, this->Interface, this->Media, this->LeastWeight, origin, direction,
      from };
  }
  bool IsVisible(const Vector& point, const EntrySearch::Entry& entry) const;
  bool IsLit(const Vector& point, const Vector& towards, double distance, vtkIdType patch) const;

  const PatchScene& Scene;
  std::vector<PhotonMedium> Media;
  double Index;
  Lights Sources;
  double LeastWeight;
  PhotonInterface Interface;
  EntrySearch Search;
  MeshBoundary Boundary;
  double Reach; ///< beyond which next to nothing arrives
};
} // namespace LightTransport

#endif
