// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors between groups of patches: F_gh = sum_{i in g, j in h} G_ij / A_g is the fraction of
 * what leaves group g (with the same radiosity everywhere) that reaches group h.
 */
#ifndef ViewFactorGroups_h
#define ViewFactorGroups_h

#include "ViewFactors/ViewFactorsResult.h"

class vtkDataObject;
class vtkMultiProcessController;
class vtkTable;

namespace LightTransport
{
class PatchScene;

namespace ViewFactorGroups
{
/// A table of more groups than this is refused: it has a column for each.
constexpr int MaximumNumberOfGroups = 2000;

struct Groups
{
  std::vector<int> OfPatches;     ///< of each patch of the scene, an index into Names
  std::vector<std::string> Names; ///< all different, and different from the other columns' names
};

/**
 * The groups of the scene that was built from `input`: by the cell array `arrayName` of one
 * component with integer values, which are the names; where there is none the blocks of composite
 * input, by the names in their metadata (vtkCompositeDataSet::NAME), "Block k" without one (k
 * counts all blocks from 0; the pieces of one data set are one block); else one group, "All". Only
 * groups that have patches count. Collective. Returns false, on all ranks alike, with `error`
 * naming the array when it has other values or more than MaximumNumberOfGroups of them.
 */
bool Gather(const PatchScene& scene, vtkDataObject* input, const std::string& arrayName,
  Groups& groups, std::string& error);

/**
 * One row per group: "Group" (name), "Area" (unit of the input squared; `scale` is the length of
 * the scene's unit in that of the input), the view factors to each group in a column of its name,
 * "Sky" and "BackFace" (the fractions of Result). All columns but the first are of doubles.
 * Collective; all ranks get the whole table. Returns false when the ranks could not be added up.
 */
bool FillTable(const ViewFactorsResult& result, const Groups& groups, double scale,
  vtkMultiProcessController* controller, vtkTable* table);
} // namespace ViewFactorGroups
} // namespace LightTransport

#endif
