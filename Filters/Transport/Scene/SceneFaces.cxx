// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/SceneFaces.h"

#include "Shared/Pulse.h"

#include <numeric>

namespace LightTransport
{
//------------------------------------------------------------------------------
SceneFaces::SceneFaces(vtkIdType numberOfPolygons, int numberOfSides,
  const std::vector<vtkIdType>& faces, const std::vector<double>& areas)
  : NumberOfPolygons(numberOfPolygons), NumberOfSides(numberOfSides), OfPatches(faces),
    Offsets(numberOfPolygons * numberOfSides + 1, 0), Patches(faces.size()),
    Areas(numberOfPolygons * numberOfSides, 0.0), Shares(faces.size())
{
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    Pulse::Beat(patch);
    ++this->Offsets[faces[patch] + 1];
    this->Areas[faces[patch]] += areas[patch];
  }
  std::partial_sum(this->Offsets.begin(), this->Offsets.end(), this->Offsets.begin());
  std::vector<vtkIdType> next(this->Offsets.begin(), this->Offsets.end() - 1);
  for (std::size_t patch = 0; patch < faces.size(); ++patch)
  {
    Pulse::Beat(patch);
    this->Patches[next[faces[patch]]++] = static_cast<vtkIdType>(patch);
    this->Shares[patch] = areas[patch] / this->Areas[faces[patch]];
  }
}

//------------------------------------------------------------------------------
std::string SceneFaces::Describe(vtkIdType face) const
{
  return (this->GetSide(face) == 0 ? "polygon " : "the back of polygon ") +
    std::to_string(this->GetPolygon(face));
}

//------------------------------------------------------------------------------
std::vector<double> SceneFaces::GetMeans(const std::vector<double>& values, int components) const
{
  std::vector<double> means(this->GetNumberOfFaces() * components, 0.0);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    const auto patch = static_cast<vtkIdType>(k) / components;
    means[this->OfPatches[patch] * components + k % components] += this->Shares[patch] * values[k];
  }
  return means;
}
} // namespace LightTransport
