// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Rows of the view factors of a scene that is too large for all of them.
#ifndef ExactRows_h
#define ExactRows_h

#include "Scene/PatchScene.h"

#include <vector>

using namespace LightTransport;

/**
 * A few rows, each computed pair by pair: the exchange with nothing in between in double precision
 * (UnoccludedPairs), and the visible part with all that reaches into the shaft between the two
 * patches (ShaftCuller, PairVisibility). Nothing of it knows of clusters but to leave out
 * pairs that certainly exchange nothing and tests of pairs with certainly nothing in between.
 */
class ExactRows
{
public:
  using Values = std::vector<double>; ///< one per patch of the scene

  /// `count` patches of the scene at random, the same in every run; all where there are fewer.
  ExactRows(const PatchScene& scene, int count);

  /// The patches, in order.
  const std::vector<vtkIdType>& GetPatches() const { return this->Patches; }

  /// Compute the rows and multiply them with vectors, which rows are not kept for.
  void Multiply(const std::vector<const Values*>& vectors);

  ///@{ Of the row of GetPatches()[row]: sum_j F_ij x_j, and an estimate of sum_j |error of F_ij|.
  double GetProduct(std::size_t row, std::size_t vector) const
  {
    return this->Products[row][vector];
  }
  double GetError(std::size_t row) const { return this->Errors[row]; }
  ///@}

private:
  struct Worker;

  const PatchScene& Scene;
  std::vector<vtkIdType> Patches;
  std::vector<Values> Products;
  std::vector<double> Errors;
};

#endif
