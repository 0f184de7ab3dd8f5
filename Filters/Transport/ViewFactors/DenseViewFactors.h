// SPDX-FileCopyrightText: Copyright (c) the vtkLightTransport authors
// SPDX-License-Identifier: BSD-3-Clause
/// View factors for all pairs of patches, in an exchange matrix: the exchange to a tolerance of
/// each row (ViewFactorAssembly), openings, and where it is asked for the closure of the rows.
#ifndef DenseViewFactors_h
#define DenseViewFactors_h

#include "Links/LinkBuilder.h"
#include "vtkExchangeMatrix.h"
#include "vtkSmartPointer.h"

#include <vector>

namespace LightTransport
{
class DenseViewFactors : public LinkBuilder
{
public:
  /// `senders` tells which patches send anything, empty for all: pairs of which neither does are
  /// left out, and openings are known by a few rays then. A closure needs whole rows and all
  /// senders.
  DenseViewFactors(double tolerance, bool enforceClosure, std::vector<bool> senders);

  /// The rows and columns of these patches alone, in this rank's part of a matrix, to the
  /// tolerance. Collective.
  static Outcome FillRows(const PatchScene& scene, double tolerance,
    const std::vector<bool>& patches, const Ranks& ranks, const Monitor& monitor,
    vtkSmartPointer<vtkExchangeMatrix>& matrix);

  LinkKey GetKey() const override;
  Outcome Build(const PatchScene& scene, const Ranks& ranks, const Monitor& monitor,
    Links& links) const override;

private:
  double Tolerance;
  bool EnforceClosure;
  std::vector<bool> Senders;
};
} // namespace LightTransport

#endif
