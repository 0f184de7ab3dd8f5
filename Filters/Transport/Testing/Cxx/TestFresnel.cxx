// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
// What a smooth surface reflects: known angles, and means against exact integrals.
#include "LightTransportTesting.h"
#include "Shared/Fresnel.h"

using namespace LightTransport;

using namespace LightTransportTesting;

namespace
{
/// Index, mean internal reflectance (Egan and Hilgeman), exact mean external reflectance.
const double Means[][3] = { { 1.0001, 0.001923, 0.000033 }, { 1.1, 0.193424, 0.025157 },
  { 1.2, 0.336073, 0.044280 }, { 1.3, 0.444845, 0.061132 }, { 1.33, 0.472439, 0.065931 },
  { 1.35, 0.489743, 0.069081 }, { 1.4, 0.529569, 0.076812 }, { 1.5, 0.596811, 0.091778 },
  { 1.6, 0.651087, 0.106246 }, { 2.0, 0.790275, 0.160597 } };

//------------------------------------------------------------------------------
void TestMeans()
{
  for (const auto& mean : Means)
  {
    const std::string what = "index " + std::to_string(mean[0]);
    Check(std::abs(Fresnel::GetMeanInternalReflectance(mean[0]) - mean[1]) < 5.1e-7,
      what + " internal");
    Check(std::abs(Fresnel::GetMeanExternalReflectance(mean[0]) - mean[2]) < 5.1e-7,
      what + " external");
  }
  Check(Fresnel::GetMeanInternalReflectance(1.0) == 0.0, "index 1 internal");
  Check(Fresnel::GetMeanExternalReflectance(1.0) == 0.0, "index 1 external");
}

//------------------------------------------------------------------------------
void TestAngles()
{
  Check(Fresnel::GetTransmittance(0.3, 1.0) == 1.0, "index 1 transmits all");
  Check(Fresnel::GetReflectance(0.3, 1.0) == 0.0, "index 1 reflects nothing");
  Check(Fresnel::GetReflectance(0.0, 1.5) == 1.0, "light along the surface is reflected");
  CheckClose(Fresnel::GetTransmittance(1.0, 1.5), 0.96, 1e-14, "normal incidence");
  // Brewster's angle: only the perpendicular half is reflected.
  const double brewster = std::cos(std::atan(1.5));
  const double reflected = (1.0 - 1.5 * 1.5) / (1.0 + 1.5 * 1.5);
  CheckClose(Fresnel::GetTransmittance(brewster, 1.5), 1.0 - 0.5 * reflected * reflected, 1e-14,
    "Brewster's angle");
}
} // namespace

//------------------------------------------------------------------------------
int TestFresnel(int, char*[])
{
  TestMeans();
  TestAngles();
  return Result();
}
