// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Cell arrays of the input (point arrays of texel images) as numbers of the patches of a scene.
/// Those of backs have the suffix "Back"; where there is none of that name the fronts' holds for
/// both sides.
#ifndef CellArrays_h
#define CellArrays_h

#include "Shared/Outcome.h"
#include "Support/Ranks.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace LightTransport
{
class PatchScene;

class CellArrays
{
public:
  /// `input` is the data object that the scene was built from on `ranks`.
  CellArrays(const PatchScene& scene, vtkDataObject* input, const Ranks& ranks)
    : Scene(scene), Input(input), AllRanks(ranks)
  {
  }

  /**
   * An array as doubles, for all patches of all ranks: values[patch * components + component].
   * `required` decides whether an array that is missing everywhere is an error or leaves `values`
   * empty. Fails, on all ranks alike, where the array is missing in some block, is not numeric, is
   * one of the points (of an image: the cells), has different component counts, or holds a value
   * that is not finite, and where there is an array of the backs but none of the fronts. `hasBack`,
   * where it is not null, tells whether backs have an array of their own. Collective.
   */
  Outcome Read(const std::string& name, bool required, std::vector<double>& values, int& components,
    bool* hasBack = nullptr) const;

  /// InputArrays::Suggest for an array that is missing everywhere, as this rank knows it.
  std::string Suggest(const std::string& name) const;

  /// What the array of patches is in a message: "cell array", in images "point array".
  std::string GetKind() const;

  /// Whether any block of any rank has the array. Collective.
  bool IsInput(const std::string& name) const;

  /**
   * A value per block of this rank's input, spread over the patches: one value for all patches of
   * all ranks. Blocks are those of Leaves. Collective.
   */
  std::vector<double> SpreadBlockValues(const std::vector<double>& blockValues) const;

private:
  /// Values of polygons; `components` is 0 where there is no such array.
  Outcome ReadPolygons(const std::string& name, std::vector<double>& values, int& components) const;
  /// `components` is 0 where this rank has no patches, -1 where the array is missing.
  Outcome ReadLocal(const std::string& name, std::vector<double>& values, int& components) const;
  /// Tuples of polygons in, those of all patches out; of each side those of its own.
  std::vector<double> Spread(const std::vector<double>& fronts, const std::vector<double>& backs,
    int components) const;

  const PatchScene& Scene;
  vtkDataObject* Input;
  Ranks AllRanks;
};
} // namespace LightTransport

#endif
