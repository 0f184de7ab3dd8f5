// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Some rows of the view factors once more, more exactly than the links are: what these differ by is
 * how wrong links are, whatever made them. A sample of patches, in proportion to their areas, tells
 * of all; the few brightest patches send what matters most, and their rows say by reciprocity how
 * much of it arrives wrongly everywhere.
 */
#ifndef CheckedRows_h
#define CheckedRows_h

#include "Shared/Monitor.h"
#include "Shared/Outcome.h"
#include "vtkType.h"

#include <cstdint>
#include <map>
#include <vector>

namespace LightTransport
{
class PatchScene;
class Ranks;
struct Links;

class CheckedRows
{
public:
  /// The sample: a patch with twice the area comes in twice as often.
  static std::vector<vtkIdType> TakeSample(const std::vector<double>& areas);

  /// See to it that the rows of the sample are there, and those of what is brightest of a radiosity
  /// (patches x bands), exact enough to judge links. Rows of another scene, or less exact ones, are
  /// given up. Collective.
  Outcome Provide(const PatchScene& scene, const Links& links, const std::vector<double>& radiosity,
    const Ranks& ranks, const Monitor& monitor);

  /// The exchange of a patch with each other one, by patch.
  const std::map<vtkIdType, std::vector<float>>& Get() const { return this->Rows; }

private:
  static std::vector<vtkIdType> FindBrightest(const std::vector<double>& areas,
    const std::vector<double>& radiosity);
  Outcome Fill(const PatchScene& scene, const std::vector<vtkIdType>& patches, const Ranks& ranks,
    const Monitor& monitor);

  std::uint64_t Fingerprint = 0; ///< of the scene
  double Tolerance = 0.0;
  std::map<vtkIdType, std::vector<float>> Rows;
};
} // namespace LightTransport

#endif
