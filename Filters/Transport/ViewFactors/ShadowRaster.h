// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a point sees of a planar convex target past a number of convex polygons: the target is
 * covered with Lines parallel lines of Bits samples each; the shadow that a polygon throws on a
 * line is an interval, so an edge costs a few vector instructions for all samples together.
 *
 * Coordinates (u, w, h) are those of the target: it lies in the plane h = 0 and looks towards h >
 * 0; lines run along w.
 */
#ifndef ShadowRaster_h
#define ShadowRaster_h

#include <array>
#include <cstdint>
#include <vector>

namespace LightTransport
{
namespace ShadowRaster
{
constexpr int Lines = 16;
constexpr int Bits = 32;

/// The target: for each u the points from the largest lower to the smallest upper edge.
struct Target
{
  struct Edge
  {
    double Position, Slope; ///< w = Position + Slope * u
    bool IsLower;
  };
  std::vector<Edge> Edges;
  double Begin = 0.0; ///< range of u
  double End = 0.0;
};

/// Convex plane polygons strictly between the point's plane and the target's, as triangles and
/// quadrilaterals: one array per coordinate of each corner.
struct Occluders
{
  template <int Corners>
  struct Shapes
  {
    std::vector<double> Corner[Corners][3];
    int Count = 0;

    void Add(const double* const* corners);
  };
  Shapes<3> Triangles;
  Shapes<4> Quadrilaterals;

  std::vector<const double*> Kept; ///< while one is added

  void Clear();
  void Add(const std::vector<std::array<double, 3>>& corners);
  int GetCount() const { return this->Triangles.Count + this->Quadrilaterals.Count; }
};

/// Integrals over the target of what the point receives, in a unit that belongs to the target.
struct Flux
{
  double Visible = 0.0;
  double Open = 0.0;

  void Add(double weight, const Flux& other)
  {
    this->Visible += weight * other.Visible;
    this->Open += weight * other.Open;
  }

  /// The visible part; `other` where there is no flux at all.
  double GetShare(double other = 1.0) const
  {
    return this->Open > 0.0 ? this->Visible / this->Open : other;
  }
};

/// Samples along a line that share a weight: it follows the kernel linearly. A weight of few
/// samples for each is exact wherever the target is, one of many costs a third and is for targets
/// far away.
enum class Weights
{
  Fine,
  Coarse
};

/// What a point sees of the target, not weighed yet.
struct View
{
  double Point[3];
  float U[Lines];     ///< where the lines are
  float Start[Lines]; ///< sample b of a line is at w = Start + b * Step
  float Step[Lines];
  std::uint32_t Visible[Lines]; ///< a bit for each sample
};

/**
 * Look from a point (u, w, h); false where it sees no sample. `shift` (0 to 1 each) moves lines,
 * and samples along them, within their spacing: over many points the samples fill the target
 * evenly.
 */
bool Look(const Target& target, const Occluders& occluders, const double point[3],
  const double shift[2], View& view);

/// The flux at the point of a view, with a normal.
Flux Weigh(const View& view, const double normal[3], Weights weights = Weights::Fine);
} // namespace ShadowRaster
} // namespace LightTransport

#endif
