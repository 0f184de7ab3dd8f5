// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/VaryingMedium.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace LightTransport
{
namespace
{
constexpr double Infinite = std::numeric_limits<double>::infinity();
} // namespace

//------------------------------------------------------------------------------
VaryingMedium::VaryingMedium(const MediumImage& image, const PhotonMedium& outside, int band)
  : Image(image), Outside(outside), Band(band),
    ScatteringFactor(image.GetMillimeters() / (1.0 - outside.Anisotropy)),
    AbsorptionFactor(image.GetMillimeters())
{
  const int* voxels = image.GetNumbersOfVoxels();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->VoxelsPerCell[axis] = (voxels[axis] + MostCells - 1) / MostCells;
    this->Cells[axis] = (voxels[axis] + this->VoxelsPerCell[axis] - 1) / this->VoxelsPerCell[axis];
  }
  const int cells = this->Cells[0] * this->Cells[1] * this->Cells[2];
  for (int cell = 0; cell < cells; ++cell)
  {
    const int indices[] = { cell % this->Cells[0], cell / this->Cells[0] % this->Cells[1],
      cell / (this->Cells[0] * this->Cells[1]) };
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = indices[axis] * this->VoxelsPerCell[axis];
      last[axis] = std::min(first[axis] + this->VoxelsPerCell[axis], voxels[axis]);
    }
    this->Majorants.push_back(this->GetLargest(image.GetScattering(), this->ScatteringFactor,
                                outside.Scattering, first, last) +
      this->GetLargest(image.GetAbsorption(), this->AbsorptionFactor, outside.Absorption, first,
        last));
  }
}

//------------------------------------------------------------------------------
double VaryingMedium::GetLargest(const MediumImage::Field& field, double factor, double otherwise,
  const int first[3], const int last[3]) const
{
  return field.Exists() ? factor * field.GetLargest(first, last, this->Band) : otherwise;
}

//------------------------------------------------------------------------------
bool VaryingMedium::CanScatter() const
{
  const int none[3] = { 0, 0, 0 };
  return this->Outside.Scattering > 0.0 ||
    this->GetLargest(this->Image.GetScattering(), 1.0, 0.0, none,
      this->Image.GetNumbersOfVoxels()) > 0.0;
}

//------------------------------------------------------------------------------
double VaryingMedium::GetMeanMajorant() const
{
  return std::accumulate(this->Majorants.begin(), this->Majorants.end(), 0.0) /
    static_cast<double>(this->Majorants.size());
}

//------------------------------------------------------------------------------
VaryingMedium::Span VaryingMedium::Clip(const Vector& position, const Vector& direction) const
{
  const Vector step = this->Image.GetIndexDirection(direction);
  Span span{ this->Image.GetIndex(position), step, step.cwiseInverse(), 0.0, Infinite };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double start = span.Start[axis];
    const double high = this->Image.GetNumbersOfVoxels()[axis];
    if (step[axis] != 0.0)
    {
      const double first = -start * span.Inverse[axis];
      const double last = (high - start) * span.Inverse[axis];
      span.Begin = std::max(span.Begin, std::min(first, last));
      span.End = std::min(span.End, std::max(first, last));
    }
    else if (start < 0.0 || start > high)
    {
      span.End = 0.0;
    }
  }
  return span;
}

//------------------------------------------------------------------------------
VaryingMedium::Place VaryingMedium::FindPlace(const Vector& position, const Vector& direction,
  double depth) const
{
  const double extinction = this->Outside.GetExtinction();
  const Span span = this->Clip(position, direction);
  Place place{ 0.0, extinction, false, Vector::Zero() };
  if (span.Begin < span.End && depth >= extinction * span.Begin)
  {
    depth -= extinction * span.Begin;
    place.Distance = span.Begin;
    if (this->FindInImage(span, depth, place))
    {
      return place;
    }
  }
  place.Majorant = extinction;
  place.Distance = extinction > 0.0 ? place.Distance + depth / extinction : Infinite;
  return place;
}

//------------------------------------------------------------------------------
// From cell to cell (J. Amanatides, A. Woo, Eurographics 1987). `depth` that is left, and the
// distance in `place` where the path leaves the image.
bool VaryingMedium::FindInImage(const Span& span, double& depth, Place& place) const
{
  int cell[3];
  int strides[3];
  double ends[3];
  int cells = 1;
  std::ptrdiff_t at = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int width = this->VoxelsPerCell[axis];
    const auto voxel = static_cast<int>(span.Start[axis] + span.Begin * span.Step[axis]);
    cell[axis] = std::min(std::max(voxel / width, 0), this->Cells[axis] - 1);
    const int next = (cell[axis] + (span.Step[axis] > 0.0 ? 1 : 0)) * width;
    ends[axis] = span.Step[axis] != 0.0 ? (next - span.Start[axis]) * span.Inverse[axis] : Infinite;
    strides[axis] = cells;
    at += std::ptrdiff_t(cell[axis]) * cells;
    cells *= this->Cells[axis];
  }
  for (;;)
  {
    const int lower = ends[0] < ends[1] ? 0 : 1;
    const int axis = ends[lower] < ends[2] ? lower : 2;
    const double length = std::max(std::min(ends[axis], span.End) - place.Distance, 0.0);
    place.Majorant = this->Majorants[at];
    if (depth < place.Majorant * length)
    {
      place.Distance += depth / place.Majorant;
      place.IsInImage = true;
      place.Index = span.Start + place.Distance * span.Step;
      return true;
    }
    depth -= place.Majorant * length;
    place.Distance += length;
    const int turn = span.Step[axis] > 0.0 ? 1 : -1;
    cell[axis] += turn;
    if (place.Distance >= span.End || cell[axis] < 0 || cell[axis] >= this->Cells[axis])
    {
      break;
    }
    ends[axis] += this->VoxelsPerCell[axis] * std::abs(span.Inverse[axis]);
    at += turn * strides[axis];
  }
  place.Distance = span.End;
  return false;
}

//------------------------------------------------------------------------------
void VaryingMedium::Get(const Place& place, double& scattering, double& absorption) const
{
  scattering = this->Outside.Scattering;
  absorption = this->Outside.Absorption;
  if (!place.IsInImage)
  {
    return;
  }
  int voxel[3];
  Vector within;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxel[axis] = std::min(std::max(static_cast<int>(place.Index[axis]), 0),
      this->Image.GetNumbersOfVoxels()[axis] - 1);
    within[axis] = std::min(std::max(place.Index[axis] - voxel[axis], 0.0), 1.0);
  }
  if (this->Image.GetScattering().Exists())
  {
    scattering =
      this->ScatteringFactor * this->Image.GetScattering().Get(voxel, within, this->Band);
  }
  if (this->Image.GetAbsorption().Exists())
  {
    absorption =
      this->AbsorptionFactor * this->Image.GetAbsorption().Get(voxel, within, this->Band);
  }
}
} // namespace LightTransport
