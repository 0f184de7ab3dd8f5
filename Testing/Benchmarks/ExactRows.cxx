// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ExactRows.h"
#include "Geometry/ShaftCuller.h"
#include "Shared/Threads.h"
#include "ViewFactors/PairVisibility.h"
#include "ViewFactors/UnoccludedPairs.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>

using namespace LightTransport;

namespace
{
constexpr std::uint32_t Seed = 4;
// Of the sum of the errors of a row with nothing in between.
constexpr double OpenTolerance = 1e-5;
// How exact the visible part of a pair is, and what it may do to the row: errors of single pairs
// have no common sign.
constexpr double ShareTolerance = 1e-2;
constexpr double RowTolerance = 1e-4;
} // end of anonymous namespace

//------------------------------------------------------------------------------
struct ExactRows::Worker
{
  ExactRows& Outer;
  const std::vector<const Values*>& Vectors;
  const UnoccludedPairs& Open;
  const ShaftCuller& Culler;
  const std::vector<int>& Leaves; ///< of each patch

  /// One row at work.
  struct Row
  {
    std::size_t Index;
    vtkIdType Patch;
    int Leaf;
    PairVisibility Visibility;
    std::vector<ShaftCuller::Occluder> Between;
  };

  void operator()(vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType index = begin; index < end; ++index)
    {
      const vtkIdType patch = this->Outer.Patches[index];
      Row row{ static_cast<std::size_t>(index), patch, this->Leaves[patch], {}, {} };
      this->Descend(0, !this->Culler.HasOccluders(), row);
    }
  }

  void Descend(int node, bool isFree, Row& row) const
  {
    if (!this->Open.MayFace(row.Leaf, node))
    {
      return;
    }
    isFree = isFree || !this->Culler.MayBlock(row.Leaf, node);
    const PatchTree::Node& there = this->Outer.Scene.GetTree().GetNode(node);
    if (!there.IsLeaf())
    {
      this->Descend(there.Left, isFree, row);
      this->Descend(there.Left + 1, isFree, row);
      return;
    }
    for (vtkIdType j = there.First; j < there.Last; ++j)
    {
      this->AddPair(j, isFree, row);
    }
  }

  void AddPair(vtkIdType j, bool isFree, Row& row) const
  {
    const PairIntegrals::Estimate open =
      j == row.Patch ? PairIntegrals::Estimate() : this->Open.Compute(row.Patch, j);
    if (open.Value <= 0.0)
    {
      return;
    }
    const double factor = open.Value / this->Outer.Scene.GetAreas()[row.Patch];
    const PairVisibility::Share share =
      isFree ? PairVisibility::Share() : this->See(j, open.Value, factor, row);
    this->Outer.Errors[row.Index] +=
      factor * share.Error + open.Error / this->Outer.Scene.GetAreas()[row.Patch];
    for (std::size_t k = 0; k < this->Vectors.size(); ++k)
    {
      this->Outer.Products[row.Index][k] += factor * share.Value * (*this->Vectors[k])[j];
    }
  }

  /// The visible part of a pair.
  PairVisibility::Share See(vtkIdType j, double open, double factor, Row& row) const
  {
    const PatchScene& scene = this->Outer.Scene;
    this->Culler.FindBetween(row.Patch, j, row.Between);
    if (row.Between.empty())
    {
      return {};
    }
    if (!row.Visibility.SetPair(scene, row.Patch, j, this->Culler.GetWalls(), row.Between,
          PairVisibility::GetKey(row.Patch, j), open))
    {
      return {};
    }
    const PairVisibility::Share share = row.Visibility.Look();
    const double allowed = std::min(ShareTolerance, RowTolerance / factor);
    return share.Error > allowed ? row.Visibility.Integrate(allowed) : share;
  }
};

//------------------------------------------------------------------------------
ExactRows::ExactRows(const PatchScene& scene, int count)
  : Scene(scene), Patches(scene.GetNumberOfPatches())
{
  std::iota(this->Patches.begin(), this->Patches.end(), vtkIdType(0));
  std::mt19937 random(Seed);
  // As std::shuffle, which is not the same everywhere.
  const std::size_t rows = std::min<std::size_t>(count, this->Patches.size());
  for (std::size_t k = 0; k < rows; ++k)
  {
    std::swap(this->Patches[k], this->Patches[k + random() % (this->Patches.size() - k)]);
  }
  this->Patches.resize(rows);
  std::sort(this->Patches.begin(), this->Patches.end());
}

//------------------------------------------------------------------------------
void ExactRows::Multiply(const std::vector<const Values*>& vectors)
{
  this->Products.assign(this->Patches.size(), Values(vectors.size(), 0.0));
  this->Errors.assign(this->Patches.size(), 0.0);
  const UnoccludedPairs open(this->Scene, OpenTolerance);
  const ShaftCuller culler(this->Scene);
  std::vector<int> leaves(this->Scene.GetNumberOfPatches());
  const auto& nodes = this->Scene.GetTree().GetNodes();
  for (std::size_t index = 0; index < nodes.size(); ++index)
  {
    if (nodes[index].IsLeaf())
    {
      std::fill(leaves.begin() + nodes[index].First, leaves.begin() + nodes[index].Last,
        static_cast<int>(index));
    }
  }
  Worker worker{ *this, vectors, open, culler, leaves };
  Threads::For(0, static_cast<vtkIdType>(this->Patches.size()), 1, worker);
}
