// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// Numbers of polygons in a message.
#ifndef PolygonList_h
#define PolygonList_h

#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
namespace PolygonList
{
/// More are left out.
constexpr std::size_t MostNumbers = 5;

/// "3 polygons (4, 7, 12)" or "1 polygon (4)", and `text`.
inline std::string Format(const std::vector<vtkIdType>& polygons, const std::string& text)
{
  const bool isOne = polygons.size() == 1;
  std::string list = std::to_string(polygons.size()) + (isOne ? " polygon (" : " polygons (");
  for (std::size_t k = 0; k < polygons.size() && k < MostNumbers; ++k)
  {
    list += (k > 0 ? ", " : "") + std::to_string(polygons[k]);
  }
  list += polygons.size() > MostNumbers ? ", ...)" : ")";
  return list + text;
}
} // namespace PolygonList
} // namespace LightTransport

#endif
