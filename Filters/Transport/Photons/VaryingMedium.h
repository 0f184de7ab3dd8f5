// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What photons of one band walk in where it varies: the coefficients of an image, and around it
 * those of a uniform medium, which also stands in for a coefficient that the image does not have.
 *
 * Where they may be scattered is found by delta tracking (E. Woodcock et al. 1965): as if the
 * extinction were its majorant, which is one for each of a few cells of the image, so that what is
 * dense in one place does not cost steps elsewhere. Some of these places are none: VaryingPath
 * decides.
 */
#ifndef VaryingMedium_h
#define VaryingMedium_h

#include "Photons/MediumImage.h"
#include "Photons/PhotonMedium.h"

#include <Eigen/Core>

#include <vector>

namespace LightTransport
{
class VaryingMedium
{
public:
  using Vector = Eigen::Vector3d;

  /// Where a photon may be scattered.
  struct Place
  {
    double Distance; ///< infinite where there is none
    double Majorant;
    bool IsInImage;
    Vector Index; ///< in the image
  };

  /// `outside` in the unit of the walk. The image must outlive this.
  VaryingMedium(const MediumImage& image, const PhotonMedium& outside, int band);

  /// The first place where the majorants along a path add up to `depth`. Thread-safe.
  Place FindPlace(const Vector& position, const Vector& direction, double depth) const;

  /// The coefficients there.
  void Get(const Place& place, double& scattering, double& absorption) const;

  /// Whether anything scatters anywhere.
  bool CanScatter() const;
  double GetMeanMajorant() const;

private:
  // Along each axis at most.
  static constexpr int MostCells = 32;

  /// A path in indices: `Inverse` of its step for a unit of distance, and the part in the image.
  struct Span
  {
    Vector Start;
    Vector Step;
    Vector Inverse;
    double Begin;
    double End;
  };
  Span Clip(const Vector& position, const Vector& direction) const;
  double GetLargest(const MediumImage::Field& field, double factor, double otherwise,
    const int first[3], const int last[3]) const;
  bool FindInImage(const Span& span, double& depth, Place& place) const;

  const MediumImage& Image;
  PhotonMedium Outside;
  int Band;
  double ScatteringFactor; ///< from the image's to those of the walk
  double AbsorptionFactor;
  int VoxelsPerCell[3];
  int Cells[3];
  std::vector<double> Majorants; ///< of cells of the image
};
} // namespace LightTransport

#endif
