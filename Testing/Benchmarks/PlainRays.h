// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What anyone with a ray tracer can write in an afternoon, as fast as it can be made: the floor
 * that the filters must stand above. It shares no code with them.
 *
 * Each patch casts as many rays, in Embree's packets of 16 on one thread: Sobol' points in four
 * dimensions (two of the direction, two of the place), scrambled for each patch, in an order that
 * keeps the directions of a packet together. A row is how often other patches were hit. Where a
 * small part of the area sends, it casts a quarter more rays, and what both ends of a link have
 * counted is combined by density. Jacobi's iteration solves. Single precision, no error estimate;
 * back faces absorb.
 */
#ifndef PlainRays_h
#define PlainRays_h

#if LIGHTTRANSPORT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <cstdint>
#include <vector>

class vtkPolyData;

class PlainRays
{
public:
  using Values = std::vector<float>; ///< one per patch

  /// Patches are triangles and parallelograms.
  explicit PlainRays(vtkPolyData* scene);
  ~PlainRays();
  PlainRays(const PlainRays&) = delete;
  void operator=(const PlainRays&) = delete;

  /// The radiosity by a multiple of 16 rays from each patch. `sky` is what openings send.
  Values Solve(std::uint32_t rays, std::uint32_t seed, const Values& emission,
    const Values& reflectance, float sky);

  /// Patches that the rows name, of the latest solution.
  std::size_t GetNumberOfEntries() const { return this->Entries.size(); }

private:
  struct Patch
  {
    float Corner[3], Edges[2][3], Frame[3][3]; ///< Frame: two tangents and the normal
    float Area;
    bool IsTriangle;
  };
  struct Entry
  {
    std::uint32_t Patch;
    float Weight;
  };
  struct Packet;

  void AddPatch(const std::vector<std::array<double, 3>>& corners);
  void BuildTree();
  void MakePoints(std::uint32_t rays);
  template <typename Visit>
  void Cast(std::uint32_t patch, std::uint32_t rays, std::uint32_t seed, const Visit& visit) const;
  void CastRows(std::uint32_t rays, std::uint32_t seed);
  void CastFromLamps(std::uint32_t rays, std::uint32_t seed, const Values& emission);
  Values Gather(const Values& sent) const;

  std::vector<Patch> Patches;
  std::vector<std::array<std::uint32_t, 4>> Points; ///< not yet scrambled
  ///@{ Row r: Entries from Begins[r] to Begins[r + 1], and what of it goes to the sky.
  std::vector<Entry> Entries;
  std::vector<std::size_t> Begins;
  Values Sky;
  ///@}
  Values Direct;       ///< irradiance by small lamps; empty without
  float Offset = 0.0f; ///< of the beginning of rays from their patch
  RTCDevice Device = nullptr;
  RTCScene Tree = nullptr;
};

#endif
