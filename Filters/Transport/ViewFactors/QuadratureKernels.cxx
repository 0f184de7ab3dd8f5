// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/QuadratureKernels.h"

#include "Support/InstructionSets.h"

namespace LightTransport
{
namespace
{
using QuadratureKernels::Lanes;
using QuadratureKernels::Patches;
using QuadratureKernels::Segments;

// Helpers take vectors by reference: passed by value their calling convention would depend on the
// instruction set.
typedef double Wide __attribute__((vector_size(Lanes * sizeof(double))));
typedef double WideUnaligned
  __attribute__((vector_size(Lanes * sizeof(double)), aligned(alignof(double)), may_alias));
typedef long long WideInteger __attribute__((vector_size(Lanes * sizeof(long long))));

//------------------------------------------------------------------------------
LT_INLINE void Load(const double* source, Wide& values)
{
  values = *reinterpret_cast<const WideUnaligned*>(source);
}

//------------------------------------------------------------------------------
LT_INLINE void Load(const double* const* sources, long offset, Wide (&values)[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    Load(sources[axis] + offset, values[axis]);
  }
}

//------------------------------------------------------------------------------
LT_INLINE void Store(double* target, const Wide& values, int count)
{
  if (count >= Lanes)
  {
    *reinterpret_cast<WideUnaligned*>(target) = values;
    return;
  }
  for (int lane = 0; lane < count; ++lane)
  {
    target[lane] = values[lane];
  }
}

// Heights over a plane below this are the rounding of coordinates (the scene's diagonal is 1).
constexpr double HeightRounding = 1e-15;

//------------------------------------------------------------------------------
LT_INLINE void Clamp(Wide& heights)
{
  const Wide zero = {};
  heights = heights > HeightRounding - zero ? heights : zero;
}

//------------------------------------------------------------------------------
// Sum of numerator / denominator over the terms, with one division for every four of them:
// divisions cost more than all the rest.
template <int Terms>
LT_INLINE void SumOfQuotients(const Wide* numerators, const Wide* denominators, Wide& sum)
{
  sum = Wide{};
#pragma GCC unroll 8
  for (int first = 0; first < Terms; first += 4)
  {
    Wide numerator = numerators[first];
    Wide denominator = denominators[first];
    for (int term = first + 1; term < first + 4 && term < Terms; ++term)
    {
      numerator = numerator * denominators[term] + numerators[term] * denominator;
      denominator *= denominators[term];
    }
    sum += numerator / denominator;
  }
}

// A patch as the rows of a kernel see it.
struct Row
{
  double Normal[3];
  double Centroid[3];
  double Radius;
};

//------------------------------------------------------------------------------
LT_INLINE Row GetRow(const Patches& rows, long row)
{
  Row patch;
  for (int axis = 0; axis < 3; ++axis)
  {
    patch.Normal[axis] = rows.Normals[axis][row];
    patch.Centroid[axis] = rows.Centroids[axis][row];
  }
  patch.Radius = rows.Radii[row];
  return patch;
}

//------------------------------------------------------------------------------
LT_INLINE void GetMargins(const Row& row, const Wide (&normals)[3], const Wide (&centroids)[3],
  const Wide& radii, Wide& margins)
{
  Wide heightOfColumn = {};
  Wide heightOfRow = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    const Wide between = centroids[axis] - row.Centroid[axis];
    heightOfColumn += row.Normal[axis] * between;
    heightOfRow -= normals[axis] * between;
  }
  heightOfColumn /= radii;
  heightOfRow /= row.Radius;
  margins = heightOfColumn < heightOfRow ? heightOfColumn : heightOfRow;
}

//------------------------------------------------------------------------------
// One row, Lanes columns. What depends on the points of one side alone (a height over the other's
// plane, which is the same from all points of that plane) is taken out of the double sum.
template <int Count>
LT_INLINE void IntegrateLanes(const Row& row, const Patches& rows, int rowCount, long index,
  const Patches& columns, long first, const Wide (&normals)[3], const Wide (&centroids)[3],
  Wide& total)
{
  Wide points[Count][3];
  Wide heights[Count];
#pragma GCC unroll 25
  for (int point = 0; point < Count; ++point)
  {
    const long offset = point * columns.Stride + first;
    Load(columns.Points, offset, points[point]);
    heights[point] = row.Normal[0] * (points[point][0] - row.Centroid[0]) +
      row.Normal[1] * (points[point][1] - row.Centroid[1]) +
      row.Normal[2] * (points[point][2] - row.Centroid[2]);
    Clamp(heights[point]);
    Wide weights;
    Load(columns.Weights + offset, weights);
    heights[point] *= weights;
  }
  total = Wide{};
  for (int rowPoint = 0; rowPoint < rowCount; ++rowPoint)
  {
    const long offset = rowPoint * rows.Stride + index;
    const double x = rows.Points[0][offset];
    const double y = rows.Points[1][offset];
    const double z = rows.Points[2][offset];
    Wide height = normals[0] * (x - centroids[0]) + normals[1] * (y - centroids[1]) +
      normals[2] * (z - centroids[2]);
    Clamp(height);
    Wide fourth[Count];
#pragma GCC unroll 25
    for (int point = 0; point < Count; ++point)
    {
      const Wide dx = points[point][0] - x;
      const Wide dy = points[point][1] - y;
      const Wide dz = points[point][2] - z;
      const Wide squared = dx * dx + dy * dy + dz * dz;
      fourth[point] = squared * squared;
    }
    Wide sum;
    SumOfQuotients<Count>(heights, fourth, sum);
    total += rows.Weights[offset] * (height * sum);
  }
}

//------------------------------------------------------------------------------
template <int Count>
LT_INLINE void IntegrateColumns(const Patches& rows, int rowCount, long index,
  const Patches& columns, long first, int count, double* sums, double* margins)
{
  const Row row = GetRow(rows, index);
  for (int column = 0; column < count; column += Lanes)
  {
    Wide normals[3];
    Wide centroids[3];
    Load(columns.Normals, first + column, normals);
    Load(columns.Centroids, first + column, centroids);
    Wide total;
    IntegrateLanes<Count>(row, rows, rowCount, index, columns, first + column, normals, centroids,
      total);
    Store(sums + column, total, count - column);
    if (margins)
    {
      Wide radii;
      Load(columns.Radii + first + column, radii);
      Wide lowest;
      GetMargins(row, normals, centroids, radii, lowest);
      Store(margins + column, lowest, count - column);
    }
  }
}

#define LT_DEFINE_COUNT(Count)                                                                     \
  LT_CLONES void Integrate##Count(const Patches& rows, int rowCount, long index,                   \
    const Patches& columns, long first, int count, double* sums, double* margins)                  \
  {                                                                                                \
    IntegrateColumns<Count>(rows, rowCount, index, columns, first, count, sums, margins);          \
  }
LT_DEFINE_COUNT(1)
LT_DEFINE_COUNT(3)
LT_DEFINE_COUNT(4)
LT_DEFINE_COUNT(6)
LT_DEFINE_COUNT(7)
LT_DEFINE_COUNT(9)
LT_DEFINE_COUNT(16)
LT_DEFINE_COUNT(25)
#undef LT_DEFINE_COUNT

//------------------------------------------------------------------------------
// The Kronrod rule of 15 points on [-1, 1] (Kronrod 1965; the nodes of Piessens et al., QUADPACK,
// 1983), and one node of no weight.
constexpr int KronrodPoints = 16;
constexpr double Nodes[KronrodPoints] = { -0.991455371120812639206854697526329,
  -0.949107912342758524526189684047851, -0.864864423359769072789712788640926,
  -0.741531185599394439863864773280788, -0.586087235467691130294144691693013,
  -0.405845151377397166906606412076961, -0.207784955007898467600689403773245, 0.0,
  0.207784955007898467600689403773245, 0.405845151377397166906606412076961,
  0.586087235467691130294144691693013, 0.741531185599394439863864773280788,
  0.864864423359769072789712788640926, 0.949107912342758524526189684047851,
  0.991455371120812639206854697526329, 0.0 };
constexpr double KronrodWeights[KronrodPoints] = { 0.022935322010529224963732008058970,
  0.063092092629978553290700663189204, 0.104790010322250183839876322541518,
  0.140653259715525918745189590510238, 0.169004726639267902826583426598550,
  0.190350578064785409913256402421014, 0.204432940075298892414161999234649,
  0.209482141084727828012999174891714, 0.204432940075298892414161999234649,
  0.190350578064785409913256402421014, 0.169004726639267902826583426598550,
  0.140653259715525918745189590510238, 0.104790010322250183839876322541518,
  0.063092092629978553290700663189204, 0.022935322010529224963732008058970, 0.0 };
//------------------------------------------------------------------------------
LT_INLINE void SquareRoot(const Wide& x, Wide& result)
{
  for (int lane = 0; lane < Lanes; ++lane)
  {
    result[lane] = __builtin_sqrt(x[lane]);
  }
}

//------------------------------------------------------------------------------
// ln x for positive normal x, to about an ulp: x = 2^e m with m around 1, ln m = 2 artanh((m - 1) /
// (m + 1)) by its series.
LT_INLINE void Logarithm(const Wide& x, Wide& result)
{
  const WideInteger rootHalf = 0x3FE6A09E667F3BCDll - WideInteger{};
  // In the low bits of this number an integer becomes a double without a conversion, which not all
  // instruction sets have.
  constexpr double magic = 6755399441055744.0; // 1.5 * 2^52
  const WideInteger magicBits = 0x4338000000000000ll - WideInteger{};
  const WideInteger bits = (WideInteger)x;
  const WideInteger exponent = (bits - rootHalf) >> 52;
  const Wide mantissa = (Wide)(bits - (exponent << 52));
  const Wide scale = (Wide)(exponent + magicBits) - magic;
  const Wide part = mantissa - 1.0;
  const Wide ratio = part / (part + 2.0);
  const Wide squared = ratio * ratio;
  Wide series = 1.0 / 23.0 - Wide{};
#pragma GCC unroll 10
  for (int odd = 21; odd > 1; odd -= 2)
  {
    series = series * squared + 1.0 / odd;
  }
  constexpr double ln2High = 0.693147180369123816490;
  constexpr double ln2Low = 1.90821492927058770002e-10;
  result = scale * ln2High + (2.0 * ratio + (2.0 * ratio * squared * series + scale * ln2Low));
}

//------------------------------------------------------------------------------
// The angle of (x, y), y >= 0, in [0, pi]; 0 at the origin.
LT_INLINE void Angle(const Wide& y, const Wide& x, Wide& result)
{
  constexpr double tan16 = 0.198912367379658006911598;  // tan(pi / 16)
  constexpr double tan8 = 0.414213562373095048801689;   // tan(pi / 8)
  constexpr double tan316 = 0.668178637919298919997758; // tan(3 pi / 16)
  constexpr double pi = 3.14159265358979323846;
  const Wide zero = {};
  const Wide one = 1.0 - zero;
  const Wide size = x < zero ? -x : x;
  const Wide low = y < size ? y : size;
  const Wide high = y < size ? size : y;
  // atan t = atan c + atan((t - c) / (1 + c t)), c = 0, tan(pi / 8) or 1.
  const Wide center = low < tan16 * high ? zero : (low < tan316 * high ? tan8 - zero : one);
  Wide angle = low < tan16 * high ? zero : (low < tan316 * high ? pi / 8 - zero : pi / 4 - zero);
  Wide denominator = high + center * low;
  denominator = denominator > zero ? denominator : one;
  const Wide ratio = (low - center * high) / denominator;
  const Wide squared = ratio * ratio;
  Wide series = 1.0 / 25.0 - zero;
#pragma GCC unroll 11
  for (int odd = 23; odd > 1; odd -= 2)
  {
    series = 1.0 / odd - series * squared;
  }
  angle += ratio - ratio * squared * series;
  angle = y < size ? angle : pi / 2 - angle;
  result = x < zero ? pi - angle : angle;
}

//------------------------------------------------------------------------------
// x ln x^2 / 2, 0 at 0.
LT_INLINE void TimesLogarithm(const Wide& x, const Wide& squared, Wide& result)
{
  const Wide zero = {};
  const Wide safe = squared > zero ? squared : 1.0 - zero;
  Logarithm(safe, result);
  result *= 0.5 * x;
}

//------------------------------------------------------------------------------
LT_INLINE void IntegrateLogarithm(const Wide& along, const Wide& squared, const Wide& length,
  Wide& result)
{
  const Wide first = -along;
  const Wide last = length - along;
  Wide height;
  SquareRoot(squared, height);
  Wide upper;
  Wide lower;
  Wide angle;
  TimesLogarithm(last, last * last + squared, upper);
  TimesLogarithm(first, first * first + squared, lower);
  Angle(height * length, squared + first * last, angle);
  result = upper - lower - length + height * angle;
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

//------------------------------------------------------------------------------
LT_CLONES double Kronrod(const Segments& segments, double begin, double end)
{
  const double center = 0.5 * (begin + end);
  const double half = 0.5 * (end - begin);
  Wide sum = {};
  for (int node = 0; node < KronrodPoints; node += Lanes)
  {
    Wide nodes;
    Wide weights;
    Load(Nodes + node, nodes);
    Load(KronrodWeights + node, weights);
    const Wide s = center + half * nodes;
    const Wide along = segments.Along[0] + s * segments.Along[1];
    Wide squared = {};
    for (int axis = 0; axis < 3; ++axis)
    {
      const Wide across = segments.Across[axis][0] + s * segments.Across[axis][1];
      squared += across * across;
    }
    Wide value;
    IntegrateLogarithm(along, squared, segments.Length - Wide{}, value);
    sum += weights * value;
  }
  return half * Sum(sum);
}

//------------------------------------------------------------------------------
LT_CLONES void Logarithms(const double* along, const double* squared, const double* lengths,
  int count, double* results)
{
  for (int first = 0; first < count; first += Lanes)
  {
    Wide x;
    Wide y;
    Wide length;
    Wide result;
    Load(along + first, x);
    Load(squared + first, y);
    Load(lengths + first, length);
    IntegrateLogarithm(x, y, length, result);
    Store(results + first, result, Lanes);
  }
}
} // namespace

namespace QuadratureKernels
{
//------------------------------------------------------------------------------
void IntegrateRow(const Patches& rows, int rowCount, long row, const Patches& columns,
  int columnCount, long first, int count, double* sums, double* margins)
{
  switch (columnCount)
  {
    case 1:
      return Integrate1(rows, rowCount, row, columns, first, count, sums, margins);
    case 3:
      return Integrate3(rows, rowCount, row, columns, first, count, sums, margins);
    case 4:
      return Integrate4(rows, rowCount, row, columns, first, count, sums, margins);
    case 6:
      return Integrate6(rows, rowCount, row, columns, first, count, sums, margins);
    case 7:
      return Integrate7(rows, rowCount, row, columns, first, count, sums, margins);
    case 9:
      return Integrate9(rows, rowCount, row, columns, first, count, sums, margins);
    case 16:
      return Integrate16(rows, rowCount, row, columns, first, count, sums, margins);
    default:
      return Integrate25(rows, rowCount, row, columns, first, count, sums, margins);
  }
}

//------------------------------------------------------------------------------
double IntegrateKronrod(const Segments& segments, double begin, double end)
{
  return Kronrod(segments, begin, end);
}

//------------------------------------------------------------------------------
void IntegrateLogarithms(const double* along, const double* squared, const double* lengths,
  int count, double* results)
{
  Logarithms(along, squared, lengths, count, results);
}
} // namespace QuadratureKernels
} // namespace LightTransport
