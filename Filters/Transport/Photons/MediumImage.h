// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Coefficients of a medium that varies, of an image: "Scattering" (the reduced one) and
 * "Absorption" per mm, 1 or 3 components; cell arrays are constant in each voxel, point arrays
 * trilinear between its corners. Places are indices: voxel i reaches from i to i + 1, the first
 * from 0.
 */
#ifndef MediumImage_h
#define MediumImage_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

class vtkImageData;

namespace LightTransport
{
class MediumImage
{
public:
  using Vector = Eigen::Vector3d;

  /// Where photons walk: image coordinates are Center + Scale * those of the walk.
  struct Frame
  {
    Vector Center;
    double Scale;
    double Millimeters; ///< of the walk's unit
  };

  /// What one array says, 0 to as many voxels as there are along each axis.
  class Field
  {
  public:
    /// Whether the image has it.
    bool Exists() const { return !this->Values.empty(); }
    /// In a voxel, at a place from 0 to 1 in it.
    double Get(const int voxel[3], const Vector& place, int band) const;
    /// Largest value in voxels from `first` to before `last`.
    double GetLargest(const int first[3], const int last[3], int band) const;

  private:
    friend class MediumImage;
    vtkIdType GetOffset(int i, int j, int k) const
    {
      return (k * this->Counts[1] + j) * this->Counts[0] + i;
    }
    double GetValue(vtkIdType offset, int band) const
    {
      return this->Values[this->Components == 1 ? offset : 3 * offset + band];
    }

    std::vector<float> Values;
    vtkIdType Counts[3] = { 0, 0, 0 }; ///< of points or voxels along each axis
    int Components = 1;
    bool IsOnPoints = false;
  };

  /// Fails with arrays that are not coefficients, with neither of them, and for a flat image.
  Outcome Read(vtkImageData* image, const Frame& frame);

  const Field& GetScattering() const { return this->Scattering; }
  const Field& GetAbsorption() const { return this->Absorption; }
  const int* GetNumbersOfVoxels() const { return this->Voxels; }
  double GetMillimeters() const { return this->Millimeters; }

  ///@{ Of a place and a direction of the walk.
  Vector GetIndex(const Vector& position) const { return this->Origin + this->Axes * position; }
  Vector GetIndexDirection(const Vector& direction) const { return this->Axes * direction; }
  ///@}

  /// Depends on the values and where they are: what was made with another one does not serve.
  std::uint64_t GetFingerprint() const { return this->Fingerprint; }

private:
  Outcome ReadPlacement(vtkImageData* image, const Frame& frame);
  Outcome ReadField(vtkImageData* image, const char* name, Field& field) const;
  void ComputeFingerprint();

  Field Scattering;
  Field Absorption;
  int Voxels[3] = { 0, 0, 0 };
  Vector Origin = Vector::Zero(); ///< index of the walk's origin
  Eigen::Matrix3d Axes = Eigen::Matrix3d::Identity();
  double Millimeters = 1.0;
  std::uint64_t Fingerprint = 0;
};

//------------------------------------------------------------------------------
inline double MediumImage::Field::Get(const int voxel[3], const Vector& place, int band) const
{
  const vtkIdType first = this->GetOffset(voxel[0], voxel[1], voxel[2]);
  if (!this->IsOnPoints)
  {
    return this->GetValue(first, band);
  }
  const vtkIdType row = this->Counts[0];
  const vtkIdType layer = row * this->Counts[1];
  const auto along = [&](vtkIdType at)
  {
    const double value = this->GetValue(at, band);
    return value + place[0] * (this->GetValue(at + 1, band) - value);
  };
  const auto across = [&](vtkIdType at)
  {
    const double value = along(at);
    return value + place[1] * (along(at + row) - value);
  };
  const double value = across(first);
  return value + place[2] * (across(first + layer) - value);
}
} // namespace LightTransport

#endif
