// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef VectorBuffer_h
#define VectorBuffer_h

#include "Shared/Outcome.h"
#include "vtkType.h"

#include <vector>

namespace LightTransport
{
/// A buffer of OpenGL with records of as many vectors of four floats, which shaders write by
/// transform feedback and read as attributes, or read as constants after a copy of texels. In one
/// context, which is current in all calls.
class VectorBuffer
{
public:
  static constexpr int FloatsPerVector = 4;

  explicit VectorBuffer(int vectorsPerRecord) : Vectors(vectorsPerRecord) {}
  VectorBuffer(const VectorBuffer&) = delete;
  void operator=(const VectorBuffer&) = delete;

  /// Before the context goes.
  void Release();

  /// Exchange what two of the same records hold.
  void Swap(VectorBuffer& other);

  /// Room for so many records; the first `kept` stay, others are undefined.
  Outcome Reserve(vtkIdType records, vtkIdType kept);

  Outcome Upload(const std::vector<float>& values);
  void Download(vtkIdType records, std::vector<float>& values) const;

  unsigned int GetHandle() const { return this->Handle; }
  vtkIdType GetBytesPerRecord() const;
  vtkIdType GetCapacity() const { return this->Capacity; }

private:
  int Vectors;
  unsigned int Handle = 0;
  vtkIdType Capacity = 0; ///< records
};
} // namespace LightTransport

#endif
