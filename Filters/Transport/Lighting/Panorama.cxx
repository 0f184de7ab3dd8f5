// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/Panorama.h"

#include "Shared/EnvironmentPicture.h"
#include "Shared/Pulse.h"
#include "vtkMath.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace LightTransport
{
namespace
{
/// Peaks are what is brighter than this many times the mean of the background. Where all that
/// shines takes less than its inverse of the sphere, there is no background.
constexpr double LargestContrast = 4.0;
/// The limit between them is found by iteration; below this part of where it began it is 0.
constexpr double LeastLimit = 1e-3;
constexpr int LimitSteps = 40;
constexpr double LimitAccuracy = 1e-2;

//------------------------------------------------------------------------------
/// Where a density that goes linearly from `a` to `b` over (0, 1) has the part `u` before it.
double InvertLinear(double a, double b, double u)
{
  const double root = std::sqrt(a * a + u * (b * b - a * a));
  return a + root > 0.0 ? u * (a + b) / (a + root) : u;
}

//------------------------------------------------------------------------------
/// The first of ascending ends that is above `u`, which becomes the place within what it ends.
template <typename GetEnd>
std::size_t Choose(std::size_t first, std::size_t last, const GetEnd& getEnd, double& u)
{
  const std::size_t begin = first;
  while (first + 1 < last)
  {
    const std::size_t middle = (first + last - 1) / 2;
    (getEnd(middle) > u ? last : first) = middle + 1;
  }
  const double from = first > begin ? getEnd(first - 1) : 0.0;
  const double width = getEnd(first) - from;
  u = width > 0.0 ? std::min(std::max((u - from) / width, 0.0), 1.0) : 0.5;
  return first;
}
} // namespace

//------------------------------------------------------------------------------
Outcome Panorama::Read(vtkImageData* picture)
{
  EnvironmentPicture source;
  if (Outcome read = source.Read(picture); !read)
  {
    return read;
  }
  this->Width = source.Width;
  this->Height = source.Height;
  this->Values = std::move(source.Values);
  this->FindLimit();
  this->FindMoments();
  this->FillTable();
  return Outcome::Done();
}

//------------------------------------------------------------------------------
double Panorama::GetBrightness(std::size_t pixel) const
{
  const double* value = &this->Values[pixel * LightBands];
  return (std::abs(value[0]) + std::abs(value[1]) + std::abs(value[2])) / 3.0;
}

//------------------------------------------------------------------------------
double Panorama::GetPeakShare(std::size_t pixel) const
{
  const double brightness = this->GetBrightness(pixel);
  return brightness > this->Limit ? 1.0 - this->Limit / brightness : 0.0;
}

//------------------------------------------------------------------------------
// The mean of what is left of the background below a limit gives the next limit.
void Panorama::FindLimit()
{
  std::vector<double> brightness(this->Values.size() / LightBands);
  for (std::size_t pixel = 0; pixel < brightness.size(); ++pixel)
  {
    brightness[pixel] = this->GetBrightness(pixel);
  }
  const double largest = *std::max_element(brightness.begin(), brightness.end());
  const auto getMean = [&](double limit)
  {
    double sum = 0.0;
    for (int row = 0; row < this->Height; ++row)
    {
      Pulse::Beat();
      double rowSum = 0.0;
      const double* values = &brightness[static_cast<std::size_t>(row) * this->Width];
      for (int column = 0; column < this->Width; ++column)
      {
        rowSum += std::min(values[column], limit);
      }
      const double height = vtkMath::Pi() / this->Height;
      sum += rowSum / this->Width * 0.5 * (std::cos(row * height) - std::cos((row + 1) * height));
    }
    return sum;
  };
  this->Limit = LargestContrast * getMean(largest);
  const double least = LeastLimit * this->Limit;
  for (int step = 0; step < LimitSteps && this->Limit < largest; ++step)
  {
    const double next = LargestContrast * getMean(this->Limit);
    const bool isFound = std::abs(next - this->Limit) <= LimitAccuracy * this->Limit;
    this->Limit = next > least ? next : 0.0;
    if (isFound || this->Limit == 0.0)
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
void Panorama::FindMoments()
{
  for (int band = 0; band < LightBands; ++band)
  {
    this->VectorMoments[band].setZero();
    this->SquareMoments[band].setZero();
  }
  const double height = vtkMath::Pi() / this->Height;
  const double width = 2.0 * vtkMath::Pi() / this->Width;
  std::vector<Vector> around;
  for (int column = 0; column < this->Width; ++column)
  {
    const double longitude = (column + 0.5) * width;
    around.emplace_back(std::cos(longitude), std::sin(longitude), 0.0);
  }
  for (int row = 0; row < this->Height; ++row)
  {
    Pulse::Beat();
    const double angle = (row + 0.5) * height; // from -z
    const double size = width * (std::cos(row * height) - std::cos((row + 1) * height));
    for (int column = 0; column < this->Width; ++column)
    {
      const std::size_t pixel = static_cast<std::size_t>(row) * this->Width + column;
      this->AddMoments(pixel, std::sin(angle) * around[column] - std::cos(angle) * Vector::UnitZ(),
        size);
    }
  }
}

//------------------------------------------------------------------------------
void Panorama::AddMoments(std::size_t pixel, const Vector& direction, double size)
{
  const double part = 1.0 - this->GetPeakShare(pixel);
  const Eigen::Matrix3d square = direction * direction.transpose();
  for (int band = 0; band < LightBands; ++band)
  {
    const double all = size * this->Values[pixel * LightBands + band];
    this->MeanIrradiance[band] += 0.25 * all;
    this->Moments[band] += part * all;
    this->VectorMoments[band] += part * all * direction;
    this->SquareMoments[band] += part * all * square;
  }
}

//------------------------------------------------------------------------------
// Spherical harmonics up to the second order (Ramamoorthi and Hanrahan 2001), written with moments.
void Panorama::GetIrradiance(const Vector& normal, double irradiance[LightBands]) const
{
  for (int band = 0; band < LightBands; ++band)
  {
    const double square = normal.dot(this->SquareMoments[band] * normal);
    irradiance[band] = std::max(0.0,
      0.25 * this->Moments[band] + 0.5 * this->VectorMoments[band].dot(normal) +
        15.0 / 32.0 * (square - this->Moments[band] / 3.0));
  }
}

//------------------------------------------------------------------------------
Panorama::Cell Panorama::GetCell(int row, int column) const
{
  const std::size_t below = static_cast<std::size_t>(std::max(row - 1, 0)) * this->Width;
  const std::size_t above = static_cast<std::size_t>(std::min(row, this->Height - 1)) * this->Width;
  const int next = (column + 1) % this->Width;
  const double height = vtkMath::Pi() / this->Height;
  return { { { below + column, below + next }, { above + column, above + next } },
    std::max(row - 0.5, 0.0) * height - 0.5 * vtkMath::Pi(),
    std::min(row + 0.5, static_cast<double>(this->Height)) * height - 0.5 * vtkMath::Pi() };
}

//------------------------------------------------------------------------------
void Panorama::FillTable()
{
  const double width = 2.0 * vtkMath::Pi() / this->Width;
  const auto getPeak = [this](std::size_t pixel)
  { return this->GetPeakShare(pixel) * this->GetBrightness(pixel); };
  for (int row = 0; row <= this->Height; ++row)
  {
    Pulse::Beat();
    const std::size_t first = this->Columns.size();
    double sum = 0.0;
    for (int column = 0; column < this->Width; ++column)
    {
      const Cell cell = this->GetCell(row, column);
      const double mean = 0.25 *
        (getPeak(cell.Pixels[0][0]) + getPeak(cell.Pixels[0][1]) + getPeak(cell.Pixels[1][0]) +
          getPeak(cell.Pixels[1][1]));
      if (mean > 0.0)
      {
        sum += mean * width * (std::sin(cell.North) - std::sin(cell.South));
        this->Columns.push_back(column);
        this->ColumnEnds.push_back(sum);
      }
    }
    if (sum > 0.0)
    {
      this->Total += sum;
      this->Rows.push_back({ row, first, this->Columns.size(), this->Total });
    }
  }
}

//------------------------------------------------------------------------------
void Panorama::GetBackground(const Vector& direction, double radiance[LightBands]) const
{
  const double longitude = std::atan2(direction.y(), direction.x()) / (2.0 * vtkMath::Pi());
  const double latitude =
    std::asin(std::min(1.0, std::max(-1.0, direction.z()))) / vtkMath::Pi() + 0.5;
  const double x = (longitude < 0.0 ? longitude + 1.0 : longitude) * this->Width - 0.5;
  const double y = std::min(std::max(latitude * this->Height - 0.5, 0.0), this->Height - 1.0);
  const int column = static_cast<int>(std::floor(x));
  const int row = std::min(static_cast<int>(y), std::max(0, this->Height - 2));
  const double right = x - column;
  const double up = y - row;
  const std::size_t columns[2] = { static_cast<std::size_t>((column + this->Width) % this->Width),
    static_cast<std::size_t>((column + 1 + this->Width) % this->Width) };
  const std::size_t rows[2] = { static_cast<std::size_t>(row),
    static_cast<std::size_t>(std::min(row + 1, this->Height - 1)) };
  std::fill_n(radiance, LightBands, 0.0);
  for (int corner = 0; corner < 4; ++corner)
  {
    const std::size_t pixel = rows[corner / 2] * this->Width + columns[corner % 2];
    const double weight = (corner / 2 == 0 ? 1.0 - up : up) *
      (corner % 2 == 0 ? 1.0 - right : right) *
      (this->HasPeaks() ? 1.0 - this->GetPeakShare(pixel) : 1.0);
    for (int band = 0; band < LightBands; ++band)
    {
      radiance[band] += weight * this->Values[pixel * LightBands + band];
    }
  }
}

//------------------------------------------------------------------------------
// Within a cell directions are as dense as its brightness in longitude and latitude: bilinear, so
// that both follow by inversion.
Panorama::Vector Panorama::GetPeak(double u, double v, double weights[LightBands]) const
{
  double up = v * this->Total;
  const Row& row = this->Rows[Choose(
    0, this->Rows.size(), [this](std::size_t k) { return this->Rows[k].End; }, up)];
  double right = u * this->ColumnEnds[row.Last - 1];
  const std::size_t place = Choose(
    row.First, row.Last, [this](std::size_t k) { return this->ColumnEnds[k]; }, right);
  const int column = this->Columns[place];
  const Cell cell = this->GetCell(row.Number, column);
  double shares[2][2];
  double bright[2][2];
  for (int k = 0; k < 4; ++k)
  {
    const std::size_t pixel = cell.Pixels[k / 2][k % 2];
    shares[k / 2][k % 2] = this->GetPeakShare(pixel);
    bright[k / 2][k % 2] = shares[k / 2][k % 2] * this->GetBrightness(pixel);
  }
  up = InvertLinear(bright[0][0] + bright[0][1], bright[1][0] + bright[1][1], up);
  const double left = (1.0 - up) * bright[0][0] + up * bright[1][0];
  right = InvertLinear(left, (1.0 - up) * bright[0][1] + up * bright[1][1], right);

  const double height = cell.North - cell.South;
  const double latitude = cell.South + up * height;
  const double longitude = 2.0 * vtkMath::Pi() * (column + 0.5 + right) / this->Width;
  double radiance[LightBands] = {};
  double brightness = 0.0;
  for (int k = 0; k < 4; ++k)
  {
    const double weight = (k / 2 == 0 ? 1.0 - up : up) * (k % 2 == 0 ? 1.0 - right : right);
    brightness += weight * bright[k / 2][k % 2];
    const double* value = &this->Values[cell.Pixels[k / 2][k % 2] * LightBands];
    for (int band = 0; band < LightBands; ++band)
    {
      radiance[band] += weight * shares[k / 2][k % 2] * value[band];
    }
  }
  const double cosine = std::cos(latitude);
  const double inverse = brightness > 0.0
    ? this->Total * height * cosine / (brightness * (std::sin(cell.North) - std::sin(cell.South)))
    : 0.0;
  for (int band = 0; band < LightBands; ++band)
  {
    weights[band] = radiance[band] * inverse;
  }
  return { cosine * std::cos(longitude), cosine * std::sin(longitude), std::sin(latitude) };
}
} // namespace LightTransport
