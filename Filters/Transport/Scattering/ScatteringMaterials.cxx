// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scattering/ScatteringMaterials.h"

#include <iterator>

namespace LightTransport
{
namespace
{
constexpr ScatteringMaterial Materials[] = {
  { "Apple", { 2.29, 2.39, 1.97 }, { 0.003, 0.0034, 0.046 }, 1.3 },
  { "Chicken1", { 0.15, 0.21, 0.38 }, { 0.015, 0.077, 0.19 }, 1.3 },
  { "Chicken2", { 0.19, 0.25, 0.32 }, { 0.018, 0.088, 0.2 }, 1.3 },
  { "Cream", { 7.38, 5.47, 3.15 }, { 0.0002, 0.0028, 0.0163 }, 1.3 },
  { "Ketchup", { 0.18, 0.07, 0.03 }, { 0.061, 0.97, 1.45 }, 1.3 },
  { "Marble", { 2.19, 2.62, 3 }, { 0.0021, 0.0041, 0.0071 }, 1.5 },
  { "Potato", { 0.68, 0.7, 0.55 }, { 0.0024, 0.009, 0.12 }, 1.3 },
  { "Skimmilk", { 0.7, 1.22, 1.9 }, { 0.0014, 0.0025, 0.0142 }, 1.3 },
  { "Skin1", { 0.74, 0.88, 1.01 }, { 0.032, 0.17, 0.48 }, 1.3 },
  { "Skin2", { 1.09, 1.59, 1.79 }, { 0.013, 0.07, 0.145 }, 1.3 },
  { "Spectralon", { 11.6, 20.4, 14.9 }, { 0, 0, 0 }, 1.3 },
  { "Wholemilk", { 2.55, 3.21, 3.77 }, { 0.0011, 0.0024, 0.014 }, 1.3 },
};
} // namespace

//------------------------------------------------------------------------------
const ScatteringMaterial* ScatteringMaterials::Find(int number)
{
  const int count = static_cast<int>(std::size(Materials));
  return number >= 1 && number <= count ? &Materials[number - 1] : nullptr;
}
} // namespace LightTransport
