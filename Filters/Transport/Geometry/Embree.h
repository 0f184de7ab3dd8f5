// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Embree 3 or 4, which differ in the folder of their header and in the name of a query's context.
/// For sources alone that are compiled with LIGHTTRANSPORT_EMBREE_MAJOR.
#ifndef TransportEmbree_h
#define TransportEmbree_h

#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace LightTransport
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
using QueryContext = RTCRayQueryContext;
#else
using QueryContext = RTCIntersectContext;
#endif

//------------------------------------------------------------------------------
inline void InitializeContext(QueryContext& context)
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  rtcInitRayQueryContext(&context);
#else
  rtcInitIntersectContext(&context);
#endif
}

//------------------------------------------------------------------------------
inline void Intersect(RTCScene scene, QueryContext& context, RTCRayHit& hit)
{
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.context = &context;
  rtcIntersect1(scene, &hit, &arguments);
#else
  rtcIntersect1(scene, &context, &hit);
#endif
}

//------------------------------------------------------------------------------
inline void FindOccluded(RTCScene scene, QueryContext& context, RTCRay& ray)
{
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.context = &context;
  rtcOccluded1(scene, &ray, &arguments);
#else
  rtcOccluded1(scene, &context, &ray);
#endif
}
} // namespace LightTransport

#endif
