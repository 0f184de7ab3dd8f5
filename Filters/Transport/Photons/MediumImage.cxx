// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Photons/MediumImage.h"

#include "Shared/BitHash.h"
#include "Shared/InputArrays.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace LightTransport
{
namespace
{
constexpr int Bands = 3;
constexpr const char* ScatteringName = "Scattering";
constexpr const char* AbsorptionName = "Absorption";

//------------------------------------------------------------------------------
std::string Describe(bool isOnPoints, const char* name)
{
  return std::string("The ") + (isOnPoints ? "point" : "cell") + " array \"" + name +
    "\" of the medium ";
}

//------------------------------------------------------------------------------
// Something near to the name of an array that is not there.
std::string Suggest(vtkImageData* image, const char* name)
{
  const std::string ofCells = InputArrays::Suggest(image->GetCellData(), name);
  return ofCells.empty() ? InputArrays::Suggest(image->GetPointData(), name) : ofCells;
}
} // namespace

//------------------------------------------------------------------------------
double MediumImage::Field::GetLargest(const int first[3], const int last[3], int band) const
{
  double largest = 0.0;
  const int more = this->IsOnPoints ? 1 : 0;
  for (int k = first[2]; k < last[2] + more; ++k)
  {
    for (int j = first[1]; j < last[1] + more; ++j)
    {
      for (int i = first[0]; i < last[0] + more; ++i)
      {
        largest = std::max(largest, this->GetValue(this->GetOffset(i, j, k), band));
      }
    }
  }
  return largest;
}

//------------------------------------------------------------------------------
Outcome MediumImage::Read(vtkImageData* image, const Frame& frame)
{
  if (const std::string problem = InputArrays::DescribeLengths(image); !problem.empty())
  {
    return Outcome::Failed("In the medium " + problem + ".");
  }
  Outcome read = this->ReadPlacement(image, frame);
  read = read ? this->ReadField(image, ScatteringName, this->Scattering) : read;
  read = read ? this->ReadField(image, AbsorptionName, this->Absorption) : read;
  if (read && !this->Scattering.Exists() && !this->Absorption.Exists())
  {
    return Outcome::Failed("The medium has neither \"Scattering\" nor \"Absorption\": give its "
                           "cells or points one of these arrays (per mm), or disconnect it.");
  }
  this->ComputeFingerprint();
  return read;
}

//------------------------------------------------------------------------------
Outcome MediumImage::ReadPlacement(vtkImageData* image, const Frame& frame)
{
  int extent[6];
  image->GetExtent(extent);
  Eigen::Matrix4d toIndex, toImage;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      toImage(row, column) = image->GetIndexToPhysicalMatrix()->GetElement(row, column);
    }
  }
  toIndex = toImage.inverse();
  bool isSolid = toIndex.allFinite();
  Vector first;
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Voxels[axis] = extent[2 * axis + 1] - extent[2 * axis];
    isSolid = isSolid && this->Voxels[axis] > 0;
    first[axis] = extent[2 * axis];
  }
  if (!isSolid)
  {
    std::ostringstream text;
    text << "The medium is flat or empty: " << this->Voxels[0] + 1 << " x " << this->Voxels[1] + 1
         << " x " << this->Voxels[2] + 1
         << " points. It needs at least 2 along each axis, and spacings that are not 0.";
    return Outcome::Failed(text.str());
  }
  const Eigen::Matrix3d axes = toIndex.topLeftCorner<3, 3>();
  this->Origin = axes * frame.Center + toIndex.topRightCorner<3, 1>() - first;
  this->Axes = axes * frame.Scale;
  this->Millimeters = frame.Millimeters;
  return Outcome::Done();
}

//------------------------------------------------------------------------------
// A cell array goes before a point array of the same name. Without either there is none.
Outcome MediumImage::ReadField(vtkImageData* image, const char* name, Field& field) const
{
  field = Field();
  vtkAbstractArray* found = image->GetCellData()->GetAbstractArray(name);
  field.IsOnPoints = found == nullptr;
  found = found ? found : image->GetPointData()->GetAbstractArray(name);
  if (!found)
  {
    const std::string suggestion = Suggest(image, name);
    return suggestion.empty()
      ? Outcome::Done()
      : Outcome::Failed(std::string("The medium has no \"") + name + "\"." + suggestion);
  }
  const std::string what = Describe(field.IsOnPoints, name);
  vtkDataArray* array = vtkDataArray::SafeDownCast(found);
  if (!array)
  {
    return Outcome::Failed(what + "holds no numbers: it must be numeric.");
  }
  field.Components = array->GetNumberOfComponents();
  if (field.Components != 1 && field.Components != Bands)
  {
    return Outcome::Failed(what + "has " + std::to_string(field.Components) +
      " components: it must have 1 (the same in all bands) or 3 (red, green, blue).");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    field.Counts[axis] = this->Voxels[axis] + (field.IsOnPoints ? 1 : 0);
  }
  const vtkIdType tuples = array->GetNumberOfTuples();
  field.Values.resize(tuples * field.Components);
  std::vector<double> tuple(field.Components);
  for (vtkIdType k = 0; k < tuples; ++k)
  {
    array->GetTuple(k, tuple.data());
    for (int component = 0; component < field.Components; ++component)
    {
      const auto value = static_cast<float>(tuple[component]);
      if (!(value >= 0.0f) || !std::isfinite(value))
      {
        std::ostringstream text;
        text << what << "is " << tuple[component] << " at " << (field.IsOnPoints ? "point" : "cell")
             << ' ' << k << ": coefficients must be finite and not negative.";
        return Outcome::Failed(text.str());
      }
      field.Values[k * field.Components + component] = value;
    }
  }
  return Outcome::Done();
}

//------------------------------------------------------------------------------
void MediumImage::ComputeFingerprint()
{
  BitHash hash;
  const auto addNumber = [&hash](double number) { hash.AddNumber(number); };
  for (const Field* field : { &this->Scattering, &this->Absorption })
  {
    hash.Add(field->Values.size());
    hash.Add(field->Components);
    hash.Add(field->IsOnPoints);
    std::for_each(field->Values.begin(), field->Values.end(), addNumber);
  }
  hash.AddAll(this->Voxels);
  std::for_each(this->Origin.data(), this->Origin.data() + 3, addNumber);
  std::for_each(this->Axes.data(), this->Axes.data() + 9, addNumber);
  hash.AddNumber(this->Millimeters);
  this->Fingerprint = hash.Get();
}
} // namespace LightTransport
