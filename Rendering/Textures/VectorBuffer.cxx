// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Textures/VectorBuffer.h"

#include "Context/OpenGLFunctions.h"
#include "Device/DeviceErrors.h"
#include "Shared/TransportMemory.h"

#include <utility>

namespace LightTransport
{
//------------------------------------------------------------------------------
void VectorBuffer::Release()
{
  if (this->Handle != 0)
  {
    glDeleteBuffers(1, &this->Handle);
  }
  this->Handle = 0;
  this->Capacity = 0;
}

//------------------------------------------------------------------------------
void VectorBuffer::Swap(VectorBuffer& other)
{
  std::swap(this->Handle, other.Handle);
  std::swap(this->Capacity, other.Capacity);
}

//------------------------------------------------------------------------------
vtkIdType VectorBuffer::GetBytesPerRecord() const
{
  return static_cast<vtkIdType>(sizeof(float)) * FloatsPerVector * this->Vectors;
}

//------------------------------------------------------------------------------
Outcome VectorBuffer::Reserve(vtkIdType records, vtkIdType kept)
{
  if (records <= this->Capacity)
  {
    return Outcome::Done();
  }
  // Drivers end the process where memory is refused to them.
  const vtkIdType bytes = records * this->GetBytesPerRecord();
  if (!TransportMemory::IsWithinLimits(static_cast<double>(bytes)))
  {
    return Outcome::Failed("out of memory");
  }
  unsigned int larger = 0;
  glGenBuffers(1, &larger);
  glBindBuffer(GL_COPY_WRITE_BUFFER, larger);
  glBufferData(GL_COPY_WRITE_BUFFER, bytes, nullptr, GL_DYNAMIC_COPY);
  if (kept > 0)
  {
    glBindBuffer(GL_COPY_READ_BUFFER, this->Handle);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, 0, 0,
      kept * this->GetBytesPerRecord());
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
  }
  glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  this->Release();
  this->Handle = larger;
  this->Capacity = records;
  return DeviceErrors::Check();
}

//------------------------------------------------------------------------------
Outcome VectorBuffer::Upload(const std::vector<float>& values)
{
  const auto records = static_cast<vtkIdType>(values.size()) / (this->Vectors * FloatsPerVector);
  Outcome reserved = this->Reserve(records, 0);
  if (reserved && records > 0)
  {
    glBindBuffer(GL_COPY_WRITE_BUFFER, this->Handle);
    glBufferSubData(GL_COPY_WRITE_BUFFER, 0, records * this->GetBytesPerRecord(), values.data());
    glBindBuffer(GL_COPY_WRITE_BUFFER, 0);
  }
  return reserved;
}

//------------------------------------------------------------------------------
void VectorBuffer::Download(vtkIdType records, std::vector<float>& values) const
{
  values.resize(static_cast<std::size_t>(records * this->Vectors * FloatsPerVector));
  if (records > 0)
  {
    glBindBuffer(GL_COPY_READ_BUFFER, this->Handle);
    glGetBufferSubData(GL_COPY_READ_BUFFER, 0, records * this->GetBytesPerRecord(), values.data());
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
  }
}
} // namespace LightTransport
