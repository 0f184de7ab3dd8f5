// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Numbers of patches and faces as arrays of a filter's output, which gets the structure and the
 * arrays of the input, with points duplicated where several smooth groups meet at one. What is a
 * cell array of a surface is a point array of a texel image.
 */
#ifndef SceneOutput_h
#define SceneOutput_h

#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkPolyData;

namespace LightTransport
{
class PatchScene;
class SmoothPoints;

class SceneOutput
{
public:
  /// Copy `input`, that `scene` was built from, to `output`. Without `points` (texels have none) no
  /// point is duplicated, and arrays go to cells only. All must outlive this.
  SceneOutput(const PatchScene& scene, const SmoothPoints* points, vtkDataObject* input,
    vtkDataObject* output);

  /**
   * Write the means over faces of values[patch * components + component] (of all patches) as the
   * cell array `name` of the local part of the output, and as a point array where there are smooth
   * points; those of backs as `name` with the suffix "Back". Cells that are no faces (ghosts,
   * lines), faces without patches, and points of none, get 0.
   */
  void AddArray(const std::string& name, const std::vector<double>& values, int components) const;

  /// The same with values[face * components + component].
  void AddFaceArray(const std::string& name, const std::vector<double>& values,
    int components) const;

  /// The smooth group that the front of each point belongs to as the point array `name`, -1 for
  /// none; numbers of SmoothPoints.
  void AddGroups(const std::string& name) const;

  /// Flags of each face, as integers of the cell array `name`, and of that of the backs.
  void AddFlags(const std::string& name, const std::vector<int>& flags) const;

private:
  /// The smooth groups that have values at a point, of the front and of the back; -1 for none.
  using PointGroups = std::array<vtkIdType, 2>;

  void CopyBlock(vtkDataSet* input, int block, vtkIdType firstLocal, vtkDataSet* output);
  void DividePoints(vtkPolyData* input, int block, vtkIdType firstLocal, vtkPolyData* output);
  PointGroups GetGroups(vtkIdType polygon, vtkIdType corner) const;
  template <typename Array, typename Value>
  void AddCellArray(const std::string& name, const std::vector<Value>& values, int components,
    int side) const;
  void AddPointArray(const std::string& name, const std::vector<double>& means, int components,
    int side) const;

  const PatchScene& Scene;
  const SmoothPoints* Points;
  vtkDataObject* Output;
  std::vector<std::vector<PointGroups>> Groups; ///< of each output point of each block
};
} // namespace LightTransport

#endif
