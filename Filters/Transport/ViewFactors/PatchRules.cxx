// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ViewFactors/PatchRules.h"

#include "Geometry/Polygon.h"

#include "vtkMath.h"

#include <cstddef>

namespace LightTransport
{
//------------------------------------------------------------------------------
PatchRules::PatchRules(const PatchScene& scene)
{
  this->Stride = static_cast<long>(scene.GetNumberOfPatches()) + QuadratureKernels::Lanes;
  this->CountCorners(scene);
  this->FillPatches(scene);
  for (int rule = 0; rule < QuadratureRules::NumberOfRules; ++rule)
  {
    this->FillRule(scene, rule);
  }
}

//------------------------------------------------------------------------------
void PatchRules::CountCorners(const PatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  this->Quadrilaterals.assign(patches + 1, 0);
  this->LargePolygons.assign(patches + 1, 0);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    const int corners = scene.GetNumberOfCorners(patch);
    this->Quadrilaterals[patch + 1] = this->Quadrilaterals[patch] + (corners == 4 ? 1 : 0);
    this->LargePolygons[patch + 1] = this->LargePolygons[patch] + (corners > 4 ? 1 : 0);
  }
}

//------------------------------------------------------------------------------
void PatchRules::FillPatches(const PatchScene& scene)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Normals[axis].assign(this->Stride, 0.0);
    this->Centroids[axis].assign(this->Stride, 0.0);
    for (vtkIdType patch = 0; patch < patches; ++patch)
    {
      this->Normals[axis][patch] = scene.GetNormal(patch)[axis];
      this->Centroids[axis][patch] = scene.GetCentroid(patch)[axis];
    }
  }
  this->Radii.assign(this->Stride, 1.0);
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    this->Radii[patch] = scene.GetRadius(patch);
  }
}

//------------------------------------------------------------------------------
void PatchRules::FillRule(const PatchScene& scene, int rule)
{
  const vtkIdType patches = scene.GetNumberOfPatches();
  const int size = this->GetRuleSize(rule, 0, patches);
  RulePoints& table = this->Rules[rule];
  table.Weights.assign(size * this->Stride, 0.0);
  for (std::vector<double>& coordinates : table.Points)
  {
    coordinates.assign(size * this->Stride, 0.0);
  }
  Polygon polygon;
  PatchScene::Vector points[QuadratureRules::MaximumCompactPoints];
  double weights[QuadratureRules::MaximumCompactPoints];
  for (vtkIdType patch = 0; patch < patches; ++patch)
  {
    polygon.Set(scene, patch);
    int count = 1;
    points[0] = scene.GetCentroid(patch);
    weights[0] = rule == 0 ? scene.GetAreas()[patch] : 0.0;
    if (rule > 0 && polygon.Count <= 4)
    {
      count = QuadratureRules::GetNumberOfPoints(rule, polygon.Count);
      QuadratureRules::MakeCompact(polygon, rule, points, weights);
    }
    for (int point = 0; point < size; ++point)
    {
      const std::size_t at = point * this->Stride + patch;
      const int source = point < count ? point : 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        table.Points[axis][at] = points[source][axis];
      }
      table.Weights[at] = point < count ? weights[point] : 0.0;
    }
  }
}

//------------------------------------------------------------------------------
QuadratureKernels::Patches PatchRules::GetPatches(int rule) const
{
  const RulePoints& table = this->Rules[rule];
  QuadratureKernels::Patches patches;
  for (int axis = 0; axis < 3; ++axis)
  {
    patches.Normals[axis] = this->Normals[axis].data();
    patches.Centroids[axis] = this->Centroids[axis].data();
    patches.Points[axis] = table.Points[axis].data();
  }
  patches.Radii = this->Radii.data();
  patches.Weights = table.Weights.data();
  patches.Stride = this->Stride;
  return patches;
}

//------------------------------------------------------------------------------
int PatchRules::GetRuleSize(int rule, vtkIdType first, vtkIdType last) const
{
  return QuadratureRules::GetNumberOfPoints(rule, this->HasQuadrilaterals(first, last) ? 4 : 3);
}

//------------------------------------------------------------------------------
void PatchRules::IntegrateRow(vtkIdType i, int ruleI, vtkIdType first, int count, int ruleJ,
  double* sums, double* margins) const
{
  QuadratureKernels::IntegrateRow(this->GetPatches(ruleI), this->GetRuleSize(ruleI, i, i + 1), i,
    this->GetPatches(ruleJ), this->GetRuleSize(ruleJ, first, first + count), first, count, sums,
    margins);
  for (int column = 0; column < count; ++column)
  {
    sums[column] *= 1.0 / vtkMath::Pi();
  }
}
} // namespace LightTransport
