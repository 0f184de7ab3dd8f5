// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Light that is scattered exactly once in a body and leaves at a point in a direction: the ray is
 * refracted inwards, a point on it chosen (InsidePath), and from there light is looked for: of
 * lights and of what is bright in an environment where it enters (EntrySearch), of the rest of the
 * environment along rays that are chosen by the phase function. One sample for one set of numbers;
 * a ray of a camera needs no more than that, nor does a patch.
 *
 * Both rays are reflected inside as often as it is worth, and go on by chance where they leave a
 * body and meet it again, but the search knows the straight way only. What of the light of lights
 * and peaks is reflected inside before it is scattered, was reflected outside or has passed through
 * a body before is followed from where it meets the surface first, the way of the light: Shine.
 */
#ifndef RayMarcher_h
#define RayMarcher_h

#include "Lighting/Panorama.h"
#include "Lighting/PunctualLight.h"
#include "Marching/EntrySearch.h"
#include "Marching/InsidePath.h"
#include "Marching/OutsideRay.h"
#include "Photons/MeshBoundary.h"

#include <cstdint>
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
    Vector Outwards;      ///< the direction outside, away from the surface
    double Place;         ///< on the ray
    double Sky[2];        ///< where in the environment, or in the disc of a light
    int Band;             ///< 0 to 2: whose phase function chooses
    std::uint64_t Stream; ///< of random numbers, for what enters again
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
    std::uint64_t Stream;
  };
  using Receive = std::function<void(vtkIdType patch, const double flux[LightBands])>;

  /// Media are those of LightBands bands, lengths in scene units. Rays inside are followed until
  /// less than a part `leastWeight` of them is left. The scene must outlive this.
  RayMarcher(const PatchScene& scene, const std::vector<PhotonMedium>& media,
    double refractiveIndex, const Lights& lights, double leastWeight);

  Outcome Build();

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
  /// A ray that goes on where it leaves a body and meets it again.
  struct Ray : public OutsideRay
  {
    double Weights[LightBands] = {}; ///< what reaches its start, or its end, of each band
    double Part = 1.0;               ///< what is left of it since then, on average
    int RoundsInPlace = 0;           ///< that it has entered where it had entered before
  };

  void AddScattered(const InsidePath& path, double number, const Ray& ray, const Sample& sample,
    PhotonRandom& random, double* radiance) const;
  void AddPoint(const PunctualLight& light, const Scattering& place, double* radiance) const;
  void AddDistant(const Vector& towards, const double* irradiance, const Scattering& place,
    double* radiance) const;
  void AddBackground(const Sample& sample, const Scattering& place, PhotonRandom& random,
    double* radiance) const;
  void AddSkyAt(const InsidePath& path, int k, const Ray& ray, double* radiance) const;
  void AddSky(const Vector& towards, const double* weights, double* radiance) const;
  void AddEntry(const EntrySearch::Entry& entry, const double* irradiance, double distance,
    const Scattering& place, double* radiance) const;
  void ShineFrom(const Vector& towards, double distance, const double* irradiance,
    const Entrance& entrance, const Receive& receive) const;
  void Scatter(const InsidePath& path, int first, const Ray& ray, const Entrance& entrance,
    PhotonRandom& random, const Receive& receive) const;
  void SendOut(const Scattering& place, int band, const double* turn, PhotonRandom& random,
    const Receive& receive) const;
  bool GoOn(const InsidePath& path, Ray& ray, PhotonRandom& random) const;
  Vector ChooseDirection(int band, const double* turn, const Vector& axis, double* weights) const;
  InsidePath Follow(const OutsideRay& ray) const
  {
    return { this->Boundary, this->Interface, this->Media, this->LeastWeight, ray.Position,
      ray.Direction, ray.Patch };
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
  /// Whether what leaves may meet the surface again.
  bool HasHollows = false;
};
} // namespace LightTransport

#endif
