// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Lighting/LightErrors.h"

#include "Lighting/LightSource.h"
#include "Scene/PatchScene.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace LightTransport
{
//------------------------------------------------------------------------------
LightErrors::LightErrors(const PatchScene& scene, const std::vector<double>& incident,
  const std::vector<double>& errors, const std::vector<double>& unshadowed)
  : Scene(scene), Incident(scene.GetFaces().GetMeans(incident, LightBands)),
    Errors(scene.GetFaces().GetMeans(errors, LightBands)),
    Unshadowed(scene.GetFaces().GetMeans(unshadowed, 1))
{
  for (vtkIdType polygon = 1; polygon < scene.GetFaces().GetNumberOfPolygons(); ++polygon)
  {
    this->Worst =
      this->GetRelative(polygon) > this->GetRelative(this->Worst) ? polygon : this->Worst;
  }
}

//------------------------------------------------------------------------------
double LightErrors::GetRelative(vtkIdType polygon) const
{
  const double* error = &this->Errors[polygon * LightBands];
  const double largest = *std::max_element(error, error + LightBands);
  return largest > 0.0 ? largest / this->Unshadowed[polygon] : 0.0;
}

//------------------------------------------------------------------------------
double LightErrors::GetTotal() const
{
  double total = 0.0;
  for (int band = 0; band < LightBands; ++band)
  {
    double squares = 0.0;
    double errors = 0.0;
    for (vtkIdType polygon = 0; polygon < this->Scene.GetFaces().GetNumberOfPolygons(); ++polygon)
    {
      const double area = this->Scene.GetFaces().GetArea(polygon);
      squares += area * std::pow(this->Incident[polygon * LightBands + band], 2);
      errors += area * std::pow(this->Errors[polygon * LightBands + band], 2);
    }
    total = std::max(total, squares > 0.0 ? std::sqrt(errors / squares) : 0.0);
  }
  return total;
}

//------------------------------------------------------------------------------
std::string LightErrors::Describe(double tolerance, const std::string& property) const
{
  const vtkIdType polygons = this->Scene.GetFaces().GetNumberOfPolygons();
  vtkIdType count = 0;
  for (vtkIdType polygon = 0; polygon < polygons; ++polygon)
  {
    count += this->GetRelative(polygon) > tolerance ? 1 : 0;
  }
  if (count == 0)
  {
    return {};
  }
  const LitPatch::Vector place = this->Scene.GetCenter() +
    this->Scene.GetScale() * this->Scene.GetCentroid(this->Scene.GetPatch(this->Worst));
  const double* error = &this->Errors[this->Worst * LightBands];
  const auto band = std::max_element(error, error + LightBands) - error;
  std::ostringstream text;
  text << "Tolerance " << tolerance << " was not reached on " << count << " of " << polygons
       << " polygons. It is worst at polygon " << this->Worst << " near (" << place.x() << ", "
       << place.y() << ", " << place.z() << "): the irradiance there is "
       << this->Incident[this->Worst * LightBands + band] << ", give or take " << error[band]
       << ". Raise " << property
       << " or Tolerance; the cell array \"DirectIrradianceError\" tells the error everywhere.";
  return text.str();
}
} // namespace LightTransport
