// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Mappers of one surface, which take extra arrays: those of composite data do not.
#ifndef PlainMapper_h
#define PlainMapper_h

#include "vtkPolyDataMapper.h"

namespace LightTransport
{
/// nullptr where the mapper is no such one, or nothing is connected to it.
inline vtkPolyDataMapper* FindPlainMapper(vtkMapper* mapper)
{
  auto* plain = vtkPolyDataMapper::SafeDownCast(mapper);
  return plain && !plain->IsA("vtkCompositePolyDataMapper") &&
      !plain->IsA("vtkCompositePolyDataMapper2") && plain->GetNumberOfInputConnections(0) > 0
    ? plain
    : nullptr;
}

/// Of glyphs the input is where they are, and not what is drawn.
inline bool DrawsItsInput(vtkMapper* mapper)
{
  return !mapper->IsA("vtkGlyph3DMapper");
}
} // namespace LightTransport

#endif
