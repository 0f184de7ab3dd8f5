// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Radiance from all directions as a picture in longitude and latitude, +z up, bilinear between the
 * centres of pixels; the sum of two parts. The *background* is even enough for rays that are spread
 * over the sky. The *peaks* (a sun, lamps, windows: what is brighter than a few times the mean of
 * the background) are small, and have a table to choose directions from as often as they are
 * bright.
 */
#ifndef Panorama_h
#define Panorama_h

#include "Lighting/LightSource.h"
#include "Shared/Outcome.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

class vtkImageData;

namespace LightTransport
{
class Panorama
{
public:
  using Vector = LitPatch::Vector;

  /// Take over a picture. Fails where it is none of 1 or 3 components, or not finite.
  Outcome Read(vtkImageData* picture);

  bool HasBackground() const { return this->Limit > 0.0; }
  bool HasPeaks() const { return !this->Rows.empty(); }

  /// Irradiance by all of it, the mean over all orientations of a surface.
  const double* GetMeanIrradiance() const { return this->MeanIrradiance; }

  /// Irradiance by the background on a surface with nothing in the way, to a few percent.
  void GetIrradiance(const Vector& normal, double irradiance[LightBands]) const;

  /// Radiance of the background.
  void GetBackground(const Vector& direction, double radiance[LightBands]) const;

  /**
   * A direction where peaks are, for two numbers evenly spread in (0, 1), and the radiance of the
   * peaks there over the density of such directions in solid angle.
   */
  Vector GetPeak(double u, double v, double weights[LightBands]) const;

private:
  // Between four centres of pixels, or two and the pole. Row r is between the pixels r - 1 and r.
  struct Cell
  {
    std::size_t Pixels[2][2]; // [up][right]
    double South, North;      // latitudes
  };

  void FindLimit();
  void FindMoments();
  void AddMoments(std::size_t pixel, const Vector& direction, double size);
  void FillTable();
  Cell GetCell(int row, int column) const;
  double GetBrightness(std::size_t pixel) const;
  /// Which part of a pixel belongs to the peaks.
  double GetPeakShare(std::size_t pixel) const;

  int Width = 0;
  int Height = 0;
  std::vector<double> Values;
  double Limit = 0.0; ///< brightness of pixels up to which they are background

  double MeanIrradiance[LightBands] = {};
  ///@{ Of the background over all directions: of radiance, times the direction, times its square.
  double Moments[LightBands] = {};
  Vector VectorMoments[LightBands];
  Eigen::Matrix3d SquareMoments[LightBands];
  ///@}

  ///@{ Cells with peaks, row by row, and how much of the peaks is in a row, and in the cells of a
  /// row, up to the end of each.
  struct Row
  {
    int Number;
    std::size_t First, Last; ///< among Columns
    double End;
  };
  std::vector<Row> Rows;
  std::vector<int> Columns;
  std::vector<double> ColumnEnds;
  ///@}
  double Total = 0.0; ///< of all peaks: brightness times solid angle
};
} // namespace LightTransport

#endif
