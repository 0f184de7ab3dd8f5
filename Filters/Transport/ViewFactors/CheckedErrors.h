// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * How wrong links are, by some of their rows that have been computed once more (CheckedRows). Known
 * is all that the checked patches receive wrongly, and what all others do of them; and what rows of
 * a closed scene miss of their sum, which the mean of the light tells the most of. What is left in
 * the sample of rows is as large elsewhere, on the average, and has either sign: alternatives are
 * by chance, each patch for itself, but that links that are symmetric lose and gain nothing in a
 * closed scene.
 */
#ifndef CheckedErrors_h
#define CheckedErrors_h

#include "ViewFactors/LinkDoubts.h"
#include "vtkType.h"

#include <cstddef>
#include <map>
#include <vector>

namespace LightTransport
{
class CheckedRows;
class PatchScene;
class Ranks;
struct Links;

class CheckedErrors : public LinkDoubts
{
public:
  /// `rows` have those of the sample. All must outlive this.
  CheckedErrors(const PatchScene& scene, const CheckedRows& rows, const Links& links,
    const Ranks& ranks);

  Outcome FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
    const std::vector<double>& background, std::vector<double>& differences,
    std::vector<double>& known) const override;
  std::vector<double> GetDeviations(const std::vector<double>& differences) const override;

private:
  struct Light;
  using Changes = std::map<vtkIdType, std::vector<double>>;

  double GetOpen(std::size_t patch) const;
  bool IsOpen(std::size_t patch) const;
  Changes FindChanges() const;
  Light GetLight(const std::vector<double>& radiosity, int band, int numberOfBands,
    const std::vector<double>& background) const;
  double GetWhole(vtkIdType patch, const std::vector<double>& changes, const Light& light) const;
  std::vector<double> FindKnown(const Light& light, const Changes& changes) const;
  void KeepEnergy(double total, std::vector<double>& differences) const;
  void AddAlternatives(double deviation, std::size_t band, std::size_t bands,
    std::vector<double>& differences) const;

  const PatchScene& Scene;
  const CheckedRows& Rows;
  const Links& AllLinks;
  const Ranks& AllRanks;
  double Area = 0.0;
  bool IsClosed = true; ///< the whole scene
};
} // namespace LightTransport

#endif
