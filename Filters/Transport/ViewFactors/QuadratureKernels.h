// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The innermost loops of the open exchange, compiled for several instruction sets (as
 * TileKernels): products of quadrature rules between one patch and a run of patches, and the
 * inner integral of a contour integral at the nodes of a Gauss-Kronrod rule.
 */
#ifndef QuadratureKernels_h
#define QuadratureKernels_h

namespace LightTransport
{
namespace QuadratureKernels
{
/// Patches that are worked on together.
constexpr int Lanes = 8;

/**
 * Quadrature rules of many patches, each coordinate of each point contiguous over the patches:
 * point p of patch k has its x at Points[0][p * Stride + k]. All arrays may be read up to Lanes
 * patches beyond the last one. Points of weight 0 fill up where a patch has fewer than Count.
 */
struct Patches
{
  const double* Normals[3];
  const double* Centroids[3];
  const double* Radii;
  const double* Points[3];
  const double* Weights;
  long Stride;
};

/**
 * pi times the exchange of patch `row`, by its first `rowCount` points in `rows`, with patches
 * [first, first + count), by their first `columnCount` points in `columns`, in sums[0 ... count).
 * Cosines are clamped at zero point by point.
 *
 * Where `margins` is not null it gets, for each patch, the smaller of the two heights of a centroid
 * over the other's plane, in units of the centroid's patch's radius: from 1 on no plane cuts the
 * other patch, down to -1 one lies behind the other.
 */
void IntegrateRow(const Patches& rows, int rowCount, long row, const Patches& columns,
  int columnCount, long first, int count, double* sums, double* margins);

/// A line in space seen from a segment: all that the integral of ln |x(s) - y| over the segment's
/// points y needs, for x(s) along the line.
struct Segments
{
  double Along[2];     ///< x(s) from the segment's start, along it: Along[0] + s Along[1]
  double Across[3][2]; ///< and across it
  double Length;
};

/// The integral over s in [begin, end] of the integral of ln |x(s) - y| over the segment, by the
/// 15-point Gauss-Kronrod rule.
double IntegrateKronrod(const Segments& segments, double begin, double end);

/**
 * The integrals of ln |x - y| over `count` segments (at most 2 * Lanes; all arrays have room for as
 * many): x is along[k] from the start of segment k in its direction, and the root of squared[k]
 * from its line.
 */
void IntegrateLogarithms(const double* along, const double* squared, const double* lengths,
  int count, double* results);
} // namespace QuadratureKernels
} // namespace LightTransport

#endif
