// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Finds the triangle of the original surface that a place on the repaired one comes from.
#ifndef vtkPatchSources_h
#define vtkPatchSources_h

#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkStaticCellLocator.h"
#include "vtkTriangleSoup.h"

class vtkPatchSources
{
public:
  /// The soup must stay alive.
  explicit vtkPatchSources(const vtkTriangleSoup& soup);

  struct Place
  {
    /// Index of the triangle of the soup.
    std::size_t Triangle;
    /// Barycentric coordinates of the closest point in it.
    vtkTriangleSoup::Point Weights;
  };
  /// The closest place on the original surface, fastest when it is about `reach` away.
  Place Find(const vtkTriangleSoup::Point& position, double reach);

private:
  const vtkTriangleSoup& Soup;
  vtkNew<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

#endif
