// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The trees of renderers that are drawn in turn, each kept for as long as its scene serves.
#ifndef SceneTrees_h
#define SceneTrees_h

#include "Tracing/SceneTree.h"

#include "vtkWeakPointer.h"

#include <memory>
#include <string>
#include <vector>

class vtkRenderer;
class vtkWindow;

namespace LightTransport
{
class SceneTrees
{
public:
  struct Entry
  {
    vtkWeakPointer<vtkRenderer> Renderer;
    vtkWeakPointer<vtkWindow> Window;
    SceneTree Tree;
    ///@{ Of its last frame, which has been told: of the tree and shadows, of what is marched.
    std::string Problem;
    std::string MarchProblem;
    ///@}
  };

  /// That of a renderer, which need not be up to date.
  Entry& Get(vtkRenderer* renderer);

  /// How often any tree has been made.
  vtkIdType GetNumberOfRuns() const;

  /// Drops those of a window; of all where it is nullptr.
  void Release(vtkWindow* window);

private:
  template <typename Condition>
  void Drop(const Condition& isDropped);

  std::vector<std::unique_ptr<Entry>> Entries;
  vtkIdType DroppedRuns = 0;
};
} // namespace LightTransport

#endif
