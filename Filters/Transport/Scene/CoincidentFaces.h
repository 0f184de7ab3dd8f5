// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Faces that lie on others which face the same way: the same surface, there twice. Of two such the
 * one of the lower number counts. Faces back to back (the sides of a sheet, of a wall between two
 * rooms) are no such thing.
 */
#ifndef CoincidentFaces_h
#define CoincidentFaces_h

#include "vtkType.h"

#include <string>
#include <utility>
#include <vector>

namespace LightTransport
{
class PatchScene;

class CoincidentFaces
{
public:
  /// Find those of a scene, by what its coordinates can tell apart (PatchPlane).
  explicit CoincidentFaces(const PatchScene& scene);

  /// Faces that lie on others wholly, in increasing order: what is in their place is there already.
  const std::vector<vtkIdType>& GetCovered() const { return this->Covered; }
  /// Those of which a part does.
  const std::vector<vtkIdType>& GetOverlapping() const { return this->Overlapping; }

  /// A line for each kind that there is.
  std::vector<std::string> GetWarnings() const;

private:
  /// A patch, and one on which some of it lies.
  using Pair = std::pair<vtkIdType, vtkIdType>;

  std::vector<Pair> FindPairs() const;
  void Decide(const std::vector<Pair>& pairs);
  void AddWarning(const std::vector<vtkIdType>& faces, const std::string& text,
    std::vector<std::string>& warnings) const;

  const PatchScene& Scene;
  std::vector<vtkIdType> Covered;
  std::vector<vtkIdType> Overlapping;
  double OverlappingArea = 0.0; ///< in the input's unit squared
};
} // namespace LightTransport

#endif
