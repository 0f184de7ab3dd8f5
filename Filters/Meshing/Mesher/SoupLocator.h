// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Finds the triangle of a soup that is closest to a position: where a repaired surface comes from.
#ifndef SoupLocator_h
#define SoupLocator_h

#include "Common/TriangleSoup.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkStaticCellLocator.h"

namespace LightTransport
{
class SoupLocator
{
public:
  /// The soup must stay alive.
  explicit SoupLocator(const TriangleSoup& soup);

  struct Place
  {
    /// Index of the triangle of the soup.
    std::size_t Triangle;
    /// Barycentric coordinates of the closest point in it.
    TriangleSoup::Point Weights;
  };
  /// The closest place on the surface, fastest when it is about `reach` away.
  Place Find(const TriangleSoup::Point& position, double reach);

private:
  const TriangleSoup& Soup;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};
} // namespace LightTransport

#endif
