// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Operators/TileKernels.h"

#include "Support/InstructionSets.h"
#include "vtkExchangeMatrix.h"

namespace LightTransport
{
namespace
{
constexpr int N = vtkExchangeMatrix::TileSize;

// Eight columns at once; the compiler splits them where its registers are narrower. Helpers take
// vectors by reference: passed by value their calling convention would depend on the instruction
// set.
constexpr int Lanes = 8;
typedef double Wide __attribute__((vector_size(Lanes * sizeof(double))));
typedef double WideUnaligned
  __attribute__((vector_size(Lanes * sizeof(double)), aligned(alignof(double)), may_alias));

//------------------------------------------------------------------------------
LT_INLINE void Load(const double* source, Wide& values)
{
  values = *reinterpret_cast<const WideUnaligned*>(source);
}

//------------------------------------------------------------------------------
LT_INLINE void Load(const float* source, Wide& values)
{
  // Not __builtin_convertvector: GCC makes one instruction of this loop and four of that.
  for (int lane = 0; lane < Lanes; ++lane)
  {
    values[lane] = source[lane];
  }
}

//------------------------------------------------------------------------------
LT_INLINE void Store(double* target, const Wide& values)
{
  *reinterpret_cast<WideUnaligned*>(target) = values;
}

//------------------------------------------------------------------------------
LT_INLINE double Sum(const Wide& values)
{
  double sum = 0.0;
  for (int lane = 0; lane < Lanes; ++lane)
  {
    sum += values[lane];
  }
  return sum;
}

// Rows that are handled together: what is loaded and stored per column serves all of them, and
// their sums stay in registers.
constexpr int Rows = 4;

//------------------------------------------------------------------------------
// Ask for a part of the rows that come in two steps' time, as large as what one step over the
// columns reads: processors follow long runs of addresses by themselves, but not four rows in turn.
// Into the second-level cache, since the first holds the vectors. After the last rows this is the
// next tile, and at the end of the matrix nothing: a prefetch reads no memory that is not there.
LT_INLINE void PrefetchComingRows(const float* tile, int first, int column)
{
  constexpr int forReading = 0;
  constexpr int secondLevel = 2;
  const float* values = tile + (first + 2 * Rows) * N + column * Rows;
  __builtin_prefetch(values, forReading, secondLevel);
  __builtin_prefetch(values + 64 / sizeof(float), forReading, secondLevel);
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void Spread(const double* x, long stride, Wide (&values)[Rows][Bands])
{
  const Wide zero = {};
  for (int row = 0; row < Rows; ++row)
  {
    for (int band = 0; band < Bands; ++band)
    {
      values[row][band] = x[band * stride + row] + zero;
    }
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void AddSums(const Wide (&sums)[Rows][Bands], long stride, double* y)
{
  for (int row = 0; row < Rows; ++row)
  {
    for (int band = 0; band < Bands; ++band)
    {
      y[band * stride + row] += Sum(sums[row][band]);
    }
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void MultiplyTileBands(const float* tile, long stride, const double* xRow,
  const double* xColumn, double* yRow, double* yColumn)
{
  for (int first = 0; first < N; first += Rows)
  {
    Wide factors[Rows][Bands];
    Wide sums[Rows][Bands] = {};
    Spread(xRow + first, stride, factors);
    for (int column = 0; column < N; column += Lanes)
    {
      PrefetchComingRows(tile, first, column);
      Wide values[Rows];
#pragma GCC unroll 4
      for (int row = 0; row < Rows; ++row)
      {
        Load(tile + (first + row) * N + column, values[row]);
      }
#pragma GCC unroll 4
      for (int band = 0; band < Bands; ++band)
      {
        Wide x;
        Wide y;
        Load(xColumn + band * stride + column, x);
        Load(yColumn + band * stride + column, y);
#pragma GCC unroll 4
        for (int row = 0; row < Rows; ++row)
        {
          sums[row][band] += values[row] * x;
          y += values[row] * factors[row][band];
        }
        Store(yColumn + band * stride + column, y);
      }
    }
    AddSums(sums, stride, yRow + first);
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void MultiplyRowsBands(const float* tile, long stride, const double* x, double* y)
{
  for (int first = 0; first < N; first += Rows)
  {
    Wide sums[Rows][Bands] = {};
    for (int column = 0; column < N; column += Lanes)
    {
      PrefetchComingRows(tile, first, column);
      Wide factors[Bands];
#pragma GCC unroll 4
      for (int band = 0; band < Bands; ++band)
      {
        Load(x + band * stride + column, factors[band]);
      }
#pragma GCC unroll 4
      for (int row = 0; row < Rows; ++row)
      {
        Wide values;
        Load(tile + (first + row) * N + column, values);
#pragma GCC unroll 4
        for (int band = 0; band < Bands; ++band)
        {
          sums[row][band] += values * factors[band];
        }
      }
    }
    AddSums(sums, stride, y + first);
  }
}

//------------------------------------------------------------------------------
template <int Bands>
LT_INLINE void MultiplyColumnsBands(const float* tile, long stride, const double* x, double* y)
{
  for (int first = 0; first < N; first += Rows)
  {
    Wide factors[Rows][Bands];
    Spread(x + first, stride, factors);
    for (int column = 0; column < N; column += Lanes)
    {
      PrefetchComingRows(tile, first, column);
      Wide values[Rows];
#pragma GCC unroll 4
      for (int row = 0; row < Rows; ++row)
      {
        Load(tile + (first + row) * N + column, values[row]);
      }
#pragma GCC unroll 4
      for (int band = 0; band < Bands; ++band)
      {
        Wide sum;
        Load(y + band * stride + column, sum);
#pragma GCC unroll 4
        for (int row = 0; row < Rows; ++row)
        {
          sum += values[row] * factors[row][band];
        }
        Store(y + band * stride + column, sum);
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
const TileFunction TileFunctions[TileKernels::MaximumBands] = { Tile1, Tile2, Tile3, Tile4 };
const OneWayFunction RowsFunctions[TileKernels::MaximumBands] = { Rows1, Rows2, Rows3, Rows4 };
const OneWayFunction ColumnsFunctions[TileKernels::MaximumBands] = { Columns1, Columns2, Columns3,
  Columns4 };

//------------------------------------------------------------------------------
void MultiplyOneWay(const OneWayFunction* functions, const float* tile, int bands, long stride,
  const double* x, double* y)
{
  constexpr int most = TileKernels::MaximumBands;
  for (int band = 0; band < bands; band += most)
  {
    const int count = bands - band < most ? bands - band : most;
    functions[count - 1](tile, stride, x + band * stride, y + band * stride);
  }
}
} // namespace

namespace TileKernels
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
  if (__builtin_cpu_supports("x86-64-v4"))
  {
    return "AVX-512";
  }
  if (__builtin_cpu_supports("x86-64-v3"))
  {
    return "AVX2";
  }
#endif
  return "baseline";
}
} // namespace TileKernels
} // namespace LightTransport
