// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The innermost loops of the dense link operator: products with one tile of a vtkExchangeMatrix.
 * Tiles are single precision, sums are double. Compiled for several instruction sets, chosen when
 * the library is loaded: the default platform's x86-64 baseline would be limited by arithmetic, not
 * by memory.
 */
#ifndef TileKernels_h
#define TileKernels_h

namespace LightTransport
{
namespace TileKernels
{
/// Bands that one pass over a tile serves; more bands take another pass.
constexpr int MaximumBands = 4;

/**
 * An off-diagonal tile serves both directions: yRow += G xColumn and yColumn += G^T xRow. `stride`
 * is the distance between bands in all four vectors, which point to the first patch of the tile's
 * rows or columns.
 */
void MultiplyTile(const float* tile, int bands, long stride, const double* xRow,
  const double* xColumn, double* yRow, double* yColumn);

/// One direction only: y += G x. Diagonal tiles, which are stored in full, need no more.
void MultiplyTileRows(const float* tile, int bands, long stride, const double* x, double* y);

/// The other direction only: y += G^T x.
void MultiplyTileColumns(const float* tile, int bands, long stride, const double* x, double* y);

/// The instruction set in use, for reports: "AVX-512", "AVX2" or "baseline".
const char* GetInstructionSet();
} // namespace TileKernels
} // namespace LightTransport

#endif
