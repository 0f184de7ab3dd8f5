// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What looks like a mistake in a thermal scene, though the equation has a solution.
#ifndef ThermalDoubts_h
#define ThermalDoubts_h

#include <string>
#include <vector>

namespace LightTransport
{
class EnclosureVerdict;
class PatchScene;
struct RadiosityMaterials;

namespace ThermalDoubts
{
/// Adds a line for each: temperatures that look like degrees Celsius, a sky at 0 K, and power
/// (`netPower`, in the input's unit of area) that a closed scene loses.
void Add(const RadiosityMaterials& materials, const PatchScene& scene,
  const EnclosureVerdict& verdict, double netPower, std::vector<std::string>& warnings);
} // namespace ThermalDoubts
} // namespace LightTransport

#endif
