// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The mappers that have been asked to hand a point array to their shaders, as the attribute
 * RadianceShader::Attribute of vertices. Mapping an array makes a mapper upload everything anew, so
 * it is done once.
 */
#ifndef MappedArrays_h
#define MappedArrays_h

#include "vtkTimeStamp.h"
#include "vtkWeakPointer.h"

#include <functional>
#include <map>
#include <string>

class vtkActor;
class vtkPolyDataMapper;
class vtkRenderState;

namespace LightTransport
{
class MappedArrays
{
public:
  MappedArrays() = default;
  ~MappedArrays() { this->Unmap(); }
  MappedArrays(const MappedArrays&) = delete;
  void operator=(const MappedArrays&) = delete;

  /// Asks the mappers of all props that have the point array `getName`(actor) with 1, 3 or 4
  /// components, and takes back what others were asked for; no name leaves an actor out. False
  /// where no prop has it.
  bool Map(const vtkRenderState* state, const std::function<std::string(vtkActor*)>& getName);

  /// Takes back what all mappers have been asked for.
  void Unmap();

  /// Of the array that a mapper hands to its shaders, found by its address; 0 without one.
  int GetNumberOfComponents(const void* mapper) const;

  /// When a mapper was last asked, so that shaders have to be made anew.
  vtkMTimeType GetMTime() const { return this->Time.GetMTime(); }

private:
  struct Drawing
  {
    vtkWeakPointer<vtkPolyDataMapper> Mapper;
    std::string ArrayName;
    int Components = 0;
  };

  void ForgetDeadMappers();
  void Map(vtkPolyDataMapper* mapper, const std::string& arrayName, int components);

  std::map<const void*, Drawing> Drawings;
  vtkTimeStamp Time;
};
} // namespace LightTransport

#endif
