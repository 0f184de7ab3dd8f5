// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLinkKernels.h"

#include "vtkExchangeMatrix.h"

// Several clones of one function, one per instruction set: GCC and Clang on x86-64 Linux resolve
// them at load time.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define LT_CLONES __attribute__((target_clones("default", "arch=haswell", "arch=skylake-avx512")))
#define LT_X86_CLONES 1
#else
#define LT_CLONES
#endif
#if defined(__GNUC__)
#define LT_INLINE inline __attribute__((always_inline))
#else
#define LT_INLINE inline
#endif

namespace
{
constexpr int N = vtkExchangeMatrix::TileSize;

//------------------------------------------------------------------------------
// Two rows at a time: the column vectors are loaded and stored once for both, and the sums stay in
// registers.
template <int Bands>
LT_INLINE void MultiplyTileBands(const float* tile, long stride, const double* xRow,
  const double* xColumn, double* yRow, double* yColumn)
{
  for (int row = 0; row < N; row += 2)
  {
    const float* g0 = tile + row * N;
    const float* g1 = g0 + N;
    double x0[Bands], x1[Bands], sum0[Bands], sum1[Bands];
    for (int band = 0; band < Bands; ++band)
    {
      x0[band] = xRow[band * stride + row];
      x1[band] = xRow[band * stride + row + 1];
      sum0[band] = sum1[band] = 0.0;
    }
#pragma omp simd reduction(+ : sum0[:Bands], sum1[:Bands])
    for (int column = 0; column < N; ++column)
    {
      const double a = g0[column];
      const double b = g1[column];
      for (int band = 0; band < Bands; ++band)
      {
        const double x = xColumn[band * stride + column];
        sum0[band] += a * x;
        sum1[band] += b * x;
        yColumn[band * stride + column] += a * x0[band] + b * x1[band];
      }
    }
    for (int band = 0; band < Bands; ++band)
    {
      yRow[band * stride + row] += sum0[band];
      yRow[band * stride + row + 1] += sum1[band];
    }
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void MultiplyRowsBands(const float* tile, long stride, const double* x, double* y)
{
  for (int row = 0; row < N; ++row)
  {
    const float* g = tile + row * N;
    double sum[Bands] = {};
#pragma omp simd reduction(+ : sum[:Bands])
    for (int column = 0; column < N; ++column)
    {
      for (int band = 0; band < Bands; ++band)
      {
        sum[band] += static_cast<double>(g[column]) * x[band * stride + column];
      }
    }
    for (int band = 0; band < Bands; ++band)
    {
      y[band * stride + row] += sum[band];
    }
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void MultiplyColumnsBands(const float* tile, long stride, const double* x, double* y)
{
  for (int row = 0; row < N; ++row)
  {
    const float* g = tile + row * N;
    double factor[Bands];
    for (int band = 0; band < Bands; ++band)
    {
      factor[band] = x[band * stride + row];
    }
#pragma omp simd
    for (int column = 0; column < N; ++column)
    {
      for (int band = 0; band < Bands; ++band)
      {
        y[band * stride + column] += static_cast<double>(g[column]) * factor[band];
      }
    }
  }
}

#define LT_DEFINE_BANDS(Bands)                                                                     \
  LT_CLONES void Tile##Bands(const float* tile, long stride, const double* xRow,                   \
    const double* xColumn, double* yRow, double* yColumn)                                          \
  {                                                                                                \
    MultiplyTileBands<Bands>(tile, stride, xRow, xColumn, yRow, yColumn);                          \
  }                                                                                                \
  LT_CLONES void Rows##Bands(const float* tile, long stride, const double* x, double* y)           \
  {                                                                                                \
    MultiplyRowsBands<Bands>(tile, stride, x, y);                                                  \
  }                                                                                                \
  LT_CLONES void Columns##Bands(const float* tile, long stride, const double* x, double* y)        \
  {                                                                                                \
    MultiplyColumnsBands<Bands>(tile, stride, x, y);                                               \
  }
LT_DEFINE_BANDS(1)
LT_DEFINE_BANDS(2)
LT_DEFINE_BANDS(3)
LT_DEFINE_BANDS(4)
#undef LT_DEFINE_BANDS

using TileFunction = void (*)(const float*, long, const double*, const double*, double*, double*);
using OneWayFunction = void (*)(const float*, long, const double*, double*);
const TileFunction TileFunctions[vtkLinkKernels::MaximumBands] = { Tile1, Tile2, Tile3, Tile4 };
const OneWayFunction RowsFunctions[vtkLinkKernels::MaximumBands] = { Rows1, Rows2, Rows3, Rows4 };
const OneWayFunction ColumnsFunctions[vtkLinkKernels::MaximumBands] = { Columns1, Columns2,
  Columns3, Columns4 };

//------------------------------------------------------------------------------
void MultiplyOneWay(const OneWayFunction* functions, const float* tile, int bands, long stride,
  const double* x, double* y)
{
  constexpr int most = vtkLinkKernels::MaximumBands;
  for (int band = 0; band < bands; band += most)
  {
    const int count = bands - band < most ? bands - band : most;
    functions[count - 1](tile, stride, x + band * stride, y + band * stride);
  }
}
} // namespace

namespace vtkLinkKernels
{
//------------------------------------------------------------------------------
void MultiplyTile(const float* tile, int bands, long stride, const double* xRow,
  const double* xColumn, double* yRow, double* yColumn)
{
  for (int band = 0; band < bands; band += MaximumBands)
  {
    const int count = bands - band < MaximumBands ? bands - band : MaximumBands;
    const long offset = band * stride;
    TileFunctions[count - 1](tile, stride, xRow + offset, xColumn + offset, yRow + offset,
      yColumn + offset);
  }
}

//------------------------------------------------------------------------------
void MultiplyTileRows(const float* tile, int bands, long stride, const double* x, double* y)
{
  MultiplyOneWay(RowsFunctions, tile, bands, stride, x, y);
}

//------------------------------------------------------------------------------
void MultiplyTileColumns(const float* tile, int bands, long stride, const double* x, double* y)
{
  MultiplyOneWay(ColumnsFunctions, tile, bands, stride, x, y);
}

//------------------------------------------------------------------------------
const char* GetInstructionSet()
{
#ifdef LT_X86_CLONES
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
  {
    return "AVX-512";
  }
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    return "AVX2";
  }
#endif
  return "baseline";
}
} // namespace vtkLinkKernels
