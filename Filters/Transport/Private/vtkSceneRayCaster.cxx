// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSceneRayCaster.h"

#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

namespace
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

// What a filter function needs to know of its ray; Embree hands the first member back.
struct OwnPatches
{
  QueryContext Context;
  const std::vector<vtkIdType>* PatchOfTriangle;
  const std::vector<vtkIdType>* Places;
  vtkIdType From;
  vtkIdType To;
};

//------------------------------------------------------------------------------
// For each patch the first one with the same corners: the two sides of a thin wall are one place,
// and neither may stop the rays of the other.
std::vector<vtkIdType> FindPlaces(const vtkPatchScene& scene)
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
void RejectOwnPatches(const RTCFilterFunctionNArguments* arguments)
{
  const auto* own = reinterpret_cast<const OwnPatches*>(arguments->context);
  for (unsigned int ray = 0; ray < arguments->N; ++ray)
  {
    const unsigned int triangle = RTCHitN_primID(arguments->hit, arguments->N, ray);
    const vtkIdType place = (*own->Places)[(*own->PatchOfTriangle)[triangle]];
    if (place == own->From || place == own->To)
    {
      arguments->valid[ray] = 0;
    }
  }
}

//------------------------------------------------------------------------------
void SetRay(RTCRay& ray, const vtkPatchScene::Vector& origin,
  const vtkPatchScene::Vector& direction, float length)
{
  ray.org_x = static_cast<float>(origin.x());
  ray.org_y = static_cast<float>(origin.y());
  ray.org_z = static_cast<float>(origin.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = 0.0f;
  ray.tfar = length;
  ray.time = 0.0f;
  ray.mask = std::numeric_limits<unsigned int>::max();
  ray.id = 0;
  ray.flags = 0;
}
} // namespace

struct vtkSceneRayCaster::Internals
{
  RTCDevice Device = nullptr;
  RTCScene Scene = nullptr;
  std::vector<vtkIdType> PatchOfTriangle;
  std::vector<vtkIdType> Places;
  /// For each place: whether fronts look both ways.
  std::vector<bool> TwoSided;

  ~Internals() { this->Close(); }

  void Close()
  {
    if (this->Scene)
    {
      rtcReleaseScene(this->Scene);
    }
    if (this->Device)
    {
      rtcReleaseDevice(this->Device);
    }
    this->Scene = nullptr;
    this->Device = nullptr;
    this->PatchOfTriangle.clear();
  }

  OwnPatches MakeContext(vtkIdType from, vtkIdType to) const
  {
    OwnPatches own;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
    rtcInitRayQueryContext(&own.Context);
#else
    rtcInitIntersectContext(&own.Context);
#endif
    own.PatchOfTriangle = &this->PatchOfTriangle;
    own.Places = &this->Places;
    own.From = this->Places[from];
    own.To = to < 0 ? to : this->Places[to];
    return own;
  }

  void FindThinWalls(const vtkPatchScene& scene);
  bool AddTriangles(const vtkPatchScene& scene, const std::vector<bool>* subset);
};

//------------------------------------------------------------------------------
void vtkSceneRayCaster::Internals::FindThinWalls(const vtkPatchScene& scene)
{
  this->Places = FindPlaces(scene);
  this->TwoSided.assign(this->Places.size(), false);
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const vtkIdType place = this->Places[patch];
    if (scene.GetNormal(patch).dot(scene.GetNormal(place)) < 0.0)
    {
      this->TwoSided[place] = true;
    }
  }
}

//------------------------------------------------------------------------------
bool vtkSceneRayCaster::Internals::AddTriangles(const vtkPatchScene& scene,
  const std::vector<bool>* subset)
{
  for (vtkIdType patch = 0; patch < scene.GetNumberOfPatches(); ++patch)
  {
    const int triangles = !subset || (*subset)[patch] ? scene.GetNumberOfCorners(patch) - 2 : 0;
    this->PatchOfTriangle.insert(this->PatchOfTriangle.end(), triangles, patch);
  }
  RTCGeometry geometry = rtcNewGeometry(this->Device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
    RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.GetPoints().size()));
  auto* index = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX,
    0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned int), this->PatchOfTriangle.size()));
  if (!vertex || !index)
  {
    rtcReleaseGeometry(geometry);
    return false;
  }
  for (const vtkPatchScene::Vector& point : scene.GetPoints())
  {
    *vertex++ = static_cast<float>(point.x());
    *vertex++ = static_cast<float>(point.y());
    *vertex++ = static_cast<float>(point.z());
  }
  for (std::size_t triangle = 0; triangle < this->PatchOfTriangle.size();)
  {
    const vtkIdType patch = this->PatchOfTriangle[triangle];
    const vtkIdType* corners = scene.GetCorners(patch);
    for (int corner = 1; corner + 1 < scene.GetNumberOfCorners(patch); ++corner, ++triangle)
    {
      *index++ = static_cast<unsigned int>(corners[0]);
      *index++ = static_cast<unsigned int>(corners[corner]);
      *index++ = static_cast<unsigned int>(corners[corner + 1]);
    }
  }
  rtcSetGeometryOccludedFilterFunction(geometry, RejectOwnPatches);
  rtcSetGeometryIntersectFilterFunction(geometry, RejectOwnPatches);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Scene, geometry);
  rtcReleaseGeometry(geometry);
  return true;
}

//------------------------------------------------------------------------------
vtkSceneRayCaster::vtkSceneRayCaster() : Self(new Internals) {}

//------------------------------------------------------------------------------
vtkSceneRayCaster::~vtkSceneRayCaster() = default;

//------------------------------------------------------------------------------
bool vtkSceneRayCaster::Build(const vtkPatchScene& scene, std::string& error,
  const std::vector<bool>* subset)
{
  this->Self->Close();
  // Rays come from the threads of vtkSMPTools; Embree's own would only build the tree.
  this->Self->Device = rtcNewDevice("threads=1");
  bool ok = this->Self->Device != nullptr;
  if (ok)
  {
    this->Self->Scene = rtcNewScene(this->Self->Device);
    // Robust: no ray slips through the common edge of two triangles.
    rtcSetSceneFlags(this->Self->Scene, RTC_SCENE_FLAG_ROBUST);
    this->Self->FindThinWalls(scene);
    ok = this->Self->AddTriangles(scene, subset);
  }
  if (ok)
  {
    rtcCommitScene(this->Self->Scene);
    ok = rtcGetDeviceError(this->Self->Device) == RTC_ERROR_NONE;
  }
  if (!ok)
  {
    error = "Embree could not build its tree of " + std::to_string(scene.GetNumberOfPatches()) +
      " patches: use fewer patches or a machine with more memory.";
    this->Self->Close();
  }
  return ok;
}

//------------------------------------------------------------------------------
bool vtkSceneRayCaster::IsOccluded(const vtkPatchScene::Vector& origin,
  const vtkPatchScene::Vector& target, vtkIdType from, vtkIdType to) const
{
  OwnPatches own = this->Self->MakeContext(from, to);
  RTCRay ray;
  SetRay(ray, origin, target - origin, 1.0f);
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &own.Context;
  rtcOccluded1(this->Self->Scene, &ray, &arguments);
#else
  rtcOccluded1(this->Self->Scene, &own.Context, &ray);
#endif
  return ray.tfar < 0.0f;
}

//------------------------------------------------------------------------------
vtkIdType vtkSceneRayCaster::FindHit(const vtkPatchScene::Vector& origin,
  const vtkPatchScene::Vector& direction, vtkIdType from, bool& front) const
{
  OwnPatches own = this->Self->MakeContext(from, from);
  RTCRayHit hit;
  SetRay(hit.ray, origin, direction, std::numeric_limits<float>::infinity());
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &own.Context;
  rtcIntersect1(this->Self->Scene, &hit, &arguments);
#else
  rtcIntersect1(this->Self->Scene, &own.Context, &hit);
#endif
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
  {
    return -1;
  }
  const vtkIdType patch = this->Self->PatchOfTriangle[hit.hit.primID];
  const vtkPatchScene::Vector normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
  front = this->Self->TwoSided[this->Self->Places[patch]] || normal.dot(direction) < 0.0;
  return patch;
}
