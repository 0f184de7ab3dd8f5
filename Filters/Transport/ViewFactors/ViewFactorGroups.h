// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * View factors between groups of patches: F_gh = sum_{i in g, j in h} G_ij / A_g is the fraction of
 * what leaves group g (with the same radiosity everywhere) that reaches group h.
 */
#ifndef ViewFactorGroups_h
#define ViewFactorGroups_h

#include "Shared/Outcome.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkTable;

namespace LightTransport
{
class CellArrays;
class Ranks;
struct Links;

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
 * The groups of a scene: by the cell array `arrayName` of one component with integer values, which
 * are the names; where there is none the blocks of composite `input`, by the names in their
 * metadata (vtkCompositeDataSet::NAME), "Block k" without one (k counts all blocks from 0; the
 * pieces of one data set are one block); else one group, "All". Only groups that have patches
 * count. Collective. Fails, on all ranks alike, when the array has other values or more than
 * MaximumNumberOfGroups of them.
 */
Outcome Gather(const CellArrays& arrays, vtkDataObject* input, const std::string& arrayName,
  Groups& groups);

/**
 * One row per group: "Group" (name), "Area" (unit of the input squared; `scale` is the length of
 * the scene's unit in that of the input), the view factors to each group in a column of its name,
 * "Sky" and "BackFace" (the fractions of the links). All columns but the first are of doubles.
 * Collective; all ranks get the whole table.
 */
Outcome FillTable(const Links& links, const Groups& groups, double scale, const Ranks& ranks,
  vtkTable* table);
} // namespace ViewFactorGroups
} // namespace LightTransport

#endif
