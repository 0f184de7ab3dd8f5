// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What links may be wrong by, as differences of the irradiance that they give of a radiosity: one
 * part that is known with its sign, and several alternatives of what is not. What one patch sends
 * wrongly all others receive, so alternatives are kept apart until the equation has been solved for
 * each of them (SolutionErrors); their spread is then the error.
 */
#ifndef LinkDoubts_h
#define LinkDoubts_h

#include "Shared/Outcome.h"

#include <vector>

namespace LightTransport
{
class LinkDoubts
{
public:
  /// How many alternatives there are.
  static constexpr int Groups = 8;

  virtual ~LinkDoubts() = default;

  /**
   * For a radiosity (patches x bands), and the irradiance that enters through openings where there
   * is nothing else (one per band; empty: none): the differences of the irradiance, patches x
   * groups x bands; what is known, if anything is, is added to `known`, patches x bands.
   * Collective.
   */
  virtual Outcome FindDifferences(const std::vector<double>& radiosity, int numberOfBands,
    const std::vector<double>& background, std::vector<double>& differences,
    std::vector<double>& known) const = 0;

  /// Standard errors, patches x bands, from differences like those above.
  virtual std::vector<double> GetDeviations(const std::vector<double>& differences) const = 0;

protected:
  LinkDoubts() = default;
  LinkDoubts(const LinkDoubts&) = default;
  LinkDoubts& operator=(const LinkDoubts&) = default;
};
} // namespace LightTransport

#endif
