// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SceneRayCaster.h"

#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

// Several times what the coordinates of boxes and rays lose in single precision, and what Embree's
// arithmetic adds, in a scene whose diagonal is 1: a ray that meets a patch meets its box.
constexpr float BoxMargin = 1e-6f;
// Rounding in double precision in such a scene: of heights over a plane, whose normal comes from
// rounded corners, and of the side on which an edge passes (a bound of its arithmetic).
constexpr double HeightRounding = 32.0 * std::numeric_limits<double>::epsilon();
constexpr double SideRounding = 4.0 * std::numeric_limits<double>::epsilon();
// Longer than the scene.
constexpr double OutOfScene = 2.0;

//------------------------------------------------------------------------------
// A primitive of Embree: what tells that most of them are not in the way lies side by side.
struct Candidate
{
  Vector Normal;
  double Offset; // Normal . p in the plane of the patch
  vtkIdType Patch;
  vtkIdType Place;

  double GetHeight(const Vector& point) const { return this->Normal.dot(point) - this->Offset; }
};

//------------------------------------------------------------------------------
// A segment on its way through the scene and the nearest patch that it has met. Embree hands the
// first member back to the functions that test candidates.
struct Segment
{
  QueryContext Context;
  const PatchScene* Scene;
  const Candidate* Candidates;
  vtkIdType From; // places that do not stop it
  vtkIdType To;
  Vector Origin;
  Vector Target;
  Vector Direction;
  double LargestSideRounding; // over the length of the edge

  double HitFraction = std::numeric_limits<double>::infinity();
  vtkIdType HitPatch = -1;
  bool HitFront = false;

  Segment(const Vector& origin, const Vector& target)
    : Origin(origin), Target(target), Direction(target - origin),
      LargestSideRounding(SideRounding * this->Direction.lpNorm<1>())
  {
  }

  // On which side of the segment's line an edge passes: 0 where rounding decides. The edge comes
  // from its ends: a difference of vectors from the origin would lose the digits of a short one.
  double GetSide(const Vector& a, const Vector& b) const
  {
    const Vector edge = b - a;
    const double side = this->Direction.dot((a - this->Origin).cross(edge));
    return std::abs(side) <= this->LargestSideRounding * edge.lpNorm<1>() ? 0.0 : side;
  }

  // Whether the segment's line meets a patch or its border. Triangles of a fan, because corners
  // within the tolerance of PatchScene may be a little concave.
  bool Meets(vtkIdType patch) const
  {
    const vtkIdType* corners = this->Scene->GetCorners(patch);
    const int count = this->Scene->GetNumberOfCorners(patch);
    const Vector* points = this->Scene->GetPoints().data();
    const Vector& first = points[corners[0]];
    double begin = this->GetSide(first, points[corners[1]]);
    for (int corner = 2; corner < count; ++corner)
    {
      const Vector& last = points[corners[corner]];
      const double outer = this->GetSide(points[corners[corner - 1]], last);
      if (corner + 1 == count && begin * outer < 0.0)
      {
        return false; // as most candidates: the last side need not be known
      }
      const double end = this->GetSide(last, first);
      if ((begin >= 0.0 && outer >= 0.0 && end >= 0.0) ||
        (begin <= 0.0 && outer <= 0.0 && end <= 0.0))
      {
        return true;
      }
      begin = -end;
    }
    return false;
  }

  // Whether a patch is in the way; also the heights of both ends over its plane.
  bool Crosses(const Candidate& candidate, double& from, double& to) const
  {
    from = candidate.GetHeight(this->Origin);
    to = candidate.GetHeight(this->Target);
    // What an end lies on, or continues in the same plane, is not between the ends.
    const bool through = (from > HeightRounding && to < -HeightRounding) ||
      (from < -HeightRounding && to > HeightRounding);
    return through && candidate.Place != this->From && candidate.Place != this->To &&
      this->Meets(candidate.Patch);
  }

  void AddHit(vtkIdType patch, double from, double to)
  {
    const double fraction = from / (from - to);
    const double rounding = HeightRounding / std::abs(from - to);
    const bool front = from > 0.0;
    const bool same = std::abs(fraction - this->HitFraction) <= rounding;
    if (same ? front && !this->HitFront : fraction < this->HitFraction)
    {
      this->HitFraction = fraction;
      this->HitPatch = patch;
      this->HitFront = front;
    }
  }

  void SetRay(RTCRay& ray) const
  {
    ray.org_x = static_cast<float>(this->Origin.x());
    ray.org_y = static_cast<float>(this->Origin.y());
    ray.org_z = static_cast<float>(this->Origin.z());
    ray.dir_x = static_cast<float>(this->Direction.x());
    ray.dir_y = static_cast<float>(this->Direction.y());
    ray.dir_z = static_cast<float>(this->Direction.z());
    ray.tnear = 0.0f;
    ray.tfar = 1.0f;
    ray.time = 0.0f;
    ray.mask = std::numeric_limits<unsigned int>::max();
    ray.id = 0;
    ray.flags = 0;
  }
};

//------------------------------------------------------------------------------
// For each patch the first one with the same corners: the two sides of a thin wall are one place,
// and neither may stop the rays of the other.
std::vector<vtkIdType> FindPlaces(const PatchScene& scene)
{
  std::map<std::vector<vtkIdType>, vtkIdType> first;
  std::vector<vtkIdType> places;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const vtkIdType* corners = scene.GetCorners(patch);
    std::vector<vtkIdType> key(corners, corners + scene.GetNumberOfCorners(patch));
    std::sort(key.begin(), key.end());
    places.push_back(first.emplace(std::move(key), patch).first->second);
  }
  return places;
}

//------------------------------------------------------------------------------
void TestOccluded(const RTCOccludedFunctionNArguments* arguments)
{
  const auto* segment = reinterpret_cast<const Segment*>(arguments->context);
  double from, to;
  if (segment->Crosses(segment->Candidates[arguments->primID], from, to))
  {
    RTCRayN_tfar(arguments->ray, 1, 0) = -std::numeric_limits<float>::infinity();
  }
}

//------------------------------------------------------------------------------
void TestIntersected(const RTCIntersectFunctionNArguments* arguments)
{
  auto* segment = reinterpret_cast<Segment*>(arguments->context);
  const Candidate& candidate = segment->Candidates[arguments->primID];
  double from, to;
  if (segment->Crosses(candidate, from, to))
  {
    segment->AddHit(candidate.Patch, from, to);
    // Embree may leave out what is certainly further away.
    RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, 1), 1, 0) =
      static_cast<float>(segment->HitFraction) + BoxMargin;
  }
}
} // namespace

struct SceneRayCaster::Internals
{
  RTCDevice Device = nullptr;
  RTCScene Tree = nullptr;
  const PatchScene* Scene = nullptr;
  std::vector<vtkIdType> Places;
  std::vector<Candidate> Candidates;

  ~Internals() { this->Close(); }

  void Close()
  {
    if (this->Tree)
    {
      rtcReleaseScene(this->Tree);
    }
    if (this->Device)
    {
      rtcReleaseDevice(this->Device);
    }
    this->Tree = nullptr;
    this->Device = nullptr;
    this->Candidates.clear();
  }

  Segment MakeSegment(const Vector& origin, const Vector& target, vtkIdType from,
    vtkIdType to) const
  {
    Segment segment(origin, target);
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&segment.Context);
#else
    rtcInitIntersectContext(&segment.Context);
#endif
    segment.Scene = this->Scene;
    segment.Candidates = this->Candidates.data();
    segment.From = this->Places[from];
    segment.To = to < 0 ? to : this->Places[to];
    return segment;
  }

  void AddPatches(const PatchScene& scene, const std::vector<bool>* subset);
  static void FindBox(const RTCBoundsFunctionArguments* arguments);
};

//------------------------------------------------------------------------------
void SceneRayCaster::Internals::AddPatches(const PatchScene& scene, const std::vector<bool>* subset)
{
  this->Scene = &scene;
  this->Places = FindPlaces(scene);
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    if (!subset || (*subset)[patch])
    {
      const Vector& normal = scene.GetNormal(patch);
      const double offset = normal.dot(scene.GetCentroid(patch));
      this->Candidates.push_back({ normal, offset, patch, this->Places[patch] });
    }
  }
  RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(this->Candidates.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, FindBox, nullptr);
  rtcSetGeometryOccludedFunction(geometry, TestOccluded);
  rtcSetGeometryIntersectFunction(geometry, TestIntersected);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Tree, geometry);
  rtcReleaseGeometry(geometry);
}

//------------------------------------------------------------------------------
void SceneRayCaster::Internals::FindBox(const RTCBoundsFunctionArguments* arguments)
{
  const auto* self = static_cast<const Internals*>(arguments->geometryUserPtr);
  const vtkIdType patch = self->Candidates[arguments->primID].Patch;
  Vector low = self->Scene->GetCorner(patch, 0);
  Vector high = low;
  for (int corner = 1; corner < self->Scene->GetNumberOfCorners(patch); ++corner)
  {
    low = low.cwiseMin(self->Scene->GetCorner(patch, corner));
    high = high.cwiseMax(self->Scene->GetCorner(patch, corner));
  }
  RTCBounds* box = arguments->bounds_o;
  box->lower_x = static_cast<float>(low.x()) - BoxMargin;
  box->lower_y = static_cast<float>(low.y()) - BoxMargin;
  box->lower_z = static_cast<float>(low.z()) - BoxMargin;
  box->upper_x = static_cast<float>(high.x()) + BoxMargin;
  box->upper_y = static_cast<float>(high.y()) + BoxMargin;
  box->upper_z = static_cast<float>(high.z()) + BoxMargin;
}

//------------------------------------------------------------------------------
SceneRayCaster::SceneRayCaster() : Internal(new Internals) {}

//------------------------------------------------------------------------------
SceneRayCaster::~SceneRayCaster() = default;

//------------------------------------------------------------------------------
Outcome SceneRayCaster::Build(const PatchScene& scene, const std::vector<bool>* subset)
{
  this->Internal->Close();
  // Rays come from the threads of vtkSMPTools; Embree's own would only build the tree.
  this->Internal->Device = rtcNewDevice("threads=1");
  bool ok = this->Internal->Device != nullptr;
  if (ok)
  {
    this->Internal->Tree = rtcNewScene(this->Internal->Device);
    this->Internal->AddPatches(scene, subset);
    rtcCommitScene(this->Internal->Tree);
    ok = rtcGetDeviceError(this->Internal->Device) == RTC_ERROR_NONE;
  }
  if (!ok)
  {
    this->Internal->Close();
    return Outcome::Failed("Embree could not build its tree of " +
      std::to_string(scene.GetNumberOfPatches()) +
      " patches: use fewer patches or a machine with more memory.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
bool SceneRayCaster::IsOccluded(const Vector& origin, const Vector& target, vtkIdType from,
  vtkIdType to) const
{
  Segment segment = this->Internal->MakeSegment(origin, target, from, to);
  RTCRay ray;
  segment.SetRay(ray);
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &segment.Context;
  rtcOccluded1(this->Internal->Tree, &ray, &arguments);
#else
  rtcOccluded1(this->Internal->Tree, &segment.Context, &ray);
#endif
  return ray.tfar < 0.0f;
}

//------------------------------------------------------------------------------
vtkIdType SceneRayCaster::FindHit(const Vector& origin, const Vector& direction, vtkIdType from,
  bool& front) const
{
  Segment segment =
    this->Internal->MakeSegment(origin, origin + OutOfScene * direction.normalized(), from, -1);
  RTCRayHit hit;
  segment.SetRay(hit.ray);
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &segment.Context;
  rtcIntersect1(this->Internal->Tree, &hit, &arguments);
#else
  rtcIntersect1(this->Internal->Tree, &segment.Context, &hit);
#endif
  front = segment.HitFront;
  return segment.HitPatch;
}
} // namespace LightTransport
