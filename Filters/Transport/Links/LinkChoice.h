// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * From which clusters the patches of a scene receive: what links keep when patches move. It is that
 * of the scene for which links were chosen afresh, whatever has been refined on the way since.
 */
#ifndef LinkChoice_h
#define LinkChoice_h

#include <cstdint>
#include <memory>
#include <vector>

class vtkExchangeHierarchy;

namespace LightTransport
{
struct PatchArrangement;

struct LinkChoice
{
  std::shared_ptr<const PatchArrangement> Arrangement; ///< of the scene, and its tree
  ///@{ As told when it was made.
  double Error = 0.0;
  double LinksPerReceiver = 0.0;
  bool IsLimited = false; ///< by the number of links
  ///@}
  double Threshold = 0.0; ///< relative (ScatteringRefinement)
  std::vector<bool> AreDivided; ///< slots that are divided for all receivers
  ///@{ Receiver k has the slots columns[offsets[k]] to columns[offsets[k + 1]], in the order of the
  /// patches that they hold; none where it belongs to another rank. Empty until TakeRows.
  std::vector<std::int64_t> Offsets;
  std::vector<int> Columns;
  ///@}

  bool HasRows() const { return !this->Offsets.empty(); }
  /// From the links that were made by it, coded or not; of these, slots whose links have a value of
  /// 0 may be missing.
  void TakeRows(const vtkExchangeHierarchy& links);
};
} // namespace LightTransport

#endif
