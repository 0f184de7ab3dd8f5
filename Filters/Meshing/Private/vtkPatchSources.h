// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Finds the triangle of the original surface that a place on the remeshed one comes from.
#ifndef vtkPatchSources_h
#define vtkPatchSources_h

#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkTriangleSoup.h"

#include <vector>

class vtkAbstractCellLocator;

class vtkPatchSources
{
public:
  /// `parts` holds the part of the surface that each triangle belongs to. The soup must stay alive.
  vtkPatchSources(const vtkTriangleSoup& soup, const std::vector<std::size_t>& parts,
    std::size_t numberOfParts);

  struct Place
  {
    /// Index of the triangle of the soup.
    std::size_t Triangle;
    /// Barycentric coordinates of the closest point in it.
    vtkTriangleSoup::Point Weights;
  };
  /// The closest place on one part of the original surface, fastest when it is about `reach` away.
  Place Find(std::size_t part, const vtkTriangleSoup::Point& position, double reach);

private:
  const vtkTriangleSoup& Soup;
  std::vector<std::vector<std::size_t>> TrianglesOfParts;
  std::vector<vtkSmartPointer<vtkAbstractCellLocator>> Locators;
  vtkNew<vtkGenericCell> Cell;
};

#endif
