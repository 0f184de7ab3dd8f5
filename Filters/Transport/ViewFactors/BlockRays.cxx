// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/BlockRays.h"

#include "Geometry/PatchSampler.h"
#include "Geometry/Polygon.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace LightTransport
{
namespace
{
// What a row may exchange with a block on which a verdict is given, of the tolerance.
constexpr double LargestShare = 0.5;
// The error of a verdict, relative to the exchange, over the tolerance of a row: usually they are
// off by a part of it (RowBudget), so that all verdicts of a row, on no more than all that leaves
// it, leave half of the tolerance to others.
constexpr double ErrorOfTolerance = 2.0;
// Rays of a patch, times the square root of the tolerance: what n rays do not meet is some part
// 1 / n^2 of what there is, if all parts are as likely as each other.
constexpr double RaysOfTolerance = 0.8;
// Rays for each pair at most: looking at one takes as long as some of them.
constexpr double RaysOfPair = 2.0;
// Spreads a sequence of places evenly, however many there are of them.
constexpr double GoldenRatio = 0.6180339887498949;
} // namespace

// The rays of one block, until they disagree.
class BlockRays::Poll
{
public:
  Poll(const BlockRays& outer, const Block& block)
    : Outer(outer), Own(block), Sampler(static_cast<std::uint64_t>(block.FirstI) << 32 ^
                                  static_cast<std::uint64_t>(block.FirstJ)),
      Begin(Sampler.Get(0, 0))
  {
  }

  bool IsOpen() const { return this->Blocked == 0 || this->Passed == 0; }
  Verdict Get() const
  {
    const bool isEnough = 2 * (this->Blocked + this->Passed) > this->Index;
    const Verdict verdict = this->Blocked > 0 ? Verdict::Hidden : Verdict::Free;
    return isEnough && this->IsOpen() ? verdict : Verdict::Unknown;
  }

  // From one patch of the first block to some of the other that it exchanges anything with.
  void CastFromRow(vtkIdType row)
  {
    this->Cast(this->Own.Columns, [row](vtkIdType k) { return Pair{ row, k }; });
  }
  void CastFromColumn(vtkIdType column)
  {
    this->Cast(this->Own.Rows, [column](vtkIdType k) { return Pair{ k, column }; });
  }

private:
  struct Pair
  {
    vtkIdType Row, Column;
  };

  template <typename GetPair>
  void Cast(vtkIdType count, const GetPair& getPair)
  {
    const double place = this->Begin + GoldenRatio * this->Index;
    const auto first =
      static_cast<vtkIdType>((place - std::floor(place)) * static_cast<double>(count));
    for (vtkIdType k = 0; k < count; ++k)
    {
      const Pair pair = getPair((first + k) % count);
      if (this->Own.GetValue(pair.Row, pair.Column) > 0.0)
      {
        this->Cast(this->Own.FirstI + pair.Row, this->Own.FirstJ + pair.Column);
        return;
      }
    }
  }

  // Where one end is behind the plane of the other nothing is exchanged.
  void Cast(vtkIdType i, vtkIdType j)
  {
    this->From.Set(this->Outer.Scene, i);
    this->To.Set(this->Outer.Scene, j);
    const Polygon::Vector a = this->Sampler.GetPoint(this->From, this->Index, 0);
    const Polygon::Vector b = this->Sampler.GetPoint(this->To, this->Index, 2);
    ++this->Index;
    if (this->From.Normal.dot(b - a) > 0.0 && this->To.Normal.dot(a - b) > 0.0)
    {
      ++(this->Outer.Caster.IsOccluded(a, b, i, j) ? this->Blocked : this->Passed);
    }
  }

  const BlockRays& Outer;
  const Block& Own;
  const PatchSampler Sampler;
  const double Begin;
  Polygon From, To;
  int Index = 0;
  int Blocked = 0;
  int Passed = 0;
};

//------------------------------------------------------------------------------
BlockRays::BlockRays(const PatchScene& scene, double tolerance)
  : Scene(scene), Tolerance(tolerance), Error(ErrorOfTolerance * tolerance),
    Rays(static_cast<int>(std::ceil(RaysOfTolerance / std::sqrt(std::max(tolerance, 1e-6)))))
{
  this->HasRays = static_cast<bool>(this->Caster.Build(scene));
}

//------------------------------------------------------------------------------
// Whether no row exchanges much.
bool BlockRays::IsLittle(const Block& block) const
{
  const double* const areas = this->Scene.GetAreas().data();
  const double share = LargestShare * this->Tolerance;
  std::array<double, MostPatches> columns{};
  for (vtkIdType row = 0; row < block.Rows; ++row)
  {
    double sum = 0.0;
    for (vtkIdType column = 0; column < block.Columns; ++column)
    {
      sum += block.GetValue(row, column);
      columns[column] += block.GetValue(row, column);
    }
    if (sum > share * areas[block.FirstI + row])
    {
      return false;
    }
  }
  for (vtkIdType column = 0; column < block.Columns; ++column)
  {
    if (columns[column] > share * areas[block.FirstJ + column])
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
BlockRays::Verdict BlockRays::Ask(int nodeI, int nodeJ, const float* values, vtkIdType stride) const
{
  const PatchTree::Node& i = this->Scene.GetTree().GetNode(nodeI);
  const PatchTree::Node& j = this->Scene.GetTree().GetNode(nodeJ);
  const Block block{ i.First, j.First, i.GetSize(), j.GetSize(), values, stride };
  const auto pairs = static_cast<double>(block.Rows * block.Columns);
  const auto rays = static_cast<double>(this->Rays * (block.Rows + block.Columns));
  if (!this->HasRays || nodeI == nodeJ || std::max(block.Rows, block.Columns) > MostPatches ||
    rays > RaysOfPair * pairs || !this->IsLittle(block))
  {
    return Verdict::Unknown;
  }
  Poll poll(*this, block);
  for (int round = 0; round < this->Rays && poll.IsOpen(); ++round)
  {
    for (vtkIdType row = 0; row < block.Rows && poll.IsOpen(); ++row)
    {
      poll.CastFromRow(row);
    }
    for (vtkIdType column = 0; column < block.Columns && poll.IsOpen(); ++column)
    {
      poll.CastFromColumn(column);
    }
  }
  return poll.Get();
}
} // namespace LightTransport
