// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Finds the triangle of the original surface that a place on the repaired one comes from.
#ifndef PatchSources_h
#define PatchSources_h

#include "Common/TriangleSoup.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkStaticCellLocator.h"

namespace LightTransport
{
class PatchSources
{
public:
  /// The soup must stay alive.
  explicit PatchSources(const TriangleSoup& soup);

  struct Place
  {
    /// Index of the triangle of the soup.
    std::size_t Triangle;
    /// Barycentric coordinates of the closest point in it.
    TriangleSoup::Point Weights;
  };
  /// The closest place on the original surface, fastest when it is about `reach` away.
  Place Find(const TriangleSoup::Point& position, double reach);

private:
  const TriangleSoup& Soup;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};
} // namespace LightTransport

#endif
