// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// What the irradiance of polygons may be off by: summaries, and what users should know.
#ifndef LightErrors_h
#define LightErrors_h

#include "vtkType.h"

#include <string>
#include <vector>

namespace LightTransport
{
class PatchScene;

class LightErrors
{
public:
  /// Irradiance of all patches and its standard errors, each with LightBands components, and what
  /// Tolerance counts from (LightSum::Unshadowed, of the brightest band).
  LightErrors(const PatchScene& scene, const std::vector<double>& incident,
    const std::vector<double>& errors, const std::vector<double>& unshadowed);

  /// Of all polygons together: root mean squares over the area, of the band where it is largest.
  double GetTotal() const;
  /// Of the polygon where it is largest, as Tolerance counts it.
  double GetLargest() const { return this->GetRelative(this->Worst); }

  /// Where a tolerance was not reached, and what `property` does about it; empty where it was.
  std::string Describe(double tolerance, const std::string& property) const;

private:
  double GetRelative(vtkIdType polygon) const;

  const PatchScene& Scene;
  ///@{ of each polygon
  std::vector<double> Incident;
  std::vector<double> Errors;
  std::vector<double> Unshadowed;
  ///@}
  vtkIdType Worst = 0;
};
} // namespace LightTransport

#endif
