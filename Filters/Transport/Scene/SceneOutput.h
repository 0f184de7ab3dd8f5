// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Numbers of patches as arrays of a filter's output, which gets the structure and the arrays of the
 * input, with points duplicated where several smooth groups meet at one.
 */
#ifndef SceneOutput_h
#define SceneOutput_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkPolyData;

namespace LightTransport
{
class PatchScene;
class SmoothPoints;

class SceneOutput
{
public:
  /// Copy `input`, that `scene` was built from, to `output`. Without `points` no point is
  /// duplicated, and arrays go to cells only. All must outlive this.
  SceneOutput(const PatchScene& scene, const SmoothPoints* points, vtkDataObject* input,
    vtkDataObject* output);

  /**
   * Write values[patch * components + component] (of all patches) as the cell array `name` of the
   * local part of the output, and as a point array where there are smooth points. Cells that are no
   * patches (ghosts, lines), and points of none, get 0.
   */
  void AddArray(const std::string& name, const std::vector<double>& values, int components) const;

private:
  void CopyBlock(vtkPolyData* input, int block, vtkIdType firstLocal, vtkPolyData* output);
  void AddCellArray(const std::string& name, const std::vector<double>& values,
    int components) const;
  void AddPointArray(const std::string& name, const std::vector<double>& values,
    int components) const;

  const PatchScene& Scene;
  const SmoothPoints* Points;
  vtkDataObject* Output;
  /// Smooth group of each output point of each block, -1 for points of no patch.
  std::vector<std::vector<vtkIdType>> PointGroups;
};
} // namespace LightTransport

#endif
