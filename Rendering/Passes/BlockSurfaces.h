// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// The surfaces of a mapper of composite data, and what its attributes say of them.
#ifndef BlockSurfaces_h
#define BlockSurfaces_h

#include <array>
#include <vector>

class vtkMapper;
class vtkPolyData;

namespace LightTransport
{
struct BlockSurface
{
  vtkPolyData* Surface = nullptr;
  bool IsVisible = true;
  ///@{ In place of the property's, where they are set.
  bool HasOpacity = false;
  double Opacity = 1.0;
  bool HasColor = false;
  std::array<double, 3> Color = {};
  ///@}
};

/// False where the mapper is one of a single surface or of glyphs, or nothing is connected to it.
/// Otherwise all blocks that have polygons or strips, in order; what an inner block is set to holds
/// for those below.
bool FindBlockSurfaces(vtkMapper* mapper, std::vector<BlockSurface>& blocks);
} // namespace LightTransport

#endif
