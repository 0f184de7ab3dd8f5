// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Geometry/EmbreeTree.h"

#include "Shared/Pulse.h"
#include "Shared/TransportMemory.h"

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>

namespace LightTransport
{
namespace
{
// The stack of a thread, and what Embree takes for its device.
constexpr double StackBytes = 8388608.0;
constexpr double DeviceBytes = 8388608.0;

//------------------------------------------------------------------------------
// Embree starts threads of TBB with the first tree of a process, whether it needs them or not, and
// they end the process where there is no room for their stacks.
bool HasRoomForThreads()
{
  static std::atomic<bool> areThere{ false };
  areThere = areThere ||
    TransportMemory::IsWithinLimits(
      DeviceBytes + StackBytes * std::max(2u, std::thread::hardware_concurrency()));
  return areThere;
}

//------------------------------------------------------------------------------
// Embree asks before it takes memory, and is told at once how much it has taken or given back.
bool HasMemory(void*, ssize_t bytes, bool isTaken)
{
  return isTaken || bytes <= 0 || TransportMemory::CanAllocate(static_cast<double>(bytes));
}
} // namespace

//------------------------------------------------------------------------------
bool EmbreeTree::Open(bool isWatertight)
{
  this->Close();
  if (!HasRoomForThreads())
  {
    return false;
  }
  // Rays come from the threads of vtkSMPTools; Embree's own would only build the tree. Nothing here
  // is tessellated: the cache for that is 128 MB at once, and where there is no room for it Embree
  // keeps a lock, for which the next device to be released waits for ever.
  this->Device = rtcNewDevice("threads=1,tessellation_cache_size=0");
  if (this->Device)
  {
    rtcSetDeviceMemoryMonitorFunction(this->Device, HasMemory, nullptr);
    this->Scene = rtcNewScene(this->Device);
  }
  if (this->Scene && isWatertight)
  {
    rtcSetSceneFlags(this->Scene, RTC_SCENE_FLAG_ROBUST);
  }
  return this->Scene != nullptr;
}

//------------------------------------------------------------------------------
void EmbreeTree::Close()
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
}

//------------------------------------------------------------------------------
void EmbreeTree::Attach(RTCGeometry geometry)
{
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->Scene, geometry);
  rtcReleaseGeometry(geometry);
}

//------------------------------------------------------------------------------
Outcome EmbreeTree::Build(vtkIdType numberOfPatches)
{
  if (this->Scene)
  {
    this->Commit();
  }
  if (!this->Scene || rtcGetDeviceError(this->Device) != RTC_ERROR_NONE)
  {
    this->Close();
    return Outcome::Failed("Embree could not build its tree of " + std::to_string(numberOfPatches) +
      " patches: use fewer patches or a machine with more memory.");
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// Embree asks now and then whether to go on; exceptions must not pass through it.
void EmbreeTree::Commit()
{
  bool isStopped = false;
  const auto goesOn = [](void* stopped, double)
  {
    try
    {
      Pulse::Beat();
      return true;
    }
    catch (const Stopped&)
    {
      *static_cast<bool*>(stopped) = true;
      return false;
    }
  };
  rtcSetSceneProgressMonitorFunction(this->Scene, goesOn, &isStopped);
  rtcCommitScene(this->Scene);
  rtcSetSceneProgressMonitorFunction(this->Scene, nullptr, nullptr);
  if (isStopped)
  {
    throw Stopped();
  }
}

//------------------------------------------------------------------------------
void EmbreeTree::Initialize(Context& context)
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context);
#else
  rtcInitIntersectContext(&context);
#endif
}

//------------------------------------------------------------------------------
void EmbreeTree::Intersect(Context& context, RTCRayHit& hit) const
{
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(this->Scene, &hit, &arguments);
#else
  rtcIntersect1(this->Scene, &context, &hit);
#endif
}

//------------------------------------------------------------------------------
void EmbreeTree::FindOccluded(Context& context, RTCRay& ray) const
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(this->Scene, &ray, &arguments);
#else
  rtcOccluded1(this->Scene, &context, &ray);
#endif
}

//------------------------------------------------------------------------------
void EmbreeTree::Intersect(Context& context, const int* valid, RTCRayHit16& hits) const
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect16(valid, this->Scene, &hits, &arguments);
#else
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect16(valid, this->Scene, &context, &hits);
#endif
}
} // namespace LightTransport
