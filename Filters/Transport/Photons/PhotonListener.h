// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Who gets to know what becomes of photons: tallies of patches, of distances, of links.
#ifndef PhotonListener_h
#define PhotonListener_h

#include "vtkType.h"

#include <Eigen/Core>

namespace LightTransport
{
class PhotonListener
{
public:
  virtual ~PhotonListener() = default;

  /// It leaves through a patch, after it was scattered at least once. `weights` of all bands: of
  /// what started.
  virtual void Leave(vtkIdType patch, const Eigen::Vector3d& position, const double* weights) = 0;

  /// It goes away for good, scattered or not.
  virtual void Escape(bool isScattered, const double* weights) = 0;

  /// It is lost on the way: through a hole, or after very many scatterings.
  virtual void Lose(const Eigen::Vector3d& position, const double* weights) = 0;
};
} // namespace LightTransport

#endif
