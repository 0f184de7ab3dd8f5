// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/PatchRays.h"

#include "Geometry/EmbreeTree.h"
#include "Geometry/PatchSampler.h"
#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"
#include "Shared/Pulse.h"
#include "Shared/Threads.h"
#include "Support/InstructionSets.h"
#include "Support/SplitMix.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace LightTransport
{
namespace
{
using Vector = PatchScene::Vector;
constexpr int Lanes = RayPattern::Lanes;

// How far above a patch its rays start, in a scene whose diagonal is 1: what single precision may
// lose of a coordinate, several times. Beside it what coordinates are worth.
constexpr float Lift = 2.5e-7f;
// Heights of the start over the plane that a ray meets, from which on single precision tells that
// it meets the front.
constexpr float CertainHeight = 2e-6f;
// Distance from the rim, where a ray may start beyond a neighbour: beside what coordinates are
// worth, twice.
constexpr float RimWidth = 16.0f * Lift;
// The cosine from which on two normals are those of surfaces that face each other.
constexpr float Facing = 0.95f;

/// A part of a patch that Embree knows.
struct Facet
{
  float Normal[3];
  float Height; ///< of the start over the plane that is certain at the patch
  float Slope;  ///< and how that grows with the distance
  PatchRays::Hit Patch;
  PatchRays::Hit Twin; ///< the patch with the same corners that faces the other way, or -1
};

/// A parallelogram, half of it, or a triangle of a fan: points are Origin + u U + v V.
struct Corner
{
  float Origin[3];
  float U[3];
  float V[3];
};

/// Rays at work.
struct alignas(64) Bundle
{
  float Numbers[RayPattern::Dimensions][Lanes];
  float Points[3][Lanes]; ///< where they start on the patch
  float Rims[Lanes];      ///< and how far from its rim; below 0 where that is not known
  RTCRayHit16 Rays;
};

/// What rays of a patch have alike.
struct Frame
{
  std::uint32_t Seeds[RayPattern::Dimensions];
  Corner First;
  bool IsFolded;    ///< a triangle, half of what u and v cover
  float Heights[3]; ///< of the sides u = 0, v = 0 and, folded, u + v = 1, to what is opposite
  float Tangent[3];
  float Other[3];
  float Normal[3];
  float Lift;              ///< above the patch, where rays start
  float Rim;               ///< from which on they do so for certain
  std::vector<Corner> Fan; ///< of a polygon that is neither a triangle nor a parallelogram
  std::vector<float> Ends; ///< of each of its triangles: the area up to there, relative
};

//------------------------------------------------------------------------------
void Copy(const Vector& vector, float* target)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    target[axis] = static_cast<float>(vector[axis]);
  }
}

//------------------------------------------------------------------------------
LT_INLINE void SetNumbers(const RayPattern::Packet& packet, const Frame& frame, Bundle& bundle)
{
  for (int dimension = 0; dimension < RayPattern::Dimensions; ++dimension)
  {
    for (int lane = 0; lane < Lanes; ++lane)
    {
      const std::uint32_t digits = OwenScrambling::Reverse(
        OwenScrambling::ScrambleReversed(packet.Digits[dimension][lane], frame.Seeds[dimension]));
      // Single precision holds 24 digits; none of the numbers is 0 or 1.
      bundle.Numbers[dimension][lane] =
        static_cast<float>(static_cast<std::int32_t>(digits >> 8)) * 0x1p-24f + 0x1p-25f;
    }
  }
}

//------------------------------------------------------------------------------
LT_INLINE void SetPoints(const Frame& frame, Bundle& bundle)
{
  for (int lane = 0; lane < Lanes; ++lane)
  {
    float u = bundle.Numbers[0][lane];
    float v = bundle.Numbers[1][lane];
    const bool isBeyond = frame.IsFolded && u + v > 1.0f;
    u = isBeyond ? 1.0f - u : u;
    v = isBeyond ? 1.0f - v : v;
    for (int axis = 0; axis < 3; ++axis)
    {
      bundle.Points[axis][lane] =
        frame.First.Origin[axis] + u * frame.First.U[axis] + v * frame.First.V[axis];
    }
    const float least = std::min(u * frame.Heights[0], v * frame.Heights[1]);
    const float most = frame.IsFolded
      ? (1.0f - u - v) * frame.Heights[2]
      : std::min((1.0f - u) * frame.Heights[0], (1.0f - v) * frame.Heights[1]);
    bundle.Rims[lane] = std::min(least, most);
  }
}

//------------------------------------------------------------------------------
// Of a polygon with many corners: first the triangle, by the stretched number.
void SetPointsOfFan(const Frame& frame, Bundle& bundle)
{
  for (int lane = 0; lane < Lanes; ++lane)
  {
    float u = bundle.Numbers[0][lane];
    float v = bundle.Numbers[1][lane];
    const auto end =
      std::min(std::upper_bound(frame.Ends.begin(), frame.Ends.end(), u), frame.Ends.end() - 1);
    const float begin = end == frame.Ends.begin() ? 0.0f : end[-1];
    u = std::min((u - begin) / std::max(*end - begin, 1e-30f), 1.0f);
    if (u + v > 1.0f)
    {
      u = 1.0f - u;
      v = 1.0f - v;
    }
    const Corner& corner = frame.Fan[end - frame.Ends.begin()];
    bundle.Rims[lane] = -1.0f;
    for (int axis = 0; axis < 3; ++axis)
    {
      bundle.Points[axis][lane] = corner.Origin[axis] + u * corner.U[axis] + v * corner.V[axis];
    }
  }
}

//------------------------------------------------------------------------------
// Evenly in projected solid angle: rings of the square become rings of the disk (P. Shirley,
// K. Chiu, "A Low Distortion Map Between Disk and Square", JGT 2, 1997). Sine and cosine of at most
// an eighth of a turn by their series, whose next terms are below single precision.
LT_INLINE void SetRays(const Frame& frame, Bundle& bundle)
{
  constexpr float quarterPi = 0.785398163397f;
  RTCRay16& ray = bundle.Rays.ray;
  for (int lane = 0; lane < Lanes; ++lane)
  {
    const float u = 2.0f * bundle.Numbers[2][lane] - 1.0f;
    const float v = 2.0f * bundle.Numbers[3][lane] - 1.0f;
    const bool isFlat = std::abs(u) > std::abs(v);
    const float radius = isFlat ? u : v;
    const float x = quarterPi * (isFlat ? v : u) / (radius != 0.0f ? radius : 1.0f);
    const float y = x * x;
    const float sine =
      x * (1.0f + y * (-1.0f / 6 + y * (1.0f / 120 + y * (-1.0f / 5040 + y / 362880.0f))));
    const float cosine =
      1.0f + y * (-1.0f / 2 + y * (1.0f / 24 + y * (-1.0f / 720 + y * (1.0f / 40320))));
    const float a = radius * (isFlat ? cosine : sine);
    const float b = radius * (isFlat ? sine : cosine);
    const float c = std::sqrt(1.0f - radius * radius);
    ray.org_x[lane] = bundle.Points[0][lane] + frame.Lift * frame.Normal[0];
    ray.org_y[lane] = bundle.Points[1][lane] + frame.Lift * frame.Normal[1];
    ray.org_z[lane] = bundle.Points[2][lane] + frame.Lift * frame.Normal[2];
    ray.dir_x[lane] = a * frame.Tangent[0] + b * frame.Other[0] + c * frame.Normal[0];
    ray.dir_y[lane] = a * frame.Tangent[1] + b * frame.Other[1] + c * frame.Normal[1];
    ray.dir_z[lane] = a * frame.Tangent[2] + b * frame.Other[2] + c * frame.Normal[2];
    ray.tnear[lane] = 0.0f;
    ray.tfar[lane] = std::numeric_limits<float>::infinity();
    ray.time[lane] = 0.0f;
    ray.mask[lane] = 0xFFFFFFFFu;
    ray.id[lane] = lane;
    ray.flags[lane] = 0;
    bundle.Rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    bundle.Rays.hit.primID[lane] = 0;
    bundle.Rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
}

//------------------------------------------------------------------------------
LT_CLONES void MakeRays(const RayPattern::Packet& packet, const Frame& frame, Bundle& bundle)
{
  SetNumbers(packet, frame, bundle);
  frame.Fan.empty() ? SetPoints(frame, bundle) : SetPointsOfFan(frame, bundle);
  SetRays(frame, bundle);
}

//------------------------------------------------------------------------------
// Whether a part does not just face what has this frame: then it is no other surface in its place.
bool IsAside(const Facet& facet, const Frame& frame)
{
  return facet.Normal[0] * frame.Normal[0] + facet.Normal[1] * frame.Normal[1] +
    facet.Normal[2] * frame.Normal[2] >
    -Facing;
}

//------------------------------------------------------------------------------
bool IsParallelogram(const Vector* corners, int count)
{
  return count == 4 &&
    (corners[0] - corners[1] + corners[2] - corners[3]).norm() <=
    1e-6 * (corners[2] - corners[0]).norm();
}
} // namespace

struct PatchRays::Internals
{
  const PatchScene* Scene = nullptr;
  EmbreeTree Tree;
  SceneRayCaster Caster;
  std::vector<Facet> Facets;
  std::vector<char> IsNarrow; ///< patches that have others right before them
  bool IsWhole = false;       ///< after Build

  void AddPatches();
  std::vector<Hit> FindTwins() const;
  void FindNarrow();
  Frame MakeFrame(vtkIdType patch) const;
  Vector GetPoint(vtkIdType patch, const Frame& frame, double u, double v) const;
  Hit Decide(vtkIdType patch, const Vector& origin, const Vector& direction) const;
  bool IsAtRim(vtkIdType patch, const Vector& origin, double margin) const;

  /// What a ray meets in single precision: a part of a patch, or none.
  struct Meeting
  {
    const Facet* Part;
    float Distance;
    float Cosine; ///< with its normal, above 0 from in front
  };
  Vector GetStart(vtkIdType patch, const Frame& frame, const Bundle& bundle, int lane) const;
  bool IsRough(vtkIdType patch, const Frame& frame, const Bundle& bundle, int lane) const;
  Meeting GetMeeting(const Bundle& bundle, int lane) const;
  static Hit FindCertain(vtkIdType patch, const Meeting& meeting);
  bool IsOfNeighbour(vtkIdType patch, const Frame& frame, const Meeting& meeting,
    const Vector& origin) const;
  Hit Judge(vtkIdType patch, const Frame& frame, const Bundle& bundle, int lane) const;
};

//------------------------------------------------------------------------------
// The sides of sheets, and of walls that are meshed alike on both: of two patches with the same
// corners one faces the other way.
std::vector<PatchRays::Hit> PatchRays::Internals::FindTwins() const
{
  const PatchScene& scene = *this->Scene;
  const auto patches = static_cast<Hit>(scene.GetNumberOfPatches());
  std::vector<std::pair<std::uint64_t, Hit>> order(patches);
  const auto getCorners = [&](Hit patch)
  {
    const vtkIdType* corners = scene.GetCorners(patch);
    std::vector<vtkIdType> sorted(corners, corners + scene.GetNumberOfCorners(patch));
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  };
  for (Hit patch = 0; patch < patches; ++patch)
  {
    Pulse::Beat(patch);
    const vtkIdType* corners = scene.GetCorners(patch);
    std::uint64_t sum = 0;
    for (int corner = 0; corner < scene.GetNumberOfCorners(patch); ++corner)
    {
      sum += SplitMix(static_cast<std::uint64_t>(corners[corner])).GetNext();
    }
    order[patch] = { sum, patch };
  }
  std::sort(order.begin(), order.end());
  std::vector<Hit> twins(patches, -1);
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    const Hit one = order[k - 1].second;
    const Hit other = order[k].second;
    if (order[k - 1].first == order[k].first && getCorners(one) == getCorners(other) &&
      scene.GetNormal(one).dot(scene.GetNormal(other)) < 0.0)
    {
      twins[one] = other;
      twins[other] = one;
    }
  }
  return twins;
}

//------------------------------------------------------------------------------
void PatchRays::Internals::AddPatches()
{
  const PatchScene& scene = *this->Scene;
  const std::vector<int>& problems = scene.GetProblems();
  const std::vector<Hit> twins = this->FindTwins();
  std::vector<unsigned int> corners;
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    Pulse::Beat(patch);
    const PatchPlane plane = scene.GetPlane(patch);
    const bool isShared = (problems[scene.GetFaces().GetFace(patch)] & SceneFaces::COINCIDENT) != 0;
    Facet facet{ {},
      isShared ? std::numeric_limits<float>::infinity()
               : CertainHeight + static_cast<float>(plane.Rounding),
      static_cast<float>(plane.Slope), static_cast<Hit>(patch), twins[patch] };
    Copy(plane.Normal, facet.Normal);
    // Quadrilaterals of a fan; a triangle is one with a corner that is there twice.
    const vtkIdType* points = scene.GetCorners(patch);
    const int count = scene.GetNumberOfCorners(patch);
    for (int corner = 1; corner + 1 < count; corner += 2)
    {
      const vtkIdType last = points[std::min(corner + 2, count - 1)];
      for (const vtkIdType point : { points[0], points[corner], points[corner + 1], last })
      {
        corners.push_back(static_cast<unsigned int>(point));
      }
      this->Facets.push_back(facet);
    }
  }
  RTCGeometry geometry = rtcNewGeometry(this->Tree.GetDevice(), RTC_GEOMETRY_TYPE_QUAD);
  auto* places = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.GetPoints().size()));
  auto* indices = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry,
    RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned int), corners.size() / 4));
  if (places && indices)
  {
    for (const Vector& point : scene.GetPoints())
    {
      Copy(point, places);
      places += 3;
    }
    std::copy(corners.begin(), corners.end(), indices);
  }
  this->Tree.Attach(geometry);
}

//------------------------------------------------------------------------------
// Rays that start above such a patch may start beyond what is before it.
void PatchRays::Internals::FindNarrow()
{
  const PatchScene& scene = *this->Scene;
  this->IsNarrow.assign(scene.GetNumberOfPatches(), 0);
  const auto look = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType patch = begin; patch < end; ++patch)
    {
      Pulse::Beat(patch);
      const Vector& origin = scene.GetCentroid(patch);
      bool front = false;
      const vtkIdType hit = this->Caster.FindHit(origin, scene.GetNormal(patch), patch, front);
      this->IsNarrow[patch] = hit >= 0 &&
          std::abs(scene.GetPlane(hit).GetHeight(origin)) <
            CertainHeight + 2.0 * (scene.GetPlane(patch).Rounding + scene.GetPlane(hit).Rounding)
        ? 1
        : 0;
    }
  };
  Threads::For(0, scene.GetNumberOfPatches(), 0, look);
}

//------------------------------------------------------------------------------
Frame PatchRays::Internals::MakeFrame(vtkIdType patch) const
{
  const PatchScene& scene = *this->Scene;
  Vector corners[PatchGeometry::MaximumCorners];
  const int count = scene.GetNumberOfCorners(patch);
  for (int corner = 0; corner < count; ++corner)
  {
    corners[corner] = scene.GetCorner(patch, corner);
  }
  Frame frame{};
  SplitMix bits(static_cast<std::uint64_t>(patch));
  for (std::uint32_t& seed : frame.Seeds)
  {
    seed = bits.GetNextHalf();
  }
  const Vector& normal = scene.GetNormal(patch);
  const Vector tangent = normal.unitOrthogonal();
  Copy(normal, frame.Normal);
  Copy(tangent, frame.Tangent);
  Copy(normal.cross(tangent), frame.Other);
  frame.Lift = Lift + static_cast<float>(scene.GetPlane(patch).Rounding);
  frame.Rim = RimWidth + 2.0f * static_cast<float>(scene.GetPlane(patch).Rounding);
  const auto makeCorner = [&](const Vector& u, const Vector& v)
  {
    Corner made{};
    Copy(corners[0], made.Origin);
    Copy(u - corners[0], made.U);
    Copy(v - corners[0], made.V);
    return made;
  };
  frame.IsFolded = count == 3;
  frame.First = makeCorner(corners[1], corners[count - 1]);
  const Vector u = corners[1] - corners[0];
  const Vector v = corners[count - 1] - corners[0];
  const double area = u.cross(v).norm();
  const Vector sides[3] = { v, u, u - v };
  std::transform(sides, sides + 3, frame.Heights,
    [area](const Vector& side) { return static_cast<float>(area / side.norm()); });
  if (count > 3 && !IsParallelogram(corners, count))
  {
    double whole = 0.0;
    for (int corner = 2; corner < count; ++corner)
    {
      frame.Fan.push_back(makeCorner(corners[corner - 1], corners[corner]));
      const Vector side = corners[corner - 1] - corners[0];
      whole += std::max(0.0, side.cross(corners[corner] - corners[0]).dot(normal));
      frame.Ends.push_back(static_cast<float>(whole));
    }
    for (float& end : frame.Ends)
    {
      end /= static_cast<float>(whole);
    }
  }
  return frame;
}

//------------------------------------------------------------------------------
// As SetPoints, in double precision: single precision may be beyond the rim.
Vector PatchRays::Internals::GetPoint(vtkIdType patch, const Frame& frame, double u, double v) const
{
  int second = 1;
  int third = this->Scene->GetNumberOfCorners(patch) - 1;
  if (!frame.Fan.empty())
  {
    const auto end =
      std::min(std::upper_bound(frame.Ends.begin(), frame.Ends.end(), static_cast<float>(u)),
        frame.Ends.end() - 1);
    const double begin = end == frame.Ends.begin() ? 0.0 : static_cast<double>(end[-1]);
    u = std::min((u - begin) / std::max(static_cast<double>(*end) - begin, 1e-30), 1.0);
    second = static_cast<int>(end - frame.Ends.begin()) + 1;
    third = second + 1;
  }
  if ((frame.IsFolded || !frame.Fan.empty()) && u + v > 1.0)
  {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Vector& origin = this->Scene->GetCorner(patch, 0);
  return origin + u * (this->Scene->GetCorner(patch, second) - origin) +
    v * (this->Scene->GetCorner(patch, third) - origin);
}

//------------------------------------------------------------------------------
PatchRays::Hit PatchRays::Internals::Decide(vtkIdType patch, const Vector& origin,
  const Vector& direction) const
{
  bool front = false;
  const vtkIdType hit = this->Caster.FindHit(origin, direction, patch, front);
  const auto number = static_cast<Hit>(hit);
  return hit < 0 || front ? number : FromBehind(number);
}

//------------------------------------------------------------------------------
bool PatchRays::Internals::IsAtRim(vtkIdType patch, const Vector& origin, double margin) const
{
  const PatchScene& scene = *this->Scene;
  const Vector& normal = scene.GetNormal(patch);
  const int count = scene.GetNumberOfCorners(patch);
  for (int corner = 0; corner < count; ++corner)
  {
    const Vector& begin = scene.GetCorner(patch, corner);
    const Vector inward = normal.cross(scene.GetCorner(patch, (corner + 1) % count) - begin);
    if (inward.dot(origin - begin) < margin * inward.norm())
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
// In double precision, as SetPoints.
Vector PatchRays::Internals::GetStart(vtkIdType patch, const Frame& frame, const Bundle& bundle,
  int lane) const
{
  return this->GetPoint(patch, frame, static_cast<double>(bundle.Numbers[0][lane]),
    static_cast<double>(bundle.Numbers[1][lane]));
}

//------------------------------------------------------------------------------
// Whether single precision does not tell on which side of its neighbours a ray starts.
bool PatchRays::Internals::IsRough(vtkIdType patch, const Frame& frame, const Bundle& bundle,
  int lane) const
{
  const float rim = bundle.Rims[lane];
  return this->IsNarrow[patch] ||
    (rim >= 0.0f ? rim < frame.Rim
                 : this->IsAtRim(patch, this->GetStart(patch, frame, bundle, lane),
                     static_cast<double>(frame.Rim)));
}

//------------------------------------------------------------------------------
PatchRays::Internals::Meeting PatchRays::Internals::GetMeeting(const Bundle& bundle, int lane) const
{
  const RTCRay16& ray = bundle.Rays.ray;
  Meeting meeting{ nullptr, ray.tfar[lane], 0.0f };
  if (bundle.Rays.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID)
  {
    meeting.Part = &this->Facets[bundle.Rays.hit.primID[lane]];
    const float* normal = meeting.Part->Normal;
    meeting.Cosine =
      -(ray.dir_x[lane] * normal[0] + ray.dir_y[lane] * normal[1] + ray.dir_z[lane] * normal[2]);
  }
  return meeting;
}

//------------------------------------------------------------------------------
// What is met for certain; -1 where single precision does not tell.
PatchRays::Hit PatchRays::Internals::FindCertain(vtkIdType patch, const Meeting& meeting)
{
  const Facet& part = *meeting.Part;
  const Hit hit = meeting.Cosine > 0.0f ? part.Patch : part.Twin;
  const bool isCertain =
    meeting.Distance * std::abs(meeting.Cosine) > part.Height + part.Slope * meeting.Distance &&
    hit != patch && part.Patch != patch;
  return isCertain ? hit : -1;
}

//------------------------------------------------------------------------------
// What starts on the plane of a neighbour, as far as coordinates tell, passes it. Where it then
// meets nothing in front, it would find a gap in the corner of a closed room.
bool PatchRays::Internals::IsOfNeighbour(vtkIdType patch, const Frame& frame,
  const Meeting& meeting, const Vector& origin) const
{
  return meeting.Part && meeting.Cosine > 0.0f && meeting.Part->Patch != patch &&
    !this->IsNarrow[patch] && IsAside(*meeting.Part, frame) &&
    this->Scene->GetPlane(meeting.Part->Patch).GetCertainHeight(origin) == 0.0;
}

//------------------------------------------------------------------------------
PatchRays::Hit PatchRays::Internals::Judge(vtkIdType patch, const Frame& frame,
  const Bundle& bundle, int lane) const
{
  const Meeting meeting = this->GetMeeting(bundle, lane);
  if (!this->IsRough(patch, frame, bundle, lane))
  {
    const Hit certain = meeting.Part ? FindCertain(patch, meeting) : Sky;
    if (!meeting.Part || certain >= 0)
    {
      return certain;
    }
  }
  const RTCRay16& ray = bundle.Rays.ray;
  const Vector origin = this->GetStart(patch, frame, bundle, lane);
  const Hit decided =
    this->Decide(patch, origin, Vector(ray.dir_x[lane], ray.dir_y[lane], ray.dir_z[lane]));
  return decided < 0 && this->IsOfNeighbour(patch, frame, meeting, origin) ? meeting.Part->Patch
                                                                           : decided;
}

//------------------------------------------------------------------------------
PatchRays::PatchRays() : Internal(new Internals) {}

//------------------------------------------------------------------------------
PatchRays::~PatchRays() = default;

//------------------------------------------------------------------------------
Outcome PatchRays::Build(const PatchScene& scene)
{
  Internals& self = *this->Internal;
  self.Scene = &scene;
  self.IsWhole = false;
  self.Facets.clear();
  Outcome built = self.Caster.Build(scene);
  if (!built)
  {
    return built;
  }
  if (self.Tree.Open(true))
  {
    self.AddPatches();
  }
  built = self.Tree.Build(scene.GetNumberOfPatches());
  if (built)
  {
    self.FindNarrow();
    self.IsWhole = true;
  }
  return built;
}

//------------------------------------------------------------------------------
bool PatchRays::IsBuilt() const
{
  return this->Internal->IsWhole;
}

//------------------------------------------------------------------------------
void PatchRays::Cast(vtkIdType patch, const RayPattern& pattern, Hit* hits) const
{
  const Internals& self = *this->Internal;
  const Frame frame = self.MakeFrame(patch);
  Bundle bundle;
  EmbreeTree::Context context;
  EmbreeTree::Initialize(context);
  for (const RayPattern::Packet& packet : pattern.GetPackets())
  {
    alignas(64) int valid[Lanes];
    for (int lane = 0; lane < Lanes; ++lane)
    {
      valid[lane] = lane < packet.Count ? -1 : 0;
    }
    MakeRays(packet, frame, bundle);
    self.Tree.Intersect(context, valid, bundle.Rays);
    for (int lane = 0; lane < packet.Count; ++lane)
    {
      hits[packet.Places[lane]] = self.Judge(patch, frame, bundle, lane);
    }
  }
}
} // namespace LightTransport
