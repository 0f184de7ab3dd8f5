// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Which patches may see a back face at all, whatever stands between: they lie in part behind a
/// patch that lies in part in front of them. What is not among them certainly sees none.
#ifndef BackFaceSearch_h
#define BackFaceSearch_h

#include "ViewFactors/NodeViews.h"

#include <vector>

namespace LightTransport
{
class BackFaceSearch
{
public:
  explicit BackFaceSearch(const PatchScene& scene);

  bool MaySeeBackFaces(vtkIdType patch) const { return this->MaySee[patch]; }

private:
  void Visit(int watcher, int other);
  bool IsSettled(int watcher) const;

  const PatchTree& Tree;
  const NodeViews Views;
  std::vector<bool> MaySee;
};
} // namespace LightTransport

#endif
