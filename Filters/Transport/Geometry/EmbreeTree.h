// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A tree of Embree 3 or 4 with its device: it asks for memory before it takes any, and hears an
 * abort while it is built. For sources alone that are compiled with LIGHTTRANSPORT_EMBREE_MAJOR.
 */
#ifndef EmbreeTree_h
#define EmbreeTree_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace LightTransport
{
class EmbreeTree
{
public:
#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
  using Context = RTCRayQueryContext;
#else
  using Context = RTCIntersectContext;
#endif

  EmbreeTree() = default;
  ~EmbreeTree()
  {
    this->Close();
  }
  EmbreeTree(const EmbreeTree&) = delete;
  void operator=(const EmbreeTree&) = delete;

  /// An empty tree, in place of what was there. False without a device. Rays through a watertight
  /// one miss no edge between triangles.
  bool Open(bool isWatertight = false);
  void Close();

  /// nullptr while closed.
  RTCDevice GetDevice() const
  {
    return this->Device;
  }
  RTCScene Get() const
  {
    return this->Scene;
  }

  /// Take a geometry, which is released.
  void Attach(RTCGeometry geometry);

  /// Build the tree. Fails, and closes it, where Embree has met an error; throws Stopped when
  /// aborted.
  Outcome Build(vtkIdType numberOfPatches);

  static void Initialize(Context& context);
  void Intersect(Context& context, RTCRayHit& hit) const;
  void FindOccluded(Context& context, RTCRay& ray) const;
  /// Sixteen rays that go much the same way, those of which `valid` is -1.
  void Intersect(Context& context, const int* valid, RTCRayHit16& hits) const;

private:
  void Commit();

  RTCDevice Device = nullptr;
  RTCScene Scene = nullptr;
};
} // namespace LightTransport

#endif
