// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether all pairs of two blocks of patches are hidden from each other, or all free, as far as
 * rays between them tell: few of them, spread over the pairs by their exchange, where so little is
 * at stake that no row is off by much of its tolerance even if they are wrong. The more is
 * tolerated, the fewer rays and the larger the blocks. What they all agree on is off by no more
 * than some of them, usually.
 */
#ifndef BlockRays_h
#define BlockRays_h

#include "Geometry/SceneRayCaster.h"
#include "Scene/PatchScene.h"

namespace LightTransport
{
class BlockRays
{
public:
  enum class Verdict
  {
    Unknown, ///< some pass, or too much is at stake, or too little for so many rays
    Hidden,
    Free
  };

  /// `tolerance`: of the sum of the absolute errors of the view factors of a row. The scene must
  /// outlive this. Without memory for the rays no verdict is ever given.
  BlockRays(const PatchScene& scene, double tolerance);

  /**
   * Of two different nodes; values[(i - first of I) * stride + (j - first of J)] is the exchange of
   * their patches with nothing in between.
   */
  Verdict Ask(int nodeI, int nodeJ, const float* values, vtkIdType stride) const;

  /// Of what is then said of a pair, relative to its exchange with nothing in between.
  double GetError() const { return this->Error; }

private:
  struct Block
  {
    vtkIdType FirstI, FirstJ, Rows, Columns;
    const float* Values;
    vtkIdType Stride;
    double GetValue(vtkIdType row, vtkIdType column) const
    {
      return static_cast<double>(this->Values[row * this->Stride + column]);
    }
  };
  class Poll;

  static constexpr vtkIdType MostPatches = 64; ///< of a node
  bool IsLittle(const Block& block) const;

  const PatchScene& Scene;
  const double Tolerance;
  const double Error;
  const int Rays; ///< of each patch
  SceneRayCaster Caster;
  bool HasRays = false;
};
} // namespace LightTransport

#endif
