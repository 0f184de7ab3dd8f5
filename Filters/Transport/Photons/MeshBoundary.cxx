// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/MeshBoundary.h"

#include "Geometry/EmbreeTree.h"
#include "Photons/BallGrid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace LightTransport
{
namespace
{
using Vector = PhotonBoundary::Vector;

// Several times what single precision loses in a scene whose diagonal is 1.
constexpr double Margin = 1e-6;

//------------------------------------------------------------------------------
struct Triangle
{
  Vector Corners[3];
  vtkIdType Patch;
};

//------------------------------------------------------------------------------
// A path on its way. Embree hands the first member back to the function that tests what it meets.
struct Query
{
  EmbreeTree::Context Context;
  const PatchScene* Scene;
  const Triangle* Triangles;
  const PhotonBoundary::Path* Path;
  bool TakesExpectedOnly;

  // Whether a patch with this normal is met from the side on which the photon is.
  bool IsExpected(const Vector& normal) const
  {
    return (this->Path->Direction.dot(normal) > 0.0) == this->Path->IsInside;
  }

  bool Counts(const Triangle& triangle) const
  {
    const Vector& normal = this->Scene->GetNormal(triangle.Patch);
    const bool isExpected = this->IsExpected(normal);
    if (std::abs(normal.dot(this->Path->Origin - triangle.Corners[0])) >= Margin)
    {
      return isExpected || !this->TakesExpectedOnly;
    }
    // A body that has been entered cannot be left through the plane where it was.
    const bool isBehind = this->Path->IsInside && this->Path->From >= 0 &&
      std::abs(normal.dot(this->Scene->GetNormal(this->Path->From))) > 1.0 - Margin;
    return isExpected && !isBehind && triangle.Patch != this->Path->From;
  }
};

//------------------------------------------------------------------------------
void TestHit(const RTCFilterFunctionNArguments* arguments)
{
  const auto* query = reinterpret_cast<const Query*>(arguments->context);
  if (!query->Counts(query->Triangles[RTCHitN_primID(arguments->hit, 1, 0)]))
  {
    arguments->valid[0] = 0;
  }
}

//------------------------------------------------------------------------------
// C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: by the region of the triangle's
// plane that the point is over.
double GetSquaredDistance(const Vector& point, const Triangle& triangle)
{
  const Vector& a = triangle.Corners[0];
  const Vector& b = triangle.Corners[1];
  const Vector& c = triangle.Corners[2];
  const auto toSegment = [&point](const Vector& from, const Vector& to)
  {
    const Vector along = to - from;
    const double part = (point - from).dot(along) / along.squaredNorm();
    return (point - from - std::min(std::max(part, 0.0), 1.0) * along).squaredNorm();
  };
  const Vector normal = (b - a).cross(c - a);
  const auto isWithin = [&](const Vector& from, const Vector& to)
  { return normal.cross(to - from).dot(point - from) >= 0.0; };
  if (isWithin(a, b) && isWithin(b, c) && isWithin(c, a))
  {
    const double height = normal.dot(point - a);
    return height * height / normal.squaredNorm();
  }
  return std::min({ toSegment(a, b), toSegment(b, c), toSegment(c, a) });
}

//------------------------------------------------------------------------------
struct Nearest
{
  const std::vector<Triangle>* Triangles;
  Vector Point;
  double SquaredDistance;
};

//------------------------------------------------------------------------------
bool TestDistance(RTCPointQueryFunctionArguments* arguments)
{
  auto* nearest = static_cast<Nearest*>(arguments->userPtr);
  const double square =
    GetSquaredDistance(nearest->Point, (*nearest->Triangles)[arguments->primID]);
  if (square >= nearest->SquaredDistance)
  {
    return false;
  }
  nearest->SquaredDistance = square;
  arguments->query->radius = static_cast<float>(std::sqrt(square));
  return true;
}
} // namespace

//------------------------------------------------------------------------------
struct MeshBoundary::Internals
{
  EmbreeTree Tree;
  const PatchScene* Scene = nullptr;
  std::vector<Triangle> Triangles;
  double LargestBall = 0.0;
  BallGrid Balls;

  void AddTriangles();
  double FindDistance(const Vector& point) const;
  const Triangle* FindFirst(const Path& path, double reach, bool takesExpectedOnly,
    double& distance) const;
};

//------------------------------------------------------------------------------
void MeshBoundary::Internals::AddTriangles()
{
  for (vtkIdType patch = 0; patch < this->Scene->GetNumberOfPatches(); ++patch)
  {
    for (int corner = 2; corner < this->Scene->GetNumberOfCorners(patch); ++corner)
    {
      this->Triangles.push_back(
        { { this->Scene->GetCorner(patch, 0), this->Scene->GetCorner(patch, corner - 1),
            this->Scene->GetCorner(patch, corner) },
          patch });
    }
  }
  RTCGeometry geometry = rtcNewGeometry(this->Tree.GetDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = this->Triangles.size();
  auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
  auto* indices = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry,
    RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned int), count));
  for (std::size_t k = 0; points && indices && k < 3 * count; ++k)
  {
    const Vector& point = this->Triangles[k / 3].Corners[k % 3];
    std::copy_n(point.cast<float>().eval().data(), 3, points + 3 * k);
    indices[k] = static_cast<unsigned int>(k);
  }
  rtcSetGeometryIntersectFilterFunction(geometry, TestHit);
  this->Tree.Attach(geometry);
}

//------------------------------------------------------------------------------
// To the surface, or LargestBall where that is further away.
double MeshBoundary::Internals::FindDistance(const Vector& point) const
{
  Nearest nearest{ &this->Triangles, point, this->LargestBall * this->LargestBall };
  RTCPointQuery query{ static_cast<float>(point.x()), static_cast<float>(point.y()),
    static_cast<float>(point.z()), 0.0f, static_cast<float>(this->LargestBall) };
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(this->Tree.Get(), &query, &context, TestDistance, &nearest);
  return std::sqrt(nearest.SquaredDistance);
}

//------------------------------------------------------------------------------
MeshBoundary::MeshBoundary() : Internal(new Internals) {}

//------------------------------------------------------------------------------
MeshBoundary::~MeshBoundary() = default;

//------------------------------------------------------------------------------
Outcome MeshBoundary::Build(const PatchScene& scene, double largestBall)
{
  Internals& self = *this->Internal;
  self.Triangles.clear();
  self.Scene = &scene;
  self.LargestBall = largestBall;
  self.Balls.Build(scene.GetPoints());
  if (self.Tree.Open())
  {
    rtcSetSceneFlags(self.Tree.Get(), RTC_SCENE_FLAG_ROBUST);
    self.AddTriangles();
  }
  return self.Tree.Build(scene.GetNumberOfPatches());
}

//------------------------------------------------------------------------------
// The first triangle that counts within a reach, or nullptr, and its distance as far as single
// precision knows it.
const Triangle* MeshBoundary::Internals::FindFirst(const Path& path, double reach,
  bool takesExpectedOnly, double& distance) const
{
  Query query{ {}, this->Scene, this->Triangles.data(), &path, takesExpectedOnly };
  EmbreeTree::Initialize(query.Context);
  RTCRayHit hit;
  const Eigen::Vector3f start = (path.Origin - Margin * path.Direction).cast<float>();
  const Eigen::Vector3f direction = path.Direction.cast<float>();
  hit.ray = { start.x(), start.y(), start.z(), 0.0f, direction.x(), direction.y(), direction.z(),
    0.0f, static_cast<float>(reach + Margin), ~0u, 0, 0 };
  this->Tree.Intersect(query.Context, hit);
  distance = hit.ray.tfar - Margin;
  return hit.hit.primID == RTC_INVALID_GEOMETRY_ID ? nullptr : &this->Triangles[hit.hit.primID];
}

//------------------------------------------------------------------------------
bool MeshBoundary::FindCrossing(const Path& path, PhotonCrossing& crossing) const
{
  const Internals& self = *this->Internal;
  double found;
  const Triangle* triangle = self.FindFirst(path, path.Reach, false, found);
  if (!triangle)
  {
    return false;
  }
  const Query query{ {}, self.Scene, nullptr, &path, false };
  crossing.IsExpected = query.IsExpected(self.Scene->GetNormal(triangle->Patch));
  if (!crossing.IsExpected)
  {
    // Where bodies touch.
    double again;
    if (const Triangle* other = self.FindFirst(path, found + 2.0 * Margin, true, again))
    {
      crossing.IsExpected = true;
      triangle = other;
      found = again;
    }
  }
  crossing.Patch = triangle->Patch;
  crossing.Normal = self.Scene->GetNormal(triangle->Patch);
  const double exact =
    (triangle->Corners[0] - path.Origin).dot(crossing.Normal) / path.Direction.dot(crossing.Normal);
  // Along the surface single precision knows as much.
  crossing.Distance = std::max(0.0, std::min(std::max(exact, found - Margin), found + Margin));
  return true;
}

//------------------------------------------------------------------------------
PhotonBall MeshBoundary::GetBall(const Vector& position) const
{
  const Internals& self = *this->Internal;
  return self.Balls.Get(position,
    [&self](const Vector& center) { return self.FindDistance(center) - Margin; });
}
} // namespace LightTransport
