// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The points of every quadrature rule on every patch of a scene, side by side as QuadratureKernels
 * needs them, and the exchange of one patch with a run of others by them.
 *
 * Polygons of more than four corners have no points but that of rule 0, the centroid: whoever wants
 * another rule for them goes pair by pair (PairPlanner).
 */
#ifndef PatchRules_h
#define PatchRules_h

#include "Scene/PatchScene.h"
#include "ViewFactors/QuadratureKernels.h"
#include "ViewFactors/QuadratureRules.h"

#include <vector>

namespace LightTransport
{
class PatchRules
{
public:
  explicit PatchRules(const PatchScene& scene);

  ///@{ What kinds of polygons the patches [first, last) are.
  bool HasLargePolygons(vtkIdType first, vtkIdType last) const
  {
    return this->LargePolygons[last] > this->LargePolygons[first];
  }
  bool HasQuadrilaterals(vtkIdType first, vtkIdType last) const
  {
    return this->Quadrilaterals[last] > this->Quadrilaterals[first];
  }
  bool AreTriangles(vtkIdType first, vtkIdType last) const
  {
    return !this->HasQuadrilaterals(first, last) && !this->HasLargePolygons(first, last);
  }
  ///@}

  /**
   * The exchange of patch `i`, by rule `ruleI`, with patches [first, first + count), by rule
   * `ruleJ`, the points of all of them as they are: cosines are clamped at zero point by point.
   * `margins` as in QuadratureKernels::IntegrateRow; may be null.
   */
  void IntegrateRow(vtkIdType i, int ruleI, vtkIdType first, int count, int ruleJ, double* sums,
    double* margins) const;

private:
  struct RulePoints
  {
    std::vector<double> Points[3];
    std::vector<double> Weights;
  };

  void CountCorners(const PatchScene& scene);
  void FillPatches(const PatchScene& scene);
  void FillRule(const PatchScene& scene, int rule);
  QuadratureKernels::Patches GetPatches(int rule) const;
  int GetRuleSize(int rule, vtkIdType first, vtkIdType last) const;

  // In the order of the patches.
  std::vector<double> Normals[3];
  std::vector<double> Centroids[3];
  std::vector<double> Radii;
  RulePoints Rules[QuadratureRules::NumberOfRules];
  long Stride = 0;
  ///@{ Sums over the patches before each.
  std::vector<vtkIdType> Quadrilaterals;
  std::vector<vtkIdType> LargePolygons; ///< of more than four corners
  ///@}
};
} // namespace LightTransport

#endif
