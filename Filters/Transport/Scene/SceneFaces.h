// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What users gave and what a scene works on: a *polygon* is the input's, all blocks and ranks in
 * order, ghosts left out. A *face* is a side of it: fronts are 0 to n - 1, the back of polygon i is
 * n + i in a two-sided scene. A *patch* is a convex plane piece of a face, see PolygonCutting; most
 * faces have one, those that exchange nothing have none. Users meet values of faces, which are the
 * means of their patches by area.
 */
#ifndef SceneFaces_h
#define SceneFaces_h

#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
class SceneFaces
{
public:
  /// Why a face exchanges less than its polygon says: flags of the array "SceneProblems".
  enum Problem
  {
    COINCIDENT = 4,   ///< lies on one of a lower number that faces the same way
    WITHOUT_AREA = 8, ///< or skipped for another reason
    NOT_PLANE = 32
  };

  /// Patches as a container.
  class Range
  {
  public:
    Range(const vtkIdType* first, const vtkIdType* last) : First(first), Last(last) {}
    const vtkIdType* begin() const { return this->First; }
    const vtkIdType* end() const { return this->Last; }
    bool empty() const { return this->First == this->Last; }

  private:
    const vtkIdType* First;
    const vtkIdType* Last;
  };

  SceneFaces() = default;
  /// `faces` and `areas` of each patch.
  SceneFaces(vtkIdType numberOfPolygons, int numberOfSides, const std::vector<vtkIdType>& faces,
    const std::vector<double>& areas);

  vtkIdType GetNumberOfPolygons() const { return this->NumberOfPolygons; }
  /// 1, or 2 where backs count.
  int GetNumberOfSides() const { return this->NumberOfSides; }
  vtkIdType GetNumberOfFaces() const { return this->NumberOfPolygons * this->NumberOfSides; }

  vtkIdType GetFace(vtkIdType patch) const { return this->OfPatches[patch]; }
  vtkIdType GetPolygon(vtkIdType face) const { return face % this->NumberOfPolygons; }
  /// 0 for fronts, 1 for backs.
  int GetSide(vtkIdType face) const { return static_cast<int>(face / this->NumberOfPolygons); }
  /// "polygon 7", or "the back of polygon 7".
  std::string Describe(vtkIdType face) const;
  Range GetPatches(vtkIdType face) const
  {
    return { this->Patches.data() + this->Offsets[face],
      this->Patches.data() + this->Offsets[face + 1] };
  }
  /// One patch of a face, for what all of them have alike; -1 where there is none.
  vtkIdType GetPatch(vtkIdType face) const
  {
    const Range patches = this->GetPatches(face);
    return patches.empty() ? -1 : *patches.begin();
  }
  double GetArea(vtkIdType face) const { return this->Areas[face]; }
  /// What part of its face's area a patch has.
  double GetShare(vtkIdType patch) const { return this->Shares[patch]; }

  /// Of values[patch * components + component] the means of each face; 0 of those without patches.
  std::vector<double> GetMeans(const std::vector<double>& values, int components) const;

private:
  vtkIdType NumberOfPolygons = 0;
  int NumberOfSides = 1;
  std::vector<vtkIdType> OfPatches;
  std::vector<vtkIdType> Offsets; ///< of each face, in Patches
  std::vector<vtkIdType> Patches;
  std::vector<double> Areas;  ///< of each face
  std::vector<double> Shares; ///< of each patch
};
} // namespace LightTransport

#endif
