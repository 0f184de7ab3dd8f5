// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The pieces that the polygons of a scene are cut into, before they are sorted: patches to be.
#ifndef ScenePieces_h
#define ScenePieces_h

#include "Scene/PolygonCutting.h"
#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
struct ScenePieces
{
  using Vector = Eigen::Vector3d;

  /// Cut polygons: the corners of polygon k are [starts[k], starts[k + 1]) of `corners`.
  /// `rounding` as PolygonCutting has it.
  ScenePieces(const std::vector<vtkIdType>& starts, const std::vector<Vector>& corners,
    double rounding);

  vtkIdType GetNumber() const { return static_cast<vtkIdType>(this->Faces.size()); }
  vtkIdType GetCount(vtkIdType piece) const
  {
    return this->Offsets[piece + 1] - this->Offsets[piece];
  }
  /// The same pieces seen from behind, as faces of their own.
  void AddBacks();
  /// Leave out the pieces of some faces.
  void Remove(const std::vector<vtkIdType>& faces);
  /// A line for each kind of polygon that users should know of.
  std::vector<std::string> GetWarnings() const;

  std::vector<vtkIdType> Faces;        ///< of each piece
  std::vector<vtkIdType> Offsets{ 0 }; ///< of each piece, in Corners
  std::vector<vtkIdType> Corners;      ///< among those of all polygons
  std::vector<Vector> Planes;          ///< normal of each piece; 0 where its corners tell it
  std::vector<int> Problems;           ///< of each face (SceneFaces::Problem)

private:
  void Add(vtkIdType polygon, vtkIdType start, const PolygonCutting::Pieces& pieces);

  ///@{ Polygons.
  std::vector<vtkIdType> WithoutArea;
  std::vector<vtkIdType> Crossing;
  std::vector<vtkIdType> Warped;
  ///@}
};
} // namespace LightTransport

#endif
