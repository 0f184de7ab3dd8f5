// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/ShadowRaster.h"

#include "Support/InstructionSets.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace LightTransport
{
namespace
{
using namespace ShadowRaster;

constexpr int Batch = 8;
// Further out than any sample: an edge that does not bound a shadow on this side.
constexpr float Far = 1e20f;
// Slopes of an edge's line below this part of its other coefficients count as parallel to the
// raster's lines.
constexpr double Parallel = 1e-7;
// Edges below this part of a polygon with more than three corners are none.
constexpr double ShortEdge = 1e-6;

// The chords of the target along the lines: a position w is sample w * Scale + Offset.
struct Grid
{
  float Scale[Lines];
  float ScaledU[Lines];
  float Offset[Lines];
};

// Edges of a batch of polygons: on line k the shadow begins behind all lower and ends before all
// upper positions Position * Scale + Slope * ScaledU + Offset.
template <int Corners>
struct Bounds
{
  float Lower[Corners][Batch], LowerSlope[Corners][Batch];
  float Upper[Corners][Batch], UpperSlope[Corners][Batch];
};

//------------------------------------------------------------------------------
LT_INLINE void MakeGrid(const Target& target, const double shift[2], View& view, Grid& grid)
{
  const double width = (target.End - target.Begin) / Lines;
  float lower[Lines], upper[Lines];
  for (int k = 0; k < Lines; ++k)
  {
    view.U[k] = static_cast<float>(target.Begin + (k + shift[0]) * width);
    lower[k] = -Far;
    upper[k] = Far;
  }
  for (const Target::Edge& edge : target.Edges)
  {
    const auto position = static_cast<float>(edge.Position);
    const auto slope = static_cast<float>(edge.Slope);
    for (int k = 0; k < Lines; ++k)
    {
      const float bound = position + slope * view.U[k];
      const float low = edge.IsLower ? bound : -Far;
      const float high = edge.IsLower ? Far : bound;
      lower[k] = low > lower[k] ? low : lower[k];
      upper[k] = high < upper[k] ? high : upper[k];
    }
  }
  for (int k = 0; k < Lines; ++k)
  {
    // The golden ratio spreads the samples of successive lines evenly over their spacing.
    float jitter = static_cast<float>(shift[1]) + 0.61803399f * k;
    jitter -= static_cast<float>(static_cast<int>(jitter));
    const float length = std::max(upper[k] - lower[k], 0.0f);
    view.Step[k] = length / Bits;
    grid.Scale[k] = length > 0.0f ? Bits / length : 0.0f;
    view.Start[k] = lower[k] + jitter * view.Step[k];
    grid.ScaledU[k] = view.U[k] * grid.Scale[k];
    grid.Offset[k] = -lower[k] * grid.Scale[k] - jitter;
    view.Visible[k] = length > 0.0f ? ~0u : 0u;
  }
}

//------------------------------------------------------------------------------
// The planes through the point and the edges of each polygon, cut with the target's plane.
template <int Corners>
LT_INLINE void MakeBounds(const Occluders::Shapes<Corners>& shapes, int first,
  const double point[3], Bounds<Corners>& bounds)
{
  double r[Corners][3][Batch];
  for (int corner = 0; corner < Corners; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* values = &shapes.Corner[corner][axis][first];
      for (int k = 0; k < Batch; ++k)
      {
        r[corner][axis][k] = values[k] - point[axis];
      }
    }
  }
  double normal[Corners][3][Batch];
  for (int edge = 0; edge < Corners; ++edge)
  {
    const auto& a = r[edge];
    const auto& b = r[(edge + 1) % Corners];
    for (int k = 0; k < Batch; ++k)
    {
      normal[edge][0][k] = a[1][k] * b[2][k] - a[2][k] * b[1][k];
      normal[edge][1][k] = a[2][k] * b[0][k] - a[0][k] * b[2][k];
      normal[edge][2][k] = a[0][k] * b[1][k] - a[1][k] * b[0][k];
    }
  }
  // One volume for all edges: from the polygon's own plane rounding decides its sign, and signs
  // that differ would bound no more than a half-plane.
  double volume[Batch];
  for (int k = 0; k < Batch; ++k)
  {
    volume[k] = 0.0;
    for (int edge = 0; edge < 2 * (Corners - 2); edge += 2)
    {
      const auto& opposite = r[(edge + 2) % Corners];
      volume[k] += normal[edge][0][k] * opposite[0][k] + normal[edge][1][k] * opposite[1][k] +
        normal[edge][2][k] * opposite[2][k];
    }
  }
  for (int edge = 0; edge < Corners; ++edge)
  {
    for (int k = 0; k < Batch; ++k)
    {
      const double nu = normal[edge][0][k];
      const double nw = normal[edge][1][k];
      const double nh = normal[edge][2][k];
      const double constant = -(nu * point[0] + nw * point[1] + nh * point[2]);
      // Inside: sign * (constant + nu * u + nw * w) > 0, where the sign is that of the volume. An
      // edge along the lines takes its direction from nu, which neighbors have with opposite signs.
      const double least = Parallel * (std::abs(nu) + std::abs(nh)) + 1e-300;
      const double divisor = std::abs(nw) > least ? nw : (nu < 0.0 ? -least : least);
      const double inverse = -1.0 / divisor;
      const bool isLower = (divisor > 0.0) == (volume[k] > 0.0);
      const auto position = static_cast<float>(constant * inverse);
      const auto slope = static_cast<float>(nu * inverse);
      bounds.Lower[edge][k] = isLower ? position : -Far;
      bounds.LowerSlope[edge][k] = isLower ? slope : 0.0f;
      bounds.Upper[edge][k] = isLower ? Far : position;
      bounds.UpperSlope[edge][k] = isLower ? 0.0f : slope;
      // A polygon seen from its own plane throws no shadow.
      if (!(std::abs(volume[k]) > 0.0))
      {
        bounds.Lower[edge][k] = Far;
      }
    }
  }
}

//------------------------------------------------------------------------------
// The first `count` bits, 0 to 32.
LT_INLINE std::uint32_t GetFirstBits(std::int32_t count)
{
  const std::uint32_t bits = 0xFFFFFFFFu >> ((32 - count) & 31);
  return count > 0 ? bits : 0u;
}

//------------------------------------------------------------------------------
template <int Corners>
LT_INLINE void Cover(const Bounds<Corners>& bounds, int shape, const Grid& grid,
  std::uint32_t* visible)
{
  for (int k = 0; k < Lines; ++k)
  {
    float begin = 0.0f;
    float end = Bits;
    for (int edge = 0; edge < Corners; ++edge)
    {
      const float lower = bounds.Lower[edge][shape] * grid.Scale[k] +
        bounds.LowerSlope[edge][shape] * grid.ScaledU[k] + grid.Offset[k];
      const float upper = bounds.Upper[edge][shape] * grid.Scale[k] +
        bounds.UpperSlope[edge][shape] * grid.ScaledU[k] + grid.Offset[k];
      begin = lower > begin ? lower : begin;
      end = upper < end ? upper : end;
    }
    // Samples from the first at or behind `begin` to the last before `end`.
    begin = begin < Bits ? begin : Bits;
    end = end > 0.0f ? end : 0.0f;
    const std::int32_t first = Bits - static_cast<std::int32_t>(Bits - begin);
    const std::int32_t last = Bits - static_cast<std::int32_t>(Bits - end);
    visible[k] &= ~(GetFirstBits(last) & ~GetFirstBits(first));
  }
}

//------------------------------------------------------------------------------
// Take away what the shapes hide; false where nothing is left.
template <int Corners>
LT_INLINE bool CoverAll(const Occluders::Shapes<Corners>& shapes, const double point[3],
  const Grid& grid, std::uint32_t* visible)
{
  std::uint32_t any = ~0u;
  for (int first = 0; first < shapes.Count && any != 0; first += Batch)
  {
    Bounds<Corners> bounds;
    MakeBounds(shapes, first, point, bounds);
    const int count = std::min(Batch, shapes.Count - first);
    for (int k = 0; k < count; ++k)
    {
      Cover(bounds, k, grid, visible);
    }
    any = 0;
    for (int k = 0; k < Lines; ++k)
    {
      any |= visible[k];
    }
  }
  return any != 0;
}

//------------------------------------------------------------------------------
// Of the bits of words, in fields of as many bits: how many are set, and the sum of their places in
// the field.
struct Fields
{
  std::uint32_t Counts[Lines];
  std::uint32_t Places[Lines];
};

template <int Group>
LT_INLINE void Gather(const std::uint32_t* words, Fields& fields)
{
  static_assert(Group == 2 || Group == 8, "fields of other sizes are not gathered");
  for (int k = 0; k < Lines; ++k)
  {
    const std::uint32_t odd = words[k] >> 1 & 0x55555555u;
    const std::uint32_t pairs = odd + (words[k] & 0x55555555u);
    if (Group == 2)
    {
      fields.Counts[k] = pairs;
      fields.Places[k] = odd;
      continue;
    }
    constexpr std::uint32_t two = 0x33333333u, four = 0x0F0F0F0Fu;
    const std::uint32_t upper = pairs >> 2 & two;
    const std::uint32_t counts = upper + (pairs & two);
    const std::uint32_t places = (odd & two) + (odd >> 2 & two) + 2 * upper;
    const std::uint32_t high = counts >> 4 & four;
    fields.Counts[k] = high + (counts & four);
    fields.Places[k] = (places & four) + (places >> 4 & four) + 4 * high;
  }
}

//------------------------------------------------------------------------------
// `Group` samples share a weight.
template <int Group>
LT_INLINE Flux WeighGroups(const View& view, const double normal[3])
{
  constexpr float middle = 0.5f * (Group - 1);
  constexpr std::uint32_t mask = (1u << Group) - 1u;
  const auto pu = static_cast<float>(view.Point[0]);
  const auto pw = static_cast<float>(view.Point[1]);
  const auto ph = static_cast<float>(view.Point[2]);
  const auto nu = static_cast<float>(normal[0]);
  const auto nw = static_cast<float>(normal[1]);
  const auto nh = static_cast<float>(normal[2]);
  Fields fields;
  Gather<Group>(view.Visible, fields);
  float open[Lines] = {};
  float seen[Lines] = {};
  for (int first = 0; first < Bits; first += Group)
  {
    for (int k = 0; k < Lines; ++k)
    {
      const float u = view.U[k] - pu;
      const float w = view.Start[k] + (first + middle) * view.Step[k] - pw;
      const float inverse = 1.0f / (u * u + w * w + ph * ph);
      const float cosine = std::max(u * nu + w * nw - ph * nh, 0.0f);
      const float factor = view.Step[k] * inverse * inverse;
      const float weight = cosine * factor;
      // The weight changes along the line; no sample of the group weighs less than nothing.
      const float most = weight / middle;
      const float slope = view.Step[k] * factor * (nw - 4.0f * w * cosine * inverse);
      const auto count =
        static_cast<float>(static_cast<std::int32_t>(fields.Counts[k] >> first & mask));
      const auto places =
        static_cast<float>(static_cast<std::int32_t>(fields.Places[k] >> first & mask));
      open[k] += weight * Group;
      seen[k] +=
        weight * count + std::max(-most, std::min(most, slope)) * (places - middle * count);
    }
  }
  // The cosine at the target is the height over the distance: the height is the same everywhere.
  Flux flux;
  for (int k = 0; k < Lines; ++k)
  {
    flux.Open += view.Point[2] * open[k];
    flux.Visible += view.Point[2] * seen[k];
  }
  return flux;
}
} // namespace

namespace ShadowRaster
{
//------------------------------------------------------------------------------
template <int Corners>
void Occluders::Shapes<Corners>::Add(const double* const* corners)
{
  const std::size_t size = static_cast<std::size_t>(this->Count) + Batch;
  for (int corner = 0; corner < Corners; ++corner)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      // Whole batches are read: what is behind the last shape counts for nothing.
      auto& values = this->Corner[corner][axis];
      if (values.size() < size)
      {
        values.resize(2 * size, 0.0);
      }
      values[this->Count] = corners[corner][axis];
    }
  }
  ++this->Count;
}

//------------------------------------------------------------------------------
void Occluders::Clear()
{
  this->Triangles.Count = 0;
  this->Quadrilaterals.Count = 0;
}

//------------------------------------------------------------------------------
// A fan of quadrilaterals, the last of which may be a triangle. Of an edge that is nothing beside
// the polygon rounding would decide where it leads: its end is left out.
void Occluders::Add(const std::vector<std::array<double, 3>>& corners)
{
  const auto getSquared = [](const double* a, const double* b)
  {
    return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
      (a[2] - b[2]) * (a[2] - b[2]);
  };
  const double* const origin = corners[0].data();
  double size = 0.0;
  for (const std::array<double, 3>& corner : corners)
  {
    size = std::max(size, getSquared(corner.data(), origin));
  }
  const double least = corners.size() > 3 ? ShortEdge * ShortEdge * size : -1.0;
  this->Kept.assign(1, origin);
  for (std::size_t corner = 1; corner < corners.size(); ++corner)
  {
    const double* const place = corners[corner].data();
    if (getSquared(place, this->Kept.back()) > least && getSquared(place, origin) > least)
    {
      this->Kept.push_back(place);
    }
  }
  const std::size_t kept = this->Kept.size();
  for (std::size_t corner = 1; corner + 1 < kept; corner += 2)
  {
    const bool isTriangle = corner + 2 == kept;
    const double* const shape[4] = { this->Kept[0], this->Kept[corner], this->Kept[corner + 1],
      this->Kept[isTriangle ? 0 : corner + 2] };
    isTriangle ? this->Triangles.Add(shape) : this->Quadrilaterals.Add(shape);
  }
}

//------------------------------------------------------------------------------
LT_CLONES bool Look(const Target& target, const Occluders& occluders, const double point[3],
  const double shift[2], View& view)
{
  Grid grid;
  std::copy(point, point + 3, view.Point);
  MakeGrid(target, shift, view, grid);
  return CoverAll(occluders.Quadrilaterals, point, grid, view.Visible) &&
    CoverAll(occluders.Triangles, point, grid, view.Visible);
}

//------------------------------------------------------------------------------
LT_CLONES Flux Weigh(const View& view, const double normal[3], Weights weights)
{
  return weights == Weights::Coarse ? WeighGroups<8>(view, normal) : WeighGroups<2>(view, normal);
}
} // namespace ShadowRaster
} // namespace LightTransport
