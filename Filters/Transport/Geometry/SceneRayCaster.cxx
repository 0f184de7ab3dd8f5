// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/SceneRayCaster.h"

#include "Geometry/EmbreeTree.h"
#include "Shared/Pulse.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;

// Several times what the coordinates of boxes and rays lose in single precision, and what Embree's
// arithmetic adds, in a scene whose diagonal is 1: a ray that meets a patch meets its box.
constexpr float BoxMargin = 1e-6f;
// Rounding in double precision in such a scene of the side on which an edge passes (a bound of its
// arithmetic).
constexpr double SideRounding = 4.0 * std::numeric_limits<double>::epsilon();
// Longer than the scene.
constexpr double OutOfScene = 2.0;

//------------------------------------------------------------------------------
// A primitive of Embree: what tells that most of them are not in the way lies side by side.
struct Candidate
{
  Vector Normal;
  double Offset;   // Normal . p in the plane of the patch
  double Rounding; // of heights over it, and how that grows with the distance
  double Slope;
  double EdgeRounding;
  vtkIdType Patch;

  double GetHeight(const Vector& point) const { return this->Normal.dot(point) - this->Offset; }
};

//------------------------------------------------------------------------------
// The nearest patch of those that a ray meets with the same side.
struct Hit
{
  double Fraction = std::numeric_limits<double>::infinity();
  double Rounding = 0.0; // of the fraction
  vtkIdType Patch = -1;
  bool IsBeside = false; // met within the rounding of its edges only

  // Of two in one place the one counts that is really met, and else the first one.
  void Add(const Hit& other)
  {
    const double rounding = std::max(this->Rounding, other.Rounding);
    const bool isSame = std::abs(other.Fraction - this->Fraction) <= rounding;
    const bool isBetter =
      std::tie(other.IsBeside, other.Patch) < std::tie(this->IsBeside, this->Patch);
    if (isSame ? isBetter : other.Fraction < this->Fraction)
    {
      *this = other;
    }
  }
};

//------------------------------------------------------------------------------
// A segment on its way through the scene and the nearest patch that it has met. Embree hands the
// first member back to the functions that test candidates.
struct Segment
{
  EmbreeTree::Context Context;
  const PatchScene* Scene;
  const Candidate* Candidates;
  vtkIdType From; // patches that do not stop it
  vtkIdType To;
  Vector Origin;
  Vector Target;
  Vector Direction;
  double Length;

  Hit Front;
  Hit Back;
  // Where all that is met is wanted; else nullptr.
  std::vector<SceneRayCaster::Crossing>* All = nullptr;

  Segment(const Vector& origin, const Vector& target)
    : Origin(origin), Target(target), Direction(target - origin), Length(this->Direction.norm())
  {
  }

  // On which side of the segment's line an edge passes: 0 where rounding decides. The edge comes
  // from its ends: a difference of vectors from the origin would lose the digits of a short one.
  double GetSide(const Vector& a, const Vector& b, double rounding) const
  {
    const Vector edge = b - a;
    const double side = this->Direction.dot((a - this->Origin).cross(edge));
    return std::abs(side) <= rounding * edge.lpNorm<1>() ? 0.0 : side;
  }

  // Whether the segment's line meets a patch or its border. Triangles of a fan, because corners
  // within the tolerance of PatchScene may be a little concave.
  bool Meets(const Candidate& candidate, double edgeRounding) const
  {
    const vtkIdType* corners = this->Scene->GetCorners(candidate.Patch);
    const int count = this->Scene->GetNumberOfCorners(candidate.Patch);
    const double rounding =
      SideRounding * this->Direction.lpNorm<1>() + edgeRounding * this->Length;
    const Vector* points = this->Scene->GetPoints().data();
    const Vector& first = points[corners[0]];
    double begin = this->GetSide(first, points[corners[1]], rounding);
    for (int corner = 2; corner < count; ++corner)
    {
      const Vector& last = points[corners[corner]];
      const double outer = this->GetSide(points[corners[corner - 1]], last, rounding);
      if (corner + 1 == count && begin * outer < 0.0)
      {
        return false; // as most candidates: the last side need not be known
      }
      const double end = this->GetSide(last, first, rounding);
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
    return (from > 0.0) != (to > 0.0) && this->IsThrough(candidate, from, to) &&
      candidate.Patch != this->From && candidate.Patch != this->To &&
      this->Meets(candidate, candidate.EdgeRounding);
  }

  // What an end lies on, or continues in the same plane, is not between the ends.
  bool IsThrough(const Candidate& candidate, double from, double to) const
  {
    const double left = std::abs(from) - candidate.Rounding;
    const double right = std::abs(to) - candidate.Rounding;
    // Heights over the whole length: what one end gets of it is the distance to the plane.
    const double slope = candidate.Slope * this->Length / std::abs(from - to);
    return left > slope * std::abs(from) && right > slope * std::abs(to);
  }

  void AddHit(const Candidate& candidate, double from, double to)
  {
    const double height = std::abs(from - to);
    (from > 0.0 ? this->Front : this->Back)
      .Add({ from / (from - to), candidate.Rounding / height, candidate.Patch,
        !this->Meets(candidate, 0.0) });
  }

  // Of two sides in one place the one that faces the ray is first.
  bool IsFrontFirst() const
  {
    return this->Front.Patch >= 0 &&
      this->Front.Fraction <=
      this->Back.Fraction + std::max(this->Front.Rounding, this->Back.Rounding);
  }

  // Patches further away than this are not met first.
  double GetReach() const
  {
    const Hit& nearest = this->Front.Fraction < this->Back.Fraction ? this->Front : this->Back;
    return nearest.Fraction + nearest.Rounding;
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
  if (!segment->Crosses(candidate, from, to))
  {
    return;
  }
  if (segment->All)
  {
    segment->All->push_back(
      { from / (from - to), candidate.Rounding / std::abs(from - to), candidate.Patch });
  }
  else
  {
    segment->AddHit(candidate, from, to);
    // Embree may leave out what is certainly further away.
    RTCRayN_tfar(RTCRayHitN_RayN(arguments->rayhit, 1), 1, 0) =
      std::min(1.0f, static_cast<float>(segment->GetReach()) + BoxMargin);
  }
}
} // namespace

struct SceneRayCaster::Internals
{
  EmbreeTree Tree;
  const PatchScene* Scene = nullptr;
  std::vector<Candidate> Candidates;

  Segment MakeSegment(const Vector& origin, const Vector& target, vtkIdType from,
    vtkIdType to) const
  {
    Segment segment(origin, target);
    EmbreeTree::Initialize(segment.Context);
    segment.Scene = this->Scene;
    segment.Candidates = this->Candidates.data();
    segment.From = from;
    segment.To = to;
    return segment;
  }

  void AddPatches(const PatchScene& scene, const std::vector<bool>* subset);
  static void FindBox(const RTCBoundsFunctionArguments* arguments);
};

//------------------------------------------------------------------------------
void SceneRayCaster::Internals::AddPatches(const PatchScene& scene, const std::vector<bool>* subset)
{
  this->Scene = &scene;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    if (!subset || (*subset)[patch])
    {
      const PatchPlane plane = scene.GetPlane(patch);
      this->Candidates.push_back({ plane.Normal, plane.Normal.dot(plane.Origin), plane.Rounding,
        plane.Slope, scene.GetEdgeRounding(patch), patch });
    }
  }
  RTCGeometry geometry = rtcNewGeometry(this->Tree.GetDevice(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned int>(this->Candidates.size()));
  rtcSetGeometryUserData(geometry, this);
  rtcSetGeometryBoundsFunction(geometry, FindBox, nullptr);
  rtcSetGeometryOccludedFunction(geometry, TestOccluded);
  rtcSetGeometryIntersectFunction(geometry, TestIntersected);
  this->Tree.Attach(geometry);
}

//------------------------------------------------------------------------------
void SceneRayCaster::Internals::FindBox(const RTCBoundsFunctionArguments* arguments)
{
  const auto* self = static_cast<const Internals*>(arguments->geometryUserPtr);
  const Candidate& candidate = self->Candidates[arguments->primID];
  const vtkIdType patch = candidate.Patch;
  const float margin = BoxMargin + static_cast<float>(candidate.EdgeRounding);
  Vector low = self->Scene->GetCorner(patch, 0);
  Vector high = low;
  for (int corner = 1; corner < self->Scene->GetNumberOfCorners(patch); ++corner)
  {
    low = low.cwiseMin(self->Scene->GetCorner(patch, corner));
    high = high.cwiseMax(self->Scene->GetCorner(patch, corner));
  }
  RTCBounds* box = arguments->bounds_o;
  box->lower_x = static_cast<float>(low.x()) - margin;
  box->lower_y = static_cast<float>(low.y()) - margin;
  box->lower_z = static_cast<float>(low.z()) - margin;
  box->upper_x = static_cast<float>(high.x()) + margin;
  box->upper_y = static_cast<float>(high.y()) + margin;
  box->upper_z = static_cast<float>(high.z()) + margin;
}

//------------------------------------------------------------------------------
SceneRayCaster::SceneRayCaster() : Internal(new Internals) {}

//------------------------------------------------------------------------------
SceneRayCaster::~SceneRayCaster() = default;

//------------------------------------------------------------------------------
Outcome SceneRayCaster::Build(const PatchScene& scene, const std::vector<bool>* subset)
{
  Internals& self = *this->Internal;
  self.Candidates.clear();
  if (self.Tree.Open())
  {
    self.AddPatches(scene, subset);
  }
  return self.Tree.Build(scene.GetNumberOfPatches());
}

//------------------------------------------------------------------------------
bool SceneRayCaster::IsOccluded(const Vector& origin, const Vector& target, vtkIdType from,
  vtkIdType to) const
{
  Segment segment = this->Internal->MakeSegment(origin, target, from, to);
  RTCRay ray;
  segment.SetRay(ray);
  this->Internal->Tree.FindOccluded(segment.Context, ray);
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
  this->Internal->Tree.Intersect(segment.Context, hit);
  front = segment.IsFrontFirst();
  return front ? segment.Front.Patch : segment.Back.Patch;
}

//------------------------------------------------------------------------------
void SceneRayCaster::FindCrossings(const Vector& origin, const Vector& target, vtkIdType from,
  vtkIdType to, std::vector<Crossing>& found) const
{
  found.clear();
  Segment segment = this->Internal->MakeSegment(origin, target, from, to);
  segment.All = &found;
  RTCRayHit hit;
  segment.SetRay(hit.ray);
  this->Internal->Tree.Intersect(segment.Context, hit);
}
} // namespace LightTransport
